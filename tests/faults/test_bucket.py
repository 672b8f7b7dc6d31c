"""The service on a bucket: a real S3 server on loopback, and two services that share it."""

from pathlib import Path

import httpx
import pytest
import s3fs
from moto.server import ThreadedMotoServer

from served import serving

FILM = {
    "stack": {
        "incident": "air",
        "substrate": {"n": 1.5},
        "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
    },
    "table": {"cos_theta": 8},
}


def test_services_share_a_bucket(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What one has computed the other reads instead of computing it; no quota is asked of a bucket."""
    server = ThreadedMotoServer("127.0.0.1", 0, verbose=False)
    server.start()
    host, port = server.get_host_and_port()
    for name, value in {
        "FSSPEC_S3_ENDPOINT_URL": f"http://{host}:{port}",
        "FSSPEC_S3_KEY": "nobody",
        "FSSPEC_S3_SECRET": "nothing",
    }.items():
        monkeypatch.setenv(name, value)
    s3fs.S3FileSystem(endpoint_url=f"http://{host}:{port}", key="nobody", secret="nothing").mkdir("films")  # noqa: S106
    files = []
    for name, status in (("one", 201), ("two", 200)):
        with serving(tmp_path / name, store="s3://films/nacreous") as served:
            served.await_ready()
            with httpx.Client(base_url=served.url, timeout=60) as client:
                answer = client.post("/v1/tables", json=FILM)
                assert answer.status_code == status
                files.append(client.get(answer.json()["links"]["exr"]).content)
                lines = client.get("/metrics").text.splitlines()
                assert f"nacreous_engine_computed_total {float(status == 201)}" in lines
    server.stop()
    assert files[0] == files[1]
    assert not any(tmp_path.glob("*/"))
