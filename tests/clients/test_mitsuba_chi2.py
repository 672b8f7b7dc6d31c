"""The BSDF plugin for Mitsuba: its sampling is its density, by Mitsuba's own chi-square test."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from lut_contract import CONTRACT_SPEC
from mitsuba_plugin import context, direction, table_file, use_variant

ROUGHNESSES = [{"alpha": 0.3}, {"alpha": 0.4, "distribution": "beckmann"}, {"alpha_u": 0.2, "alpha_v": 0.5}]
COSINES = [0.95, 0.3, -0.8, -0.1]
"""From both sides, near the normal and grazing; the last beyond the critical angle."""
LOBES = {"both": None, "reflection": 0, "transmission": 1}
VARIANTS = ["llvm_ad_rgb", "llvm_ad_spectral"]
TESTS = len(list(itertools.product(ROUGHNESSES, COSINES, LOBES, VARIANTS)))
"""How many there are: the chance that one in all of them rejects what is right is 1 %."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the tables."""
    return tmp_path_factory.mktemp("chi2")


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("lobe", LOBES)
@pytest.mark.parametrize("cos_theta", COSINES)
@pytest.mark.parametrize("roughness", ROUGHNESSES, ids=["ggx", "beckmann", "anisotropic"])
def test_samples_have_their_density(
    roughness: dict[str, object],
    cos_theta: float,
    lobe: str,
    variant: str,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Pearson's test of a histogram of samples against the integral of `pdf`, at a significance of 1 %."""
    use_variant(variant)
    monkeypatch.chdir(folder)  # where Mitsuba writes the histogram that it rejects
    from mitsuba.chi2 import BSDFAdapter, ChiSquareTest, SphericalDomain

    file = table_file(folder, variant, CONTRACT_SPEC)
    plugin = {"type": "nacreous", "filename": str(file), "thickness_scale": 0.9, **roughness}
    wi = direction(cos_theta).tolist()
    sample, pdf = BSDFAdapter("nacreous", plugin, wi=wi, ctx=context("Radiance", LOBES[lobe]))
    test = ChiSquareTest(SphericalDomain(), sample, pdf, sample_dim=3, sample_count=200_000, ires=16)
    assert test.run(test_count=TESTS), test.messages
    assert np.isclose(test.pdf_sum[0], test.histogram_sum[0], atol=0.02)
