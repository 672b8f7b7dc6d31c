"""One question and its answer, over networks and services as they are."""

from collections.abc import Callable
from typing import Any

import pytest
from nacreous_client import (
    AddressError,
    AnswerError,
    BudgetError,
    BusyError,
    Client,
    DeadlineError,
    KeyRefusedError,
    MissingError,
    ProblemError,
    SpecError,
    UnavailableError,
    UnreachableError,
)

from answering_server import Answer, AnsweringServer, answering, json_answer, problem_answer

Call = Callable[..., Any]

ID = "a1" * 32
TABLE = {"id": ID, "created": True, "certificate": {"nonfinite": 0}, "links": {"exr": f"/v1/tables/{ID}.exr"}}
ATTEMPTS = 3


@pytest.mark.parametrize(("status", "kind"), [(429, "busy"), (503, "unavailable")])
def test_a_service_that_asks_for_time_is_given_it(
    server: AnsweringServer, call: Call, status: int, kind: str
) -> None:
    """RFC 9110, 10.2.3: Retry-After says how long to wait, in seconds, before the next request."""
    server.script("POST /v1/tables", problem_answer(status, kind, "1"), json_answer(TABLE, 201))
    assert call(server.address, "tabulate", {"stack": {}}).id == ID
    first, second = server.calls("POST /v1/tables")
    assert second.at_s - first.at_s >= 1
    assert first.body == second.body == b'{"stack": {}}'


def test_it_gives_up_after_its_attempts(server: AnsweringServer, call: Call) -> None:
    """The last answer is the error that is raised, with what the service has said."""
    server.script("GET /v1/presets", problem_answer(503, "unavailable", detail="the engine starts"))
    with pytest.raises(UnavailableError, match="the engine starts"):
        call(server.address, "presets")
    assert len(server.asked) == ATTEMPTS


@pytest.mark.parametrize("later", ["3600", "Fri, 31 Dec 2100 23:59:59 GMT"])
def test_it_does_not_wait_for_hours(server: AnsweringServer, call: Call, later: str) -> None:
    """A Retry-After beyond the longest wait, as seconds or as a date, ends the call at once."""
    server.script("GET /v1/presets", problem_answer(429, "busy", later))
    with pytest.raises(BusyError) as caught:
        call(server.address, "presets")
    assert caught.value.retry_after_s >= 3600
    assert len(server.asked) == 1


def test_a_connection_that_is_cut_is_made_again(server: AnsweringServer, call: Call) -> None:
    """Tables are named by what is in them: to send a spec twice is to send it once."""
    server.script("POST /v1/tables", Answer(0), Answer(200, {}, b'{"id": "', 4), json_answer(TABLE, 201))
    assert call(server.address, "tabulate", {}).certificate == {"nonfinite": 0}
    assert len(server.asked) == 3


def test_nobody_there_is_told_with_the_address(call: Call) -> None:
    """A port that was free a moment ago refuses connections."""
    with answering() as server:
        address = server.address
    with pytest.raises(UnreachableError, match=f"cannot reach {address}") as caught:
        call(address, "presets")
    assert caught.value.address == address


@pytest.mark.parametrize(
    ("status", "error"),
    [
        (400, SpecError), (401, KeyRefusedError), (403, KeyRefusedError), (404, MissingError),
        (413, BudgetError), (415, SpecError), (422, SpecError), (500, ProblemError), (504, DeadlineError),
    ],
)  # fmt: skip
def test_each_status_has_its_error_and_is_not_repeated(
    server: AnsweringServer, call: Call, status: int, error: type[ProblemError]
) -> None:
    """The members of the problem details (RFC 9457) are attributes of the error."""
    told = {"field": "table.cos_theta", "expected": "a count", "got": "-1", "remedy": "give one"}
    server.script("POST /v1/tables", problem_answer(status, "spec", detail="what is wrong", **told))
    with pytest.raises(error) as caught:
        call(server.address, "tabulate", {})
    assert type(caught.value) is error
    assert {name: getattr(caught.value, name) for name in told} == told
    assert (str(caught.value), caught.value.kind, caught.value.status) == ("what is wrong", "spec", status)
    assert len(server.asked) == 1


@pytest.mark.parametrize("body", [b"<html>Bad gateway</html>", b"", b"[]", b'{"detail": 3}', b"\xff"])
def test_an_error_without_problem_details_is_one_all_the_same(
    server: AnsweringServer, call: Call, body: bytes
) -> None:
    """Proxies answer by themselves, in HTML or in nothing."""
    server.script("GET /v1/presets", Answer(502, {}, body))
    with pytest.raises(ProblemError, match="the service answered 502"):
        call(server.address, "presets")


@pytest.mark.parametrize("body", [b"hello", b"[1]", b'{"id": 3}', b'{"id": "a"}', b"\xff", b"[" * 100_000])
def test_an_answer_of_something_else_is_told(server: AnsweringServer, call: Call, body: bytes) -> None:
    """What is behind the address may be any program."""
    server.script("POST /v1/tables", Answer(200, {}, body))
    with pytest.raises(AnswerError, match="is it one"):
        call(server.address, "tabulate", {})


def test_a_link_to_another_host_is_refused(server: AnsweringServer, call: Call) -> None:
    """The key is for one host; links are paths of it."""
    server.script("POST /v1/tables", json_answer({**TABLE, "links": {"exr": "http://127.0.0.1:1/a.exr"}}))
    with pytest.raises(AnswerError):
        call(server.address, "tabulate", {})
    with pytest.raises(ValueError, match="begins with /"):
        call(server.address, "fetch", "@127.0.0.1:1/a.exr", "a.exr")


def test_the_key_is_in_a_header_and_nowhere_else(server: AnsweringServer, call: Call) -> None:
    """RFC 6750, 2.1: addresses are logged by whoever passes them on."""
    server.script("GET /v1/presets", json_answer({"presets": []}))
    call(server.address, "presets", key="s3cret")
    (asked,) = server.asked
    assert asked.headers["authorization"] == "Bearer s3cret"
    assert "s3cret" not in asked.path


@pytest.mark.parametrize("key", ["two words", "line\nend", "schlüssel"])
def test_a_key_that_no_header_can_hold_is_refused_and_not_shown(key: str) -> None:
    """A line end in it would begin another header."""
    with pytest.raises(AddressError) as caught:
        Client("http://localhost:8000", key)
    assert key not in str(caught.value)


@pytest.mark.parametrize(
    "url", ["", "localhost:8000", "ftp://localhost", "http://", "http://a/?q=1", "http://[::1", "\0"]
)
def test_what_is_no_address_is_refused(url: str) -> None:
    """With an example of what one looks like."""
    with pytest.raises(AddressError, match="such as http://localhost:8000"):
        Client(url)
