"""The scenes for Mitsuba's own `measured` and `measured_polarized`, rendered by Mitsuba's own program."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nacreous
from mitsuba_plugin import CLIENT, FloatArray, table_file, use_variant
from mitsuba_surface import variant_fault
from nacreous.formats import registry

ALPHA = 0.15
STACK = {
    "incident": "air",
    "substrate": "main/Ti/Johnson",
    "layers": [{"material": "anodic-titanium-dioxide", "thickness_nm": 45.0}],
}
SURFACE = {"distribution": "ggx", "masking": "smith-separable", "alpha_x": ALPHA}
"""With the masking of Mitsuba's own surfaces."""
RANGE_NM = {"start": 380, "stop": 750, "step": 10}
HEIGHT, SAMPLES = 48, 512


def measured_file(folder: Path, suffix: str) -> Path:
    """Tabulate anodised titanium as a measured material; skip where this version has no such format."""
    if suffix not in {form.suffix for form in registry.FORMATS.values()}:
        pytest.skip(f"this version of Nacreous has no format whose files end in {suffix}")
    table = {"quantity": "bsdf", "wavelength_nm": RANGE_NM}
    spec = {"stack": STACK, "surface": SURFACE, "table": table}
    return nacreous.write(nacreous.tabulate(spec), folder / f"film{suffix}")[0]


def rendered(scene: str, variant: str, film: Path) -> FloatArray:
    """Render a scene of the client by the program `mitsuba`: channels (H, W, C)."""
    picture = film.with_name("picture.exr")
    program = Path(sys.executable).with_name("mitsuba")
    sizes = ["-D", f"height={HEIGHT}", "-D", f"samples={SAMPLES}"]
    subprocess.run(
        [program, "-m", variant, "-D", f"film={film}", *sizes, "-o", picture, CLIENT / scene],
        check=True,
        capture_output=True,
    )
    return read_exr(picture)


def read_exr(file: Path) -> FloatArray:
    """Return the channels, (H, W, C)."""
    import OpenImageIO

    image = OpenImageIO.ImageInput.open(str(file))
    return np.asarray(image.read_image(OpenImageIO.FLOAT), np.float64)


def rendered_by_the_plugin(scene: str, film: Path) -> FloatArray:
    """Render the same scene with a lookup texture in the plugin instead of the measured material."""
    import mitsuba as mi

    text, parts = re.subn(
        r'<bsdf type="measured">.*?</bsdf>',
        f'<bsdf type="nacreous"><string name="filename" value="{film}"/>'
        f'<float name="alpha" value="{ALPHA}"/></bsdf>',
        (CLIENT / scene).read_text(encoding="utf-8"),
        flags=re.DOTALL,
    )
    assert parts == 1
    sizes: dict[str, Any] = {"height": str(HEIGHT), "samples": str(SAMPLES)}
    text = text.replace("measured_studio.xml", str(CLIENT / "measured_studio.xml"))
    return np.array(mi.render(mi.load_string(text, **sizes)), np.float64)


@pytest.mark.parametrize(
    ("scene", "variant", "suffix"),
    [
        ("measured_spectral.xml", "llvm_ad_spectral", ".bsdf"),
        ("measured_rgb.xml", "llvm_ad_rgb", ".rgb.bsdf"),
    ],
)
def test_a_measured_sphere_looks_like_the_lookup_texture(
    scene: str, variant: str, suffix: str, tmp_path: Path
) -> None:
    """Two ways to render one surface: the pictures differ by less than 2 % on average, noise included."""
    use_variant(variant)
    film = measured_file(tmp_path, suffix)
    table = {"wavelength_nm": RANGE_NM, "cos_theta": 129}
    texture = table_file(tmp_path, variant, {"stack": STACK, "table": table}, "texture")
    got, expected = rendered(scene, variant, film)[..., :3], rendered_by_the_plugin(scene, texture)[..., :3]
    on_sphere = sphere_mask()
    assert np.abs(got.mean(axis=2) - expected.mean(axis=2))[on_sphere].mean() <= (
        0.03 * expected[on_sphere].mean()
    )
    np.testing.assert_allclose(got[on_sphere].mean(axis=0), expected[on_sphere].mean(axis=0), rtol=0.01)


def sphere_mask() -> np.ndarray:
    """Return which pixels see the sphere alone: it fills most of the picture around its middle."""
    y, x = (np.mgrid[:HEIGHT, :HEIGHT] + 0.5) / HEIGHT * 2 - 1
    return np.hypot(x, y) < 0.6


def test_a_polarised_sphere_has_stokes_vectors(tmp_path: Path) -> None:
    """Light is polarised in part: S1² + S2² + S3² is between 0 and S0², whatever surface reflects it."""
    variant = "scalar_spectral_polarized"
    if fault := variant_fault(variant):
        pytest.skip(fault)
    channels = rendered("measured_polarized.xml", variant, measured_file(tmp_path, ".pbsdf"))
    stokes = channels[..., -12:].reshape(HEIGHT, HEIGHT, 4, 3).mean(axis=-1)[sphere_mask()]
    polarised = np.linalg.norm(stokes[:, 1:], axis=1)
    assert (stokes[:, 0] > 0).all()
    assert (polarised <= stokes[:, 0] * 1.001).all()
    assert (polarised > 0.01 * stokes[:, 0]).mean() > 0.5
