"""``/v1/tables``: what is sent, what is stored, and what is answered are the same table."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import nacreous
from nacreous.engine.cost import estimated_seconds
from nacreous.engine.work import Work
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS
from nacreous.tables.spec import Spec
from running_app import RunningApp, running_app, settings_for
from spec_texts import STACK

TOML = f"""{STACK}
[table]
cos_theta = 8
wavelength_nm = {{ start = 400, stop = 700, count = 16 }}
"""


def test_a_new_table_is_created_once(app: RunningApp, film: Mapping[str, Any]) -> None:
    """201 with Location for a spec that is unknown, 200 with the same id for it from then on."""
    spec = {**film, "name": "first", "table": {**film["table"], "cos_theta": 9}}
    first = app.post("/v1/tables", json=spec)
    again = app.post("/v1/tables", json={**spec, "name": "a label is no part of it"})
    assert (first.status_code, again.status_code) == (201, 200)
    assert first.json() == {**again.json(), "created": True}
    assert first.headers["location"] == first.json()["links"]["self"] == f"/v1/tables/{first.json()['id']}"


def test_toml_is_json(app: RunningApp, table: Mapping[str, Any]) -> None:
    """The same spec in TOML is the same table."""
    answer = app.post("/v1/tables", content=TOML, headers={"content-type": "application/toml; charset=UTF-8"})
    assert answer.json()["id"] == table["id"]


def test_the_id_is_the_library_s_own(table: Mapping[str, Any], film: Mapping[str, Any]) -> None:
    """REST and Python name a table alike."""
    dataset = nacreous.tabulate(Spec.model_validate(film))
    assert dataset.attrs["nacreous:id"] == table["id"]


@pytest.mark.parametrize("name", ["exr", "npz", "csv", "png", "spectral-exr", "materialx"])
def test_a_file_is_what_python_writes(
    app: RunningApp, table: Mapping[str, Any], film: Mapping[str, Any], tmp_path: Path, name: str
) -> None:
    """REST and Python give the same bytes for the same spec, and the ETag is their SHA-256."""
    path = tmp_path / f"{table['id']}{FORMATS[FormatName(name)].suffix}"
    nacreous.write(nacreous.tabulate(Spec.model_validate(film)), path)
    answer = app.get(table["links"][name], headers={"accept-encoding": "identity"})
    assert answer.status_code == 200
    assert answer.content == path.read_bytes()
    assert answer.headers["etag"] == f'"{hashlib.sha256(answer.content).hexdigest()}"'
    assert answer.headers["content-disposition"] == f'attachment; filename="{path.name}"'
    assert answer.headers["cache-control"] == "public, max-age=31536000, immutable"


def test_the_transmission_is_a_file_beside(app: RunningApp, table: Mapping[str, Any]) -> None:
    """A transparent substrate has a second texture; an absorbing one has none, which is 404."""
    assert app.get(f"/v1/tables/{table['id']}.transmission.exr").status_code == 200
    assert app.get("/v1/presets/anodised-titanium.transmission.exr").status_code == 404


def test_companions_are_linked_where_there_are_some(app: RunningApp, table: Mapping[str, Any]) -> None:
    """What a film transmits has a picture in each format of pictures; an opaque one has no such link."""
    names = {name for name in table["links"] if name.endswith("-transmission")}
    assert names == {"exr-transmission", "spectral-exr-transmission", "png-transmission"}
    for name in names:
        pictured = FORMATS[FormatName(name.removesuffix("-transmission"))]
        assert table["links"][name] == f"/v1/tables/{table['id']}.transmission{pictured.suffix}"
        assert app.get(table["links"][name]).headers["content-type"] == pictured.media_type
    opaque = app.get("/v1/presets/anodised-titanium").json()["links"]
    assert "exr" in opaque
    assert not [name for name in opaque if name.endswith("-transmission")]


def test_what_is_known_of_a_table(app: RunningApp, table: Mapping[str, Any]) -> None:
    """GET of the id has the complete spec, which makes the same table again."""
    known = app.get(table["links"]["self"]).json()
    assert known["certificate"] == table["certificate"]
    assert known["links"] == table["links"]
    again = app.post("/v1/tables", json=known["spec"])
    assert again.status_code == 200
    assert again.json()["id"] == table["id"]


def test_links_are_of_the_formats_that_can_hold_it(app: RunningApp, table: Mapping[str, Any]) -> None:
    """Each link of a format is answered, and no other format is: 422, with those that can."""
    links = dict(table["links"])
    assert {app.get(url).status_code for url in links.values()} == {200}
    refused = app.get(f"/v1/tables/{table['id']}.bsdf")
    assert refused.status_code == 422
    assert "rgl is for table.quantity" in refused.json()["remedy"]


def test_an_unknown_suffix_names_the_known_ones(app: RunningApp, table: Mapping[str, Any]) -> None:
    """404 that says what there is."""
    answer = app.get(f"/v1/tables/{table['id']}.tiff")
    assert answer.status_code == 404
    assert ".exr, .spectral.exr" in answer.json()["detail"]


def test_what_takes_long_becomes_a_job(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """202 with the job's address where the estimate is over the limit; the job makes the same table."""
    assert estimated_seconds(Work(Spec.model_validate(film), FormatName.EXR)) > 0
    with running_app(settings_for(tmp_path, synchronous_seconds=0)) as slow:
        answer = slow.post("/v1/tables", json=film)
        assert answer.status_code == 202
        links = answer.json()["links"]
        assert answer.headers["location"] == links["job"]
        events = slow.get(f"{links['job']}/events")
        assert '"state":"done"' in events.text
        assert slow.get(f"{links['table']}.exr").status_code == 200
        assert slow.post("/v1/tables", json=film).status_code == 200


def test_a_client_can_want_no_job(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """With long=refuse, 422 with the estimate and the limit, and nothing is begun; a known table is 200."""
    with running_app(settings_for(tmp_path, synchronous_seconds=0)) as slow:
        refused = slow.post("/v1/tables?long=refuse", json=film)
        assert refused.status_code == 422
        assert refused.json()["field"] == "table"
        assert "at most 0 s" in refused.json()["expected"]
        assert "nacreous_store_bytes 0.0" in slow.get("/metrics").text
        slow.get(f"{slow.post('/v1/tables', json=film).json()['links']['job']}/events")
        assert slow.post("/v1/tables?long=refuse", json=film).status_code == 200
        assert slow.post("/v1/tables?long=reject", json=film).json()["field"] == "long"


def test_a_file_that_takes_too_long_is_made_by_a_job(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """202 where a request could not wait for it, of a table and of a preset; 200 once it is there."""
    with running_app(settings_for(tmp_path, deadline_seconds=1e-6)) as hurried:
        known = hurried.post("/v1/tables", json=film).json()["id"]
        for url in (f"/v1/tables/{known}.npz", "/v1/presets/coated-lens.npz"):
            answer = hurried.get(url)
            assert answer.status_code == 202
            assert '"state":"done"' in hurried.get(f"{answer.headers['location']}/events").text
            assert hurried.get(url).status_code == 200
