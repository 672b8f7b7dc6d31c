"""``/v1/presets``: links that anyone can paste."""

import importlib
import sys
import types
from pathlib import Path

import numpy as np
import pytest

import nacreous
from nacreous.tables.axes import thickness_scale_values
from nacreous.tables.presets import preset, preset_names
from nacreous.tables.spec import Spec
from running_app import RunningApp

ADDON = Path(__file__).parents[2] / "clients/blender"


def arrays(content: bytes, folder: Path) -> dict[str, np.ndarray]:
    """Return the arrays of an npz file."""
    (folder / "table.npz").write_bytes(content)
    with np.load(folder / "table.npz") as file:
        return {name: file[name] for name in file.files}


def test_all_presets_are_listed_with_their_sources(app: RunningApp) -> None:
    """The names of `nacreous presets`, in their order, each with whose numbers it has."""
    listed = app.get("/v1/presets").json()
    assert [each["name"] for each in listed] == list(preset_names())
    assert all(each["title"] and each["description"] and each["source"] for each in listed)


@pytest.mark.parametrize("name", ["soap-bubble", "paper/figure-3"])
def test_a_preset_has_its_spec(app: RunningApp, name: str) -> None:
    """GET of the name, slashes and all, has the complete spec and the id of its table."""
    described = app.get(f"/v1/presets/{name}").json()
    assert Spec.model_validate(described["spec"]) == preset(name)
    assert described["links"]["exr"] == f"/v1/presets/{name}.exr"
    assert len(described["id"]) == 64


def test_a_file_is_the_one_that_the_program_writes(app: RunningApp, tmp_path: Path) -> None:
    """The bytes of `nacreous tabulate coated-lens`, under the same name, its texture beside it."""
    for suffix, path in (("exr", "coated-lens.exr"), ("mtlx", "coated-lens.mtlx")):
        nacreous.write(nacreous.tabulate(preset("coated-lens")), tmp_path / path)
        answer = app.get(f"/v1/presets/coated-lens.{suffix}", headers={"accept-encoding": "identity"})
        assert answer.content == (tmp_path / path).read_bytes()
        assert answer.headers["content-disposition"] == f'attachment; filename="{path}"'
        assert answer.headers["cache-control"] == "max-age=0, must-revalidate"


def test_one_thickness_is_a_row_of_the_axis(app: RunningApp, tmp_path: Path) -> None:
    """thickness_scale = x is the film that the table over all thicknesses has at x."""
    whole = arrays(app.get("/v1/presets/nacre.npz").content, tmp_path)
    axis = thickness_scale_values(preset("nacre").table.thickness_scale)
    row = 40
    one = arrays(app.get(f"/v1/presets/nacre.npz?thickness_scale={axis[row]:.17g}").content, tmp_path)
    assert one["R_s"].shape[0] == 1
    assert np.abs(one["R_s"][0] - whole["R_s"][row]).max() < 2e-5


def test_an_axis_is_written_as_in_a_spec(app: RunningApp, tmp_path: Path) -> None:
    """A list or a range stands in the place of table.thickness_scale."""
    answer = app.get("/v1/presets/coated-lens.npz", params={"thickness_scale": "[0.5, 1.0, 1.25]"})
    assert arrays(answer.content, tmp_path)["thickness_scale"].tolist() == [0.5, 1.0, 1.25]
    ranged = app.get(
        "/v1/presets/coated-lens.npz", params={"thickness_scale": "{ start = 0.5, stop = 1, count = 3 }"}
    )
    assert arrays(ranged.content, tmp_path)["thickness_scale"].tolist() == [0.5, 0.75, 1.0]


def test_an_unknown_preset_has_a_remedy(app: RunningApp) -> None:
    """404 with the closest name."""
    assert "did you mean soap-bubble?" in app.get("/v1/presets/soap-buble.exr").json()["detail"]


def test_the_blender_add_on_reads_the_list(app: RunningApp, monkeypatch: pytest.MonkeyPatch) -> None:
    """The add-on's own code finds every preset in what the service answers."""
    package = types.ModuleType("nacreous_add_on")
    package.__path__ = [str(ADDON)]
    monkeypatch.setitem(sys.modules, "nacreous_add_on", package)
    service = importlib.import_module("nacreous_add_on.service")
    monkeypatch.setattr(service.Service, "_get", lambda _, route, __: app.get(route).content)
    assert service.Service("http://nacreous.test").presets() == preset_names()
