"""Sweeps: the product of what varies, the same id for the same tables, mistakes named where they are."""

import json
import random
from itertools import product
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nacreous.engine.sweep import Sweep
from nacreous.errors import SpecError
from nacreous.tables.presets import preset, preset_names
from small_library import small_spec

THICKNESS = "stack.layers.0.thickness_nm"
INCIDENT = "stack.incident"


def inline() -> dict[str, Any]:
    """Return a spec's document."""
    return small_spec().model_dump(mode="json")


def sweep_of(vary: dict[str, Any], **others: object) -> Sweep:
    """Return the sweep of a small base."""
    return Sweep.from_document({"base": inline(), "vary": vary, **others})


def test_the_tables_are_the_product_of_the_axes() -> None:
    """In the order of the sorted paths, the last the fastest, whatever order they are written in."""
    nm, n = [100, 120.5, 140], [1.0, 1.33]
    for vary in ({THICKNESS: nm, "stack.incident.n": n}, {"stack.incident.n": n, THICKNESS: nm}):
        sweep = sweep_of({**vary}, base={**inline(), "stack": {**inline()["stack"], "incident": {"n": 1.0}}})
        specs = [sweep[index][0].spec for index in range(len(sweep))]
        got = [(spec.stack.incident.n, spec.stack.layers[0].thickness_nm) for spec in specs]  # type: ignore[union-attr]
        assert got == list(product(n, nm))


def test_ranges_are_those_of_a_spec() -> None:
    """By count to both ends, by step up to the last that fits; whole values serve fields of whole numbers."""
    by_count = sweep_of({THICKNESS: {"start": 100, "stop": 200, "count": 5}})
    assert [by_count[i][0].spec.stack.layers[0].thickness_nm for i in range(5)] == [100, 125, 150, 175, 200]  # type: ignore[union-attr]
    by_step = sweep_of({"table.cos_theta": {"start": 4, "stop": 9, "step": 2}})
    assert [by_step[index][0].spec.table.cos_theta for index in range(len(by_step))] == [4, 6, 8]


def test_any_value_of_a_spec_can_vary() -> None:
    """Materials, names, whole axes: what the field takes."""
    sweep = sweep_of(
        {
            "stack.substrate": ["water", {"n": 1.5}],
            "table.cos_theta": [[0.1, 0.5, 1.0], 3],
            "colour.space": ["XYZ"],
        }
    )
    assert len({sweep[index][0].id for index in range(len(sweep))}) == len(sweep) == 4


def test_every_format_is_a_work() -> None:
    """Formats twice are one; none is the default format of each table."""
    assert [work.format for work in sweep_of({}, formats=["npz", "exr", "npz"])[0]] == ["npz", "exr"]
    ultraviolet = {"table.wavelength_nm": [[300, 350], [390, 730]]}
    sweep = sweep_of(ultraviolet)
    assert [sweep[0][0].format, sweep[1][0].format] == ["npz", "exr"]


VARY = {
    THICKNESS: [100, 150.5, 200],
    "stack.substrate": ["water", {"n": 1.5}],
    "colour.space": ["XYZ"],
    "table.cos_theta": {"start": 4, "stop": 8, "step": 2},
}


def _shuffled(value: Any, chance: random.Random) -> Any:  # noqa: ANN401 - any part of a document
    if isinstance(value, dict):
        keys = chance.sample(list(value), len(value))
        return {key: _shuffled(value[key], chance) for key in keys}
    return value


@settings(max_examples=20, deadline=None)
@given(st.randoms(use_true_random=False))
def test_the_id_does_not_depend_on_how_a_sweep_is_written(chance: random.Random) -> None:
    """Order of keys at any depth, 100 for 100.0, a range for its list: the same tables, the same id."""
    document = {"base": inline(), "vary": VARY, "formats": ["exr", "npz"]}
    written = {
        "formats": ["npz", "exr", "npz"],
        "vary": {**VARY, THICKNESS: [100.0, 150.5, 200.0], "table.cos_theta": [4, 6, 8]},
        "base": {**inline(), "name": "another label"},
    }
    assert Sweep.from_document(_shuffled(written, chance)).id == Sweep.from_document(document).id


def test_other_tables_are_another_sweep() -> None:
    """Whatever changes a file changes the id."""
    vary = {THICKNESS: [100, 200]}
    base = inline() | {"accuracy": {"precision": "double"}}
    sweeps = [
        sweep_of(vary),
        sweep_of({THICKNESS: [100, 201]}),
        sweep_of({THICKNESS: [200, 100]}),
        sweep_of({"table.cos_theta": [6, 8]}),
        sweep_of(vary, formats=["exr"]),
        sweep_of(vary, formats=["npz"]),
        sweep_of(vary, base=base),
    ]
    assert len({sweep.id for sweep in sweeps}) == len(sweeps)
    assert all(len(sweep.id) == 64 for sweep in sweeps)


