"""RFC 9110 for files: ETags, conditions, ranges, HEAD and compression."""

import gzip
from collections.abc import Mapping
from typing import Any

import pytest

from running_app import RunningApp


@pytest.fixture
def url(table: Mapping[str, Any]) -> str:
    """Return a file in memory."""
    return str(table["links"]["exr"])


@pytest.mark.parametrize("tags", ["{tag}", "W/{tag}", '"other", {tag}', "*", '  {tag}  ,"x"', '"", W/{tag}'])
@pytest.mark.parametrize("kind", ["exr", "csv", "self"])
def test_a_known_file_is_not_sent_again(
    app: RunningApp, table: Mapping[str, Any], kind: str, tags: str
) -> None:
    """304 without a body, with the ETag and the Cache-Control of the 200 (RFC 9110, section 15.4.5)."""
    whole = app.get(table["links"][kind])
    answer = app.get(table["links"][kind], headers={"if-none-match": tags.format(tag=whole.headers["etag"])})
    assert answer.status_code == 304
    assert answer.content == b""
    assert "content-length" not in answer.headers
    for name in ("etag", "cache-control", "vary"):
        assert answer.headers.get(name) == whole.headers.get(name)


@pytest.mark.parametrize("tags", ['"other"', "other", "", '"', "W/", ",,,"])
def test_another_file_is_sent(app: RunningApp, url: str, tags: str) -> None:
    """What names no tag of the file is answered with it."""
    assert app.get(url, headers={"if-none-match": tags}).status_code == 200


@pytest.mark.parametrize(
    ("asked", "first", "end"),
    [
        ("bytes=0-0", 0, 1),
        ("bytes=10-19", 10, 20),
        ("bytes=10-", 10, None),
        ("bytes=-7", -7, None),
        ("bytes=5-99999999999", 5, None),
        ("bytes=-99999999999", 0, None),
        ("Bytes = 3-4", 3, 5),
    ],
)
def test_one_range(app: RunningApp, url: str, asked: str, first: int, end: int | None) -> None:
    """206 with those bytes and where they are of how many (RFC 9110, section 14.4)."""
    whole = app.get(url).content
    part = whole[first:end]
    answer = app.get(url, headers={"range": asked})
    assert answer.status_code == 206
    assert answer.content == part
    start = whole.index(part) if len(part) > 4 else first
    assert answer.headers["content-range"] == f"bytes {start}-{start + len(part) - 1}/{len(whole)}"


@pytest.mark.parametrize(
    "asked", ["bytes=0-1,3-4", "bytes=5-4", "bytes=-", "bytes=a-b", "lines=1-2", "bytes", "bytes=1-2-3"]
)
def test_other_ranges_are_ignored(app: RunningApp, url: str, asked: str) -> None:
    """Several ranges, other units and what is no range: the whole file (RFC 9110, section 14.2)."""
    assert app.get(url, headers={"range": asked}).status_code == 200


@pytest.mark.parametrize("asked", ["bytes=99999999-", "bytes=-0", "bytes=9999999999999999999-"])
def test_a_range_beyond_the_end(app: RunningApp, url: str, asked: str) -> None:
    """416 with the size (RFC 9110, section 15.5.17)."""
    answer = app.get(url, headers={"range": asked})
    assert answer.status_code == 416
    assert answer.headers["content-range"] == f"bytes */{len(app.get(url).content)}"


def test_a_range_continues_the_same_file_alone(app: RunningApp, url: str) -> None:
    """If-Range by the strong ETag (RFC 9110, section 13.1.5): another file is sent whole."""
    tag = app.get(url).headers["etag"]
    statuses = {
        given: app.get(url, headers={"range": "bytes=1-2", "if-range": given}).status_code
        for given in (tag, f"W/{tag}", '"other"', "Wed, 25 Nov 2026 03:00:00 GMT")
    }
    assert list(statuses.values()) == [206, 200, 200, 200]


@pytest.mark.parametrize("kind", ["exr", "csv", "self", "npz"])
def test_head_is_get_without_the_body(app: RunningApp, table: Mapping[str, Any], kind: str) -> None:
    """The same headers, apart from the request's id; a range is of no concern (RFC 9110, section 14.2)."""
    get = app.get(table["links"][kind])
    head = app.request("HEAD", table["links"][kind], headers={"range": "bytes=0-1"})
    assert head.status_code == 200
    assert head.content == b""
    own = {"x-request-id"} if kind in {"exr", "npz"} else {"x-request-id", "content-encoding", "etag"}
    if kind in {"exr", "npz"}:
        assert {**head.headers, "x-request-id": ""} == {**get.headers, "x-request-id": ""}
    assert head.headers.keys() >= get.headers.keys() - own


@pytest.mark.parametrize("path", ["/", "/docs", "/openapi.json", "/healthz", "/v1/presets", "/v1/materials"])
def test_every_get_is_answered_to_head(app: RunningApp, path: str) -> None:
    """RFC 9110, section 9.3.2."""
    head = app.request("HEAD", path)
    assert head.status_code == 200
    assert head.content == b""


@pytest.mark.parametrize(("kind", "smaller"), [("csv", True), ("materialx", True), ("exr", False)])
def test_text_is_compressed_and_nothing_else(
    app: RunningApp, table: Mapping[str, Any], kind: str, *, smaller: bool
) -> None:  # fmt: skip
    """Where the client takes gzip and it helps; the two forms have two ETags (RFC 9110, section 8.8.3.3)."""
    url = table["links"][kind]
    plain = app.get(url, headers={"accept-encoding": "identity"})
    packed = app.get(url, headers={"accept-encoding": "br, gzip;q=0.8"})
    assert plain.content == packed.content  # as httpx unpacks it
    assert (packed.headers.get("content-encoding") == "gzip") is smaller
    assert (int(packed.headers["content-length"]) < len(plain.content)) is smaller
    assert (packed.headers["etag"] != plain.headers["etag"]) is smaller
    assert ("accept-encoding" in plain.headers.get("vary", "").lower()) is smaller
    assert "content-encoding" not in app.get(url, headers={"accept-encoding": "gzip;q=0"}).headers


def test_the_compressed_form_is_the_same_each_time(app: RunningApp, table: Mapping[str, Any]) -> None:
    """A strong ETag is of bytes: no time of day is among them (RFC 1952, MTIME 0)."""
    url = f"http://nacreous.test{table['links']['csv']}"
    raw = []
    for _ in range(2):
        request = app.client.build_request("GET", url, headers={"accept-encoding": "gzip"})
        answer = app.run(app.client.send(request, stream=True))
        raw.append(app.run(_raw(answer)))
    assert raw[0] == raw[1]
    assert gzip.decompress(raw[0]) == app.get(url, headers={"accept-encoding": "identity"}).content
    assert raw[0][4:8] == bytes(4)


async def _raw(answer: Any) -> bytes:  # noqa: ANN401 - httpx's answer
    return b"".join([chunk async for chunk in answer.aiter_raw()])


def test_no_byte_of_a_body_is_handed_to_the_server_for_head(app: RunningApp, url: str) -> None:
    """Servers drop one, and so do clients: what the application itself sends is empty."""
    sent: list[dict[str, Any]] = []

    async def receive() -> dict[str, Any]:
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message: dict[str, Any]) -> None:
        sent.append(message)

    scope = {"type": "http", "method": "HEAD", "path": url, "query_string": b"", "headers": []}
    app.run(app.app({**scope, "root_path": "", "http_version": "1.1", "scheme": "http"}, receive, send))
    assert sent[0]["status"] == 200
    assert [message["body"] for message in sent[1:]] == [b""]
