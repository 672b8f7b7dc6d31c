"""The page of the service over HTTP: how its files are sent, and that nothing else is."""

import asyncio
import gzip
import http.client
import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from starlette.applications import Starlette

from built_page import PAGE_SOURCES, built_page, npm_command
from nacreous.tables.presets import preset_names
from nacreous.web.routes.page import BUILT_PAGE, page_routes
from served import Served, serving

KEY = "a-key-that-a-browser-lacks"
AS_IT_IS = {"accept-encoding": "identity"}


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """Return a service with the page, and with a key that no request of these tests has."""
    built_page()
    with serving(tmp_path_factory.mktemp("page") / "store", api_keys=KEY) as running:
        yield running


@pytest.fixture(scope="module")
def client(served: Served) -> Iterator[httpx.Client]:
    """Return a client that takes gzip, as browsers do."""
    with httpx.Client(base_url=served.url, headers={"accept-encoding": "gzip, deflate"}) as client:
        yield client


@pytest.fixture(scope="module")
def assets(client: httpx.Client) -> list[str]:
    """Return what the document loads at once."""
    return re.findall(r'(?:src|href)="\./(assets/[^"]+)"', client.get("/").text)


def test_the_document_is_asked_for_anew_and_rarely_sent(client: httpx.Client) -> None:
    """Its name stays when the page changes: no-cache, and a tag for 304 (RFC 9111, section 5.2.2.4)."""
    page = client.get("/")
    assert (page.status_code, page.headers["content-type"]) == (200, "text/html; charset=utf-8")
    assert page.headers["cache-control"] == "no-cache"
    again = client.get("/", headers={"if-none-match": page.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


def test_the_document_may_load_from_its_origin_alone(client: httpx.Client) -> None:
    """The policy allows nothing but what it names, and no inline script or style (CSP 3, section 6)."""
    for answer in (client.get("/"), client.head("/")):
        policy = answer.headers["content-security-policy"]
        assert policy.startswith("default-src 'none'; script-src 'self'; style-src 'self';")
        assert "unsafe" not in policy
        assert "data:" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"


def test_every_address_in_the_document_is_relative(client: httpx.Client) -> None:
    """The service may lie under a prefix of another server."""
    addresses = re.findall(r'(?:src|href)="([^"]*)"', client.get("/").text)
    assert addresses
    assert not [address for address in addresses if address.startswith("/") or ":" in address]


def test_assets_are_kept_for_good(client: httpx.Client, assets: list[str]) -> None:
    """Their names hold a hash of what they are: immutable (RFC 8246), of the type that nosniff asks for."""
    assert {Path(name).suffix for name in assets} >= {".js", ".css", ".svg"}
    types = {
        ".js": "text/javascript; charset=utf-8",
        ".css": "text/css; charset=utf-8",
        ".svg": "image/svg+xml",
    }
    for name in assets:
        answer = client.get(name)
        assert answer.status_code == 200
        assert answer.headers["cache-control"] == "max-age=31536000, immutable"
        assert answer.headers["content-type"] == types[Path(name).suffix]


def test_both_forms_are_the_file(client: httpx.Client, assets: list[str]) -> None:
    """What gzip decodes to is what is sent without it, under another tag (RFC 9110, section 8.8.3)."""
    for name in ("", *assets):
        plain = client.get(name, headers=AS_IT_IS)
        with client.stream("GET", name) as packed:
            payload = b"".join(packed.iter_raw())
        assert "content-encoding" not in plain.headers
        assert packed.headers["content-encoding"] == "gzip"
        assert gzip.decompress(payload) == plain.content
        assert packed.headers["etag"] != plain.headers["etag"]
        assert plain.headers["vary"] == packed.headers["vary"] == "Accept-Encoding"


def test_head_is_get_without_its_body(client: httpx.Client, assets: list[str]) -> None:
    """The same headers, the length included (RFC 9110, section 9.3.2)."""
    for name in ("", *assets):
        head, get = client.head(name), client.get(name)
        assert head.content == b""
        assert {**head.headers, "x-request-id": "", "date": ""} == {
            **get.headers,
            "x-request-id": "",
            "date": "",
        }


def test_a_range_is_one_of_the_file_as_it_is(client: httpx.Client, assets: list[str]) -> None:
    """Offsets count in what is asked for, and a range of gzip is of no use to anyone."""
    whole = client.get(assets[0], headers=AS_IT_IS).content
    part = client.get(assets[0], headers={"range": "bytes=10-19"})
    assert (part.status_code, part.content) == (206, whole[10:20])
    assert "content-encoding" not in part.headers


@pytest.mark.parametrize(
    "path",
    [
        "/assets/",
        "/assets/nothing.js",
        "/assets/../index.html",
        "/assets/..%2findex.html",
        "/assets/%2e%2e/routes/page.py",
        "/assets/..%2f..%2froutes%2fpage.py",
        "/assets//etc/passwd",
        "/assets/%00",
    ],
)
def test_nothing_else_is_answered(served: Served, path: str) -> None:
    """Files are known by their names; a path that leads elsewhere is a name that none of them has."""
    connection = http.client.HTTPConnection(*served.address)
    connection.request("GET", path)
    answer = connection.getresponse()
    assert answer.status == 404
    assert answer.headers["content-type"] == "application/problem+json"
    assert json.loads(answer.read())["type"] == "urn:nacreous:problem:missing"
    connection.close()


@pytest.mark.parametrize("name", ["built-from.txt", "index.html", "index.html.gz"])
def test_what_the_build_leaves_beside_the_page_is_not_sent(client: httpx.Client, name: str) -> None:
    """The document is at / alone, and no compressed form has an address of its own."""
    assert client.get(f"/{name}").status_code == 401
    assert client.get(f"/{name}", headers={"authorization": f"Bearer {KEY}"}).status_code == 404
    assert client.get(f"/assets/{name}").status_code == 404


def test_a_key_guards_what_the_page_asks_for(client: httpx.Client) -> None:
    """The page is open and asks for the key itself: what it shows of films needs one."""
    assert client.get("/").status_code == 200
    assert client.get("/v1/presets").status_code == 401


async def root_of(app: Starlette) -> httpx.Response:
    """Ask an app for /."""
    async with httpx.AsyncClient(
        transport=httpx.ASGITransport(app), base_url="http://nacreous.test"
    ) as client:
        return await client.get("/")


def test_without_a_built_page_a_plain_one_says_how_to_build_it(tmp_path: Path) -> None:
    """A checkout that was never installed has no page: presets are listed, and no script runs."""
    page = asyncio.run(root_of(Starlette(routes=page_routes(tmp_path))))
    assert "default-src 'none'" in page.headers["content-security-policy"]
    assert "<script" not in page.text
    assert "python service/page/build.py" in page.text
    for name in preset_names():
        assert f'href="v1/presets/{name}.exr"' in page.text


def test_the_page_is_built_where_the_service_looks() -> None:
    """The program that builds it and the route that answers it mean one folder."""
    assert built_page() == BUILT_PAGE


def test_the_page_knows_the_service_by_its_openapi_document(client: httpx.Client) -> None:
    """Its types of specs and answers are what make_answers.mjs makes of the document today."""
    command, environment = npm_command()
    made = subprocess.run(
        [*command, "run", "--silent", "types"],
        cwd=PAGE_SOURCES,
        env=environment,
        input=client.get("/openapi.json").text,
        capture_output=True,
        text=True,
        check=False,
    )
    assert made.returncode == 0, made.stderr
    assert made.stdout == (PAGE_SOURCES / "src" / "service" / "answers.d.ts").read_text()