def test_a_sweep_survives_its_document() -> None:
    """What is written down is read as the same sweep, through JSON."""
    for sweep in (
        sweep_of(VARY, formats=["exr"]),
        sweep_of({}),
        sweep_of({THICKNESS: [1, 2]}, base="coated-lens"),
    ):
        again = Sweep.from_document(json.loads(json.dumps(sweep.to_document())))
        assert again == sweep
        assert again.id == sweep.id


@pytest.mark.parametrize("name", preset_names())
def test_one_spec_is_a_sweep(name: str) -> None:
    """A spec whose cost is over a limit becomes a job of one."""
    spec = preset(name)
    sweep = Sweep.of(spec, ["exr"])
    assert len(sweep) == 1
    assert sweep[0][0].id == Sweep.from_document(sweep.to_document())[0][0].id
    assert sweep[0][0].spec.stack == spec.stack


BASE = inline()


def varied(path: str, axis: object) -> dict[str, Any]:
    """Return a sweep's document with one axis."""
    return {"base": BASE, "vary": {path: axis}}


WRONG: list[tuple[dict[str, Any], str, str]] = [
    ({}, "base", "a value"),
    ({"base": 3}, "base", "the name of a preset"),
    ({"base": "soap-bubbel"}, "base", "soap-bubble"),
    ({"base": "film.toml"}, "base", "the name of a preset"),
    ({"base": "/etc/passwd"}, "base", "the name of a preset"),
    ({"base": {}}, "base.stack", "a value"),
    ({"base": {**BASE, "surfase": {}}}, "base.surfase", "surface"),
    ({"base": BASE, "formats": ["exe"]}, "formats.0", "exr"),
    ({"base": BASE, "formats": ["rgl"]}, "formats", "fresnel"),
    ({"base": BASE, "formats": "exr"}, "formats", "a list"),
    ({"base": BASE, "vary": []}, "vary", "a table"),
    ({"base": BASE, "vray": {}}, "vray", "vary"),
    (varied(THICKNESS, []), f"vary.{THICKNESS}", "at least 1"),
    (varied(THICKNESS, 3), f"vary.{THICKNESS}", "a list"),
    (varied(THICKNESS, [100, -1]), f"vary.{THICKNESS}", "a thickness from"),
    (varied(THICKNESS, [100, "thick"]), f"vary.{THICKNESS}", "a number"),
    (varied(THICKNESS, {"start": 1, "stop": 2}), f"vary.{THICKNESS}", "step or count"),
    (varied(THICKNESS, {"start": -5, "stop": 5, "count": 3}), f"vary.{THICKNESS}", "a thickness from"),
    (varied("stack.layers.0.thicknes_nm", [1]), "vary.stack.layers.0.thicknes_nm", "thickness_nm"),
    (varied("stack.layers.7.thickness_nm", [1]), "vary.stack.layers.7.thickness_nm", "position"),
    (varied("stack..layers", [1]), "vary", "the path of a field"),
    (varied("", [1]), "vary", "the path of a field"),
    (varied(".".join("abcdefgh" * 9), [1]), "vary", "the path of a field"),
    (varied("table.phi_i", [None, 3]), "vary.table.phi_i", "bsdf"),
    ({"base": BASE, "vary": {"stack": [1], THICKNESS: [1]}}, "vary", "different fields"),
    ({"base": BASE, "vary": {THICKNESS: [1], f" {THICKNESS}": [2]}}, "vary", "different fields"),
    ({"base": BASE, "vary": {"stack.layers.0": [1], "stack.layers.00.x": [2]}}, "vary", "different fields"),
]


@pytest.mark.parametrize(("document", "field", "said"), WRONG)
def test_a_mistake_is_named_where_it_is(document: dict[str, Any], field: str, said: str) -> None:
    """The field of the sweep, what was expected, and no other kind of error."""
    with pytest.raises(SpecError) as caught:
        Sweep.from_document(document)
    assert caught.value.field == field
    assert said in str(caught.value)


def test_a_mistake_that_a_value_makes_elsewhere_is_the_values() -> None:
    """A wavelength axis that a material does not cover is a mistake of the axis that was varied."""
    with pytest.raises(SpecError) as caught:
        sweep_of({"table.quantity": ["fresnel", "albedo"]})
    assert caught.value.field == "vary.table.quantity"
    assert "roughness" in caught.value.expected


def test_the_number_of_tables_is_bounded() -> None:
    """Counted before any is made, and the message has both numbers."""
    axis = {"start": 1, "stop": 2, "count": 60_000}
    document = {"base": BASE, "vary": {THICKNESS: axis, "stack.substrate.n": axis, "surface.alpha_x": axis}}
    with pytest.raises(SpecError, match=r"vary: expected at most 10,000 tables, got 216,000,000,000,000"):
        Sweep.from_document(document)
    with pytest.raises(SpecError, match="at most 2 tables"):
        Sweep.from_document({"base": BASE, "vary": {THICKNESS: [1, 2, 3]}}, limit=2)
