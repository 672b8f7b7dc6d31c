"""Films of uneven thickness, averaged."""

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part
from nacreous.tables.tabulate import tabulate_table
from reference import film, spread_film

MU = [0.05, 0.4, 1.0]


def _spec(layers: list[dict[str, object]], **table: object) -> Spec:
    stack = {"incident": "vacuum", "substrate": {"n": 1.5}, "layers": layers}
    wavelengths = {"start": 380, "stop": 780, "step": 20}
    return Spec.model_validate(
        {"stack": stack, "table": {"cos_theta": MU, "wavelength_nm": wavelengths} | table}
    )


@pytest.mark.parametrize(("thickness_nm", "sigma_nm"), [(300, 5), (600, 100), (4000, 300), (2000, 1)])
def test_the_average_is_the_references(thickness_nm: float, sigma_nm: float) -> None:
    """A fine quadrature over +-7 sigma, within the 1e-4 promised."""
    layer = {"material": {"n": 2.2}, "thickness_nm": thickness_nm, "thickness_sigma_nm": sigma_nm}
    table = tabulate_table(_spec([layer]), [Part.SPECTRUM])
    expected = spread_film(
        np.array([1.0, 2.2, 1.5], complex),
        np.array([float(thickness_nm)]),
        np.array([float(sigma_nm)]),
        table.values("wavelength_nm"),
        np.array(MU),
    )
    for name in ("R_s", "R_p", "T_s", "T_p"):
        np.testing.assert_allclose(table.values(name)[0], getattr(expected, name), rtol=0, atol=1e-4)


def test_two_layers_vary_independently() -> None:
    """The average over both thicknesses, each with a distribution of its own."""
    layers = [
        {"material": {"n": 2.2}, "thickness_nm": 200, "thickness_sigma_nm": 15},
        {"material": {"n": 1.4}, "thickness_nm": 150, "thickness_sigma_nm": 20},
    ]
    table = tabulate_table(_spec(layers), [Part.SPECTRUM])
    expected = spread_film(
        np.array([1.0, 2.2, 1.4, 1.5], complex),
        np.array([200.0, 150.0]),
        np.array([15.0, 20.0]),
        table.values("wavelength_nm"),
        np.array(MU),
    )
    np.testing.assert_allclose(table.values("R_s")[0], expected.R_s, rtol=0, atol=1e-4)


def test_a_wide_spread_washes_the_fringes_out() -> None:
    """Far beyond a fringe the mean over all phases is left: of one film, the intensities' own sum.

    For a lossless film R = (R1 + R2 - 2 R1 R2) / (1 - R1 R2) with the two surfaces' reflectances.
    """
    layer = {"material": {"n": 2.0}, "thickness_nm": 9000, "thickness_sigma_nm": 1500}
    table = tabulate_table(_spec([layer]), [Part.SPECTRUM])
    first, second = ((2.0 - 1) / 3) ** 2, ((2.0 - 1.5) / 3.5) ** 2
    expected = (first + second - 2 * first * second) / (1 - first * second)
    np.testing.assert_allclose(table.values("R_s")[0, -1], expected, rtol=0, atol=1e-4)


def test_the_spread_grows_with_the_thickness_scale() -> None:
    """A scale of 2 doubles mean and deviation alike."""
    thin = {"material": {"n": 2.0}, "thickness_nm": 200, "thickness_sigma_nm": 20}
    thick = {"material": {"n": 2.0}, "thickness_nm": 400, "thickness_sigma_nm": 40}
    scaled = tabulate_table(_spec([thin], thickness_scale=[1.0, 2.0]), [Part.SPECTRUM])
    direct = tabulate_table(_spec([thick]), [Part.SPECTRUM])
    np.testing.assert_allclose(scaled.values("R_p")[1], direct.values("R_p")[0], rtol=0, atol=1e-4)
    plain = film(
        np.array([1.0, 2.0, 1.5], complex),
        np.array([400.0]),
        direct.values("wavelength_nm"),
        np.array(MU),
    )
    assert np.abs(direct.values("R_p")[0] - plain.R_p).max() > 1e-3


@pytest.mark.parametrize("layers", [5, 20, 64])
def test_too_many_spreads_are_refused(layers: int) -> None:
    """Wide spreads multiply to more combinations than can be averaged, or than 64 bits count."""
    layer = {"material": {"n": 2.0}, "thickness_nm": 2000, "thickness_sigma_nm": 300}
    with pytest.raises(SpecError, match=r"stack\.layers: .*combinations.*fewer layers"):
        tabulate_table(_spec([layer] * layers))
