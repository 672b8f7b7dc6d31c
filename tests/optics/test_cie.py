"""The shipped tables of the CIE against colour-science, which they come from."""

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.optics.cie import ILLUMINANTS, OBSERVERS, colour_matching_functions, illuminant_power

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.mark.parametrize("observer", OBSERVERS)
def test_shipped_observers_are_colour_sciences(observer: str) -> None:
    """Equal at every nanometre."""
    import colour

    nm, functions = colour_matching_functions(observer)
    known = colour.MSDS_CMFS[observer]
    np.testing.assert_array_equal(nm, known.wavelengths)
    np.testing.assert_allclose(functions.T, known.values, rtol=1e-11)


@pytest.mark.parametrize("illuminant", ILLUMINANTS)
def test_shipped_illuminants_are_colour_sciences(illuminant: str) -> None:
    """Equal wherever colour-science has a value."""
    import colour

    nm, power = illuminant_power(illuminant)
    known = colour.SDS_ILLUMINANTS[illuminant]
    np.testing.assert_allclose(np.interp(known.wavelengths, nm, power), known.values, rtol=1e-11)


def test_other_names_are_looked_up() -> None:
    """FL11 and the 2015 observer do not ship; colour-science has them."""
    assert illuminant_power("FL11")[1].max() > 0
    assert colour_matching_functions("CIE 2015 2 Degree Standard Observer")[1].shape[0] == 3


@pytest.mark.parametrize(
    ("look_up", "name"), [(illuminant_power, "D66"), (colour_matching_functions, "CIE 1932")]
)
def test_an_unknown_name_is_refused(look_up: object, name: str) -> None:
    """The message has the name, and the closest ones."""
    with pytest.raises(SpecError, match=name):
        look_up(name)  # type: ignore[operator]
