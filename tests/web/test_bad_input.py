"""Every bad input of the promises: a clear 4xx in at most 4 KB, and the engine hears nothing of it."""

import gzip
import json
from typing import Any

import pytest

from running_app import RunningApp
from spec_texts import LAYER, film, layer, table

JSON = {"content-type": "application/json"}
DOCUMENTS: dict[str, tuple[str | bytes, int]] = {
    "NaN": (layer("NaN"), 400),
    "Infinity": (layer("-Infinity"), 400),
    "1e999": (layer("1e999"), 400),
    "NaN as text": (layer('"NaN"'), 422),
    "a number as text": (layer('"420"'), 422),
    "true for a number": (layer("true"), 422),
    "a lone surrogate": (film(rest=', "name": "\\ud800"'), 400),
    "a lone surrogate as a key": (film(rest=', "\\udfff": 1'), 400),
    "a lone surrogate in bytes": (film(rest=', "name": "?"').encode().replace(b"?", b"\xed\xa0\x80"), 400),
    "a key twice": (film(rest=', "name": "a", "name": "b"'), 400),
    "an extra field": (film(rest=', "colr": {}'), 422),
    "an extra field with a long name": (film(rest=f', "{"€" * 5000}": 1'), 422),
    "depth 100,000": ("[" * 100_000, 400),
    "tables 100,000 deep": ('{"a":' * 100_000, 400),
    "empty": ("", 400),
    "blank": (" \n", 400),
    "no JSON": ("{", 400),
    "a list": ("[]", 400),
    "not UTF-8": (b"\xff\xfe{}", 400),
    "an integer of 5,000 digits": (layer("9" * 5000), 400),
    "control characters": (film(rest=', "name": "\\u0000"'), 422),
    "2 MiB + 1": (" " * (2 * 2**20 + 1), 413),
}
PHYSICS: dict[str, tuple[str | bytes, int]] = {
    "no layers": (film(""), 422),
    "65 layers": (film(", ".join([LAYER] * 65)), 422),
    "d < 0": (layer("-1"), 422),
    "d = 1e-40": (layer("1e-40"), 422),
    "d = 1e9": (layer("1e9"), 422),
    "n = 0": (layer(material='{"n": 0}'), 422),
    "k < 0": (layer(material='{"n": 1.5, "k": -0.1}'), 422),
    "|n| = 1e4": (layer(material='{"n": 1e4}'), 422),
    "an unknown material": (layer(material='"unobtainium"'), 422),
    "a material out of its range": (layer(material='"main/Ag/Sytchkova"'), 422),
    "an absorbing incident medium": (film().replace('"air"', '{"n": 1, "k": 0.1}'), 422),
    "an empty axis": (table('"wavelength_nm": []'), 422),
    "an unsorted axis": (table('"wavelength_nm": [400, 700, 550]'), 422),
    "an axis of one point": (table('"cos_theta": [0.5]'), 422),
    "mu above 1": (table('"cos_theta": [0, 1.5]'), 422),
    "mu below 0": (table('"cos_theta": [-0.5, 1]'), 422),
    "70,000 layers that are none": (film(", ".join(['{"x": 1}'] * 70_000)), 422),
    "an unknown illuminant": (film(rest=', "colour": {"illuminant": "Q"}'), 422),
    "an unknown observer": (film(rest=', "colour": {"observer": "nobody"}'), 422),
    "over the byte budget": (
        table('"cos_theta": 65536, "thickness_scale": {"start": 0.5, "stop": 1, "count": 65536}'),
        413,
    ),
    "over the byte budget, as spectra": (
        table('"wavelength_nm": {"start": 900, "stop": 990, "count": 65536}, "cos_theta": 65536'),
        413,
    ),
}  # fmt: skip
CASES = DOCUMENTS | PHYSICS

