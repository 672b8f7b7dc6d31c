"""A table's id: what decides it, and what does not."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from nacreous.opencl import sources
from nacreous.tables.identity import table_id
from nacreous.tables.presets import preset
from nacreous.tables.spec import Spec
from nacreous.tables.tabulate import tabulate_table

FILM = {
    "stack": {
        "incident": "air",
        "substrate": {"n": 1.5},
        "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
    },
}


def _id(**sections: object) -> str:
    return table_id(Spec.model_validate(FILM | sections))


def test_labels_do_not_matter() -> None:
    """Name, description and source are for people."""
    assert _id() == _id(name="a", description="b", source="c")


def test_the_same_id_is_the_same_table_to_the_last_byte() -> None:
    """Labels are in no file: whoever asks for a table by its id must get the same bytes as anyone else."""
    named = Spec.model_validate(FILM | {"name": "a", "description": "b", "source": "c"})
    bare = Spec.model_validate(FILM)
    first, second = (tabulate_table(spec, ()).provenance for spec in (named, bare))
    assert dict(first) == dict(second)


@pytest.mark.parametrize(
    "sections",
    [
        {"table": {"cos_theta": 65}},
        {"table": {"wavelength_nm": {"start": 350, "stop": 750, "step": 4}}},
        {"table": {"ellipsometry": True}},
        {"colour": {"illuminant": "D50"}},
        {"accuracy": {"precision": "double"}},
        {"accuracy": {"delta_e": 1.0}},
        {"stack": FILM["stack"] | {"substrate": {"n": 1.5, "k": 1e-9}}},
    ],
)
def test_everything_else_matters(sections: dict[str, object]) -> None:
    """Any field that could change a byte changes the id."""
    assert _id(**sections) != _id()


@pytest.mark.parametrize(
    "surface",
    [
        {"alpha_x": 0.31},
        {"alpha_y": 0.4},
        {"distribution": "ggx"},
        {"masking": "smith"},
        {"specular_weight": 0.9},
        {"diffuse_weight": 0.1},
        {"diffuse_reflectance": 0.1},
        {"multiple_scattering": "kulla-conty"},
    ],
)
def test_all_of_a_surface_matters(surface: dict[str, object]) -> None:
    """Any field of it changes the id of an albedo."""

    def of(fields: dict[str, object]) -> str:
        return _id(table={"quantity": "albedo"}, surface={"alpha_x": 0.3} | fields)

    assert of(surface) != of({})


@pytest.mark.parametrize("axis", [{"quantity": "bsdf"}, {"roughness": [0.3, 0.4]}, {"cos_theta": 65}])
def test_what_is_tabulated_of_a_surface_matters(axis: dict[str, object]) -> None:
    """The quantity, and each of its axes."""
    surface = {"alpha_x": 0.3}
    before = _id(table={"quantity": "albedo"}, surface=surface)
    assert _id(table={"quantity": "albedo"} | axis, surface=surface) != before


def test_what_a_bsdf_leaves_unread_does_not_matter() -> None:
    """It has theta_i in the place of cos_theta: the same bytes are the same table."""
    surface = {"alpha_x": 0.3}
    one, other = (_id(table={"quantity": "bsdf", "cos_theta": n}, surface=surface) for n in (8, 64))
    assert one == other


def test_a_materials_data_matters(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same name with other n and k is another table: the sampled indices are hashed."""
    from nacreous.optics import stack

    spec = preset("silica-on-silicon")
    before = table_id(spec)
    known = stack.refractive_index
    monkeypatch.setattr(stack, "refractive_index", lambda material, nm: known(material, nm) * (1 + 1e-12))
    assert table_id(spec) != before


def test_the_kernels_matter(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Another kernel text is another table."""
    before = _id()
    kernels = shutil.copytree(sources.KERNELS, tmp_path / "kernels")
    monkeypatch.setattr(sources, "KERNELS", kernels)
    assert _id() == before
    film = kernels / "film.clh"
    film.write_text(film.read_text() + "// another\n")
    assert _id() != before


@pytest.mark.parametrize("name", ["dichroic", "anodised-titanium"])
def test_what_else_is_imported_does_not_matter(name: str) -> None:
    """colour-science changes how NumPy prints numbers: tables of materials are read without printing them."""
    told = f"from nacreous.tables import identity, presets as p; print(identity.table_id(p.preset('{name}')))"
    alone, beside_colour = (
        subprocess.check_output([sys.executable, "-c", before + told], text=True)
        for before in ("", "import colour; ")
    )
    assert alone == beside_colour
    assert len(alone.strip()) == 64
