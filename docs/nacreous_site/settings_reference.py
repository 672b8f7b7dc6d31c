"""The reference of the settings: each variable of the environment that Nacreous reads."""

from collections.abc import Iterable, Iterator

from docutils import nodes

from nacreous.web.environment import ELSEWHERE
from nacreous.web.settings import Settings
from nacreous_site.entries import ReferenceDirective, entry, identifier, literal, paragraphs, section
from nacreous_site.json_schema import field_facts

__all__ = ["SettingsReference"]


class SettingsReference(ReferenceDirective):
    """``{settings-reference}``: the service's settings, and the variables of every command."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return both sections."""
        service = section("settings-service", "Of the service", *_settings())
        return [service, section("settings-program", "Of the program and its tests", *_elsewhere())]


def _settings() -> Iterator[nodes.Element]:
    for name, field in Settings.model_json_schema()["properties"].items():
        text = paragraphs(field.get("description", ""))
        yield _variable(f"NACREOUS_{name.upper()}", *text, *field_facts(name, field, literal))


def _elsewhere() -> Iterator[nodes.Element]:
    for name, description in ELSEWHERE.items():
        yield _variable(name, *paragraphs(description))


def _variable(name: str, *body: nodes.Element) -> nodes.Element:
    return entry(identifier("setting", name), name, *body)
