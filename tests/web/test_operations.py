"""What those who run a service see of it: health, readiness, metrics and logs."""

import asyncio
import json
import logging
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from prometheus_client.parser import text_string_to_metric_families

from nacreous.web.logs import JsonFormatter
from running_app import RunningApp, running_app, settings_for


def figures(app: RunningApp) -> dict[tuple[str, tuple[tuple[str, str], ...]], float]:
    """Return every sample of /metrics by its name and labels."""
    text = app.get("/metrics").text
    families = list(text_string_to_metric_families(text))
    return {
        (sample.name, tuple(sorted(sample.labels.items()))): sample.value
        for family in families
        for sample in family.samples
    }


def figure(app: RunningApp, name: str, **labels: str) -> float:
    """Return one sample, 0 where it has not been seen."""
    return figures(app).get((name, tuple(sorted(labels.items()))), 0.0)


def test_health_and_readiness(app: RunningApp) -> None:
    """Both are 200 while tables are computed, and no cache keeps them."""
    for path in ("/healthz", "/readyz"):
        answer = app.get(path)
        assert answer.status_code == 200
        assert answer.headers["cache-control"] == "no-store"


def test_an_unwritable_store_is_not_ready(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """/readyz says what is wrong; tables are answered all the same."""
    (tmp_path / "store").write_text("a file stands where the store would be")
    with running_app(settings_for(tmp_path)) as running:
        answer = running.get("/readyz")
        assert answer.status_code == 503
        assert answer.headers["retry-after"]
        assert "store" in answer.json()["detail"]
        assert running.get("/healthz").status_code == 200
        assert running.post("/v1/tables", json=film).status_code == 201


def test_requests_are_counted_by_the_template_of_their_route(
    app: RunningApp, table: Mapping[str, Any]
) -> None:
    """One label for all tables, one for all that is not there: labels do not grow with what is asked."""
    labels = {"method": "GET", "route": "/v1/tables/{table_id}.{suffix}", "status": "200"}
    before = figure(app, "nacreous_requests_total", **labels)
    for kind in ("exr", "npz", "csv"):
        app.get(table["links"][kind])
    assert figure(app, "nacreous_requests_total", **labels) == before + 3
    for n in range(5):
        app.get(f"/nothing/{n}")
        app.request(f"BREW{n}", "/v1/presets")
    routes = {dict(labels).get("route") for name, labels in figures(app) if name.startswith("nacreous_requ")}
    methods = {
        dict(labels).get("method") for name, labels in figures(app) if name == "nacreous_requests_total"
    }
    openapi = app.get("/openapi.json").json()
    assert routes <= {*openapi["paths"], "/", "/docs", "/openapi.json", "none", None}
    assert methods <= {"GET", "HEAD", "POST", "DELETE", "PUT", "PATCH", "OPTIONS", "TRACE", "other"}


def test_hits_and_misses_are_told_apart(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """The first request computes, the second finds in memory, and a new process finds in the store."""
    with running_app(settings_for(tmp_path)) as first:
        links = first.post("/v1/tables", json=film).json()["links"]
        assert figure(first, "nacreous_engine_computed_total") == 1
        assert figure(first, "nacreous_library_misses_total") == 1
        first.get(links["exr"])
        assert figure(first, "nacreous_library_hits_total", place="memory") >= 1
        assert figure(first, "nacreous_store_bytes") > 0
        assert figure(first, "nacreous_engine_state", state="ready") == 1
    with running_app(settings_for(tmp_path)) as second:
        assert second.get(links["exr"]).status_code == 200
        assert figure(second, "nacreous_library_hits_total", place="store") == 1
        assert figure(second, "nacreous_engine_computed_total") == 0


def test_identical_requests_share_one_computation(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """50 that come at once are one work of the engine, and all of them are answered alike."""
    with running_app(settings_for(tmp_path)) as app:

        async def all_at_once() -> list[Any]:
            return await asyncio.gather(*(app.client.post("/v1/tables", json=film) for _ in range(50)))

        answers = app.run(all_at_once())
        assert {answer.json()["id"] for answer in answers} == {answers[0].json()["id"]}
        assert figure(app, "nacreous_engine_computed_total") == 1
        assert figure(app, "nacreous_library_coalesced_total") == 49


def test_a_request_is_one_line_without_secrets(
    app: RunningApp, table: Mapping[str, Any], caplog: pytest.LogCaptureFixture
) -> None:
    """Method, route, status, time, bytes and id: no header, no key, no path and no query."""
    with caplog.at_level(logging.INFO, "nacreous.web"):
        answer = app.get(table["links"]["exr"] + "?secret=s3cret", headers={"authorization": "Bearer s3cret"})
    (record,) = [record for record in caplog.records if record.getMessage() == "request"]
    line = JsonFormatter().format(record)
    logged = json.loads(line)
    assert "\n" not in line
    assert logged.keys() == {
        *("time", "level", "logger", "event"),
        *("id", "method", "route", "status", "ms", "bytes"),
    }
    assert (logged["method"], logged["status"], logged["bytes"]) == ("GET", 422, len(answer.content))
    assert logged["id"] == answer.headers["x-request-id"]
    assert "s3cret" not in line
    assert table["id"] not in line


def test_an_unforeseen_error_says_nothing_of_its_inside(
    app: RunningApp, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """500 as a problem; the traceback is in the log, under the id that the client has."""
    monkeypatch.setattr(app.app.state.service, "library", None)
    with caplog.at_level(logging.ERROR, "nacreous.web"):
        answer = app.get(f"/v1/tables/{'a' * 64}")
    assert answer.status_code == 500
    assert answer.headers["content-type"] == "application/problem+json"
    assert "NoneType" not in answer.text
    (record,) = caplog.records
    logged = json.loads(JsonFormatter().format(record))
    assert "NoneType" in logged["traceback"]
    assert logged["id"] == answer.headers["x-request-id"]


@pytest.mark.parametrize("path", ["/", "/v1/presets", "/healthz", "/nothing", f"/v1/tables/{'0' * 64}"])
def test_browsers_are_told_not_to_guess(app: RunningApp, path: str) -> None:
    """Every answer has nosniff, also where it is a problem."""
    assert app.get(path).headers["x-content-type-options"] == "nosniff"


def test_the_documentation_loads_nothing_from_elsewhere(app: RunningApp) -> None:
    """Every script, style and picture of /docs is the service's own."""
    page = app.get("/docs")
    assert page.status_code == 200
    loaded = re.findall(r'(?:src|href)="([^"]*)"', page.text)
    assert len(loaded) >= 3
    for address in loaded:
        assert address.startswith("/")
        assert app.get(address).status_code == 200
