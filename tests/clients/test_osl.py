"""clients/osl in Cycles: compiled by Blender's oslc, against the lookup of clients/README.md."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from blender_process import blender_jobs, linear_pixels, packed_add_on, sphere_cosines
from lut_contract import POINTS, LookupTexture, write_contract_table

FILES = {"R": "contract.exr", "T": "contract.transmission.exr"}
SPHERE = {"thickness_scale": 0.83, "pixels": 48, "samples": 1}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return where Blender has rendered strips of R and T, and a sphere of R alone."""
    folder = tmp_path_factory.mktemp("osl")
    path = write_contract_table(folder)
    (folder / "opaque.exr").write_bytes(path.read_bytes())
    strips: list[dict[str, Any]] = [
        {"job": "read_strip", "output": name, "points": POINTS.tolist()} for name in FILES
    ]
    sphere = SPHERE | {"job": "render_sphere", "path": str(folder / "opaque.exr")}
    jobs = [
        job | {"reader": "OSL", "picture": str(folder / f"{name}.png.exr")}
        for name, job in zip(
            (*FILES, "sphere"), (*({"path": str(path)} | strip for strip in strips), sphere), strict=True
        )
    ]
    blender_jobs([{"job": "install", "archive": str(packed_add_on(folder))}, *jobs], folder)
    return folder


@pytest.mark.parametrize("side", FILES)
def test_the_shader_reads_the_contract(side: str, folder: Path) -> None:
    """At the contract's points, in Cycles: rms within 1e-4 of the lookup, the mean error within 1 %."""
    got = linear_pixels(folder / f"{side}.png.exr")[0]
    expected = LookupTexture.read(folder / FILES[side]).at(*POINTS.T)
    assert np.sqrt(np.mean((got - expected) ** 2)) <= 1e-4
    assert np.abs(got - expected).mean() <= 0.01 * expected.mean()


def test_a_sphere_has_the_colour_of_each_angle(folder: Path) -> None:
    """A smooth sphere in a white world reflects R at the pixel's own cosine: the mean within 1 %."""
    cos_theta, inside = sphere_cosines(SPHERE["pixels"])
    table = LookupTexture.read(folder / "opaque.exr")
    expected = table.at(cos_theta[inside], np.full(inside.sum(), SPHERE["thickness_scale"]))
    got = linear_pixels(folder / "sphere.png.exr")[inside]
    assert np.abs(got - expected.clip(min=0)).mean() <= 0.01 * expected.mean()
