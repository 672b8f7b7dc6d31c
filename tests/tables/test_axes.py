"""Axes: the numbers behind a count, a range and a list, and what is none of them."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from nacreous.tables import axes

WAVELENGTH: TypeAdapter[Any] = TypeAdapter(axes.WavelengthAxis)
COS_THETA: TypeAdapter[Any] = TypeAdapter(axes.CosThetaAxis)
SCALE: TypeAdapter[Any] = TypeAdapter(axes.ThicknessScaleAxis)
ROUGHNESS: TypeAdapter[Any] = TypeAdapter(axes.RoughnessAxis)
THETA: TypeAdapter[Any] = TypeAdapter(axes.PolarAngleAxis)
PHI: TypeAdapter[Any] = TypeAdapter(axes.AzimuthAxis)


def wavelengths(axis: object) -> list[float]:
    """Return the values of a wavelength axis as a spec writes it."""
    return axes.wavelength_values_nm(WAVELENGTH.validate_python(axis)).tolist()


def test_a_range_by_step_includes_its_stop() -> None:
    """350 to 750 nm by 5 nm are 81 wavelengths, as in the paper."""
    values = wavelengths({"start": 350, "stop": 750, "step": 5})
    assert values == [350.0 + 5 * i for i in range(81)]


@pytest.mark.parametrize(("step", "points"), [(0.1, 4001), (0.3, 1334), (1 / 3, 1201), (7, 58)])
def test_a_range_never_passes_its_stop(step: float, points: int) -> None:
    """Steps that do not fit end before the stop; steps that fit, but for rounding, end on it."""
    values = wavelengths({"start": 350, "stop": 750, "step": step})
    assert len(values) == points
    assert 750 - step < values[-1] <= 750
    np.testing.assert_allclose(np.diff(values), step, rtol=1e-9)


def test_a_step_that_is_not_exact_in_binary_still_fits() -> None:
    """0.3 / 0.1 is a little less than 3 in double precision: the stop is a point all the same."""
    values = axes.cos_theta_values(COS_THETA.validate_python({"start": 0, "stop": 0.3, "step": 0.1}))
    assert values.size == 4
    assert values[-1] == 0.3


def test_a_range_by_count_has_both_ends() -> None:
    """Three points from 400 to 700 nm."""
    assert wavelengths({"start": 400, "stop": 700, "count": 3}) == [400.0, 550.0, 700.0]


def test_a_list_is_itself() -> None:
    """Integers and reals alike, in double precision."""
    assert wavelengths([400, 550.5, 700]) == [400.0, 550.5, 700.0]


def test_a_count_spans_all_angles() -> None:
    """From grazing to normal incidence."""
    values = axes.cos_theta_values(COS_THETA.validate_python(5))
    assert values.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_one_thickness_is_the_thickness_itself() -> None:
    """The default axis holds the factor 1."""
    assert axes.thickness_scale_values(SCALE.validate_python(1)).tolist() == [1.0]
    assert axes.thickness_scale_values(SCALE.validate_python([0.5, 2])).tolist() == [0.5, 2.0]


@pytest.mark.parametrize(
    ("adapter", "wrong", "message"),
    [
        (WAVELENGTH, [], "at least 2"),
        (WAVELENGTH, [500], "at least 2"),
        (WAVELENGTH, [500, 400], "ascending"),
        (WAVELENGTH, [400, 400], "ascending"),
        (WAVELENGTH, [99, 400], "100 to 100000"),
        (WAVELENGTH, [400, 100_001], "100 to 100000"),
        (WAVELENGTH, [400, float("nan")], "finite"),
        (WAVELENGTH, [400, True], "number"),
        (WAVELENGTH, 81, "a list"),
        (WAVELENGTH, "350-750", "a list"),
        (WAVELENGTH, None, "a list"),
        (WAVELENGTH, {400, 500}, "a list"),
        (WAVELENGTH, {"start": 400, "stop": 700}, "either step or count, got neither"),
        (WAVELENGTH, {"start": 400, "stop": 700, "step": 1, "count": 5}, "got both"),
        (WAVELENGTH, {"start": 400, "stop": 400, "step": 1}, "more than start"),
        (WAVELENGTH, {"start": 400, "stop": 700, "step": 0}, "greater than 0"),
        (WAVELENGTH, {"start": 400, "stop": 700, "step": 301}, "2 to 65,536 points, got 1"),
        (WAVELENGTH, {"start": 400, "stop": 700, "step": 1e-9}, "2 to 65,536 points"),
        (WAVELENGTH, {"start": -1e308, "stop": 1e308, "step": 1}, "2 to 65,536 points"),
        (WAVELENGTH, {"start": -1e308, "stop": 1e308, "count": 5}, "100 to 100000"),
        (WAVELENGTH, {"start": 400, "stop": 400.0000000000001, "count": 9}, "ascending"),
        (WAVELENGTH, {"start": 400, "stop": 700, "count": 1}, "greater than or equal to 2"),
        (WAVELENGTH, {"start": 400, "stop": 700, "count": 65_537}, "less than or equal to 65536"),
        (WAVELENGTH, {"start": 400, "stop": 700, "steps": 5}, "start, stop, step, count"),
        (COS_THETA, 1, "greater than or equal to 2"),
        (COS_THETA, 65_537, "less than or equal to 65536"),
        (COS_THETA, 64.0, "a count"),
        (COS_THETA, True, "a count"),
        (COS_THETA, [0, 1.0000001], "0 to 1"),
        (COS_THETA, [-0.1, 1], "0 to 1"),
        (COS_THETA, {"start": 0, "stop": 2, "count": 5}, "0 to 1"),
        (SCALE, 0, "1"),
        (SCALE, 2, "1"),
        (SCALE, True, "1, a list"),
        (SCALE, [0, 1], "1e-06 to 100"),
        (SCALE, [1, 100.1], "1e-06 to 100"),
        (ROUGHNESS, [], "at least 1"),
        (ROUGHNESS, [0], "0.001 to 1"),
        (ROUGHNESS, [0.5, 1.01], "0.001 to 1"),
        (ROUGHNESS, [0.2, 0.1], "ascending"),
        (ROUGHNESS, [0.1, 0.1], "ascending"),
        (ROUGHNESS, 0.1, "a list"),
        (ROUGHNESS, 5, "a list"),
        (ROUGHNESS, {"start": 0, "stop": 1, "count": 5}, "0.001 to 1"),
        (THETA, 1, "greater than or equal to 2"),
        (THETA, [0, 1.5708], "0 to 1.5707 rad"),
        (THETA, [-0.1, 1], "0 to 1.5707 rad"),
        (THETA, [], "at least 1"),
        (THETA, 1.5, "a count"),
        (THETA, True, "a count"),
        (PHI, 1, "greater than or equal to 2"),
        (PHI, [-3.15, 0], "-3.1416 to 3.1416 rad"),
        (PHI, {"start": 0, "stop": 360, "step": 10}, "-3.1416 to 3.1416 rad"),
        (PHI, "pi", "a count"),
    ],
    ids=str,
)
def test_what_is_no_axis_is_refused(adapter: TypeAdapter[Any], wrong: object, message: str) -> None:
    """Each in its own words, before anything is allocated."""
    with pytest.raises(ValidationError) as caught:
        adapter.validate_python(wrong)
    assert message in str([(error["msg"], error.get("ctx")) for error in caught.value.errors()])


@given(start=st.floats(100, 9e4), length=st.floats(1e-3, 1e4), count=st.integers(2, 500))
def test_every_accepted_range_ascends(start: float, length: float, count: int) -> None:
    """Whatever was accepted has as many points as it says, from start to stop, strictly ascending."""
    values = np.array(wavelengths({"start": start, "stop": start + length, "count": count}))
    assert values.size == count
    assert (np.diff(values) > 0).all()
    assert (values[0], values[-1]) == (start, start + length)


RANGE = {"start": 0.1, "stop": 1, "step": 0.1}


@pytest.mark.parametrize(
    ("adapter", "axis"),
    [
        *((COS_THETA, axis) for axis in (64, [0.0, 0.5, 1.0], RANGE)),
        *((ROUGHNESS, axis) for axis in ([0.1], [0.1, 0.2], RANGE, None)),
        *((adapter, axis) for adapter in (THETA, PHI) for axis in (9, [0.7], [0.0, 0.5, 1.0], RANGE, None)),
    ],
    ids=str,
)
def test_an_axis_survives_json(adapter: TypeAdapter[Any], axis: object) -> None:
    """Written out and read again it is the same axis, or none."""
    read = adapter.validate_python(axis)
    assert adapter.validate_json(adapter.dump_json(read)) == read


def test_one_thickness_may_be_written_as_a_real_number() -> None:
    """1.0 is 1, in the canonical form as well; any other number alone is no axis."""
    assert repr(SCALE.validate_python(1.0)) == "1"
    for wrong in (1.5, 0, 2, True, "1"):
        with pytest.raises(ValidationError, match="expected 1, a list, "):
            SCALE.validate_python(wrong)


def test_a_roughness_may_stand_alone() -> None:
    """One alpha is a table of its own; several ascend."""
    assert axes.roughness_axis_values(ROUGHNESS.validate_python([0.1])).tolist() == [0.1]
    spaced = ROUGHNESS.validate_python({"start": 0.1, "stop": 1, "count": 4})
    np.testing.assert_allclose(axes.roughness_axis_values(spaced), [0.1, 0.4, 0.7, 1.0], rtol=1e-12)


def test_a_count_of_polar_angles_stops_short_of_the_horizon() -> None:
    """From the normal to 89 degrees, where the cosine is 0.0175 and not yet nothing."""
    values = axes.theta_values(THETA.validate_python(90), 16)
    np.testing.assert_allclose(np.degrees(values), np.arange(90), atol=1e-12)
    assert axes.theta_values(None, 16).size == 16


def test_a_list_of_angles_is_in_radians() -> None:
    """As they are written: one slice, or a grid of one's own."""
    assert axes.theta_values(THETA.validate_python([0.7]), 16).tolist() == [0.7]
    assert axes.phi_values(PHI.validate_python([-3.1416, 0, 3.1416]), axes.HALF_TURN, 9).size == 3


@pytest.mark.parametrize(
    ("ends", "degrees"),
    [
        (axes.QUARTER_TURN, [0, 22.5, 45, 67.5, 90]),
        (axes.HALF_TURN, [0, 45, 90, 135, 180]),
        (axes.WHOLE_TURN, [-180, -90, 0, 90, 180]),
    ],
)
def test_a_count_of_azimuths_has_both_ends(ends: tuple[float, float], degrees: list[float]) -> None:
    """Interpolation from end to end needs no wrapping around."""
    for axis, default in ((5, 7), (None, 5)):
        np.testing.assert_allclose(np.degrees(axes.phi_values(axis, ends, default)), degrees, atol=1e-12)
