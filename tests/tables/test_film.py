"""A spec's film as the kernels get it, in the precision that it needs, and what is refused."""

import numpy as np
import pytest

from kernel_film import plain_problem
from nacreous.errors import NumericalError
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import THICK, Segment
from nacreous.opencl.precision import Precision
from nacreous.optics.stack import Stack, sample_stack
from nacreous.tables.film import (
    Grid,
    check_range,
    checked_intensities,
    film_problem,
    optical_thickness_nm,
    phase_precision,
    segments,
)
from nacreous.tables.thickness_spread import ThicknessSpread, one_thickness
from reference import incoherent_film

GRID = Grid(np.array([0.5, 1.0, 2.0]), np.array([0.0, 0.3, 1.0]), np.array([420.0, 550.0, 680.0]))


def layer(n: float, thickness_nm: float, **rest: object) -> dict[str, object]:
    """Write a layer of constant index as a spec does."""
    return {"material": {"n": n}, "thickness_nm": thickness_nm} | rest


def stack(*layers: dict[str, object]) -> Stack:
    """Lay layers upon glass in vacuum."""
    return Stack.model_validate({"incident": "vacuum", "substrate": {"n": 1.5}, "layers": list(layers)})


MIXED = stack(
    layer(1.4, 90.0),
    {"repeat": 3, "layers": [layer(2.1, 60.0), layer(1.3, 90.0)]},
    layer(1.7, 40.0),
    layer(1.6, 20_000.0, coherent=False),
    layer(1.9, 70.0),
)


def test_a_stack_is_cut_from_the_substrate_outwards() -> None:
    """The field is grown from the substrate's outgoing wave: runs, groups and thick layers in that order."""
    assert segments(sample_stack(MIXED, 550)) == (
        Segment(5, 6, 1), Segment(4, 5, THICK), Segment(3, 4, 1), Segment(1, 3, 3), Segment(0, 1, 1)
    )  # fmt: skip


def test_neighbouring_layers_are_one_run() -> None:
    """Segments cost a rescaling each: plain layers share one."""
    plain = stack(layer(1.4, 90.0), layer(2.0, 50.0), layer(1.8, 20.0))
    assert segments(sample_stack(plain, 550)) == (Segment(0, 3, 1),)


@pytest.mark.parametrize("precision", list(Precision))
def test_a_stack_of_everything_is_computed(precision: Precision, device: Device) -> None:
    """Scales multiply every thickness: each equals the film of tests/reference.py with thicker layers."""
    problem = film_problem(MIXED, one_thickness(6), GRID)
    got = checked_intensities(device, problem, precision)
    for position, scale in enumerate(GRID.thickness_scale):
        expected = incoherent_film(
            [1, 1.4, 2.1, 1.3, 1.7, 1.6, 1.9, 1.5], scale * np.array([90, 60, 90, 40, 20_000, 70]),
            GRID.wavelength_nm, GRID.cos_theta, coherent=[True] * 4 + [False, True], groups=[(1, 3, 3)],
        )  # fmt: skip
        for name, values in got.items():
            allowed = 1e-12 if precision is Precision.DOUBLE else 2e-5
            np.testing.assert_allclose(values[position], getattr(expected, name), rtol=0, atol=allowed)


def test_a_spread_scales_with_the_film() -> None:
    """The factor is on every thickness, so on its deviation, too: (S, V, M) = scale (d + offset)."""
    film = stack(layer(1.4, 90.0), layer(2.0, 50.0))
    spread = ThicknessSpread(np.array([[-9.0, 0.0], [9.0, 5.0]]), np.array([0.5, 0.5]))
    got = film_problem(film, spread, GRID).thickness_nm
    np.testing.assert_allclose(got[2], [[162, 100], [198, 110]])
    assert got.shape == (3, 2, 2)


def test_optical_thickness_counts_repeats_and_the_largest_scale() -> None:
    """Repeats times n d of each segment, (segments, L); none of a thick layer, which has no fringes."""
    got = optical_thickness_nm(film_problem(MIXED, one_thickness(6), GRID))
    expected = 2 * np.array([1.9 * 70, 0, 1.7 * 40, 3 * (2.1 * 60 + 1.3 * 90), 1.4 * 90])
    np.testing.assert_allclose(got, np.repeat(expected[:, None], 3, axis=1))


@pytest.mark.parametrize(
    ("film", "needed"),
    [
        pytest.param(stack(layer(2.0, 420.0)), Precision.SINGLE, id="thin film"),
        pytest.param(stack(layer(2.0, 20_000.0)), Precision.DOUBLE, id="phase of 600 radians"),
        pytest.param(stack(layer(2.0, 20_000.0, coherent=False)), Precision.DOUBLE, id="echoes"),
        pytest.param(stack({"repeat": 500, "layers": [layer(2.0, 90.0)]}), Precision.DOUBLE, id="periods"),
    ],
)
def test_what_single_precision_cannot_hold(film: Stack, needed: Precision) -> None:
    """Large phases (24 bits hold 200 radians to 1e-5) and echoes; a double asked for is never taken back."""
    problem = film_problem(film, one_thickness(1), GRID)
    assert phase_precision(problem, Precision.SINGLE) is needed
    assert phase_precision(problem, Precision.DOUBLE) is Precision.DOUBLE


def test_trapped_light_is_computed_in_double_precision(device: Device) -> None:
    """Total reflection to and fro between clear gaps: a resonance that single precision moves by its width.

    Twelve gaps in glass behind a dense medium; energy is the witness, R + T = 1.
    """
    n = [1.9, *[1.05, 1.9] * 12]
    mu, wavelength_nm = np.linspace(0.05, 0.9, 400), np.linspace(380, 780, 200)
    problem = plain_problem(n, [150.0, 260.0] * 11 + [150.0], wavelength_nm, mu)
    assert phase_precision(problem, Precision.SINGLE) is Precision.DOUBLE
    got = film_intensities(device, problem, phase_precision(problem, Precision.SINGLE))
    np.testing.assert_allclose(got["R_s"] + got["T_s"], 1, rtol=0, atol=1e-9)


def test_results_are_ratios(device: Device) -> None:
    """What rounding leaves outside [0, 1] is clamped."""
    problem = film_problem(stack(layer(2.0, 420.0)), one_thickness(1), GRID)
    for values in checked_intensities(device, problem, Precision.SINGLE).values():
        assert values.min() >= 0
        assert values.max() <= 1


@pytest.mark.parametrize("fault", [np.nan, np.inf, -np.inf, -2e-6, 1.0001])
def test_a_fault_is_never_clamped(fault: float) -> None:
    """A value that is no ratio is an error that says what came and how often, whatever it stands among."""
    values = np.full((2, 3), 0.5)
    check_range("R_s", values)
    values[1, 2] = fault
    with pytest.raises(NumericalError, match="R_s lies in") as refused:
        check_range("R_s", values)
    assert f"{0 if np.isfinite(fault) else 1} values that are not finite" in str(refused.value)
