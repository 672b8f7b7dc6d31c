"""Documents from anyone: what is read, what is refused, and that nothing else happens."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nacreous.errors import SpecError
from nacreous.tables.spec_document import MAX_BYTES, Syntax, override, parse, read

TOML, JSON = Syntax.TOML, Syntax.JSON


def test_both_syntaxes_read_alike() -> None:
    """One document, written twice."""
    toml = '[table]\ncos_theta = 64\nscale = [0.5, 1]\n[colour]\nspace = "XYZ"\n'
    document = {"table": {"cos_theta": 64, "scale": [0.5, 1]}, "colour": {"space": "XYZ"}}
    assert parse(toml, TOML) == parse(json.dumps(document), JSON) == document


def test_brackets_within_text_do_not_nest() -> None:
    """Only structure counts: a description may say what it likes."""
    text = "[" * 100 + " . " * 100
    assert parse(f'a = "{text}" # {text}\nb = \'{text}\'\nc = """\n{text}"""', TOML)["b"] == text
    assert parse(json.dumps({"a": text, 'quoted " ' + text: 1}), JSON)["a"] == text


def test_thousands_of_numbers_in_a_line_are_no_nesting() -> None:
    """A tabulated material is one long line of decimals."""
    assert len(parse(f"n = {[1.5] * 10_000}", TOML)["n"]) == 10_000


@pytest.mark.parametrize(
    ("document", "syntax", "message"),
    [
        ("", TOML, "empty"),
        (" \n\t", JSON, "empty"),
        (b"\xef\xbb\xbf", JSON, "empty"),
        (b"name = '\xff'", TOML, "UTF-8"),
        (b"n" * (MAX_BYTES + 1), TOML, "2 MiB"),
        ("ü" * (MAX_BYTES // 2 + 1), TOML, "2 MiB"),
        ("a = ", TOML, "TOML"),
        ("{", JSON, "JSON"),
        ("a = 1\na = 2", TOML, "TOML"),
        ('{"a": 1, "a": 2}', JSON, 'key "a" twice'),
        ('{"a": NaN}', JSON, "NaN"),
        ('{"a": -Infinity}', JSON, "Infinity"),
        ('{"a": 1e999}', JSON, "1e999"),
        ('{"a": "\\ud800"}', JSON, "surrogate"),
        ('{"\\udfff": 1}', JSON, "surrogate"),
        ("[1]", JSON, "top level"),
        ("null", JSON, "top level"),
        ('"spec"', JSON, "top level"),
        ("a = " + "9" * 5000, TOML, "TOML"),
        ('{"a": ' + "9" * 5000 + "}", JSON, "JSON"),
        ("a\0 = 1", TOML, "TOML"),
    ],
)
def test_what_is_no_document_is_refused(document: str | bytes, syntax: Syntax, message: str) -> None:
    """One message says what came."""
    with pytest.raises(SpecError, match=message):
        parse(document, syntax)


@pytest.mark.parametrize("syntax", Syntax)
@pytest.mark.parametrize(
    "bomb",
    [
        "[" * 100_000,
        '{"a":' * 100_000,
        "a = " + "[" * 33,
        "a = " + "{a=" * 33,
        "a." * 1_000_000 + "a = 1",
        '"=".' * 500_000 + "a = 1",
        "[" + "a." * 33 + "a]",
        '"\\' * 1_000_000,
        "'''" * 600_000,
        '"' * 2_000_000,
        "'" * 2_000_000,
    ],
    ids=lambda bomb: bomb[:8],
)
def test_bombs_are_refused(bomb: str, syntax: Syntax) -> None:
    """Nesting without end, keys without end, strings without end: linear work, one message."""
    with pytest.raises(SpecError):
        parse(bomb, syntax)


def test_thirty_two_levels_are_read() -> None:
    """The limit itself is inside."""
    assert parse("a = " + "[" * 32 + "]" * 32, TOML)["a"] == json.loads("[" * 32 + "]" * 32)


@given(st.binary() | st.text(), st.sampled_from(Syntax))
def test_anything_is_read_or_refused(document: str | bytes, syntax: Syntax) -> None:
    """No bytes end in another exception than SpecError."""
    try:
        parse(document, syntax)
    except SpecError:
        return


def test_the_suffix_tells_the_syntax(tmp_path: Path) -> None:
    """JSON where the name says so, TOML otherwise."""
    (tmp_path / "a.JSON").write_text('{"name": "ü"}', encoding="utf-8")
    (tmp_path / "a.toml").write_text('name = "ü"', encoding="utf-8-sig")
    assert read(tmp_path / "a.JSON") == read(tmp_path / "a.toml") == {"name": "ü"}


@pytest.mark.parametrize("name", ["missing.toml", ".", "a\0b.toml", "x" * 5000])
def test_a_file_that_cannot_be_read(tmp_path: Path, name: str) -> None:
    """The message names the file; there is no traceback."""
    with pytest.raises(SpecError, match="a spec file that can be read"):
        read(tmp_path / name)


DOCUMENT = {
    "table": {"cos_theta": 64},
    "stack": {"incident": "air", "layers": [{"thickness_nm": 1}, {"repeat": 2}]},
}


@pytest.mark.parametrize(
    ("assignment", "path", "value"),
    [
        ("table.cos_theta=256", ("table", "cos_theta"), 256),
        ("table.cos_theta = [0.0, 1.0]", ("table", "cos_theta"), [0.0, 1.0]),
        ("stack.layers.0.thickness_nm=420.5", ("stack", "layers", 0, "thickness_nm"), 420.5),
        ("stack.layers.1={ repeat = 3 }", ("stack", "layers", 1), {"repeat": 3}),
        ("stack.incident=main/Ag/Johnson", ("stack", "incident"), "main/Ag/Johnson"),
        ('stack.incident="5"', ("stack", "incident"), "5"),
        ("colour.space=ACEScg", ("colour", "space"), "ACEScg"),
        ("name=a=b", ("name",), "a=b"),
        ("name=1\nstack=2", ("name",), "1\nstack=2"),
        ("name=", ("name",), ""),
    ],
)
def test_an_override_sets_one_value(assignment: str, path: tuple[str | int, ...], value: object) -> None:
    """TOML where it is TOML, else text; the document itself stays as it was."""
    before = json.dumps(DOCUMENT)
    found: object = override(DOCUMENT, [assignment])
    for part in path:
        found = found[part]  # type: ignore[index]
    assert found == value
    assert json.dumps(DOCUMENT) == before


def test_the_last_override_wins() -> None:
    """They are carried out in order."""
    assert override(DOCUMENT, ["table.cos_theta=1", "table.cos_theta=2"])["table"]["cos_theta"] == 2


@pytest.mark.parametrize(
    ("assignment", "message"),
    [
        ("table.cos_theta", "FIELD=VALUE"),
        ("=5", "FIELD=VALUE"),
        ("table..cos_theta=5", "FIELD=VALUE"),
        (".".join("a" * 40) + "=5", "FIELD=VALUE"),
        ("stack.layers.2.thickness_nm=5", "a position from 0 to 1"),
        ("stack.layers.-1.thickness_nm=5", "a position from 0 to 1"),
        ("stack.layers.x=5", "a position from 0 to 1"),
        (f"stack.layers.{'9' * 5000}=5", "a position from 0 to 1"),
        ("stack.incident.n=5", "a table with fields"),
        ("table.cos_theta.count=5", "a table with fields"),
    ],
)
def test_an_override_that_leads_nowhere(assignment: str, message: str) -> None:
    """A path through a number, a text or past the end of a list."""
    with pytest.raises(SpecError, match=message):
        override(DOCUMENT, [assignment])
