"""The node that artists copy keeps the table contract in MaterialX's own shaders."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from lut_contract import POINTS, LookupTexture, write_contract_table
from materialx_host import Picture, draw, opened, shader_source, standard_library

CLIENT = Path(__file__).parents[2] / "clients" / "materialx" / "nacreous_film.mtlx"
NODE = "film/film_colour"


def axes_of(texture: LookupTexture) -> dict[str, float]:
    """Return what an artist copies from the texture's attributes into the node, by the path of the input."""
    axes = {"cos_theta": texture.axis_x, "thickness_scale": texture.axis_y}
    inputs = {}
    for name, axis in axes.items():
        values = {"count": axis["count"], "first": axis["range"][0], "last": axis["range"][1]}
        inputs |= {f"{NODE}/{name}_{key}": float(value) for key, value in values.items()}
    return inputs


def test_the_document_is_valid() -> None:
    """By MaterialX's own validate(), all of its nodes defined."""
    pytest.importorskip("MaterialX")
    document = opened(CLIENT, standard_library())
    assert document.validate() == (True, "")
    assert document.getNode("film_material").getNodeDef() is not None
    assert document.getDescendant(NODE).getNodeDef().getName() == "ND_nacreous_film"


@pytest.mark.parametrize("language", ["Glsl", "Osl", "Mdl"])
@pytest.mark.parametrize("element", ["film_material", "film/colour"])
def test_every_language_has_a_shader(language: str, element: str) -> None:
    """OSL for Arnold and RenderMan, GLSL for viewports, MDL for Omniverse: each names the texture."""
    generator = pytest.importorskip(f"MaterialX.PyMaterialXGen{language}")
    library = standard_library()
    document = opened(CLIENT, library)
    made = getattr(generator, f"{language}ShaderGenerator").create()
    assert "film_colour_file" in shader_source(made, library, document.getDescendant(element))


def test_the_node_reads_what_the_contract_says(tmp_path: Path) -> None:
    """The colour at known cosines and thicknesses is that of the NumPy lookup."""
    source = write_contract_table(tmp_path)
    texture = LookupTexture.read(source)
    source.rename(tmp_path / "film.exr")
    document = Path(shutil.copy(CLIENT, tmp_path))
    axes = axes_of(texture)
    pictures = [
        Picture(str(document), "film/colour", axes | {f"{NODE}/thickness_scale": scale}, cos_theta)
        for cos_theta, scale in POINTS.tolist()
    ]
    drawn = np.array([picture.mean(axis=(0, 1)) for picture in draw(pictures, tmp_path)])
    np.testing.assert_allclose(drawn, texture.at(*POINTS.T), rtol=0, atol=1e-3)


def test_the_inputs_of_the_thickness_need_not_be_set_for_one_thickness(tmp_path: Path) -> None:
    """Both rows of such a texture are equal, so that every place between them will do."""
    import nacreous
    from lut_contract import CONTRACT_SPEC

    spec = CONTRACT_SPEC | {"table": {"wavelength_nm": {"start": 380, "stop": 780, "step": 10}}}
    (source, *_) = nacreous.write(nacreous.tabulate(spec), tmp_path / "film.exr")
    document, texture = Path(shutil.copy(CLIENT, tmp_path)), LookupTexture.read(source)
    count = {f"{NODE}/cos_theta_count": float(texture.axis_x["count"])}
    pictures = [Picture(str(document), "film/colour", count, cos_theta) for cos_theta in (0.2, 0.7)]
    drawn = np.array([picture.mean(axis=(0, 1)) for picture in draw(pictures, tmp_path)])
    np.testing.assert_allclose(drawn, texture.at(np.array([0.2, 0.7]), np.ones(2)), rtol=0, atol=1e-3)
