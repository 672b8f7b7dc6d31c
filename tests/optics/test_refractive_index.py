"""Evaluating materials: ranges, limits, and the same formulas wherever the numbers come from."""

from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from nacreous.errors import SpecError
from nacreous.optics.effective_medium import bruggeman
from nacreous.optics.material import Material
from nacreous.optics.refractive_index import refractive_index

MATERIAL: TypeAdapter[Any] = TypeAdapter(Material)
TABLE = {"wavelength_nm": [400, 500], "n": [1.5, 1.7], "k": [0.0, 0.2]}


def index(material: object, *wavelength_nm: float) -> np.ndarray:
    """Evaluate a material as a spec writes it."""
    return refractive_index(MATERIAL.validate_python(material), wavelength_nm)


def test_a_constant_is_constant() -> None:
    """The same number at every wavelength, in double precision."""
    found = index({"n": 2.0, "k": 0.5}, 100.0, 1e5)
    assert found.dtype == np.complex128
    np.testing.assert_array_equal(found, [2 + 0.5j, 2 + 0.5j])


def test_a_table_is_interpolated() -> None:
    """Halfway lies the mean, of n and of k."""
    np.testing.assert_allclose(index(TABLE, 400.0, 450.0, 500.0), [1.5, 1.6 + 0.1j, 1.7 + 0.2j])


def test_cauchy_in_micrometres() -> None:
    """Leertouwer et al. 2011: chitin is 1.552 at 500 nm."""
    assert index({"cauchy": [1.517, 0.0088]}, 500.0)[0] == pytest.approx(1.552, abs=5e-4)
    assert index({"cauchy": [1.0, 0.1, 0.01]}, 500.0)[0] == pytest.approx(1 + 0.1 * 4 + 0.01 * 16)


def test_sellmeier_in_micrometres() -> None:
    """SCHOTT data sheet: N-BK7 has n_d = 1.51680."""
    coefficients = {
        "b": [1.03961212, 0.231792344, 1.01046945],
        "c_um2": [0.00600069867, 0.0200179144, 103.560653],
    }
    assert index({"sellmeier": coefficients}, 587.5618)[0] == pytest.approx(1.51680, abs=5e-6)


def test_a_mixture_is_that_of_its_parts() -> None:
    """Water and a constant, mixed by the rule that is tested on its own."""
    mixed = {"host": "water", "inclusion": {"n": 2.0}, "fraction": 0.25, "rule": "bruggeman"}
    expected = bruggeman(index("water", 500.0), index({"n": 2.0}, 500.0), 0.25)
    np.testing.assert_allclose(index(mixed, 500.0), expected)


@pytest.mark.parametrize(
    ("material", "wavelength_nm", "message"),
    [
        (TABLE, 399.0, "400 to 500 nm"),
        (TABLE, 501.0, "400 to 500 nm"),
        ("water", 1200.0, "water, 182 to 1129 nm"),
        ("main/Ag/Johnson", 100.0, "main/Ag/Johnson, 187.9 to 1937 nm"),
        ({"cauchy": [1.5], "range_nm": [400, 700]}, 800.0, "Cauchy formula, 400 to 700 nm"),
    ],
)
def test_beyond_the_data_is_refused(material: object, wavelength_nm: float, message: str) -> None:
    """The message names the material, its range and the wavelength."""
    with pytest.raises(SpecError, match=message) as caught:
        index(material, 450.0, wavelength_nm)
    assert caught.value.got == f"{wavelength_nm:g} nm"


@pytest.mark.parametrize("name", ["water", "main/Ag/Johnson"])
def test_hold_repeats_the_end_of_the_data(name: str) -> None:
    """Beyond its range a held material stays what it was at the end."""
    held = {"name": name, "extrapolate": "hold"}
    last_nm = 1129.0 if name == "water" else 1937.0
    np.testing.assert_array_equal(index(held, 5000.0), index(name, last_nm))
    np.testing.assert_array_equal(index(held, 600.0), index(name, 600.0))


def test_the_end_of_a_range_belongs_to_it() -> None:
    """Rounding in a conversion of units does not put a wavelength outside; a picometre does."""
    assert index(TABLE, 500 * (1 + 1e-10))[0] == pytest.approx(1.7 + 0.2j)
    with pytest.raises(SpecError):
        index(TABLE, 500.001)


@pytest.mark.parametrize(
    ("material", "got"),
    [
        ({"cauchy": [-1.0]}, "n = -1"),
        ({"cauchy": [1.0, 1000.0]}, "n = 4001"),
        ({"sellmeier": {"b": [1.0], "c_um2": [0.3]}}, "n = nan"),
        ({"sellmeier": {"b": [1.0], "c_um2": [0.25]}}, "n = inf"),
        ("other/metamaterials/Valentine", "n = -"),
    ],
)
def test_what_no_film_has_is_refused(material: object, got: str) -> None:
    """A formula outside its domain, a resonance, a negative index: refused before a kernel sees it."""
    wavelength_nm = 1700.0 if material == "other/metamaterials/Valentine" else 500.0
    with pytest.raises(SpecError) as caught:
        index(material, wavelength_nm)
    assert got in caught.value.got


def test_measured_noise_below_zero_is_transparent() -> None:
    """main/GaP/Jellison prints k = -0.003 in its transparent range; ellipsometry resolves 0.01."""
    assert index("main/GaP/Jellison", 505.0)[0].imag == 0


def test_a_wrong_k_is_refused() -> None:
    """main/Al2O3/Querry-e prints k = -0.115 in the ultraviolet: no noise, and no material."""
    with pytest.raises(SpecError, match="k >= 0"):
        index("main/Al2O3/Querry-e", 210.0)


@pytest.mark.parametrize(("part", "other"), [("host", "inclusion"), ("inclusion", "host")])
def test_a_fault_within_a_mixture_names_the_part(part: str, other: str) -> None:
    """The path leads to the name that is wrong."""
    mixed = {part: "watre", other: "water", "fraction": 0.5, "rule": "bruggeman"}
    outer = {"host": mixed, "inclusion": "water", "fraction": 0.5, "rule": "maxwell-garnett"}
    with pytest.raises(SpecError) as caught:
        index(outer, 500.0)
    assert caught.value.field == f"host.{part}"
