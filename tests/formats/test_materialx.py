"""Documents for MaterialX: valid by its own reading, and drawn as the table by its own shaders."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lut_contract import CONTRACT_SPEC, POINTS, LookupTexture
from materialx_host import Picture, draw, opened, shader_source, standard_library
from nacreous.errors import FileFormatError, SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, parts_of, write
from nacreous.formats.verify import verify
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table

MATERIALX = FORMATS[FormatName.MATERIALX]


@pytest.fixture(scope="module")
def contract() -> Table:
    """Return the table that every client reads."""
    return tabulate_table(Spec.from_document(CONTRACT_SPEC))


@pytest.mark.parametrize("name", ["table", "one_thickness", "opaque"])
def test_the_document_is_valid(request: pytest.FixtureRequest, tmp_path: Path, name: str) -> None:
    """By MaterialX's own validate(), with a definition for every node."""
    pytest.importorskip("MaterialX", reason="the package MaterialX is not installed")
    (path, *_) = write(request.getfixturevalue(name), tmp_path / "film.mtlx")
    document = opened(path, standard_library())
    assert document.validate() == (True, "")
    nodes = [*document.getNodes(), *document.getNodeGraph("film").getNodes()]
    assert [node.getName() for node in nodes if node.getNodeDef() is None] == []


@pytest.mark.parametrize("language", ["Glsl", "Osl", "Mdl"])
@pytest.mark.parametrize("element", ["film_material", "film/reflection", "film/transmission"])
def test_every_language_has_a_shader(table: Table, tmp_path: Path, language: str, element: str) -> None:
    """GLSL for viewports, OSL for Arnold and RenderMan, MDL for Omniverse."""
    generator = pytest.importorskip(f"MaterialX.PyMaterialXGen{language}")
    (path, *_) = write(table, tmp_path / "film.mtlx")
    library = standard_library()
    made = getattr(generator, f"{language}ShaderGenerator").create()
    document = opened(path, library)  # its elements live as long as it does
    source = shader_source(made, library, document.getDescendant(element))
    side = element.removeprefix("film/") if "/" in element else "reflection"
    assert f"{side}_texture" in source


def test_the_shader_reads_what_the_contract_says(contract: Table, tmp_path: Path) -> None:
    """R and T at known cosines and thicknesses, in GLSL, are those of the NumPy lookup."""
    document, *textures = write(contract, tmp_path / "film.mtlx")
    pictures = [
        Picture(str(document), f"film/{side}", {"film/thickness_scale": scale}, cos_theta)
        for side in ("reflection", "transmission")
        for cos_theta, scale in POINTS.tolist()
    ]
    drawn = np.array([picture.mean(axis=(0, 1)) for picture in draw(pictures, tmp_path)])
    expected = [LookupTexture.read(texture).at(*POINTS.T) for texture in textures]
    np.testing.assert_allclose(drawn, np.concatenate(expected), rtol=0, atol=1e-3)


def test_a_sphere_in_white_surroundings_has_the_colours_of_the_table(
    contract: Table, opaque: Table, tmp_path: Path
) -> None:
    """A smooth surface shows R of the cosine at each pixel; where nothing is absorbed, R + T is white."""
    size = 96
    mirror, _ = write(replace(opaque, variables=_reflection_of(opaque)), tmp_path / "mirror.mtlx")
    window, *_ = write(contract, tmp_path / "window.mtlx")
    pictures = [Picture(str(path), "film_material", size=size) for path in (mirror, window)]
    reflected, both = draw(pictures, tmp_path)
    x = (np.arange(size) + 0.5) / size * 2 - 1
    radius = np.hypot(x[:, None], x)
    inside = radius < 0.97
    cos_theta = np.sqrt(1 - radius[inside] ** 2)
    expected = LookupTexture.read(tmp_path / "mirror.exr").at(cos_theta, np.ones_like(cos_theta))
    assert np.abs(reflected[inside] - expected).mean() < 0.01 * expected.mean()
    np.testing.assert_allclose(both[inside].mean(axis=0), 1, rtol=0, atol=0.01)


def _reflection_of(table: Table) -> dict[str, object]:
    return {name: variable for name, variable in table.variables.items() if name != "T_rgb"}


def test_the_surface_is_as_rough_as_the_spec_says(tmp_path: Path) -> None:
    """alpha_x and alpha_y of [surface], which are MaterialX's roughness as they are."""
    spec = Spec.from_document(CONTRACT_SPEC | {"surface": {"alpha_x": 0.2, "alpha_y": 0.1}})
    (path, *_) = write(tabulate_table(spec), tmp_path / "film.mtlx")
    pytest.importorskip("MaterialX", reason="the package MaterialX is not installed")
    document = opened(path, standard_library())
    assert document.getDescendant("film/roughness").getValueString() == "0.2, 0.1"


