"""Measured materials through the program: what they cannot hold is one message, what they can is verified."""

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Run = Callable[..., subprocess.CompletedProcess[str]]

FILM: dict[str, Any] = {"material": {"n": 2.0}, "thickness_nm": 420}
SILVER, GLASS = "main/Ag/Johnson", {"n": 1.5}


def document(
    *,
    substrate: object = SILVER,
    layer: dict[str, Any] | None = None,
    surface: dict[str, Any] | None = None,
    table: dict[str, Any] | None = None,
) -> str:
    """Return a spec as JSON text, right but for what is put in."""
    return json.dumps(
        {
            "stack": {"incident": "air", "substrate": substrate, "layers": [FILM | (layer or {})]},
            "surface": {"distribution": "ggx", "masking": "smith", "alpha_x": 0.4} | (surface or {}),
            "table": {"quantity": "bsdf", "wavelength_nm": {"start": 390, "stop": 710, "step": 20}}
            | (table or {}),
        }
    )


def budget(size: str) -> dict[str, str]:
    """Return the environment with a budget of bytes."""
    return {**os.environ, "NACREOUS_BYTE_BUDGET": size}


DIFFUSE = {"diffuse_weight": 0.5, "diffuse_reflectance": 0.5, "specular_weight": 0.5}
ONE = document(table={"roughness": [0.1, 0.2]})
TURNED = document(surface={"alpha_y": 0.2})
CLEAR = document(substrate=GLASS)
REFUSED = {
    "several roughnesses, merl": ("merl", ONE, ["table.roughness", "one file for each"]),
    "several roughnesses, mbsdf": ("mbsdf", ONE, ["table.roughness", "one file for each"]),
    "several roughnesses, mueller": ("mueller", ONE, ["table.roughness", "one file for each"]),
    "light is transmitted, merl": ("merl", CLEAR, ["stack.substrate", "take mbsdf"]),
    "light is transmitted, mueller": ("mueller", CLEAR, ["stack.substrate", "take mbsdf"]),
    "anisotropic, merl": ("merl", TURNED, ["surface.alpha_y", "take rgl-rgb"]),
    "anisotropic, mbsdf": ("mbsdf", TURNED, ["surface.alpha_y", "take rgl-rgb"]),
    "anisotropic, mueller": ("mueller", TURNED, ["surface.alpha_y", "take rgl"]),
    "a narrow lobe, merl": ("merl", document(surface={"alpha_x": 0.01}), ["surface.alpha_x", "as exr"]),
    "a narrow lobe, mbsdf": ("mbsdf", document(surface={"alpha_x": 0.03}), ["surface.alpha_x", "as exr"]),
    "a narrow lobe, mueller": ("mueller", document(surface={"alpha_x": 0.01}), ["surface.alpha_x", "as exr"]),
    "no phase": ("mueller", document(layer={"thickness_sigma_nm": 5.0}), ["stack.layers", "take rgl"]),
    "incoherent": ("mueller", document(layer={"coherent": False}), ["stack.layers", "take rgl"]),
    "several reflections": (
        "mueller",
        document(surface={"multiple_scattering": "kulla-conty"}),
        ["surface.multiple_scattering", "take rgl"],
    ),
    "albedos": ("merl", document(table={"quantity": "albedo"}), ["format", "npz", "bsdf"]),
    "albedos, mueller": ("mueller", document(table={"quantity": "albedo"}), ["format", "npz", "bsdf"]),
    "infrared": ("mbsdf", document(table={"wavelength_nm": [900, 1000]}), ["table.wavelength_nm"]),
}


@pytest.mark.parametrize(("name", "text", "told"), REFUSED.values(), ids=REFUSED)
def test_what_a_format_cannot_hold_is_one_message(
    run: Run, tmp_path: Path, name: str, text: str, told: list[str]
) -> None:
    """Exit code 2, the field and what can hold it; no file is left behind."""
    (tmp_path / "film.json").write_text(text)
    done = run("tabulate", "film.json", "--format", name)
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    assert done.stderr.startswith("nacreous: ")
    assert done.stderr.count("\n") == 1
    assert all(word in done.stderr for word in ("expected ", ", got ", *told)), done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["film.json"]


