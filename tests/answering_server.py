"""A small HTTP server that answers as it is told: late, broken off, wrong, or right, over real sockets."""

import hashlib
import json
import re
import socket
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

__all__ = ["Answer", "AnsweringServer", "Asked", "answering", "file_answer", "json_answer", "problem_answer"]


@dataclass(frozen=True)
class Asked:
    """A request as it came, and when, on a clock that never goes back."""

    method: str
    path: str
    headers: Mapping[str, str]
    body: bytes
    at_s: float


@dataclass(frozen=True)
class Answer:
    """What is answered.

    Parameters
    ----------
    status : int
        0 hangs up without a word.
    headers : mapping
    body : bytes
    sent : int, optional
        Bytes of the body after which the connection is cut; all of them and no cut without it.
    """

    status: int = 200
    headers: Mapping[str, str] = field(default_factory=dict)
    body: bytes = b""
    sent: int | None = None


Script = Answer | Callable[[Asked], Answer]


class AnsweringServer(ThreadingHTTPServer):
    """Answers each path by its script, one entry a request; the last one stays."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.scripts: dict[str, list[Script]] = {}
        self.asked: list[Asked] = []
        self._turns: dict[str, int] = defaultdict(int)
        self._guard = threading.Lock()

    @property
    def address(self) -> str:
        """Where it is."""
        return f"http://127.0.0.1:{self.server_port}"

    def script(self, call: str, *answers: Script) -> None:
        """Say what is answered to a call such as ``"GET /v1/presets"``."""
        self.scripts[call] = list(answers)

    def calls(self, call: str) -> list[Asked]:
        """Return the requests of a call, in the order in which they came."""
        return [asked for asked in self.asked if f"{asked.method} {asked.path}" == call]

    def answer_to(self, asked: Asked) -> Answer:
        """Return what is answered to a request."""
        call = f"{asked.method} {asked.path}"
        with self._guard:
            self.asked.append(asked)
            answers = self.scripts.get(call, [problem_answer(404, "missing", detail=f"there is no {call}")])
            turn = min(self._turns[call], len(answers) - 1)
            self._turns[call] += 1
        script = answers[turn]
        return script if isinstance(script, Answer) else script(asked)


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: AnsweringServer

    def do_GET(self) -> None:
        """Answer."""
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        headers = {name.lower(): value for name, value in self.headers.items()}
        answer = self.server.answer_to(Asked(self.command, self.path, headers, body, time.monotonic()))
        if not answer.status:
            self._cut()
            return
        self.send_response(answer.status)
        for name, value in {"Content-Length": str(len(answer.body)), **answer.headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(answer.body[: answer.sent])
        if answer.sent is not None:
            self._cut()

    do_POST = do_DELETE = do_GET  # noqa: N815 - the names that http.server looks for

    def _cut(self) -> None:
        self.wfile.flush()
        self.connection.shutdown(socket.SHUT_RDWR)
        self.close_connection = True

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@contextmanager
def answering() -> Iterator[AnsweringServer]:
    """Run a server while the context lasts."""
    with AnsweringServer() as server:
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()


def json_answer(document: Any, status: int = 200) -> Answer:  # noqa: ANN401 - any document
    """Return an answer in JSON."""
    return Answer(status, {"Content-Type": "application/json"}, json.dumps(document).encode())


def problem_answer(status: int, kind: str, retry_after: str = "", **members: str) -> Answer:
    """Return problem details (RFC 9457)."""
    document = {"type": f"urn:nacreous:problem:{kind}", "title": kind, "status": status, **members}
    headers = {"Content-Type": "application/problem+json"} | (
        {"Retry-After": retry_after} if retry_after else {}
    )
    return Answer(status, headers, json.dumps(document).encode())


def file_answer(
    payload: bytes, *, sent: int | None = None, shown: bytes | None = None
) -> Callable[[Asked], Answer]:
    """Return what answers with a file, or with a range of it that still holds (RFC 9110, 13.1.5).

    Parameters
    ----------
    payload : bytes
        The file that the ETag is of.
    sent : int, optional
        Bytes of each answer after which the connection is cut.
    shown : bytes, optional
        Other bytes to send in its place.
    """
    etag = f'"{hashlib.sha256(payload).hexdigest()}"'

    def answer(asked: Asked) -> Answer:
        body = payload if shown is None else shown
        first = re.fullmatch(r"bytes=(\d+)-", asked.headers.get("range", ""))
        if first is None or asked.headers.get("if-range", etag) != etag:
            return Answer(200, {"ETag": etag}, body, sent)
        start = int(first[1])
        if start >= len(body):
            return Answer(416, {"Content-Range": f"bytes */{len(body)}"})
        held = {"ETag": etag, "Content-Range": f"bytes {start}-{len(body) - 1}/{len(body)}"}
        return Answer(206, held, body[start:], sent)

    return answer
