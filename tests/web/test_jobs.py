"""``/v1/jobs``: sweeps, their progress, and their end."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from running_app import RunningApp, running_app, settings_for


@pytest.fixture
def sweep(film: Mapping[str, Any]) -> dict[str, Any]:
    """Return a sweep of three tables."""
    return {"base": film, "formats": ["exr", "npz"], "vary": {"stack.layers.0.thickness_nm": [101, 102, 103]}}


def progress(text: str) -> list[dict[str, Any]]:
    """Return the data of each event, as WHATWG's HTML, section 9.2.6, has them."""
    events = [block.split("\n") for block in text.split("\n\n") if block.startswith("event:")]
    assert all(lines[0] == "event: progress" and lines[1].startswith("data: ") for lines in events)
    return [json.loads(lines[1].removeprefix("data: ")) for lines in events]


def test_a_job_is_done_in_the_end(app: RunningApp, sweep: Mapping[str, Any]) -> None:
    """202 and its address; the last event says done; every file of every table is there."""
    answer = app.post("/v1/jobs", json=sweep)
    assert answer.status_code == 202
    links = answer.json()["links"]
    assert answer.headers["location"] == links["self"]
    stream = app.get(links["events"])
    assert stream.headers["content-type"].startswith("text/event-stream")
    events = progress(stream.text)
    assert (events[-1]["state"], events[-1]["done"], events[-1]["total"]) == ("done", 3, 3)
    assert all("tables" not in event for event in events)
    assert [event["fraction"] for event in events] == sorted(event["fraction"] for event in events)
    job = app.get(links["self"]).json()
    assert len(job["tables"]) == 3
    for table in job["tables"]:
        assert table["links"].keys() == {"self", "exr", "npz"}
        assert {app.get(url).status_code for url in table["links"].values()} == {200}


def test_the_same_sweep_is_the_same_job(app: RunningApp, sweep: Mapping[str, Any]) -> None:
    """A sweep that is sent again, in another order of its keys, is the job that it was."""
    first = app.post("/v1/jobs", json=sweep).json()
    again = app.post("/v1/jobs", json=dict(reversed(sweep.items()))).json()
    assert first["id"] == again["id"]


def test_tables_come_in_pages(app: RunningApp, sweep: Mapping[str, Any]) -> None:
    """Offset and limit cut the list of finished tables, in the order of the sweep."""
    links = app.post("/v1/jobs", json=sweep).json()["links"]
    app.get(links["events"])
    whole = app.get(links["self"]).json()["tables"]
    assert [app.get(f"{links['self']}?offset={n}&limit=1").json()["tables"] for n in range(3)] == [
        [table] for table in whole
    ]
    assert app.get(f"{links['self']}?offset=3").json()["tables"] == []


def test_a_job_that_is_cancelled_stays_so(app: RunningApp, film: Mapping[str, Any]) -> None:
    """DELETE ends it, at once or as soon as the table in hand is finished, and is idempotent."""
    vary = {"stack.layers.0.thickness_nm": {"start": 200, "stop": 300, "count": 200}}
    links = app.post("/v1/jobs", json={"base": film, "vary": vary}).json()["links"]
    assert app.request("DELETE", links["self"]).json()["state"] == "cancelled"
    assert app.request("DELETE", links["self"]).json()["state"] == "cancelled"
    assert progress(app.get(links["events"]).text)[-1]["state"] == "cancelled"
    assert app.get(links["self"]).json()["done"] < 200


def test_a_table_says_which_of_the_sweep_it_is(app: RunningApp, film: Mapping[str, Any]) -> None:
    """By its place in the sweep, also where another table cannot be made and has none."""
    too_thick_nm = 5e6
    sweep = {"base": film, "vary": {"stack.layers.0.thickness_nm": [110, too_thick_nm, 120]}}
    links = app.post("/v1/jobs", json=sweep).json()["links"]
    app.get(links["events"])
    job = app.get(links["self"]).json()
    assert [table["spec"] for table in job["tables"]] == [0, 2]
    assert [failure["spec"] for failure in job["failures"]] == [1]
    spec = app.get(job["tables"][1]["links"]["self"]).json()["spec"]
    assert spec["stack"]["layers"][0]["thickness_nm"] == 120
    (second,) = app.get(f"{links['self']}?offset=1").json()["tables"]
    assert second["spec"] == 2


def test_a_table_of_a_job_has_its_own_time(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """NACREOUS_JOB_DEADLINE_SECONDS is what a table may take, and the job says so where it takes longer."""
    with running_app(settings_for(tmp_path, job_deadline_seconds=2e-9)) as hurried:
        links = hurried.post("/v1/jobs", json={"base": film}).json()["links"]
        assert progress(hurried.get(links["events"]).text)[-1]["state"] == "failed"
        assert "2e-09 s" in hurried.get(links["self"]).json()["error"]


def test_head_of_events_ends(app: RunningApp, sweep: Mapping[str, Any]) -> None:
    """HEAD does not wait for the job."""
    links = app.post("/v1/jobs", json=sweep).json()["links"]
    assert app.request("HEAD", links["events"]).status_code == 200


def test_a_sweep_of_too_many_tables(app: RunningApp, film: Mapping[str, Any]) -> None:
    """422, with how many there may be."""
    axis = {"start": 100, "stop": 200, "count": 1000}
    vary = {"stack.layers.0.thickness_nm": axis, "table.cos_theta": [*range(2, 502)]}
    answer = app.post("/v1/jobs", json={"base": film, "vary": vary})
    assert answer.status_code == 422
    assert "10,000" in answer.json()["expected"]


def test_no_file_of_the_server_is_a_base(app: RunningApp) -> None:
    """A base is a preset or a spec: no name leads to the file system."""
    for base in (
        "/etc/passwd",
        "../pyproject.toml",
        "pyproject.toml",
        "soap-bubble.toml",
        "file:///etc/passwd",
    ):
        assert app.post("/v1/jobs", json={"base": base}).status_code == 422
