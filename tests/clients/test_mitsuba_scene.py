"""The BSDF plugin for Mitsuba in pictures, rendered: pixels are the table, and the example runs."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nacreous
from lut_contract import CONTRACT_SPEC, LookupTexture
from mitsuba_plugin import CLIENT, FloatArray, film, table_file, use_variant
from mitsuba_surface import variant_fault

VARIANT = "llvm_ad_rgb"
SIZE = 48
SUBPIXELS = 16
"""To average the table over a pixel, in each direction."""
SUBSTRATE_INDEX = 1.5 / 1.000277
"""Of the contract's glass, relative to its air."""


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the contract's table, R with T beside it."""
    use_variant(VARIANT)
    return table_file(tmp_path_factory.mktemp("scene"), VARIANT, CONTRACT_SPEC)


@pytest.fixture(scope="module")
def opaque_table(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the same without T."""
    use_variant(VARIANT)
    file = table_file(tmp_path_factory.mktemp("opaque"), VARIANT, CONTRACT_SPEC)
    file.with_name("film.transmission.exr").unlink()
    return file


def picture(shape: dict[str, Any], sensor: dict[str, Any], samples: int) -> FloatArray:
    """Render a shape in a white room: linear colours (H, W, 3)."""
    import mitsuba as mi

    pixels = {"type": "hdrfilm", "width": SIZE, "height": SIZE, "rfilter": {"type": "box"}}
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 3},
        "light": {"type": "constant"},
        "shape": shape,
        "sensor": {**sensor, "film": {**pixels, "pixel_format": "rgb"}},
    }
    return np.array(mi.render(mi.load_dict(scene), spp=samples), np.float64)


def places() -> tuple[FloatArray, FloatArray]:
    """Return x and y of the points of all pixels, -1 to 1 over the picture: (H, W, points)."""
    at = (np.arange(SIZE * SUBPIXELS) + 0.5) / (SIZE * SUBPIXELS) * 2 - 1
    x, y = (grid.reshape(SIZE, SUBPIXELS, SIZE, SUBPIXELS) for grid in np.meshgrid(at, at))
    return tuple(grid.transpose(0, 2, 1, 3).reshape(SIZE, SIZE, -1) for grid in (x, y))


def looked_up(file: Path, cos_theta: FloatArray, thickness_scale: float) -> FloatArray:
    """Return the table's colours, averaged over each pixel: (H, W, 3)."""
    flat = cos_theta.ravel()
    colours = LookupTexture.read(file).at(flat, np.full_like(flat, thickness_scale))
    return colours.reshape(*cos_theta.shape, 3).mean(axis=2)


@pytest.mark.parametrize("thickness_scale", [0.6, 1.37])
def test_a_sphere_in_a_white_room_has_the_table_s_colours(opaque_table: Path, thickness_scale: float) -> None:
    """A mirror that sees white everywhere has the colour R at the cosine of its normal, pixel by pixel."""
    use_variant(VARIANT)
    import mitsuba as mi

    sphere = {"type": "sphere", "bsdf": film(opaque_table, thickness_scale=thickness_scale)}
    view = mi.ScalarTransform4f().look_at([0, 0, 3], [0, 0, 0], [0, 1, 0])
    got = picture(sphere, {"type": "orthographic", "to_world": view}, samples=256)
    x, y = places()
    radius_2 = x**2 + y**2
    expected = looked_up(opaque_table, np.sqrt(np.clip(1 - radius_2, 0, 1)), thickness_scale)
    inside = radius_2.max(axis=2) < 0.95
    error = np.abs(got - expected)[inside]
    assert error.mean() <= 0.01 * expected[inside].mean()


def test_a_pane_in_a_white_room_shows_both_lobes(table: Path) -> None:
    """Radiance 1 above and below: R of the one, and T of the other over the square of the index."""
    use_variant(VARIANT)
    import mitsuba as mi

    pane = {"type": "rectangle", "to_world": mi.ScalarTransform4f().scale(100), "bsdf": film(table)}
    view = mi.ScalarTransform4f().look_at([0, -2, 1.2], [0, 0, 0], [0, 0, 1])
    got = picture(pane, {"type": "perspective", "fov": 40, "to_world": view}, samples=4096)
    expected = looked_up(table, pane_cosines(), 1.0)
    transmitted = looked_up(table.with_name("film.transmission.exr"), pane_cosines(), 1.0)
    expected = expected + transmitted / SUBSTRATE_INDEX**2
    assert np.abs(got - expected).mean() <= 0.01 * expected.mean()


def pane_cosines() -> FloatArray:
    """Return the cosines at which the perspective camera above sees the plane z = 0."""
    x, y = places()
    forward = np.array([0, 2, -1.2]) / np.hypot(2, 1.2)
    up = np.array([0, 1.2, 2]) / np.hypot(2, 1.2)
    half = np.tan(np.radians(20))
    rays = forward + half * (x[..., None] * np.array([1, 0, 0]) - y[..., None] * up)
    return -rays[..., 2] / np.linalg.norm(rays, axis=-1)


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral"])
def test_the_example_renders_spheres(variant: str, tmp_path: Path) -> None:
    """The README's program, in a process of its own: a smooth and a rough sphere, finite and coloured."""
    if fault := variant_fault(variant):
        pytest.skip(fault)
    file = table_file(tmp_path, variant, CONTRACT_SPEC)
    arguments = [*map(str, (file, file)), "--alpha", "0", "0.2", "--thickness-scale", "0.5", "1.5"]
    small = ["--height", "40", "--samples", "40", "-o", str(tmp_path / "spheres.exr")]
    subprocess.run(
        [sys.executable, CLIENT / "scene.py", *arguments, *small], check=True, env=dict(os.environ)
    )
    pixels = read_exr(tmp_path / "spheres.exr")
    assert pixels.shape == (40, 76, 3)
    assert np.isfinite(pixels).all()
    grey = pixels.mean(axis=-1, keepdims=True)
    saturation = np.abs(pixels - grey).max(axis=-1) / grey[..., 0]
    assert (saturation > 0.1).mean() > 0.05


def readme_block(language: str) -> str:
    """Return the first block of the README in a language."""
    text = (CLIENT / "README.md").read_text(encoding="utf-8")
    return re.search(rf"```{language}\n(.*?)```", text, re.DOTALL)[1]


def test_the_readme_s_python_runs(tmp_path: Path) -> None:
    """Its first example, in a process of its own, after the command above it, has a sphere of that film."""
    if fault := variant_fault("llvm_ad_spectral"):
        pytest.skip(fault)
    nacreous.write(
        nacreous.tabulate(nacreous.preset("anodised-titanium")), tmp_path / "anodised-titanium.spectral.exr"
    )
    environment = os.environ | {"PYTHONPATH": str(CLIENT)}
    program = readme_block("python") + "\nprint(mi.traverse(scene))"
    done = subprocess.run(
        [sys.executable, "-c", program], check=True, cwd=tmp_path, env=environment, capture_output=True
    )
    assert b"ball.bsdf.thickness_scale" in done.stdout


def test_the_readme_s_xml_loads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its first example, with a texture of the thickness beside it."""
    use_variant("llvm_ad_spectral")
    import mitsuba as mi

    nacreous.write(
        nacreous.tabulate(nacreous.preset("anodised-titanium")), tmp_path / "anodised-titanium.spectral.exr"
    )
    mi.Bitmap(np.full((2, 2, 1), 0.4, np.float32)).write(str(tmp_path / "thickness.exr"))
    monkeypatch.chdir(tmp_path)
    bsdf = mi.load_string(readme_block("xml").replace("<bsdf", '<bsdf version="3.0.0"', 1))
    assert "thickness_scale.data" in mi.traverse(bsdf)


def read_exr(file: Path) -> FloatArray:
    """Return the pixels, (H, W, 3)."""
    import OpenImageIO

    image = OpenImageIO.ImageInput.open(str(file))
    return np.asarray(image.read_image(OpenImageIO.FLOAT), np.float64)[..., :3]
