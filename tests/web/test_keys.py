"""Bearer keys: nobody gets further without one, and none is ever shown."""

from collections.abc import Iterator

import pytest

from running_app import RunningApp, running_app, settings_for

KEYS = ("correct-horse-battery", "another-key-of-another-team")


@pytest.fixture(scope="module")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningApp]:
    """Return an app with two keys, whose pages may be asked for from one origin."""
    settings = settings_for(
        tmp_path_factory.mktemp("guarded"), api_keys=",".join(KEYS), cors_origins="https://studio.example"
    )
    with running_app(settings) as running:
        yield running


@pytest.mark.parametrize("key", KEYS)
def test_each_key_opens(guarded: RunningApp, key: str) -> None:
    """With a key the answer is the usual one, and no shared cache may keep it."""
    headers = {"authorization": f"bearer {key}"}
    assert guarded.get("/v1/presets", headers=headers).status_code == 200
    file = guarded.get("/v1/presets/coated-lens.exr", headers=headers)
    table = file.headers["etag"]
    assert table
    known = guarded.get("/v1/presets/coated-lens", headers=headers).json()["id"]
    cached = guarded.get(f"/v1/tables/{known}.exr", headers=headers)
    assert cached.headers["cache-control"].startswith("private")


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"authorization": ""},
        {"authorization": "Bearer"},
        {"authorization": "Bearer "},
        {"authorization": "Bearer wrong"},
        {"authorization": f"Basic {KEYS[0]}"},
        {"authorization": KEYS[0]},
        {"authorization": f"Bearer {KEYS[0]}x"},
        {"authorization": f"Bearer {KEYS[0][:-1]}"},
        {"authorization": f"Bearer {KEYS[0]} {KEYS[1]}"},
        {"x-api-key": KEYS[0]},
        {"cookie": f"key={KEYS[0]}"},
    ],
)
@pytest.mark.parametrize("path", ["/v1/presets", f"/v1/tables/{'a' * 64}.exr", "/metrics", "/nothing"])
def test_nothing_else_does(guarded: RunningApp, headers: dict[str, str], path: str) -> None:
    """401 with a challenge (RFC 6750, section 3), whether the path exists or not."""
    answer = guarded.get(path, headers=headers)
    assert answer.status_code == 401
    assert answer.headers["www-authenticate"].startswith("Bearer")
    assert not any(key in answer.text for key in KEYS)


def test_a_key_in_the_query_is_none(guarded: RunningApp) -> None:
    """Addresses are logged and shared; a key in one opens nothing."""
    assert guarded.get(f"/v1/presets?key={KEYS[0]}&access_token={KEYS[0]}").status_code == 401


def test_two_authorizations_are_none(guarded: RunningApp) -> None:
    """Which of two would count is not for a client to play with."""
    headers = [("authorization", f"Bearer {KEYS[0]}"), ("authorization", "Bearer wrong")]
    assert guarded.get("/v1/presets", headers=headers).status_code == 401


@pytest.mark.parametrize("path", ["/healthz", "/readyz", "/", "/docs", "/openapi.json"])
def test_probes_and_the_page_are_open(guarded: RunningApp, path: str) -> None:
    """Load balancers have no key, and the page shows nothing of what is stored."""
    assert guarded.get(path).status_code == 200


def test_the_openapi_document_says_which_routes_want_a_key(guarded: RunningApp) -> None:
    """A GET with a fixed path lists 401 where it answers 401 without a key, and nowhere else."""
    paths = guarded.get("/openapi.json").json()["paths"]
    listed = {path: "401" in routes["get"]["responses"] for path, routes in paths.items() if "get" in routes}
    fixed = {path: lists for path, lists in listed.items() if "{" not in path}
    assert {"/healthz", "/readyz", "/metrics", "/v1/presets"} <= fixed.keys()
    assert fixed == {path: guarded.get(path).status_code == 401 for path in fixed}


def test_a_preflight_needs_no_key(guarded: RunningApp) -> None:
    """Browsers send none with it (Fetch, section 3.3.5); the origin is named, no other is."""
    asked = {"access-control-request-method": "GET", "access-control-request-headers": "authorization"}
    own = guarded.request("OPTIONS", "/v1/presets", headers={"origin": "https://studio.example", **asked})
    assert own.status_code == 200
    assert own.headers["access-control-allow-origin"] == "https://studio.example"
    other = guarded.request("OPTIONS", "/v1/presets", headers={"origin": "https://evil.example", **asked})
    assert other.status_code == 400
    assert "access-control-allow-origin" not in other.headers


@pytest.mark.parametrize(
    ("asked", "wrong"),
    [
        ({"origin": "https://evil.example"}, "origin"),
        ({"access-control-request-method": "PUT"}, "method"),
        ({"access-control-request-headers": "authorization, x-secret"}, "headers"),
    ],
)
def test_a_preflight_that_is_refused_is_a_problem(
    guarded: RunningApp, asked: dict[str, str], wrong: str
) -> None:
    """As every error is (RFC 9457); it says which of the three may not be."""
    allowed = {
        "origin": "https://studio.example",
        "access-control-request-method": "DELETE",
        "access-control-request-headers": "authorization, content-type, if-none-match, range, if-range",
    }
    assert guarded.request("OPTIONS", "/v1/presets", headers=allowed).status_code == 200
    answer = guarded.request("OPTIONS", "/v1/presets", headers={**allowed, **asked})
    assert answer.status_code == answer.json()["status"] == 400
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.headers["content-length"] == str(len(answer.content))
    assert "origin" in answer.headers["vary"].lower()
    assert answer.json()["type"] == "urn:nacreous:problem:cors"
    assert answer.json()["detail"].endswith(f"got another {wrong}")


def test_a_page_may_read_what_it_needs_to_go_on(guarded: RunningApp) -> None:
    """Headers beyond the few that every page may read are named (Fetch, section 3.3.2)."""
    headers = {"origin": "https://studio.example", "authorization": f"Bearer {KEYS[0]}"}
    exposed = guarded.get("/v1/presets", headers=headers).headers["access-control-expose-headers"]
    assert {"ETag", "Location", "Retry-After", "Content-Range", "X-Request-Id"} <= {*exposed.split(", ")}


def test_a_page_of_the_origin_reads_errors_too(guarded: RunningApp) -> None:
    """A problem has the header that lets the page read it."""
    answer = guarded.get("/v1/presets", headers={"origin": "https://studio.example"})
    assert answer.status_code == 401
    assert answer.headers["access-control-allow-origin"] == "https://studio.example"


def test_without_setting_no_origin_is_allowed(app: RunningApp) -> None:
    """CORS is off unless it is configured: a preflight is a method that the path does not have."""
    answer = app.get("/v1/presets", headers={"origin": "https://studio.example"})
    assert answer.status_code == 200
    assert "access-control-allow-origin" not in answer.headers
    asked = {"origin": "https://studio.example", "access-control-request-method": "GET"}
    assert app.request("OPTIONS", "/v1/presets", headers=asked).status_code == 405
