"""The lookup of clients/README.md, which every client is compared with, against the film itself."""

from pathlib import Path

import numpy as np
import pytest

import nacreous
from lut_contract import CONTRACT_SPEC, POINTS, LookupTexture, write_contract_table


@pytest.mark.parametrize("side", ["R", "T"])
def test_a_texel_centre_is_a_sample_of_the_axis(side: str, tmp_path: Path) -> None:
    """At (cos_theta, thickness_scale) of a sample the texture holds that sample: clients/README.md."""
    path = write_contract_table(tmp_path)
    texture = LookupTexture.read(path if side == "R" else path.with_name("contract.transmission.exr"))
    table = nacreous.tabulate(CONTRACT_SPEC)
    scale, cosine = np.meshgrid(table.thickness_scale, table.cos_theta, indexing="ij")
    got = texture.at(cosine.ravel(), scale.ravel()).reshape(*scale.shape, 3)
    np.testing.assert_allclose(got, table[f"{side}_rgb"], rtol=0, atol=1e-6)


def test_the_points_tell_rows_and_columns_apart(tmp_path: Path) -> None:
    """A reader that turns an axis around, or swaps both, finds colours that differ by far more than 1 %."""
    texture = LookupTexture.read(write_contract_table(tmp_path))
    right = texture.at(POINTS[:, 0], POINTS[:, 1])
    turned = [
        texture.at(1 - POINTS[:, 0], POINTS[:, 1]),
        texture.at(POINTS[:, 0], 2 - POINTS[:, 1]),
        texture.at(POINTS[:, 1] - 0.5, POINTS[:, 0] + 0.5),
    ]
    assert all(np.abs(wrong - right).mean() > 0.05 * right.mean() for wrong in turned)
