"""CIEDE2000 against colour-science's own."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nacreous.optics.delta_e import delta_e_2000

LIGHTNESS, CHROMATIC = st.floats(0, 100), st.floats(-120, 120)
LAB = st.tuples(LIGHTNESS, CHROMATIC, CHROMATIC)


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, 2.5, 0.0), (50.0, 0.0, -2.5), 4.3065),
        ((50.0, 2.5, 0.0), (61.0, -5.0, 29.0), 22.8977),
        ((50.0, 2.5, 0.0), (50.0, 3.1736, 0.5854), 1.0000),
        ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
        ((90.8027, -2.0831, 1.4410), (91.1528, -1.6435, 0.0447), 1.4441),
    ],
)
def test_published_pairs(first: tuple[float, ...], second: tuple[float, ...], expected: float) -> None:
    """Sharma, Wu & Dalal 2005, table 1: pairs that tell wrong implementations apart."""
    assert delta_e_2000(np.array(first), np.array(second)) == pytest.approx(expected, abs=5e-5)


@pytest.mark.filterwarnings("ignore")
def test_agrees_with_colour_science() -> None:
    """100,000 pairs, near and far, greys and opposite hues among them, against colour.delta_E."""
    import colour

    rng = np.random.default_rng(7)
    first = rng.uniform([0, -110, -110], [100, 110, 110], (100_000, 3))
    second = first + rng.normal(0, rng.choice([0.1, 5, 60], (100_000, 1)), first.shape)
    second[:100, 1:] = 0
    second[100:200] = first[100:200] * [
        1,
        -0.99,
        -1,
    ]  # nearly opposite: exactly so, the mean hue is not defined
    np.testing.assert_allclose(
        delta_e_2000(first, second), colour.delta_E(first, second, method="CIE 2000"), rtol=0, atol=1e-9
    )


@given(first=LAB, second=LAB)
def test_is_symmetric_and_zero_for_equals(
    first: tuple[float, float, float], second: tuple[float, float, float]
) -> None:
    """A difference has no direction, and there is none between a colour and itself."""
    a, b = np.array(first), np.array(second)
    assert delta_e_2000(a, b) == pytest.approx(delta_e_2000(b, a), abs=1e-9)
    assert delta_e_2000(a, a) == 0