def test_the_document_carries_the_provenance(table: Table, tmp_path: Path) -> None:
    """A program that reads MaterialX finds id and spec at the material."""
    pytest.importorskip("MaterialX", reason="the package MaterialX is not installed")
    (path, *_) = write(table, tmp_path / "film.mtlx")
    material = opened(path, standard_library()).getNode("film_material")
    assert material.getAttribute("nacreous:id") == table.id
    assert json.loads(material.getAttribute("nacreous:spec")) == json.loads(table.provenance["spec"])


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('value="clamp"', 'value="periodic"'),
        ('name="outlow" type="float" value="0.', 'name="outlow" type="float" value="1.'),
        ('colorspace="none"', 'colorspace="srgb_texture"'),
        ("interfacename", "nodename"),
    ],
)
def test_an_edited_document_is_found(table: Table, tmp_path: Path, old: str, new: str) -> None:
    """Whatever a shader would read otherwise."""
    (path, *_) = write(table, tmp_path / "film.mtlx")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(old, new), encoding="utf-8")
    assert old in text
    assert [problem.partition(":")[2][:8] for problem in verify(path).problems] == ["checksum"]


def test_another_texture_beside_the_document_is_found(
    table: Table, one_thickness: Table, tmp_path: Path
) -> None:
    """Both are good files, and do not belong together; one that is gone is told as well."""
    (path, texture, _) = write(table, tmp_path / "film.mtlx")
    write(one_thickness, texture)
    assert verify(texture).problems == ()
    assert any("nacreous:checksum" in problem for problem in verify(path).problems)
    texture.unlink()
    assert "film.exr" in verify(path).problems[0]


def test_a_document_with_a_doctype_is_not_parsed(table: Table, tmp_path: Path) -> None:
    """Entities that grow without end need one (CWE-776)."""
    (path, *_) = write(table, tmp_path / "film.mtlx")
    text = path.read_text(encoding="utf-8")
    declared = text.replace("<materialx", '<!DOCTYPE a [<!ENTITY b "c">]>\n<materialx')
    path.write_text(declared, encoding="utf-8")
    assert verify(path).problems == ("expected a MaterialX document, got one with a DOCTYPE",)


@pytest.mark.parametrize("name", ["", "..", "../film.exr", "/etc/passwd", "n" * 300])
def test_a_texture_is_looked_for_beside_the_document_alone(table: Table, tmp_path: Path, name: str) -> None:
    """Whatever a document names, nothing of other folders is read, and the answer is a problem."""
    (path, *_) = write(table, tmp_path / "film.mtlx")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace('value="film.exr"', f'value="{name}"'), encoding="utf-8")
    assert verify(path).problems != ()


@pytest.mark.parametrize(
    ("fields", "field"),
    [
        ({"table": {"cos_theta": [0.0, 0.1, 0.5, 1.0]}}, "table.cos_theta"),
        ({"table": {"thickness_scale": [0.5, 1.0, 2.0]}}, "table.thickness_scale"),
        ({"accuracy": {"delta_e": 1.0}}, "accuracy.delta_e"),
    ],
)
def test_uneven_axes_are_refused_before_anything_is_computed(fields: dict[str, object], field: str) -> None:
    """MaterialX has no lookup of them; the message names the format that holds the table."""
    with pytest.raises(SpecError, match="the format exr holds it") as refused:
        parts_of([MATERIALX], Spec.from_document(CONTRACT_SPEC | fields))
    assert refused.value.field == field


@pytest.mark.parametrize("name", ["albedo", "bsdf"])
def test_rough_surfaces_are_refused_with_the_alternatives(request: pytest.FixtureRequest, name: str) -> None:
    """MaterialX has facets of its own."""
    surface: Table = request.getfixturevalue(name)
    with pytest.raises(SpecError, match=rf"holds {name} tables \(exr"):
        parts_of([MATERIALX], surface.spec)


def test_files_of_an_earlier_film_go_with_it(table: Table, opaque: Table, tmp_path: Path) -> None:
    """An opaque film has no transmission, and a name without a suffix has its textures beside it."""
    first = write(table, tmp_path / "film.mtlx")
    assert [path.name for path in first] == ["film.mtlx", "film.exr", "film.transmission.exr"]
    write(replace(opaque, variables=_reflection_of(opaque)), tmp_path / "film.mtlx")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["film.exr", "film.mtlx"]
    named = write(opaque, tmp_path / "plain", "materialx")
    assert [path.name for path in named][:2] == ["plain", "plain.exr"]
    assert verify(tmp_path / "plain.exr").problems == ()


def test_nothing_is_written_of_uneven_axes(tmp_path: Path) -> None:
    """Who computes first and writes afterwards is told the same, and no file has changed."""
    fields = CONTRACT_SPEC | {"table": {**CONTRACT_SPEC["table"], "cos_theta": [0.0, 0.1, 0.5, 1.0]}}
    table = tabulate_table(Spec.from_document(fields))
    with pytest.raises(FileFormatError, match="evenly spaced axes"):
        MATERIALX.write(table, tmp_path / "film.mtlx")
    assert list(tmp_path.iterdir()) == []
