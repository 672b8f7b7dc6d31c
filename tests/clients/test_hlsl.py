"""The HLSL of Unreal Engine and Unity, translated by glslang and SPIRV-Cross and run in a browser's WebGL."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import nacreous
from hlsl_host import ENGINES, Sphere, draw_sphere, hlsl_page, read_points
from lut_contract import CONTRACT_SPEC, POINTS, FloatArray, LookupTexture, write_contract_table
from web_page import WebPage

ROUNDING = {"RGBA32F": 1e-4, "RGBA16F": 5e-4}
"""Formats that the clients' pages name, and what their texels may add to the mean error, as a share."""


@pytest.fixture(scope="module")
def page() -> Iterator[WebPage]:
    """Open the page that runs fragment shaders."""
    with hlsl_page() as opened:
        yield opened


@pytest.fixture(scope="module")
def soap(tmp_path_factory: pytest.TempPathFactory) -> LookupTexture:
    """Return the table of a film in all colours, with as many rows and columns as presets have."""
    table = nacreous.tabulate(nacreous.preset("soap-bubble"))
    return LookupTexture.read(nacreous.write(table, tmp_path_factory.mktemp("soap") / "soap.exr")[0])


@pytest.mark.parametrize("name", ENGINES)
@pytest.mark.parametrize("suffix", [".exr", ".transmission.exr"])
def test_reads_the_contract_table(page: WebPage, name: str, suffix: str, tmp_path: Path) -> None:
    """The function agrees with the lookup of clients/README.md at its points, and beyond the axes."""
    texture = LookupTexture.read(write_contract_table(tmp_path).with_suffix(suffix))
    points = np.vstack([POINTS, [(-0.5, 0.2), (1.5, 2.0)]])
    got = read_points(page, ENGINES[name], texture, points, tmp_path)
    np.testing.assert_allclose(got, texture.at(points[:, 0], points[:, 1]), rtol=0, atol=1e-4)


@pytest.mark.parametrize("name", ENGINES)
def test_one_thickness_has_no_upper_and_lower_row(page: WebPage, name: str, tmp_path: Path) -> None:
    """A table of one thickness has two equal rows: any thickness_scale reads the same."""
    spec = CONTRACT_SPEC | {"table": CONTRACT_SPEC["table"] | {"thickness_scale": 1}}
    texture = LookupTexture.read(nacreous.write(nacreous.tabulate(spec), tmp_path / "single.exr")[0])
    points = np.array([(0.3, 0.0), (0.3, 1.0), (0.3, 2.0)])
    got = read_points(page, ENGINES[name], texture, points, tmp_path)
    expected = texture.at(np.full(3, 0.3), np.ones(3))
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-4)


@pytest.mark.parametrize("name", ENGINES)
@pytest.mark.parametrize("texels", ROUNDING)
def test_a_picture_of_a_draining_film_is_its_table(
    page: WebPage, soap: LookupTexture, name: str, texels: str, tmp_path: Path
) -> None:
    """Each pixel of a mirror in white surroundings has R at its own angle and thickness: mean within 1 %.

    The bound is what float or half texels leave of it, as the clients' pages say.
    """
    sphere = Sphere(pixels=96, thickness_scale=(0.05, 1.6))
    picture = draw_sphere(page, ENGINES[name], soap, sphere, tmp_path, texels=texels)
    missed_2, cos_theta, height = ray_casts(sphere)
    assert np.array_equal(picture[..., 3] == 1, missed_2 < 1)
    inside = missed_2 < 1
    top, bottom = sphere.thickness_scale
    expected = soap.at(cos_theta[inside], top + (bottom - top) * (0.5 - 0.5 * height[inside]))
    error = np.abs(picture[inside, :3] - expected).mean() / expected.mean()
    assert error <= ROUNDING[texels] < 0.01


def ray_casts(sphere: Sphere) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return, of each pixel, how far its ray passes by the centre, squared, and cosine and height of its hit.

    In the triangle of eye, centre and hit, sin theta is the distance of the ray from the centre over the
    radius, 1, and theta is the sum of the two other angles: that of the ray and that of the hit.
    """
    at = ((np.arange(sphere.pixels) + 0.5) / sphere.pixels * 2 - 1) * sphere.half_width / sphere.eye_distance
    right, up = np.meshgrid(at, -at)
    slope = np.hypot(right, up)
    missed_2 = (sphere.eye_distance * np.sin(np.arctan(slope))) ** 2
    theta = np.arcsin(np.sqrt(np.minimum(missed_2, 1)))
    height = np.sin(theta - np.arctan(slope)) * up / slope
    return missed_2, np.cos(theta), height


def test_both_engines_share_their_lines() -> None:
    """What is not the engine's own is the same text in both files, and there is some."""
    start, end = "// ---- the same in every engine", "// ---- U"
    shared = [engine.file.read_text().split(start)[1].split(end)[0] for engine in ENGINES.values()]
    assert shared[0] == shared[1]
    assert "NacreousPlace" in shared[0]
