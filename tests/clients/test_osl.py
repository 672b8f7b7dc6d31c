"""clients/osl in Cycles: compiled by Blender's oslc, against the lookup of clients/README.md."""

from pathlib import Path

import numpy as np
import pytest

from blender_process import blender_jobs, linear_pixels, packed_add_on, sphere_cosines
from lut_contract import POINTS, LookupTexture, write_contract_table

FILES = {"R": "contract.exr", "T": "contract.transmission.exr"}
SCALE, PIXELS = 0.83, 48


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
    blender_jobs([{"job": "install", "archive": str(packed_add_on(folder))}, *strips, sphere], folder)
    return folder


@pytest.mark.parametrize("side", FILES)
def test_the_shader_reads_the_contract(side: str, folder: Path) -> None:
    """At the contract's points, in Cycles: rms within 1e-4 of the lookup, the mean error within 1 %."""
    got = linear_pixels(folder / f"strip {side}.exr")[0]
    expected = LookupTexture.read(folder / FILES[side]).at(*POINTS.T)
    assert np.sqrt(np.mean((got - expected) ** 2)) <= 1e-4
    assert np.abs(got - expected).mean() <= 0.01 * expected.mean()


def test_a_sphere_has_the_colour_of_each_angle(folder: Path) -> None:
    """The shader's own cosine: a smooth sphere in a white world reflects R of each pixel, mean within 1 %."""
    cos_theta, inside = sphere_cosines(PIXELS)
    table = LookupTexture.read(folder / "opaque.exr")
    expected = table.at(cos_theta[inside], np.full(inside.sum(), SCALE))
    got = linear_pixels(folder / "sphere.exr")[inside]
    assert np.abs(got - expected.clip(min=0)).mean() <= 0.01 * expected.mean()
