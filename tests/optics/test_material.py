"""Every form of a material: what it accepts, what it refuses, and in which words."""

import json
import math
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from nacreous.optics.material import ConstantMaterial, Material, Mixture, NamedMaterial, TabulatedMaterial

MATERIAL: TypeAdapter[Any] = TypeAdapter(Material)
TABLE = {"wavelength_nm": [400, 500], "n": [1.5, 1.4]}
MIX = {"host": "water", "inclusion": {"n": 2.0}, "fraction": 0.3, "rule": "bruggeman"}

GOOD = [
    "water",
    "main/Ag/Johnson",
    {"name": "main/Ag/Johnson", "extrapolate": "hold"},
    {"n": 1.5},
    {"n": 2, "k": 0},
    {"n": 0.001, "k": 999.0},
    TABLE,
    {**TABLE, "k": [0.0, 0.1], "extrapolate": "hold"},
    {"cauchy": [1.5, 0.01, 1e-4]},
    {"cauchy": [1.5], "k": 0.1, "range_nm": [400, 700]},
    {"sellmeier": {"b": [1.0], "c_um2": [0.01]}},
    {"sellmeier": {"b": [1.0, 0.1], "c_um2": [0.01, 100.0], "constant": 0.5}, "k": 0.01},
    MIX,
    {**MIX, "host": MIX, "rule": "maxwell-garnett"},
]

BAD = [
    (5, "name, or a table"),
    (None, "name, or a table"),
    ([], "name, or a table"),
    ({}, "name, or a table"),
    ("", "at least 1"),
    ("x" * 201, "at most 200"),
    ({"n": 0}, "greater than or equal"),
    ({"n": 0.0009}, "greater than or equal"),
    ({"n": 1e4}, "less than or equal"),
    ({"n": math.nan}, "finite"),
    ({"n": math.inf}, "finite"),
    ({"n": True}, "number"),
    ({"n": "1.5"}, "number"),
    ({"n": 1.5, "k": -1e-9}, "greater than or equal"),
    ({"n": 1.5, "kk": 0}, "fields n, k"),
    ({"k": 1}, "required"),
    ({"wavelength_nm": [400], "n": [1.5]}, "at least 2"),
    ({**TABLE, "wavelength_nm": [500, 400]}, "ascending"),
    ({**TABLE, "wavelength_nm": [400, 400]}, "ascending"),
    ({**TABLE, "wavelength_nm": [0, 400]}, "ascending"),
    ({**TABLE, "n": [1.5]}, "as many"),
    ({**TABLE, "k": [0.0, 0.1, 0.2]}, "as many"),
    ({**TABLE, "k": [0.0, -0.1]}, "values from 0"),
    ({**TABLE, "n": [1.5, 0]}, "values from 0.001"),
    ({**TABLE, "extrapolate": "linear"}, "refuse"),
    ({"cauchy": []}, "at least 1"),
    ({"cauchy": [1, 2, 3, 4]}, "at most 3"),
    ({"cauchy": [1.5], "range_nm": [700, 400]}, "ascending"),
    ({"sellmeier": {"b": [1.0], "c_um2": []}}, "as many"),
    ({"sellmeier": [1.0, 0.1]}, "SellmeierCoefficients"),
    ({**MIX, "fraction": 1.1}, "less than or equal"),
    ({**MIX, "rule": "lorentz"}, "bruggeman"),
    ({"host": "water"}, "required"),
]


@pytest.mark.parametrize("given_form", GOOD, ids=str)
def test_a_material_survives_json(given_form: object) -> None:
    """Whatever way it is written, writing it out and reading it again gives the same value."""
    material = MATERIAL.validate_python(given_form)
    assert MATERIAL.validate_json(MATERIAL.dump_json(material)) == material
    assert MATERIAL.validate_python(MATERIAL.dump_python(material)) == material
    assert hash(material) == hash(MATERIAL.validate_python(given_form))


@pytest.mark.parametrize(("given_form", "message"), BAD, ids=str)
def test_what_is_no_material_is_refused(given_form: object, message: str) -> None:
    """Strict: no conversion, no NaN, no unknown field, nothing that no film has."""
    with pytest.raises(ValidationError, match=message):
        MATERIAL.validate_python(given_form)


@pytest.mark.parametrize("given_form", [form for form, _ in BAD if isinstance(form, dict) and form], ids=str)
def test_a_message_speaks_of_one_form(given_form: dict[str, Any]) -> None:
    """A table of n is judged as a table of n, not as eight things that it is not."""
    with pytest.raises(ValidationError) as caught:
        MATERIAL.validate_python(given_form)
    assert len({error["loc"][0] for error in caught.value.errors()}) == 1


def test_a_name_and_its_table_are_one_value() -> None:
    """Two spellings of one material must not make two tables."""
    assert MATERIAL.validate_python("water") == MATERIAL.validate_python({"name": "water"})
    assert json.loads(MATERIAL.dump_json(NamedMaterial(name="water"))) == "water"


def test_one_zero() -> None:
    """-0.0 is 0.0: the sign of a zero k would reach the bytes of a table."""
    assert math.copysign(1, ConstantMaterial(n=1.5, k=-0.0).k) == 1


@given(
    st.recursive(
        st.floats() | st.text() | st.booleans() | st.none(),
        lambda x: (
            st.lists(x)
            | st.dictionaries(
                st.sampled_from(
                    ["n", "k", "name", "cauchy", "sellmeier", "b", "c_um2", "wavelength_nm", "host", "rule"]
                ),
                x,
            )
        ),
    )
)
@example(value={"n": 1.5, "k": 0.25})
@example(value={**MIX, "host": TABLE, "inclusion": "main/Ag/Johnson"})
@example(value={"cauchy": [1.5, 0.01], "range_nm": [400, 700]})
def test_anything_is_read_or_refused(value: object) -> None:
    """No input ends in another exception than pydantic's own, and what is read survives being written."""
    try:
        material = MATERIAL.validate_python(value)
    except ValidationError:
        return
    assert MATERIAL.validate_json(MATERIAL.dump_json(material)) == material


def test_mixtures_nest_four_deep() -> None:
    """Four levels are a hierarchy; five are an attack, for the work doubles with each."""
    material: object = "water"
    for _ in range(4):
        material = {**MIX, "host": material}
    assert isinstance(MATERIAL.validate_python(material), Mixture)
    with pytest.raises(ValidationError, match="4 deep"):
        MATERIAL.validate_python({**MIX, "inclusion": material})


def test_a_value_cannot_be_changed() -> None:
    """Specs are values: nothing that was validated can change afterwards."""
    material = TabulatedMaterial.model_validate(TABLE)
    with pytest.raises(ValidationError, match="frozen"):
        material.n = (1.0, 2.0)  # type: ignore[misc]