HEADERS: dict[str, tuple[dict[str, str], int]] = {
    "gzip": ({**JSON, "content-encoding": "gzip"}, 415),
    "several encodings": ({**JSON, "content-encoding": "gzip, br"}, 415),
    "no type": ({"content-type": ""}, 415),
    "a form": ({"content-type": "application/x-www-form-urlencoded"}, 415),
    "text": ({"content-type": "text/plain"}, 415),
    "UTF-16": ({"content-type": "application/json; charset=utf-16"}, 415),
    "a long type": ({"content-type": "a/" + "b" * 5000}, 415),
    "64 KB of header": ({**JSON, "x-many": "n" * 2**16}, 431),
}
PATHS = [
    "/v1/tables/..%2f..%2fetc%2fpasswd",
    "/v1/tables/../../etc/passwd",
    "/v1/tables/%2e%2e/%2e%2e/etc/passwd.exr",
    "/v1/tables/%00.exr",
    f"/v1/tables/{'a' * 63}",
    f"/v1/tables/{'A' * 64}.exr",
    f"/v1/tables/{'g' * 64}.exr",
    f"/v1/tables/{'a' * 64}",
    f"/v1/tables/{'a' * 64}.exr",
    f"/v1/tables/{'a' * 64}.spec",
    f"/v1/tables/{'a' * 64}%00.exr",
    f"/v1/tables/{'a' * 64}.exr%00",
    f"/v1/tables/{'a' * 64}.exr/",
    f"/v1/tables/{'é' * 64}.exr",
    "/v1/tables/%ff%fe.exr",
    "/v1/tables/" + "a" * 8000,
    "/v1/presets/../../secret.exr",
    "/v1/presets/soap-bubble%00.exr",
    "/v1/presets/soap-bubble.toml",
    "/v1/presets/%2e%2e%2fsoap-bubble.exr",
    "/v1/presets/" + "n" * 5000,
    "/v1/materials/../../etc/passwd",
    "/v1/materials/main/Ag/Nobody",
    "/v1/materials/%00",
    "/v1/materials/" + "m/" * 3000,
    f"/v1/jobs/{'0' * 64}",
    "/v1/jobs/..",
    f"/v1/jobs/{'0' * 64}/events",
    "/v2/tables",
    "//etc/passwd",
]
QUERIES = [
    "/v1/presets/soap-bubble.exr?thickness_scale=nan",
    "/v1/presets/soap-bubble.exr?thickness_scale=inf",
    "/v1/presets/soap-bubble.exr?thickness_scale=1e999",
    "/v1/presets/soap-bubble.exr?thickness_scale=-1",
    "/v1/presets/soap-bubble.exr?thickness_scale=0",
    "/v1/presets/soap-bubble.exr?thickness_scale=101",
    "/v1/presets/soap-bubble.exr?thickness_scale=[1, nan]",
    "/v1/presets/soap-bubble.exr?thickness_scale=[1, 0.5]",
    "/v1/presets/soap-bubble.exr?thickness_scale=thick",
    "/v1/presets/soap-bubble.exr?thickness_scale=1&thickness_scale=2",
    "/v1/presets/soap-bubble.exr?thickness_scale=" + "1" * 5000,
    "/v1/presets/soap-bubble.exr?thicknes_scale=1",
    "/v1/presets/soap-bubble.bsdf",
    "/v1/presets?page=2",
    "/v1/materials?search=" + "s" * 5000,
    "/v1/materials?limit=1e3",
    "/v1/materials?limit=-1",
    "/v1/materials?offset=99999999999999999999999",
    f"/v1/jobs/{'0' * 64}?limit=many",
    "/healthz?%00=%ff",
]


def check_problem(answer: Any, status: int) -> dict[str, Any]:  # noqa: ANN401 - httpx's answer
    """Check that an answer is a problem as RFC 9457 has it, and short."""
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert len(answer.content) <= 4096
    problem = dict(answer.json())
    assert problem["status"] == status
    assert problem["type"].startswith("urn:nacreous:problem:")
    assert problem["title"]
    assert problem["detail"]
    return problem


