"""Mixing rules against the laws that any mixture obeys."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from nacreous.optics.effective_medium import bruggeman, lamellar, maxwell_garnett

SPHERES = [bruggeman, maxwell_garnett]
RULES = [*SPHERES, lamellar]
fractions = st.floats(0.0, 1.0)
real_indices = st.floats(1.0, 4.0)
indices = st.builds(complex, st.floats(0.05, 5.0), st.floats(0.0, 8.0))


def array(index: complex) -> NDArray[np.complex128]:
    """One index as the array that the rules take."""
    return np.array([index], np.complex128)


@pytest.mark.parametrize("rule", RULES)
@given(host=indices, inclusion=indices)
def test_an_unmixed_material_is_itself(rule, host: complex, inclusion: complex) -> None:  # noqa: ANN001
    """A fraction of 0 leaves the host alone, of 1 the inclusion."""
    assert rule(array(host), array(inclusion), 0.0)[0] == pytest.approx(host, rel=1e-6)
    assert rule(array(host), array(inclusion), 1.0)[0] == pytest.approx(inclusion, rel=1e-6)


@pytest.mark.parametrize("rule", [bruggeman, lamellar])
@given(host=indices, inclusion=indices, fraction=fractions)
def test_equal_constituents_know_no_host(
    rule,  # noqa: ANN001
    host: complex,
    inclusion: complex,
    fraction: float,
) -> None:
    """Exchanging spheres (Sihvola 1999, section 9.1) or lamellae and their shares changes nothing."""
    one = rule(array(host), array(inclusion), fraction)[0]
    other = rule(array(inclusion), array(host), 1 - fraction)[0]
    assert one == pytest.approx(other, rel=1e-9)


@given(host=indices, inclusion=indices, fraction=fractions)
def test_bruggeman_solves_its_equation(host: complex, inclusion: complex, fraction: float) -> None:
    """The mean polarisability of the constituents in the mixture vanishes, whichever root was taken."""
    e, e_h, e_i = bruggeman(array(host), array(inclusion), fraction)[0] ** 2, host**2, inclusion**2
    terms = fraction * (e_i - e) * (e_h + 2 * e), (1 - fraction) * (e_h - e) * (e_i + 2 * e)
    assert abs(sum(terms)) <= 1e-9 * max(abs(e), abs(e_h), abs(e_i)) ** 2


@pytest.mark.parametrize("rule", RULES)
@given(host=indices, inclusion=indices, fraction=fractions)
def test_passive_constituents_make_a_passive_mixture(
    rule,  # noqa: ANN001
    host: complex,
    inclusion: complex,
    fraction: float,
) -> None:
    """Milton, The Theory of Composites: Im ε >= 0 of the parts gives Im ε >= 0 of the whole."""
    mixed = rule(array(host), array(inclusion), fraction)[0]
    assert mixed.imag >= 0
    assert mixed.real > 0


@given(host=indices, inclusion=indices, fraction=st.floats(0.01, 0.99))
def test_bruggeman_lies_between_its_constituents(host: complex, inclusion: complex, fraction: float) -> None:
    """ε lies in the angle that the constituents' permittivities span: the physical root, not the other."""
    angle = 2 * np.angle(bruggeman(array(host), array(inclusion), fraction)[0])
    low, high = sorted((2 * np.angle(host), 2 * np.angle(inclusion)))
    assert low - 1e-6 <= angle <= high + 1e-6


@pytest.mark.parametrize("rule", RULES)
@given(host=real_indices, inclusion=real_indices, fraction=fractions)
def test_wiener_bounds(rule, host: float, inclusion: float, fraction: float) -> None:  # noqa: ANN001
    """Wiener 1912: ε of any mixture lies between the harmonic and the arithmetic mean."""
    e = rule(array(host), array(inclusion), fraction)[0].real ** 2
    arithmetic = fraction * inclusion**2 + (1 - fraction) * host**2
    harmonic = 1 / (fraction / inclusion**2 + (1 - fraction) / host**2)
    assert harmonic * (1 - 1e-9) <= e <= arithmetic * (1 + 1e-9)


@given(host=real_indices, inclusion=real_indices)
def test_the_rules_for_spheres_agree_when_dilute(host: float, inclusion: float) -> None:
    """To first order in the fraction both are the same (Sihvola 1999, equation 9.6)."""
    one, other = (rule(array(host), array(inclusion), 1e-4)[0].real for rule in SPHERES)
    assert one == pytest.approx(other, abs=1e-6)


def test_silver_in_glass_by_hand() -> None:
    """ε_h = 2, ε_i = -4 + 0i at 1/2: Maxwell Garnett gives 2·(0 - 6)/(0 + 3) = -4, so n = 2i."""
    mixed = maxwell_garnett(array(np.sqrt(2)), array(2j), 0.5)
    assert mixed[0] == pytest.approx(2j, abs=1e-9)


@given(host=real_indices, inclusion=real_indices, fraction=fractions)
def test_lamellae_lie_half_their_birefringence_below_the_arithmetic_mean(
    host: float, inclusion: float, fraction: float
) -> None:
    """Born and Wolf, section 15.5.2: ε_∥ - ε_⊥ = f g (ε_i - ε_h)² / (f ε_h + g ε_i) with g = 1 - f."""
    rest, e_h, e_i = 1 - fraction, host**2, inclusion**2
    birefringence = fraction * rest * (e_i - e_h) ** 2 / (fraction * e_h + rest * e_i)
    expected = fraction * e_i + rest * e_h - birefringence / 2
    assert lamellar(array(host), array(inclusion), fraction)[0].real ** 2 == pytest.approx(expected, rel=1e-9)


def test_ridges_by_hand() -> None:
    """ε 4 and 1 at 1/2: 5/2 along the lamellae and 8/5 across them, whose mean is 41/20."""
    mixed = lamellar(array(1.0), array(2.0), 0.5)[0]
    assert mixed == pytest.approx(np.sqrt(41 / 20), abs=1e-12)
