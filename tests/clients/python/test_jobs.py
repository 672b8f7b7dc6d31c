"""Jobs, over streams of events that are cut."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from nacreous_client import (
    Job,
    JobFailedError,
)

from answering_server import Answer, AnsweringServer, file_answer, json_answer

Call = Callable[..., Any]

ID = "a1" * 32
TABLE = {"id": ID, "created": True, "certificate": {"nonfinite": 0}, "links": {"exr": f"/v1/tables/{ID}.exr"}}


def _job(state: str, done: int, **more: object) -> dict[str, Any]:
    links = {"self": "/v1/jobs/j", "events": "/v1/jobs/j/events"}
    return {"id": "j", "state": state, "done": done, "total": 2, "failures": [], "links": links, **more}


def _events(*jobs: dict[str, Any], end: str = "\n") -> bytes:
    lines = [f": still there{end}{end}event: progress{end}data: {json.dumps(job)}{end}{end}" for job in jobs]
    return "".join(lines).encode()


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_job_is_waited_for_over_streams_that_are_cut(server: AnsweringServer, call: Call, end: str) -> None:
    """Proxies end long answers; server-sent events end their lines as they like (HTML standard, 9.2.5)."""
    stream = _events(_job("queued", 0), _job("running", 1), end=end)
    table = {"spec": 0, "id": ID, "links": {"exr": f"/v1/tables/{ID}.exr"}}
    server.script("POST /v1/jobs", json_answer(_job("queued", 0), 202))
    server.script(
        "GET /v1/jobs/j/events",
        Answer(200, {}, stream, len(stream) - 5),
        Answer(200, {}, _events(_job("running", 1), _job("done", 2), end=end)),
    )
    server.script("GET /v1/jobs/j?limit=1000", json_answer(_job("done", 2, tables=[table])))
    told: list[Job] = []
    submitted = call(server.address, "submit", {"base": "soap-bubble"})
    done = call(server.address, "wait", submitted, told.append)
    assert [(job.state, job.done) for job in told] == [("queued", 0), ("running", 1), ("done", 2)]
    assert (done.finished, done.tables[0].links["exr"]) == (True, f"/v1/tables/{ID}.exr")


def test_a_table_of_some_time_is_waited_for(server: AnsweringServer, call: Call) -> None:
    """202 names the job and where the table will be (RFC 9110, 15.3.3)."""
    links = {"job": "/v1/jobs/j", "table": f"/v1/tables/{ID}"}
    server.script("POST /v1/tables", json_answer({"job": _job("queued", 0), "links": links}, 202))
    server.script("GET /v1/jobs/j/events", Answer(200, {}, _events(_job("done", 2))))
    server.script("GET /v1/jobs/j?limit=1000", json_answer(_job("done", 2)))
    server.script(f"GET /v1/tables/{ID}", json_answer({**TABLE, "spec": {"stack": {}}}))
    told: list[Job] = []
    table = call(server.address, "tabulate", {"stack": {}}, told.append)
    assert (table.id, table.spec, [job.state for job in told]) == (ID, {"stack": {}}, ["done"])


def test_a_file_of_some_time_is_waited_for(server: AnsweringServer, call: Call, tmp_path: Path) -> None:
    """A format that has not been asked for before may take a job; the file is at the same link after it."""
    links = {"job": "/v1/jobs/j", "table": f"/v1/tables/{ID}"}
    server.script(
        f"GET /v1/tables/{ID}.bsdf",
        json_answer({"job": _job("queued", 0), "links": links}, 202),
        file_answer(b"measured"),
    )
    server.script("GET /v1/jobs/j/events", Answer(200, {}, _events(_job("done", 2))))
    server.script("GET /v1/jobs/j?limit=1000", json_answer(_job("done", 2)))
    told: list[Job] = []
    call(server.address, "download", ID, ".bsdf", tmp_path / "film.bsdf", None, told.append)
    assert (tmp_path / "film.bsdf").read_bytes() == b"measured"
    assert [job.state for job in told] == ["done"]


def test_a_job_of_many_tables_is_read_by_the_page(server: AnsweringServer, call: Call) -> None:
    """All tables are in the job that is returned, in the order of the sweep."""
    tables = [{"spec": at, "id": f"{at:064x}", "links": {}} for at in range(1001)]
    server.script("GET /v1/jobs/j?limit=1000", json_answer(_job("done", 2, tables=tables[:1000])))
    server.script("GET /v1/jobs/j?offset=1000&limit=1000", json_answer(_job("done", 2, tables=tables[1000:])))
    assert [table.id for table in call(server.address, "job", "j").tables] == [each["id"] for each in tables]


@pytest.mark.parametrize("state", ["failed", "cancelled", "done"])
def test_a_table_that_could_not_be_made_is_told(server: AnsweringServer, call: Call, state: str) -> None:
    """The reason is that of the service, in its own words."""
    failures = [{"spec": 0, "message": "stack.layers: expected a layer, got nothing"}]
    links = {"job": "/v1/jobs/j", "table": f"/v1/tables/{ID}"}
    server.script("POST /v1/tables", json_answer({"job": _job("queued", 0), "links": links}, 202))
    server.script("GET /v1/jobs/j/events", Answer(200, {}, _events(_job(state, 0))))
    server.script("GET /v1/jobs/j?limit=1000", json_answer(_job(state, 0, failures=failures)))
    with pytest.raises(JobFailedError, match="expected a layer, got nothing"):
        call(server.address, "tabulate", {})


def test_a_job_is_cancelled(server: AnsweringServer, call: Call) -> None:
    """DELETE, which may be said twice (RFC 9110, 9.2.2)."""
    server.script("DELETE /v1/jobs/j", Answer(0), Answer(204))
    call(server.address, "cancel", "j")
    assert len(server.calls("DELETE /v1/jobs/j")) == 2
