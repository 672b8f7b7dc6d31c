"""Colour tables against an independent integral: Byrnes's tmm for the film, colour-science for the colour."""

import numpy as np
import pytest
import tmm

from nacreous.errors import SpecError
from nacreous.tables.presets import preset
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part
from nacreous.tables.tabulate import tabulate_table
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb

pytestmark = pytest.mark.filterwarnings("ignore")


def _tmm_reflectance(index: list[complex], thickness_nm: list[float], cos_theta: float) -> np.ndarray:
    d = [np.inf, *thickness_nm, np.inf]
    angle = np.arccos(cos_theta)
    both = [[tmm.coh_tmm(p, index, d, angle, nm)["R"] for nm in WAVELENGTH_NM] for p in "sp"]
    return np.mean(both, axis=0)


@pytest.mark.parametrize(
    ("index", "thickness_nm"),
    [
        ([1.0, 2.0, 1.5], [420.0]),
        ([1.0, 1.38, 2.35, 1.46, 0.2 + 3.4j], [90.0, 60.0, 110.0]),
        ([1.0, 2.4, 2.7 + 3.5j], [55.0]),
    ],
)
@pytest.mark.parametrize("cos_theta", [0.3, 1.0])
def test_colours_are_an_independent_integrals(
    index: list[complex], thickness_nm: list[float], cos_theta: float
) -> None:
    """Within 1e-3 of tmm's spectra through colour-science's tables, transparent and metallic."""
    media = [{"n": complex(n).real, "k": complex(n).imag} for n in index]
    layers = [{"material": m, "thickness_nm": d} for m, d in zip(media[1:-1], thickness_nm, strict=True)]
    stack = {"incident": media[0], "substrate": media[-1], "layers": layers}
    axes = {
        "cos_theta": [cos_theta - 0.1, cos_theta],
        "wavelength_nm": {"start": 360, "stop": 830, "step": 10},
    }
    table = tabulate_table(Spec.model_validate({"stack": stack, "table": axes}), [Part.COLOUR])
    expected = linear_rgb(_tmm_reflectance(index, thickness_nm, cos_theta))
    np.testing.assert_allclose(table.values("R_rgb")[0, 1], expected, rtol=0, atol=1e-3)


@pytest.mark.parametrize(("space", "name"), [("ACEScg", "ACEScg"), ("Rec.2020", "ITU-R BT.2020")])
def test_other_spaces(space: str, name: str) -> None:
    """The paper's figure 3 in wide-gamut spaces."""
    table = tabulate_table(preset("paper/figure-3", [f"colour.space={space}"]), [Part.COLOUR])
    at = film(np.array([1.0, 2.0, 1.5], complex), np.array([420.0]), WAVELENGTH_NM, 1.0)
    expected = linear_rgb((at.R_s[0] + at.R_p[0]) / 2, space=name)
    np.testing.assert_allclose(table.values("R_rgb")[0, -1], expected, rtol=0, atol=1e-3)


def test_bands_not_needles() -> None:
    """40 um of soap film: fringes 1.5 nm apart, resolved although the spectral axis has steps of 20 nm."""
    layer = {"material": {"n": 1.33}, "thickness_nm": 40_000}
    stack = {"incident": "vacuum", "substrate": "vacuum", "layers": [layer]}
    axes = {"cos_theta": [0.9, 1.0], "wavelength_nm": {"start": 360, "stop": 780, "step": 20}}
    table = tabulate_table(Spec.model_validate({"stack": stack, "table": axes}), [Part.COLOUR])
    fine_nm = np.arange(360, 780, 0.02)
    at = film(np.array([1.0, 1.33, 1.0], complex), np.array([40_000.0]), fine_nm, 1.0)
    bands = ((at.R_s[0] + at.R_p[0]) / 2).reshape(-1, 50).mean(axis=1)  # 1 nm each
    reflectance = np.interp(WAVELENGTH_NM, fine_nm.reshape(-1, 50).mean(axis=1), bands)
    np.testing.assert_allclose(table.values("R_rgb")[0, 1], linear_rgb(reflectance), rtol=0, atol=1e-3)


def test_a_sharp_cavity_is_resolved() -> None:
    """2 um between two mirrors of silver: resonances far narrower than an eighth of a fringe."""
    media = np.array([1.0, 0.05 + 3.3j, 1.5, 0.05 + 3.3j, 1.5])
    layers = [
        {"material": {"n": media[j].real, "k": media[j].imag}, "thickness_nm": d}
        for j, d in ((1, 60), (2, 2000), (3, 60))
    ]
    stack = {"incident": "vacuum", "substrate": {"n": 1.5}, "layers": layers}
    axes = {"cos_theta": [0.9, 1.0], "wavelength_nm": {"start": 360, "stop": 780, "step": 20}}
    table = tabulate_table(Spec.model_validate({"stack": stack, "table": axes}), [Part.COLOUR])
    fine_nm = np.arange(360, 780, 0.02)
    at = film(media, np.array([60.0, 2000.0, 60.0]), fine_nm, 1.0)
    bands = ((at.T_s[0] + at.T_p[0]) / 2).reshape(-1, 50).mean(axis=1)  # 1 nm each
    transmittance = np.interp(WAVELENGTH_NM, fine_nm.reshape(-1, 50).mean(axis=1), bands)
    np.testing.assert_allclose(table.values("T_rgb")[0, 1], linear_rgb(transmittance), rtol=0, atol=4e-4)
    assert table.certificate["quadrature_error"] <= 2e-4


def test_a_film_too_thick_for_fringes_is_refused() -> None:
    """A coherent centimetre of glass: the message says what to do instead."""
    layer = {"material": {"n": 1.5}, "thickness_nm": 1e7}
    stack = {"incident": "vacuum", "substrate": "vacuum", "layers": [layer]}
    with pytest.raises(SpecError, match=r"stack\.layers: .*fringes .* apart; .*coherent = false"):
        tabulate_table(Spec.model_validate({"stack": stack}))


def test_transmission_has_a_colour_too() -> None:
    """Without loss what is not reflected comes through: the two colours add up to white."""
    table = tabulate_table(preset("paper/figure-4"), [Part.COLOUR])
    both = table.values("R_rgb")[0, 1:] + table.values("T_rgb")[0, 1:]
    np.testing.assert_allclose(both, 1, rtol=0, atol=2e-5)
