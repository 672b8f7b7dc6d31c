"""The shipped tables of the CIE are colour-science's, and every other name is found there."""

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.optics.cie import ILLUMINANTS, OBSERVERS, colour_matching_functions, illuminant_power


@pytest.mark.parametrize("observer", [*OBSERVERS, "Stockman & Sharpe 2 Degree Cone Fundamentals"])
def test_observers_are_those_of_colour_science(observer: str) -> None:
    """ISO/CIE 11664-1 as colour-science has it, shipped or looked up."""
    import colour

    wavelength_nm, functions = colour_matching_functions(observer)
    expected = colour.MSDS_CMFS[observer]
    np.testing.assert_array_equal(wavelength_nm, expected.wavelengths)
    np.testing.assert_allclose(functions, np.asarray(expected.values).T, rtol=1e-11, atol=0)


@pytest.mark.parametrize("illuminant", [*ILLUMINANTS, "FL2"])
def test_illuminants_are_those_of_colour_science(illuminant: str) -> None:
    """CIE 15, tables of relative spectral power, linear between the samples of colour-science."""
    import colour

    wavelength_nm, power = illuminant_power(illuminant)
    expected = colour.SDS_ILLUMINANTS[illuminant]
    values = np.interp(wavelength_nm, expected.wavelengths, expected.values)
    np.testing.assert_allclose(power, values, rtol=1e-11, atol=0)
    assert wavelength_nm[0] <= 400
    assert wavelength_nm[-1] >= 700


@pytest.mark.parametrize(
    ("look_up", "name", "field", "meant"),
    [
        (colour_matching_functions, "CIE 1931 2 Degree Standard Observr", "colour.observer", "Observer"),
        (illuminant_power, "D 65", "colour.illuminant", "D65"),
    ],
)
def test_an_unknown_name_is_refused(look_up: object, name: str, field: str, meant: str) -> None:
    """The error names the field and what was probably meant."""
    with pytest.raises(SpecError, match=f"^{field}: ") as refused:
        look_up(name)  # type: ignore[operator]
    assert repr(name) in str(refused.value)
    assert meant in refused.value.remedy


@pytest.mark.parametrize(
    ("look_up", "name", "common"),
    [(colour_matching_functions, "nobody", OBSERVERS), (illuminant_power, "sunlight", ILLUMINANTS)],
)
def test_a_name_that_is_near_none_is_answered_with_the_common_ones(
    look_up: object, name: str, common: tuple[str, ...]
) -> None:
    """Those that ship with the package; each of them is a name that is known."""
    with pytest.raises(SpecError) as refused:
        look_up(name)  # type: ignore[operator]
    assert [each for each in common if each not in refused.value.remedy] == []
