"""The documentation's site: it builds without a warning, says all that the code has, and has no dead link."""

import ast
import json
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import nacreous_client
import pytest

import nacreous
from built_site import Site, build_site
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS
from nacreous.optics.library import library_material, library_names
from nacreous.tables.presets import preset, preset_names
from nacreous.web.app import create_app
from nacreous.web.settings import Settings

ROOT = Path(__file__).parents[1]
PROGRAM = (sys.executable, "-c", "from nacreous.cli.app import main; main()")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Site:
    """Build the site once."""
    return build_site(tmp_path_factory.mktemp("site"))


def program(*arguments: str) -> str:
    """Return what the program prints."""
    return subprocess.run([*PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


def test_the_site_builds_without_a_warning(site: Site) -> None:
    """`sphinx-build -W -n`: no dead reference, no orphan, no unknown role."""
    assert site.warnings == ""


def test_no_link_is_dead(site: Site) -> None:
    """Every link within the site leads to a file, and its anchor to an element of it."""
    assert len(site.pages) > 20
    assert list(site.dead_links()) == []


def test_nothing_comes_from_elsewhere(site: Site) -> None:
    """Scripts, styles, fonts and pictures are files of the site."""
    assert list(site.foreign_requests()) == []


def test_every_page_has_one_title(site: Site) -> None:
    """A page that includes a README has the README's title and no other."""
    generated = {"search.html", "genindex.html", "py-modindex.html"}
    titles = {
        name: page.path.read_text(encoding="utf-8").count("<h1>")
        for name, page in site.pages.items()
        if name not in generated
    }
    assert {name: count for name, count in titles.items() if count != 1} == {}


# ---- the spec ----------------------------------------------------------------------------------------------


def objects(part: object) -> Iterator[Mapping[str, Any]]:
    """Yield every object of a JSON Schema that has fields."""
    if isinstance(part, dict):
        if isinstance(part.get("properties"), dict):
            yield part
        for value in part.values():
            yield from objects(value)
    elif isinstance(part, list):
        for value in part:
            yield from objects(value)


def test_the_reference_has_every_field_of_the_spec(site: Site) -> None:
    """As many sections as `nacreous schema` has objects, each with the object's fields."""
    fields = sorted(sorted(found["properties"]) for found in objects(json.loads(program("schema"))))
    sections: dict[str, list[str]] = {}
    for entry in site.pages["reference/spec.html"].entries:
        sections.setdefault(entry.section, []).append(entry.name)
    assert sorted(map(sorted, sections.values())) == fields


def test_fields_of_the_spec_are_described(site: Site) -> None:
    """Each field has its description, its words, the ends of its range, and its unit."""
    entries = site.pages["reference/spec.html"].entries
    for found in objects(json.loads(program("schema"))):
        for name, field in found["properties"].items():
            told = [plain(entry.text) for entry in entries if entry.name == name]
            facts = [plain(field["description"]), *words_of(field), *(["nm"] if name.endswith("_nm") else [])]
            assert any(all(fact in text for fact in facts) for text in told), (name, facts, told)


def words_of(field: object) -> Iterator[str]:
    """Yield what a field's schema allows, as a person writes it."""
    if isinstance(field, dict):
        yield from (f'"{word}"' for word in field.get("enum", ()))
        yield from (f"{field[end]:,.10g}" for end in ("minimum", "maximum", "maxItems") if end in field)
        for part in field.values():
            yield from words_of(part)
    elif isinstance(field, list):
        for part in field:
            yield from words_of(part)


def plain(text: str) -> str:
    """Return text without what typography makes of quotes, spaces and code."""
    return " ".join(text.translate(_TYPED).split())


_TYPED = str.maketrans({"\u2018": "'", "\u2019": "'", "\u201c": '"', "\u201d": '"', "`": ""})


# ---- the program -------------------------------------------------------------------------------------------


def commands() -> Iterator[tuple[str, ...]]:
    """Yield the words of each command, as the program's help lists them."""
    unseen: list[tuple[str, ...]] = [()]
    while unseen:
        words = unseen.pop()
        yield words
        _, _, listed = program(*words, "--help").partition("Commands:\n")
        unseen.extend((*words, name) for name in re.findall(r"^  (\S+)  ", listed, re.MULTILINE))


def test_the_reference_has_every_command_and_option(site: Site) -> None:
    """What `--help` prints of each command is in its section: options, arguments, and what they do."""
    entries = site.pages["reference/cli.html"].entries
    for words in commands():
        section = "-".join(["cli", *words])
        shown = "".join(plain(entry.text).replace(" ", "") for entry in entries if entry.section == section)
        page = plain(site.pages["reference/cli.html"].text)
        help_ = _MARKS.sub(r"\1", program(*words, "--help").replace("`", ""))
        usage, _, listed = help_.partition("Arguments:" if "Arguments:" in help_ else "Options:")
        assert plain(usage.removeprefix("Usage: ").partition("\n")[2]) in page, words
        for line in listed.partition("Commands:")[0].replace("--help", "").splitlines():
            for word in line.split():
                assert word in shown or word in _OF_HELP, (words, line, word)


_MARKS = re.compile(r"\[(?:env var: |default: |required)([^\]]*)\]")
_OF_HELP = frozenset({"Options:", "Show", "this", "message", "and", "exit."})
"""What the program's help says of itself."""


# ---- the service -------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def openapi(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Return the document that the service answers at /openapi.json."""
    return create_app(Settings(store=str(tmp_path_factory.mktemp("store")))).openapi()


def test_the_reference_has_every_route(site: Site, openapi: dict[str, Any]) -> None:
    """Each method of each path, with its parameters, what they mean, and every status it answers."""
    entries = site.entries("reference/rest.html")
    routes = {
        f"{method.upper()} {path}": said
        for path, of in openapi["paths"].items()
        for method, said in of.items()
    }
    assert routes.keys() == {name for name in entries if name.partition(" ")[2].startswith("/")}
    for route, said in routes.items():
        text = plain(entries[route].text)
        expected = [said["description"], *said["responses"], *parameter_facts(said)]
        assert [fact for fact in expected if plain(fact) not in text] == [], route


def parameter_facts(operation: Mapping[str, Any]) -> Iterator[str]:
    """Yield the names of the parameters, what each means, and the words that it may be."""
    for parameter in operation.get("parameters", ()):
        yield parameter["name"]
        yield parameter["description"].removesuffix(".")
        yield from words_of(parameter["schema"])


def test_the_reference_has_every_document_and_example(site: Site, openapi: dict[str, Any]) -> None:
    """Each schema of an answer has its fields, described; each example of a body is there as it is."""
    page = site.pages["reference/rest.html"]
    spec_models = {"Spec", *json.loads(program("schema"))["$defs"]}
    for name, model in openapi["components"]["schemas"].items():
        if name not in spec_models:
            fields = {
                entry.name for entry in page.entries if entry.section == f"rest-document-{name.lower()}"
            }
            assert fields == set(model.get("properties", ())), name
    text = plain(page.text)
    for of in openapi["paths"].values():
        for media in of.get("post", {}).get("requestBody", {}).get("content", {}).values():
            for example in media.get("examples", {}).values():
                value = example["value"]
                assert plain(value if isinstance(value, str) else json.dumps(value, indent=2)) in text


def test_the_reference_has_every_kind_of_problem(site: Site) -> None:
    """Whatever kind some source of the service names, the page explains."""
    entries = site.entries("reference/rest.html")
    kinds = {
        kind for source in (ROOT / "service/nacreous/web").rglob("*.py") for kind in problem_kinds(source)
    }
    assert len(kinds) > 20
    assert {f"urn:nacreous:problem:{kind}" for kind in kinds} == {
        name for name in entries if name.startswith("urn:")
    }


def problem_kinds(source: Path) -> Iterator[str]:
    """Yield what is written where a problem is made for its kind."""
    makers = {"Problem": 1, "ProblemError": 1, "_Kind": 1, "_refuse": 1, "_unavailable": 0}
    for call in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
        if isinstance(call, ast.Call):
            made = call.func.id if isinstance(call.func, ast.Name) else getattr(call.func, "attr", "")
            position = makers.get(made, len(call.args))
            if position < len(call.args) and isinstance(call.args[position], ast.Constant):
                yield call.args[position].value


def test_the_reference_has_every_setting(site: Site) -> None:
    """Each variable that some source of Nacreous names; each field of the settings, described."""
    entries = site.entries("reference/settings.html")
    named = {
        node.value
        for source in (ROOT / "service/nacreous").rglob("*.py")
        for node in ast.walk(ast.parse(source.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and re.fullmatch(r"NACREOUS_[A-Z_]*[A-Z]", str(node.value))
    }
    fields = {f"NACREOUS_{name.upper()}": field for name, field in Settings.model_fields.items()}
    assert entries.keys() == named | fields.keys()
    for name, field in fields.items():
        assert plain(field.description or "?") in plain(entries[name].text)


# ---- formats, materials, presets, Python -------------------------------------------------------------------


def test_the_reference_has_every_format(site: Site) -> None:
    """Each format has a section with its file, for whom it is, and the first sentence of its manual."""
    page = site.pages["reference/formats.html"]
    for name in FormatName:
        assert f"format-{name}" in page.ids
        assert f"film{FORMATS[name].suffix}" in page.text
        assert plain(name.advice) in plain(page.text)


def test_the_reference_has_every_material_with_its_source(site: Site) -> None:
    """Names of the library, and whose numbers they have."""
    entries = site.entries("reference/materials.html")
    assert entries.keys() == set(library_names())
    for name, entry in entries.items():
        assert plain(library_material(name).citation) in plain(entry.text)


def test_the_reference_has_every_preset_with_its_source(site: Site) -> None:
    """Names of the presets, what they show, and whose numbers they have."""
    text = plain(site.pages["reference/presets.html"].text)
    for name in preset_names():
        assert name in text
        assert plain(preset(name).description) in text
        assert plain(preset(name).source) in text


def test_the_reference_has_every_public_name(site: Site) -> None:
    """What both packages export is documented under its name."""
    ids = site.pages["reference/python.html"].ids
    assert {f"nacreous.{name}" for name in nacreous.__all__} - ids <= {
        "nacreous.__version__",
        "nacreous.errors",
    }
    assert "module-nacreous.errors" in ids
    client = site.pages["reference/python_client.html"].ids
    assert {f"nacreous_client.{name}" for name in nacreous_client.__all__} - client == set()
