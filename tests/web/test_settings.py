"""Settings: what the environment may say, and that the documentation says the same."""

import re
from pathlib import Path

import pytest
from pydantic import ValidationError
from pydantic_core import PydanticUndefined

from nacreous.web.environment import KNOWN, unknown_variables
from nacreous.web.settings import Settings

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/service.md"
BEGIN, END = "<!-- settings: begin -->\n", "<!-- settings: end -->\n"


def settings_table() -> str:
    """Return the table of all settings, as docs/service.md has it."""
    rows = []
    for name, field in Settings.model_fields.items():
        default = field.default
        if default is PydanticUndefined:
            default = "the user's data folder"
        elif default in ((), None):
            default = ""
        else:
            default = f"`{default}`"
        rows.append(f"| `NACREOUS_{name.upper()}` | {default} | {field.description} |")
    return "\n".join(["| variable | default | |", "|---|---|---|", *rows]) + "\n"


def test_the_documentation_lists_every_setting() -> None:
    """The table in docs/service.md is this one; where a setting changes, put the new one there."""
    page = PAGE.read_text(encoding="utf-8")
    assert page.split(BEGIN)[1].split(END)[0] == settings_table()


def test_the_environment_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lists have commas, numbers are numbers, and what is given in code comes first."""
    monkeypatch.setenv("NACREOUS_API_KEYS", "key-of-sixteen-or-more, another-of-that-length")
    monkeypatch.setenv("NACREOUS_CORS_ORIGINS", "https://a.example,https://b.example")
    monkeypatch.setenv("NACREOUS_PORT", "9000")
    monkeypatch.setenv("NACREOUS_HOST", "0.0.0.0")  # noqa: S104 - a value that is set and never listened on
    settings = Settings(host="127.0.0.2")
    assert settings.keys == (b"key-of-sixteen-or-more", b"another-of-that-length")
    assert settings.cors_origins == ("https://a.example", "https://b.example")
    assert (settings.host, settings.port) == ("127.0.0.2", 9000)


def test_a_variable_that_nobody_reads_is_named_with_the_nearest() -> None:
    """Neither the settings nor what Kubernetes sets for a service called nacreous, nor another program's."""
    foreign = ("NACREOUS_SERVICE_HOST", "NACREOUS_PORT_8000_TCP_ADDR", "MY_NACREOUS_STOER", "PATH")
    wrong = ("NACREOUS_STOER", "NACREOUS_DEADLINE_SECOND", "NACREOUS_APIKEYS", "NACREOUS_XYZZY")
    assert dict(unknown_variables([*KNOWN, *foreign, *wrong])) == {
        "NACREOUS_STOER": "did you mean NACREOUS_STORE?",
        "NACREOUS_DEADLINE_SECOND": "did you mean NACREOUS_DEADLINE_SECONDS?",
        "NACREOUS_APIKEYS": "did you mean NACREOUS_API_KEYS?",
        "NACREOUS_XYZZY": "docs/service.md lists the settings",
    }


def test_every_variable_that_is_read_is_known() -> None:
    """Whatever name the code has beside the settings, and the tests in their environment, is no slip."""
    code = [file for file in (ROOT / "service").rglob("*.py") if file.name != "environment.py"]
    names = {name for file in code for name in re.findall(r'"(NACREOUS_[A-Z_]+)"', file.read_text())}
    for file in (ROOT / "tests").rglob("*.py"):
        names.update(re.findall(r'environ(?:\.get\(|\[)"(NACREOUS_[A-Z_]+)"', file.read_text()))
    assert {"NACREOUS_DEVICE", "NACREOUS_SERVER_KEY", "NACREOUS_SOAK", "NACREOUS_WORKER_PARENT"} < names
    assert names <= set(KNOWN)


def test_keys_are_not_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """A key appears in no text of the settings."""
    monkeypatch.setenv("NACREOUS_API_KEYS", "key-of-sixteen-or-more")
    assert "sixteen" not in f"{Settings()!r} {Settings()} {Settings().model_dump_json()}"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("port", "70000"),
        ("api_keys", "short"),
        ("api_keys", " , "),
        ("cors_origins", "https://a.example/"),
        ("log_level", "loud"),
        ("max_body", "1"),
        ("concurrency", "0"),
    ],
)
def test_a_wrong_setting_is_refused(monkeypatch: pytest.MonkeyPatch, name: str, value: str) -> None:
    """Before anything is started."""
    monkeypatch.setenv(f"NACREOUS_{name.upper()}", value)
    with pytest.raises(ValidationError, match=name):
        Settings()
