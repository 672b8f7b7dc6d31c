"""The films of figures 3 and 4 over wavelength and angle, against formulas and an independent colour."""

import numpy as np
import pytest

from figures.interference import maxima_of, normal_incidence
from figures.tables import colours, table_at_angles
from nacreous import preset
from reference_colour import film_colour

FILMS = {"paper/figure-3": 420.0, "paper/figure-4": 450.0}
INDICES = np.array([1.0, 2.0, 1.5], complex)


@pytest.mark.parametrize("name", FILMS)
def test_reflectance_is_largest_at_4_n_d_over_odd_numbers(name: str) -> None:
    """A film denser than both its neighbours: 4 n d / (2 m + 1), Born & Wolf 1999, 1.6.4."""
    odd = 1 + 2 * np.arange(20)
    formula = 4 * 2.0 * FILMS[name] / odd
    inside = np.sort(formula[(formula > 360) & (formula < 830)])
    np.testing.assert_allclose(maxima_of(normal_incidence(name)), inside, atol=0.05)


def test_maxima_move_to_longer_wavelengths_from_figure_3_to_4() -> None:
    """Those of the same order, by the ratio of the thicknesses, 450 / 420."""
    thin, thick = (maxima_of(normal_incidence(name)) for name in FILMS)
    assert len(thin) == len(thick)
    assert (thick > thin).all()
    np.testing.assert_allclose(thick / thin, 450 / 420, rtol=2e-4)


@pytest.mark.parametrize("name", FILMS)
def test_the_colours_that_the_page_tells_are_those_of_colour_science(name: str) -> None:
    """CIE 15 at 1 nm over the Airy sum, at every angle of the page's table: within 0.001."""
    theta = np.array([0.0, 30.0, 45.0, 60.0, 75.0])
    got = colours(table_at_angles(preset(name), theta))
    cosines = np.cos(np.radians(theta))
    expected = [film_colour(INDICES, np.array([FILMS[name]]), float(mu)) for mu in cosines]
    np.testing.assert_allclose(got, expected, atol=1e-3)