def test_what_a_later_format_refuses_leaves_nothing_of_an_earlier_one(run: Run, tmp_path: Path) -> None:
    """All tables are computed before any is written: of two budgets, the second is exceeded."""
    (tmp_path / "film.json").write_text(document())
    done = run("tabulate", "film.json", "--format", "rgl-rgb", "--format", "mueller", env=budget("20M"))
    assert done.returncode == 2, done.stderr
    assert "Mueller matrices" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["film.json"]


@pytest.mark.parametrize(
    ("name", "file", "told"),
    [
        ("rgl", "film.bsdf", "the grid that readers fix is too coarse"),
        ("mueller", "film.pbsdf", "the largest grid is too coarse"),
    ],
)
def test_a_grid_that_is_too_coarse_is_told(run: Run, tmp_path: Path, name: str, file: str, told: str) -> None:
    """A film of 20 micrometres has fringes that no grid of a reader follows: a file, and a line on stderr."""
    (tmp_path / "film.json").write_text(
        document(substrate={"n": 1.5, "k": 0.01}, layer={"thickness_nm": 20_000})
    )
    done = run("tabulate", "film.json", "--format", name)
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{file}\n"
    assert done.stderr.startswith(f"nacreous: {name}: {told}")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(("stem", "name"), [("film.spectral", "exr"), ("film.rgb", "rgl")])
def test_a_name_of_another_format_is_refused(run: Run, tmp_path: Path, stem: str, name: str) -> None:
    """film.spectral.exr is read as spectra, whatever it was written as."""
    (tmp_path / f"{stem}.json").write_text(document())
    done = run("tabulate", f"{stem}.json", "--format", name)
    assert done.returncode == 2
    assert f"leave .{stem.removeprefix('film.')}." in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == [f"{stem}.json"]


FRESNEL = {"quantity": "fresnel"}
LOST = {
    "no colours of a screen": ("materialx", {}, {"colour": {"space": "XYZ"}}, "colour.space"),
    "a diffuse term, gltf": ("gltf", DIFFUSE, {}, "surface"),
    "a diffuse term, materialx": ("materialx", DIFFUSE, {}, "surface"),
    "an anisotropic surface": ("gltf", {"alpha_y": 0.2}, {}, "surface.alpha_y"),
    "few angles": ("gltf", {}, {"table": FRESNEL | {"cos_theta": 8}}, "table.cos_theta"),
}


@pytest.mark.parametrize(("name", "surface", "sections", "field"), LOST.values(), ids=LOST)
def test_what_a_material_would_lose_is_refused(
    run: Run, tmp_path: Path, name: str, surface: dict[str, Any], sections: dict[str, Any], field: str
) -> None:
    """A material of another program holds the film and its roughness, or none is written."""
    spec = json.loads(document(surface=surface, table=FRESNEL)) | sections
    (tmp_path / "film.json").write_text(json.dumps(spec))
    done = run("tabulate", "film.json", "--format", name)
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith(f"nacreous: {field}: ")
    assert [path.name for path in tmp_path.iterdir()] == ["film.json"]


def test_a_smooth_film_is_no_measured_material(run: Run, tmp_path: Path) -> None:
    """Of a fresnel table there is none; the message names what to change."""
    stack = {"incident": "air", "substrate": SILVER, "layers": [FILM]}
    (tmp_path / "film.json").write_text(json.dumps({"stack": stack}))
    for name in ("merl", "mbsdf", "mueller"):
        done = run("tabulate", "film.json", "--format", name)
        assert done.returncode == 2
        assert f'{name} is for table.quantity = "bsdf"' in done.stderr


@pytest.mark.parametrize(
    ("name", "suffix"), [("merl", ".binary"), ("mbsdf", ".mbsdf"), ("mueller", ".pbsdf")]
)
def test_a_measured_material_is_written_and_verified(
    run: Run, tmp_path: Path, name: str, suffix: str
) -> None:
    """By one process, and by another that knows nothing but the file."""
    (tmp_path / "film.json").write_text(document())
    done = run("tabulate", "film.json", "--format", name)
    assert done.returncode == 0, done.stderr
    (file,) = tmp_path.rglob(f"*{suffix}")
    found = run("verify", str(file))
    assert found.returncode == 0, found.stdout + found.stderr
    assert name in found.stdout
