"""The kernels against the equations of Wu & Zheng 2015 for one film, as printed and corrected."""

from collections.abc import Callable

import numpy as np
import pytest

import reference_paper as paper
from kernel_film import kernel_film
from nacreous.opencl.precision import Precision

WAVELENGTH_NM = np.linspace(380, 780, 41)
FILMS = [
    pytest.param((1.0, 2.0, 1.5), 420.0, 0.7, id="dielectric"),
    pytest.param((1.0, 0.6 + 3j, 1.5), 30.0, 0.7, id="absorbing"),
    pytest.param((1.5, 1.2, 1.5), 200.0, 0.3, id="evanescent"),
    pytest.param((1.0, 2.4, 0.6 + 3j), 60.0, 0.5, id="on metal"),
]


@pytest.mark.parametrize(("precision", "allowed"), [(Precision.DOUBLE, 1e-12), (Precision.SINGLE, 1e-5)])
@pytest.mark.parametrize(("index", "thickness_nm", "cos_theta"), FILMS)
@pytest.mark.parametrize(("equation", "name"), [(paper.equation_7, "R"), (paper.equation_8, "T")])
def test_the_corrected_equations_hold(
    equation: Callable[[paper.SingleFilm], paper.Real],
    name: str,
    index: tuple[complex, complex, complex],
    thickness_nm: float,
    cos_theta: float,
    precision: Precision,
    allowed: float,
) -> None:
    """Equation 7 with |r|^2 for r^2, equation 8 with the substrate's angle: s and p, four kinds of film."""
    got = kernel_film(index, [thickness_nm], WAVELENGTH_NM, cos_theta, precision=precision)
    films = paper.single_film(index, thickness_nm, WAVELENGTH_NM, cos_theta)
    for polarisation, single in zip("sp", films, strict=True):
        value = getattr(got, f"{name}_{polarisation}")[0]
        np.testing.assert_allclose(value, equation(single), rtol=0, atol=allowed)


def test_equation_7_as_printed_does_not() -> None:
    """Its squares are squared moduli for a clear film; for one on metal it is off by over 0.1."""
    errors = []
    for index in ((1, 2.0, 1.5), (1, 2.4, 0.6 + 3j)):
        printed = paper.equation_7_printed(paper.single_film(index, 200, WAVELENGTH_NM, 0.5)[0])
        errors.append(np.abs(printed - kernel_film(index, [200], WAVELENGTH_NM, 0.5).R_s[0]).max())
    assert errors[0] <= 1e-12
    assert errors[1] > 0.1


def test_equation_8_as_printed_does_not() -> None:
    """It has the film's angle in place of the substrate's: right at mu = 1, 5 % off at 60 degrees."""
    errors = []
    for cos_theta in (1.0, 0.5):
        single = paper.single_film((1, 2.0, 1.5), 420, WAVELENGTH_NM, cos_theta)[0]
        T = kernel_film((1, 2.0, 1.5), [420], WAVELENGTH_NM, cos_theta).T_s[0]
        errors.append(np.abs(paper.equation_8_printed(single).real / T - 1).max())
    assert errors[0] <= 1e-12
    assert errors[1] > 0.05
