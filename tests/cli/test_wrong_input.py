"""Every kind of wrong spec: exit code 2, one message with the field, what was expected and what came."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from spec_texts import LAYER, film, layer, table

Run = Callable[..., subprocess.CompletedProcess[str]]


def surface(fields: str, quantity: str = "albedo", rest: str = "") -> str:
    """Return a spec whose surface is as given."""
    table = f'"table": {{"quantity": "{quantity}"{rest}}}'
    return film(rest=f', "surface": {{{fields}}}, {table}')


DOCUMENTS = {
    "not a number": (layer("NaN"), 'NaN, not a finite number, at the key "thickness_nm"'),
    "infinite": (layer("-Infinity"), '-Infinity, not a finite number, at the key "thickness_nm"'),
    "beyond double precision": (
        layer("1e999"),
        '1e999, not a finite number, at the key "thickness_nm"',
    ),
    "a number as text": (layer('"420"'), "stack.layers.0.thickness_nm"),
    "not a number as text": (layer('"NaN"'), "stack.layers.0.thickness_nm"),
    "true as a number": (layer("true"), "stack.layers.0.thickness_nm"),
    "half a surrogate pair": (film(rest=', "name": "\\ud800"'), 'surrogate pair at the key "name"'),
    "a control character": (film(rest=', "name": "\\u001b[2J"'), "name"),
    "a control character further down": (film(rest=', "source": "\\u0000"'), "source"),
    "not a number in a list": (
        film(rest=', "table": {"cos_theta": [0, NaN]}'),
        'NaN, not a finite number, at the key "cos_theta"',
    ),
    "a key twice": (film(rest=', "name": "a", "name": "b"'), 'the key "name" twice'),
    "an unknown field": (film(rest=', "colr": {}'), "colr"),
    "an unknown field further down": (layer(rest=', "thicknes": 1'), "stack.layers.0.thicknes"),
    "nested too deeply": ("[" * 100_000, "nesting"),
    "empty": ("", "empty"),
    "not JSON": ("{", "JSON"),
    "a list": ("[]", "a table at the top level"),
    "too large": (film(rest=f', "name": "{"x" * 2**21}"'), "2 MiB"),
}
PHYSICS = {
    "no layers": (film(""), "stack.layers"),
    "65 layers": (film(", ".join([LAYER] * 65)), "stack.layers"),
    "no stack": ("{}", "stack"),
    "a negative thickness": (layer("-1"), "stack.layers.0.thickness_nm"),
    "a thickness too small": (layer("1e-40"), "stack.layers.0.thickness_nm"),
    "a thickness too large": (layer("1e9"), "stack.layers.0.thickness_nm"),
    "n = 0": (layer(material='{"n": 0}'), "stack.layers.0.material.n"),
    "k < 0": (layer(material='{"n": 1, "k": -0.1}'), "stack.layers.0.material.k"),
    "|n| = 1e4": (layer(material='{"n": 1e4}'), "stack.layers.0.material.n"),
    "an unknown material": (layer(material='"unobtainium"'), "stack.layers.0.material"),
    "an unknown page": (layer(material='"main/Ag/Nobody"'), "stack.layers.0.material"),
    "a material out of its range": (layer(material='"main/Ag/Sytchkova"'), "stack.layers.0.material"),
    "an absorbing incident medium": (film().replace('"air"', '{"n": 1, "k": 0.1}'), "stack.incident"),
    "an empty axis": (table('"wavelength_nm": []'), "table.wavelength_nm"),
    "an axis of one point": (table('"wavelength_nm": [550]'), "table.wavelength_nm"),
    "an axis that is not sorted": (table('"wavelength_nm": [400, 700, 550]'), "table.wavelength_nm"),
    "a wavelength twice": (table('"wavelength_nm": [400, 400, 700]'), "table.wavelength_nm"),
    "a cosine above 1": (table('"cos_theta": [0, 1.5]'), "table.cos_theta"),
    "a cosine below 0": (table('"cos_theta": [-0.5, 1]'), "table.cos_theta"),
    "one cosine": (table('"cos_theta": 1'), "table.cos_theta"),
    "too many cosines": (table('"cos_theta": 1000000'), "table.cos_theta"),
    "a step of 0": (table('"wavelength_nm": {"start": 4e2, "stop": 7e2, "step": 0}'), "wavelength_nm.step"),
    "a step of almost 0": (table('"cos_theta": {"start": 0, "stop": 1, "step": 1e-300}'), "got 1e+300"),
    "five thicknesses": (table('"thickness_scale": 5'), "1, a list, { start, stop, step }"),
    "wavelengths without a colour": (table('"wavelength_nm": [900, 1000]'), "table.wavelength_nm"),
    "an unknown quantity": (table('"quantity": "brightness"'), "table.quantity"),
    "an unknown illuminant": (film(rest=', "colour": {"illuminant": "D64"}'), "colour.illuminant"),
    "an unknown space": (film(rest=', "colour": {"space": "sRGB"}'), "colour.space"),
}  # fmt: skip
SURFACES = {
    "alpha 0": (surface('"alpha_x": 0'), "surface.alpha_x"),
    "a negative alpha": (surface('"alpha_x": -0.1'), "surface.alpha_x"),
    "alpha above 1": (surface('"alpha_x": 0.1, "alpha_y": 2'), "surface.alpha_y"),
    "a negative exponent": (surface('"exponent_x": -1'), "surface.exponent_x"),
    "alpha and exponent": (surface('"alpha_x": 0.1, "exponent_x": 198'), "either alpha or exponent"),
    "y without x": (surface('"exponent_y": 10'), "surface.exponent_x"),
    "anisotropic Blinn": (surface('"distribution": "blinn", "alpha_x": 0.1, "alpha_y": 0.2'), "alpha_y"),
    "Phong behind Smith": (surface('"distribution": "phong", "masking": "smith"'), "surface.masking"),
    "a negative weight": (surface('"alpha_x": 0.1, "specular_weight": -1'), "surface.specular_weight"),
    "an unknown distribution": (surface('"distribution": "ward"'), "surface.distribution"),
    "no roughness": (surface('"masking": "smith"'), "give [surface] alpha_x, or table.roughness"),
    "roughness of a smooth film": (table('"roughness": [0.1]'), "table.roughness"),
    "roughness 0": (surface("", rest=', "roughness": [0, 1]'), "table.roughness"),
    "roughness beyond the ratio": (
        surface('"alpha_x": 0.1, "alpha_y": 0.4', rest=', "roughness": [0.1, 0.9]'),
        "got alphas from 0.05 to 1.8",
    ),
    "angles of an albedo": (surface('"alpha_x": 0.1', rest=', "theta_o": 9'), "table.theta_o"),
    "thicknesses of a bsdf": (
        surface('"alpha_x": 0.1', "bsdf", ', "thickness_scale": [1, 2]'), "table.thickness_scale"
    ),
    "phi_i of an isotropic bsdf": (surface('"alpha_x": 0.1', "bsdf", ', "phi_i": 5'), "table.phi_i"),
    "light from below": (surface('"alpha_x": 0.1', "bsdf", ', "theta_i": [0, 2]'), "table.theta_i"),
    "psi of a rough surface": (surface('"alpha_x": 0.1', rest=', "ellipsometry": true'), "ellipsometry"),
}  # fmt: skip
CASES = DOCUMENTS | PHYSICS | SURFACES


@pytest.mark.parametrize(("document", "named"), CASES.values(), ids=CASES)
def test_is_refused_in_one_message(run: Run, tmp_path: Path, document: str, named: str) -> None:
    """Exit code 2; no traceback, nothing on stdout, and no file or folder is left behind."""
    (tmp_path / "film.json").write_text(document)
    done = run("tabulate", "film.json", "-o", "out", "--json")
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    assert done.stderr.startswith("nacreous: ")
    assert done.stderr.count("\n") == 1
    assert all(word in done.stderr for word in ("expected ", ", got ", named))
    assert [path.name for path in tmp_path.iterdir()] == ["film.json"]


@pytest.mark.parametrize("name", ["n" * 5000, "../" * 50 + "film.toml", "/dev/null", ".", ""])
def test_a_path_that_is_no_spec_is_refused(run: Run, name: str) -> None:
    """Whatever a path may hold: names too long, folders, devices."""
    done = run("tabulate", name)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "Traceback" not in done.stderr
