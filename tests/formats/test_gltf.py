"""glTF files: valid by Khronos's validator, read by other libraries, and honest about the film."""

import json
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, parts_of, write
from nacreous.formats.verify import verify
from nacreous.optics.iridescence import Iridescence, iridescent_reflectance
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table

NODE = Path(__file__).parents[1] / "node"
GLTF = FORMATS[FormatName.GLTF]


def opaque_only(table: Table) -> Table:
    """Return a table without what is transmitted."""
    return replace(table, variables={k: v for k, v in table.variables.items() if k != "T_rgb"})


def material_of(path: Path) -> dict[str, Any]:
    """Return the only material of a file."""
    (material,) = json.loads(path.read_text(encoding="utf-8"))["materials"]
    return material


def base_f0_of(material: dict[str, Any]) -> np.ndarray:
    """Return F0 of the base by glTF's own rules: appendix B of glTF 2.0, KHR_materials_ior and _specular."""
    metallic, extensions = material["pbrMetallicRoughness"], material["extensions"]
    if metallic["metallicFactor"] == 1:
        return np.array(metallic["baseColorFactor"][:3])
    ior = extensions["KHR_materials_ior"]["ior"]
    tint = np.array(extensions["KHR_materials_specular"]["specularColorFactor"])
    return np.minimum(((ior - 1) / (ior + 1)) ** 2 * tint, 1)


@pytest.mark.parametrize("name", ["table", "opaque"])
def test_khronos_finds_nothing_to_say(request: pytest.FixtureRequest, tmp_path: Path, name: str) -> None:
    """The validator reports no error, and no warning, hint or remark either."""
    if shutil.which("node") is None or not (NODE / "node_modules" / "gltf-validator").is_dir():
        pytest.skip("the npm package gltf-validator is not installed in tests/node")
    table = request.getfixturevalue(name)
    (path,) = write(opaque_only(table) if name == "opaque" else table, tmp_path / "film.gltf")
    command = ["node", str(NODE / "validate_gltf.cjs"), str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=NODE)
    report = json.loads(done.stdout)
    assert report["issues"]["messages"] == []
    assert report["info"]["materialCount"] == 1
    assert report["info"]["totalTriangleCount"] > 1000


def test_another_library_reads_the_sphere(table: Table, tmp_path: Path) -> None:
    """Trimesh finds a closed sphere of radius 1, whose faces look outwards."""
    trimesh = pytest.importorskip("trimesh", reason="the package trimesh is not installed")
    (path,) = write(table, tmp_path / "film.gltf")
    mesh = trimesh.load_scene(path).to_mesh()
    mesh.merge_vertices()
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(4 / 3 * np.pi, rel=0.02)
    np.testing.assert_allclose(np.linalg.norm(mesh.vertices, axis=1), 1, rtol=1e-6)


def test_another_library_reads_the_material(table: Table, tmp_path: Path) -> None:
    """Pygltflib finds the extension's parameters within the ranges of its schema."""
    pygltflib = pytest.importorskip("pygltflib", reason="the package pygltflib is not installed")
    (path,) = write(table, tmp_path / "film.gltf")
    document = pygltflib.GLTF2().load_json(str(path))
    film = document.materials[0].extensions["KHR_materials_iridescence"]
    assert 0 <= film["iridescenceFactor"] <= 1
    assert film["iridescenceIor"] >= 1
    assert film["iridescenceThicknessMaximum"] > 0
    assert document.extensionsUsed == sorted(document.materials[0].extensions)


@pytest.mark.parametrize("name", ["table", "opaque"])
def test_the_parameters_give_the_colours_that_the_file_states(
    request: pytest.FixtureRequest, tmp_path: Path, name: str
) -> None:
    """Who evaluates the formula with the file's own numbers sees what `gltf_rgb` says."""
    table = request.getfixturevalue(name)
    (path,) = write(opaque_only(table) if name == "opaque" else table, tmp_path / "film.gltf")
    material = material_of(path)
    parameters = material["extensions"]["KHR_materials_iridescence"]
    film = Iridescence(
        np.array(parameters["iridescenceIor"]),
        np.array(parameters["iridescenceThicknessMaximum"]),
        base_f0_of(material),
        np.array(parameters["iridescenceFactor"]),
    )
    stated = material["extras"]["nacreous"]
    shown = iridescent_reflectance(film, np.cos(np.radians(stated["angles_deg"])))
    np.testing.assert_allclose(shown, stated["gltf_rgb"], rtol=0, atol=1e-5)


