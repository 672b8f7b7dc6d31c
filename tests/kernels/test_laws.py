"""Laws that every stack obeys, whatever its layers: properties of kernels/film.clh."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel_film import kernel_film, tolerance
from nacreous.opencl.precision import Precision

BOTH = pytest.mark.parametrize("precision", list(Precision))
WAVELENGTH_NM = np.linspace(380, 780, 9)

clear = st.floats(1.0, 3.0)
absorbing = st.builds(complex, st.floats(0.1, 4.0), st.floats(0.0, 6.0))
thickness_nm = st.floats(0.0, 400.0)
cosine = st.floats(0.0, 1.0)


def layers(
    index: st.SearchStrategy[complex], most: int = 8
) -> st.SearchStrategy[list[tuple[complex, float]]]:
    """Draw one to `most` layers, each an index and a thickness in nm."""
    return st.lists(st.tuples(index, thickness_nm), min_size=1, max_size=most)


def of(stack: list[tuple[complex, float]]) -> tuple[list[complex], list[float]]:
    """Split layers into their indices and their thicknesses."""
    return [n for n, _ in stack], [d for _, d in stack]


@BOTH
@given(stack=layers(clear), n_0=clear, n_s=clear, mu=cosine)
@settings(deadline=None, max_examples=60)
def test_nothing_is_lost_without_absorption(
    stack: list[tuple[complex, float]], n_0: float, n_s: float, mu: float, precision: Precision
) -> None:
    """Conservation of energy, R + T = 1, also under total reflection inside and below the stack."""
    n, d_nm = of(stack)
    got = kernel_film([n_0, *n, n_s], d_nm, WAVELENGTH_NM, mu, precision=precision)
    np.testing.assert_allclose(got.R_s + got.T_s, 1, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(got.R_p + got.T_p, 1, rtol=0, atol=tolerance(precision))


@BOTH
@given(stack=layers(absorbing), n_0=clear, n_s=absorbing, mu=cosine)
@settings(deadline=None, max_examples=60)
def test_no_film_creates_energy(
    stack: list[tuple[complex, float]], n_0: float, n_s: complex, mu: float, precision: Precision
) -> None:
    """Passive media (k >= 0): R and T are not negative and R + T <= 1."""
    n, d_nm = of(stack)
    got = np.stack(kernel_film([n_0, *n, n_s], d_nm, WAVELENGTH_NM, mu, precision=precision))
    assert np.isfinite(got).all()
    assert got.min() >= 0
    assert (got[:2] + got[2:]).max() <= 1 + tolerance(precision)


@BOTH
@given(stack=layers(absorbing), n_0=clear, n_s=clear, mu=st.floats(0.02, 1.0))
@settings(deadline=None, max_examples=60)
def test_a_reversed_stack_transmits_the_same(
    stack: list[tuple[complex, float]], n_0: float, n_s: float, mu: float, precision: Precision
) -> None:
    """Reciprocity (Born & Wolf, section 1.6.3): T does not change when light goes the other way.

    The way back starts at the refracted angle, n_s sin theta_s = n_0 sin theta_0, so that both media must be
    clear; the layers need not be.
    """
    mu = np.sqrt(
        1 - (1 - mu**2) * min(1, n_s / n_0) ** 2 * 0.98
    )  # short of total reflection by the substrate
    mu_back = np.sqrt(1 - (1 - mu**2) * (n_0 / n_s) ** 2)
    n, d_nm = of(stack)
    there = kernel_film([n_0, *n, n_s], d_nm, WAVELENGTH_NM, mu, precision=precision)
    back = kernel_film([n_s, *n[::-1], n_0], d_nm[::-1], WAVELENGTH_NM, mu_back, precision=precision)
    np.testing.assert_allclose(there.T_s, back.T_s, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(there.T_p, back.T_p, rtol=0, atol=tolerance(precision))


@BOTH
@given(stack=layers(absorbing), cut=st.floats(0.0, 1.0), position=st.integers(0, 7), mu=cosine)
@settings(deadline=None, max_examples=60)
def test_splitting_a_layer_changes_nothing(
    stack: list[tuple[complex, float]], cut: float, position: int, mu: float, precision: Precision
) -> None:
    """Two layers of one material are one layer: a boundary between equal media does not reflect."""
    n, d_nm = of(stack)
    j = position % len(stack)
    split = [*d_nm[:j], cut * d_nm[j], (1 - cut) * d_nm[j], *d_nm[j + 1 :]]
    doubled = [*n[: j + 1], *n[j:]]
    whole = kernel_film([1, *n, 1.5], d_nm, WAVELENGTH_NM, mu, precision=precision)
    parts = kernel_film([1, *doubled, 1.5], split, WAVELENGTH_NM, mu, precision=precision)
    np.testing.assert_allclose(np.stack(parts), np.stack(whole), rtol=0, atol=tolerance(precision))


@BOTH
@given(stack=layers(absorbing, 5), factor=st.floats(0.1, 10.0), mu=cosine)
@settings(deadline=None, max_examples=30)
def test_only_the_ratio_to_the_wavelength_counts(
    stack: list[tuple[complex, float]], factor: float, mu: float, precision: Precision
) -> None:
    """Maxwell's equations have no length of their own: d and lambda scaled together give the same R and T."""
    n, d_nm = of(stack)
    once = kernel_film([1, *n, 1.5], d_nm, WAVELENGTH_NM, mu, precision=precision)
    scaled = kernel_film(
        [1, *n, 1.5], factor * np.array(d_nm), factor * WAVELENGTH_NM, mu, precision=precision
    )
    np.testing.assert_allclose(np.stack(scaled), np.stack(once), rtol=0, atol=tolerance(precision))
