"""clients/osl in Cycles: compiled by Blender's oslc, against the lookup of clients/README.md."""

from pathlib import Path

import numpy as np
import pytest

from blender_process import ROOT, blender_jobs, linear_pixels, packed_add_on, sphere_cosines
from lut_contract import POINTS, LookupTexture, write_contract_table

CLOSURE = ROOT / "clients" / "osl" / "nacreous_film_surface.osl"
FILES = {"R": "contract.exr", "T": "contract.transmission.exr"}
SCALE, PIXELS = 0.83, 48
TOP, BOTTOM = 0.55, 1.45


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return where Blender has rendered strips of R and T, and a sphere of R alone."""
    folder = tmp_path_factory.mktemp("osl")
    path = write_contract_table(folder)
    (folder / "opaque.exr").write_bytes(path.read_bytes())
    strip = {"job": "read_strip", "path": str(path), "reader": "OSL", "points": POINTS.tolist()}
    strips = [strip | {"output": name, "picture": str(folder / f"strip {name}.exr")} for name in FILES]
    sphere = {
        "job": "render_sphere_by_shader",
        "path": str(folder / "opaque.exr"),
        "thickness_scale": SCALE,
        "pixels": PIXELS,
        "picture": str(folder / "sphere.exr"),
    }
    closures = [
        sphere
        | {"job": "render_sphere_of_closure", "closure": str(CLOSURE), "ior": 1.5, "samples": samples}
        | {"path": str(folder / f"{name}.exr"), "picture": str(folder / f"closure {name}.exr")}
        for name, samples in {"opaque": 1, "contract": 64}.items()
    ]
    draining = {
        "job": "render_draining_sphere",
        "path": str(folder / "opaque.exr"),
        "closure": str(CLOSURE),
        "thickness_scale": (TOP, BOTTOM),
        "roughness": 0,
        "surroundings": "white",
        "pixels": PIXELS,
        "samples": 1,
        "picture": str(folder / "draining.exr"),
    }
    install = {"job": "install", "archive": str(packed_add_on(folder))}
    jobs = [install, *strips, sphere, *closures, draining]
    blender_jobs(jobs, folder)
    return folder


@pytest.mark.parametrize("side", FILES)
def test_the_shader_reads_the_contract(side: str, folder: Path) -> None:
    """At the contract's points, in Cycles: rms within 1e-4 of the lookup, the mean error within 1 %."""
    got = linear_pixels(folder / f"strip {side}.exr")[0]
    expected = LookupTexture.read(folder / FILES[side]).at(*POINTS.T)
    assert np.sqrt(np.mean((got - expected) ** 2)) <= 1e-4
    assert np.abs(got - expected).mean() <= 0.01 * expected.mean()


@pytest.mark.parametrize("picture", ["sphere.exr", "closure opaque.exr"])
def test_a_sphere_has_the_colour_of_each_angle(picture: str, folder: Path) -> None:
    """The shader's own cosine, and the closure: a smooth sphere in a white world has R, mean within 1 %."""
    cos_theta, inside = sphere_cosines(PIXELS)
    table = LookupTexture.read(folder / "opaque.exr")
    expected = table.at(cos_theta[inside], np.full(inside.sum(), SCALE))
    got = linear_pixels(folder / picture)[inside]
    assert np.abs(got - expected.clip(min=0)).mean() <= 0.01 * expected.mean()


def test_a_draining_film_has_the_colour_of_each_angle_and_thickness(folder: Path) -> None:
    """Both shaders together, the thickness growing from the top of the sphere: mean within 1 %."""
    cos_theta, inside = sphere_cosines(PIXELS)
    down = (np.arange(PIXELS) + 0.5) / PIXELS
    scale = np.broadcast_to((TOP + (BOTTOM - TOP) * down)[:, None], inside.shape)
    expected = LookupTexture.read(folder / "opaque.exr").at(cos_theta[inside], scale[inside])
    got = linear_pixels(folder / "draining.exr")[inside]
    assert np.abs(got - expected.clip(min=0)).mean() <= 0.01 * expected.mean()


def test_the_closure_on_glass_vanishes_in_a_white_world(folder: Path) -> None:
    """R + T = 1 on both sides of a film that does not absorb: 1 to within 1 % of noise."""
    inside = sphere_cosines(PIXELS)[1]
    got = linear_pixels(folder / "closure contract.exr")[inside].mean(axis=0)
    np.testing.assert_allclose(got, 1, rtol=0, atol=0.01)