def test_the_file_states_the_colours_of_the_film(table: Table, tmp_path: Path) -> None:
    """`film_rgb` is the table at scale 1, read at 0, 45 and 70 degrees."""
    (path,) = write(table, tmp_path / "film.gltf")
    stated = material_of(path)["extras"]["nacreous"]
    row = list(table.values("thickness_scale")).index(1.0)
    cosines = np.cos(np.radians([0, 45, 70]))
    colours = table.values("R_rgb")[row].T
    expected = [np.interp(cosines, table.values("cos_theta"), channel) for channel in colours]
    assert stated["thickness_scale"] == 1
    np.testing.assert_allclose(stated["film_rgb"], np.transpose(expected), rtol=0, atol=1e-5)


@pytest.mark.parametrize("space", ["ACEScg", "Rec.2020", "XYZ"])
def test_the_file_is_in_the_space_of_gltf(tabulated: Any, tmp_path: Path, space: str) -> None:  # noqa: ANN401 - a fixture's function
    """GlTF's colours are linear Rec.709, whatever the table's are (glTF 2.0, section 3.9.2)."""
    expected, got = (
        material_of(write(tabulated(colour=colour), tmp_path / "film.gltf")[0])["extras"]["nacreous"]
        for colour in (None, {"space": space})
    )
    np.testing.assert_allclose(got["film_rgb"], expected["film_rgb"], rtol=0, atol=2e-5)


def test_an_opaque_substrate_is_a_metal_and_a_clear_one_lets_light_through(
    table: Table, opaque: Table, tmp_path: Path
) -> None:
    """The base of glTF that is as dark, or as clear, as what lies under the film."""
    (metal,) = write(opaque_only(opaque), tmp_path / "metal.gltf")
    (glass,) = write(table, tmp_path / "glass.gltf")
    assert material_of(metal)["pbrMetallicRoughness"]["metallicFactor"] == 1
    assert "KHR_materials_transmission" not in material_of(metal)["extensions"]
    assert material_of(glass)["pbrMetallicRoughness"]["metallicFactor"] == 0
    assert material_of(glass)["extensions"]["KHR_materials_transmission"] == {"transmissionFactor": 1}


def test_roughness_is_the_root_of_alpha(table: Table, tmp_path: Path) -> None:
    """Alpha = roughness² (glTF 2.0, appendix B.2.3)."""
    fields = table.spec.model_dump(mode="json", exclude_none=True) | {"surface": {"alpha_x": 0.09}}
    rough = replace(table, spec=Spec.from_document(fields))
    (path,) = GLTF.write(rough, tmp_path / "film.gltf")
    assert material_of(path)["pbrMetallicRoughness"]["roughnessFactor"] == pytest.approx(0.3)


def test_a_film_that_the_formula_cannot_show_is_said_to_be_one(tmp_path: Path) -> None:
    """Twenty pairs of layers reflect a band that no single film has."""
    layers = [{"material": {"n": n}, "thickness_nm": 550 / 4 / n} for n in (2.4, 1.46)]
    stack = {"incident": "air", "substrate": {"n": 1.5}, "layers": [{"repeat": 20, "layers": layers}]}
    axes = {"wavelength_nm": {"start": 380, "stop": 780, "step": 10}, "cos_theta": 33}
    table = tabulate_table(Spec.from_document({"stack": stack, "table": axes}))
    (path,) = write(table, tmp_path / "film.gltf")
    stated = material_of(path)["extras"]["nacreous"]
    assert max(stated["delta_e_2000"]) > 5
    assert "cannot represent this film" in stated["verdict"]
    assert "format exr" in stated["verdict"]


@pytest.mark.parametrize(
    ("old", "new"), [('"iridescenceIor"', '"iridescenceIoR"'), ('"verdict": "', '"verdict": "Not: ')]
)
def test_an_edited_file_is_found(table: Table, tmp_path: Path, old: str, new: str) -> None:
    """Every number and every word is under the checksum; other white space is no edit."""
    (path,) = write(table, tmp_path / "film.gltf")
    text = path.read_text(encoding="utf-8")
    path.write_text(json.dumps(json.loads(text)), encoding="utf-8")
    assert verify(path).problems == ()
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    (problem,) = verify(path).problems
    assert problem.startswith("nacreous:checksum")


@pytest.mark.parametrize("text", ["{}", "[]", '{"materials": [{"extras": {"nacreous": 1}}]}', "[" * 100_000])
def test_a_document_of_another_program_is_one_problem(tmp_path: Path, text: str) -> None:
    """JSON of any shape, and none that is too deep to parse."""
    path = tmp_path / "film.gltf"
    path.write_text(text)
    assert len(verify(path).problems) == 1


def test_angles_that_do_not_reach_are_refused_before_anything_is_computed(table: Table) -> None:
    """A fit is over 0 to 75 degrees."""
    fields = table.spec.model_dump(mode="json", exclude_none=True)
    fields["table"]["cos_theta"] = [0.5, 0.9, 1.0]
    with pytest.raises(SpecError, match=r"cosines from 0\.259 or less to 1") as refused:
        parts_of([GLTF], Spec.from_document(fields))
    assert refused.value.field == "table.cos_theta"