@pytest.mark.parametrize(("body", "status"), CASES.values(), ids=CASES)
@pytest.mark.parametrize("route", ["/v1/tables", "/v1/jobs"])
def test_a_bad_body_is_a_problem(app: RunningApp, route: str, body: str | bytes, status: int) -> None:
    """No 5xx, no work for the engine, and the field is named where there is one."""
    computed = app.computed
    content = body if isinstance(body, bytes) else body.encode()
    if route == "/v1/jobs" and content.startswith(b"{") and status != 400:
        content = b'{"base": %s}' % content
    problem = check_problem(app.post(route, content=content, headers=JSON), status)
    assert app.computed == computed
    if status == 422:
        assert problem["expected"]
        assert problem["got"]


@pytest.mark.parametrize(("headers", "status"), HEADERS.values(), ids=HEADERS)
@pytest.mark.parametrize("route", ["/v1/tables", "/v1/jobs"])
def test_a_bad_header_is_a_problem(app: RunningApp, route: str, headers: dict[str, str], status: int) -> None:
    """A body that is compressed, or of another type, is not looked at."""
    computed = app.computed
    check_problem(app.post(route, content=gzip.compress(film().encode()), headers=headers), status)
    assert app.computed == computed


@pytest.mark.parametrize("path", PATHS)
def test_a_bad_path_is_not_found(app: RunningApp, path: str) -> None:
    """Whatever a path holds, it is 404, and nothing is computed."""
    computed = app.computed
    check_problem(app.get(path), 404)
    assert app.computed == computed


@pytest.mark.parametrize("url", QUERIES)
def test_a_bad_query_is_refused(app: RunningApp, url: str) -> None:
    """A parameter that is wrong, unknown or given twice is 422, and nothing is computed."""
    computed = app.computed
    check_problem(app.get(url), 422)
    assert app.computed == computed


def test_the_byte_budget_is_named(app: RunningApp) -> None:
    """413 says what the table would need and what the limit is."""
    body, _ = PHYSICS["over the byte budget"]
    problem = check_problem(app.post("/v1/tables", content=body, headers=JSON), 413)
    assert "49,152.0 MiB" in problem["detail"]
    assert "2,048.0 MiB" in problem["detail"]


def test_echoes_are_short(app: RunningApp) -> None:
    """A name of 5,000 characters, each of which JSON escapes, comes back cut."""
    body = json.dumps(
        {"stack": {"incident": "\u0001" * 5000, "substrate": "\U0001f4a9" * 5000, "layers": []}}
    )
    problem = check_problem(app.post("/v1/tables", content=body, headers=JSON), 422)
    assert all(len(value) <= 500 for value in problem.values() if isinstance(value, str))


@pytest.mark.parametrize("method", ["PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "BREW"])
def test_a_method_that_a_path_does_not_have(app: RunningApp, method: str) -> None:
    """405, with those that it has in Allow (RFC 9110, section 15.5.6)."""
    answer = app.request(method, "/v1/presets")
    check_problem(answer, 405)
    assert answer.headers["allow"] == "GET, HEAD"


def test_ten_thousand_tags_and_ranges(app: RunningApp, table: dict[str, Any]) -> None:
    """Long lists cost nothing: the whole file is answered, or a problem where the header is too large."""
    url = table["links"]["exr"]
    ranges = "bytes=" + ",".join(f"{n}-{n}" for n in range(1000))
    whole = app.get(url, headers={"range": ranges})
    assert whole.status_code == 200
    assert whole.content == app.get(url).content
    check_problem(app.get(url, headers={"range": "bytes=" + ",".join(["0-0"] * 10_000)}), 431)
    check_problem(app.get(url, headers={"if-none-match": ", ".join(['"x"'] * 10_000)}), 431)
