"""Places for a store: a folder, memory, and a bucket of a real S3 server on loopback."""

import logging
from collections.abc import Iterator
from pathlib import Path

import fsspec
import pytest
import s3fs
from moto.server import ThreadedMotoServer

from nacreous.store.store import Store, open_store


@pytest.fixture(scope="session")
def s3_endpoint() -> Iterator[str]:
    """Return the URL of moto's server."""
    logging.getLogger("werkzeug").setLevel(logging.ERROR)
    server = ThreadedMotoServer("127.0.0.1", 0, verbose=False)
    server.start()
    host, port = server.get_host_and_port()
    yield f"http://{host}:{port}"
    server.stop()


@pytest.fixture
def s3_options(s3_endpoint: str, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Return what fsspec is told of S3, and tell it."""
    options = {"endpoint_url": s3_endpoint, "key": "nobody", "secret": "nothing"}
    monkeypatch.setitem(fsspec.config.conf, "s3", options)
    return options


@pytest.fixture
def bucket(s3_options: dict[str, str], request: pytest.FixtureRequest) -> Iterator[str]:
    """Return the URL of a new bucket."""
    name = f"films-{abs(hash(request.node.nodeid))}"
    files = s3fs.S3FileSystem(**s3_options)
    files.mkdir(name)
    yield f"s3://{name}"
    files.rm(name, recursive=True)


@pytest.fixture(params=["folder", "memory", "s3"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """Return a place of each kind, with nothing in it."""
    if request.param == "s3":
        return f"{request.getfixturevalue('bucket')}/nacreous"
    return str(tmp_path / "store") if request.param == "folder" else f"memory://{tmp_path.name}"


@pytest.fixture
def store(url: str) -> Store:
    """Return the store at each kind of place."""
    return open_store(url)
