"""The scene for pbrt-v4: what its parser accepts, and files of Nacreous that its reader accepts.

pbrt-v4 is no package of any registry, so that its own program cannot run here. The grammar below is what its
sources read: directives in src/pbrt/parser.cpp, kinds and parameters in cameras.cpp, samplers.cpp, film.cpp,
cpu/integrators.cpp, lights.cpp, shapes.cpp and materials.cpp, types of parameters in paramdict.cpp.
"""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nacreous
from reference_tensor_file import tensor_fields

SCENE = Path(__file__).parents[2] / "clients/pbrt/measured.pbrt"
NUMBERS = {"LookAt": 9, "Translate": 3, "WorldBegin": 0, "AttributeBegin": 0, "AttributeEnd": 0}
"""Directives that are followed by numbers alone, and by how many."""
KINDS = {
    ("Camera", "perspective"): {"float fov"},
    ("Sampler", "zsobol"): {"integer pixelsamples"},
    ("Integrator", "path"): {"integer maxdepth"},
    ("Film", "rgb"): {"string filename", "integer xresolution", "integer yresolution"},
    ("LightSource", "infinite"): {"rgb L"},
    ("AreaLightSource", "diffuse"): {"rgb L"},
    ("Material", "diffuse"): {"rgb reflectance"},
    ("Material", "measured"): {"string filename"},
    ("Shape", "sphere"): {"float radius"},
    ("Shape", "bilinearmesh"): {"point3 P"},
}
"""Directives that are followed by a kind and parameters: those of the scene, as pbrt-v4 reads them."""
OPTIONS = {"LookAt", "Camera", "Sampler", "Integrator", "Film"}
"""What stands before WorldBegin; transformations may stand on either side."""
COUNTS = {"rgb": {3}, "float": {1}, "integer": {1}, "string": {1}, "point3": {12}}
"""How many values a parameter of the scene has; the mesh is one quadrilateral."""

_TOKEN = re.compile(r'#[^\n]*|"[^"]*"|[\[\]]|[^\s"\[\]#]+')

Directive = tuple[str, list[Any]]


def directives(text: str) -> list[Directive]:
    """Return each directive with its tokens: numbers, quoted strings, brackets."""
    found: list[Directive] = []
    for token in _TOKEN.findall(text):
        if token.startswith("#"):
            continue
        if re.fullmatch(r"[A-Z][A-Za-z]+", token):
            found.append((token, []))
        else:
            found[-1][1].append(token)
    return found


def parameters(tokens: list[str]) -> dict[str, list[str]]:
    """Return the values of each parameter by its type and name."""
    values: dict[str, list[str]] = {}
    for word in (word for word in tokens if word not in ("[", "]")):
        if re.fullmatch(r'"\w+ \w+"', word):
            values[name := word.strip('"')] = []
        else:
            values[name].append(word)
    return values


@pytest.fixture(scope="module")
def scene() -> list[Directive]:
    """Return the directives of the scene."""
    return directives(SCENE.read_text(encoding="ascii"))


def test_every_directive_is_one_of_pbrt_s(scene: list[Directive]) -> None:
    """Names, kinds, parameters, their types and how many values they have are those that pbrt-v4 reads."""
    for name, tokens in scene:
        if name in NUMBERS:
            assert len([float(token) for token in tokens]) == NUMBERS[name]
            continue
        given = parameters(tokens[1:])
        assert given.keys() <= KINDS[name, tokens[0].strip('"')]
        for parameter, values in given.items():
            kind = parameter.split()[0]
            assert len(values) in COUNTS[kind]
            assert all(value.startswith('"') == (kind == "string") for value in values)


def test_brackets_close(scene: list[Directive]) -> None:
    """Values of more than one number are in one pair of brackets."""
    for _, tokens in scene:
        assert tokens.count("[") == tokens.count("]")


def test_the_world_begins_once_and_ends_with_the_file(scene: list[Directive]) -> None:
    """pbrt-v4 has no WorldEnd; options stand before the world, and attributes are balanced within it."""
    names = [name for name, _ in scene]
    assert names.count("WorldBegin") == 1
    world = names.index("WorldBegin")
    assert set(names[:world]) == OPTIONS
    assert not OPTIONS & set(names[world:])
    depth = np.cumsum([{"AttributeBegin": 1, "AttributeEnd": -1}.get(name, 0) for name in names[world:]])
    assert depth.min() == 0
    assert depth[-1] == 0


def test_the_material_is_the_file_that_the_readme_writes(scene: list[Directive]) -> None:
    """One shape has the measured material, of a file beside the scene, which README.md tells how to make."""
    measured = [parameters(tokens[1:]) for name, tokens in scene if tokens[:1] == ['"measured"']]
    assert measured == [{"string filename": ['"film.bsdf"']}]
    readme = SCENE.with_name("README.md").read_text(encoding="utf-8")
    assert "film.toml" in readme
    assert "--format rgl\n" in readme


@pytest.mark.parametrize("alpha_y", [0.15, 0.3], ids=["isotropic", "anisotropic"])
def test_pbrt_accepts_the_file(alpha_y: float, tmp_path: Path) -> None:
    """What `MeasuredBxDFData::Create`, src/pbrt/bxdfs.cpp, demands: fields, types, shapes, a whole turn."""
    surface = {"distribution": "ggx", "alpha_x": 0.15, "alpha_y": alpha_y}
    stack = {
        "incident": "air",
        "substrate": "main/Ti/Johnson",
        "layers": [{"material": {"n": 2.4}, "thickness_nm": 45}],
    }
    table = {"quantity": "bsdf", "wavelength_nm": {"start": 380, "stop": 750, "step": 74}}
    film = nacreous.tabulate({"stack": stack, "surface": surface, "table": table})
    fields = tensor_fields(nacreous.write(film, tmp_path / "film.bsdf")[0])
    phi_i, theta_i, wavelengths = (fields[name] for name in ("phi_i", "theta_i", "wavelengths"))
    grid = phi_i.size, theta_i.size
    assert [fields[name].ndim for name in ("description", "ndf", "sigma")] == [1, 2, 2]
    assert fields["jacobian"].shape == (1,)
    assert fields["vndf"].shape[:2] == grid
    squares = fields["luminance"].shape[2:]
    assert squares[0] == squares[1]
    assert fields["luminance"].shape == (*grid, *squares)
    assert fields["spectra"].shape == (*grid, wavelengths.size, *squares)
    assert {fields[name].dtype.str for name in ("description", "jacobian")} == {"|u1"}
    assert {fields[name].dtype.str for name in ("ndf", "sigma", "vndf", "luminance", "spectra")} == {"<f4"}
    assert phi_i.size <= 2 if alpha_y == 0.15 else round(2 * np.pi / np.ptp(phi_i)) == 1
