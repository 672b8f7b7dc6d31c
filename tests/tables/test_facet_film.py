"""The film that facets carry: close enough nodes, and what is between them."""

import numpy as np
import pytest

from kernel_surface import CLEAR, GLASS, rough_spec
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.tables.computed import grid_of
from nacreous.tables.facet_film import FacetFilm, cosine_weighted_nodes, facet_film
from reference import film as reference_film
from reference_facets import FloatArray

NM = np.array([400.0, 500.0, 600.0, 700.0])
ONE = np.ones(1)


def film_of(device: Device, *layers: dict[str, object], substrate: object = GLASS) -> FacetFilm:
    """Return the film on facets, in vacuum."""
    spec = rough_spec({"alpha_x": 0.3}, *layers, substrate=substrate)
    return facet_film(device, spec.stack, grid_of(spec), Precision.SINGLE)


def reference(thickness_nm: float, cosines: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unpolarised R and T of `CLEAR` at another thickness, by tests/reference.py: (K, L) each."""
    at = reference_film([1.0, 2.0, 1.5], [thickness_nm], NM, cosines)
    return (at.R_s + at.R_p) / 2, (at.T_s + at.T_p) / 2


def lagrange(values: FloatArray, cosines: FloatArray) -> FloatArray:
    """Lagrange's cubic through the four nodes about each cosine, (P, L), from its definition."""
    place = cosines * (len(values) - 1)
    first = np.clip(place.astype(int) - 1, 0, len(values) - 4)
    total = np.zeros((cosines.size, values.shape[1]))
    for k in range(4):
        others = [m for m in range(4) if m != k]
        weight = np.prod([(place - first - m) / (k - m) for m in others], axis=0)
        total += weight[:, None] * values[first + k]
    return total


@pytest.mark.parametrize("thickness_nm", [100, 300, 2000])
def test_a_cubic_stands_between_the_nodes(thickness_nm: float, device: Device) -> None:
    """R and T at 1,000 random cosines, from the nodes, are the film's to 2e-5, and to what the film says."""
    film = film_of(device, CLEAR | {"thickness_nm": thickness_nm})
    cosines = np.random.default_rng(1).uniform(0, 1, 1000)
    nodes = film.spectra(ONE, NM)
    assert film.error <= 1e-5
    expected = dict(zip((Side.REFLECTION, Side.TRANSMISSION), reference(thickness_nm, cosines), strict=True))
    for side, exact in expected.items():
        assert np.abs(lagrange(nodes[side][0], cosines) - exact).max() <= 2e-5


def test_nodes_are_the_films() -> None:
    """They lie equally spaced over [0, 1]."""
    film = FacetFilm(None, 65, 0.0)  # type: ignore[arg-type]
    np.testing.assert_allclose(film.cosines, np.arange(65) / 64)


def test_a_thick_film_takes_more_nodes(device: Device) -> None:
    """Its fringes are closer."""
    thin, thick = (film_of(device, CLEAR | {"thickness_nm": d}) for d in (100, 5000))
    assert thick.nodes > thin.nodes >= 65
    assert thick.nodes % 2 == 1


def test_a_kink_is_stated(device: Device) -> None:
    """From vacuum onto a film of lower index there is a critical angle, and no cubic follows R about it.

    The nodes are then as many as there can be, and the error what is left.
    """
    film = film_of(device, {"material": {"n": 0.5}, "thickness_nm": 5000})
    assert film.nodes == 4097
    assert film.error > 1e-5


def test_a_finer_film_is_exact(device: Device) -> None:
    """Twice the nodes in double precision: R is the reference's to 1e-10 at each."""
    film = film_of(device).finer()
    assert film.solver.precision is Precision.DOUBLE
    R, T = reference(300, film.cosines)
    nodes = film.spectra(ONE, NM)
    np.testing.assert_allclose(nodes[Side.REFLECTION][0], R, rtol=0, atol=1e-10)
    np.testing.assert_allclose(nodes[Side.TRANSMISSION][0], T, rtol=0, atol=1e-10)


def test_colours_are_weighted_spectra(device: Device) -> None:
    """The same nodes, wavelengths added up."""
    film = film_of(device)
    weights = np.array([[0.1, 0.2, 0.3, 0.4], [0.0, 1.0, 0.0, 0.0], [-0.5, 0.0, 0.0, 1.0]])
    scales = np.array([0.5, 1.0])
    spectra = film.spectra(scales, NM)
    for side in Side:
        colours = film.colours(scales, NM, weights, side)
        np.testing.assert_allclose(colours, spectra[side] @ weights.T, rtol=0, atol=2e-6)


def test_mean_reflectance_is_weighted_by_the_cosine(device: Device) -> None:
    """2 integral of R mu d mu, by a thousand midpoints of the reference."""
    mu = (np.arange(1000) + 0.5) / 1000
    R, _ = reference(300, mu)
    mean = film_of(device).mean_reflectance(ONE, NM)[0]
    np.testing.assert_allclose(mean, 2 * mu @ R / 1000, rtol=0, atol=1e-5)


@pytest.mark.parametrize("power", [0, 1, 2, 5])
def test_the_mean_of_a_power(power: int) -> None:
    """2 integral of mu^p mu d mu is 2 / (p + 2)."""
    mu, weights = cosine_weighted_nodes(24)
    assert weights @ mu**power == pytest.approx(2 / (power + 2), rel=2e-5)


def test_indices_are_those_of_both_media(device: Device) -> None:
    """Vacuum, and the real part of the substrate's."""
    film = film_of(device, substrate={"n": 1.7, "k": 0.3})
    np.testing.assert_allclose(film.indices(NM), [[1.0] * 4, [1.7] * 4])
