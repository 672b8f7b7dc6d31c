"""Every lie that a file can tell is found: files are changed by other programs' libraries, then verified."""

import hashlib
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
import xarray
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from nacreous.formats.names import FormatName
from nacreous.formats.openexr import read_part, write_part
from nacreous.formats.registry import FORMATS, write
from nacreous.formats.verify import verify
from nacreous.tables.identity import table_id
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

Held = Callable[[str], Table]

NAMES = list(FORMATS)


def lying(table: Table, path: Path, arrays: dict[str, np.ndarray] | None = None, **provenance: str) -> Path:
    """Write a file whose checksum is right, and what it was made from is not."""
    variables = {
        name: replace(variable, values=(arrays or {}).get(name, variable.values))
        for name, variable in table.variables.items()
    }
    write(replace(table, variables=variables, provenance={**table.provenance, **provenance}), path)
    return path


def changed_exr(table: Table, path: Path, **attributes: str | None) -> Path:
    """Write an EXR, replace or, for None, remove some attributes, and leave the old checksum."""
    write(table, path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header = dict(file.header()) | {f"nacreous:{key}": value for key, value in attributes.items()}
        kept = {key: value for key, value in header.items() if value is not None and key != "channels"}
        planes = {name: np.array(channel.pixels) for name, channel in file.channels().items()}
    with OpenEXR.File(kept, planes) as file:
        file.write(str(path))
    return path


def resealed_exr(table: Table, path: Path, **attributes: str) -> Path:
    """Write an EXR with some attributes replaced, and a checksum that is right for them."""
    write(table, path)
    planes, provenance, _ = read_part(path)
    del provenance["checksum"]
    write_part(path, planes, {f"nacreous:{key}": value for key, value in (provenance | attributes).items()})
    return path


def test_a_good_file_is_described(table: Table, tmp_path: Path) -> None:
    """Checksum (FIPS 180-4, as hashlib has it), shape, count, range and provenance."""
    path = tmp_path / "film.exr"
    write(table, path)
    found = verify(path)
    assert found.good
    assert found.format == "exr"
    assert found.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    assert found.shapes == ("R_rgb 5x9x3",)
    assert found.values == found.finite == 5 * 9 * 3
    assert found.least == table.values("R_rgb").min()
    assert found.largest == table.values("R_rgb").max()
    assert (found.id, found.version) == (table.id, table.provenance["version"])


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_finds_what_is_not_finite(table: Table, tmp_path: Path, bad: float) -> None:
    """No passive film has an infinite reflectance."""
    R_s = table.values("R_s").copy()
    R_s[0, 1, 2] = bad
    found = verify(lying(table, tmp_path / "film.npz", {"R_s": R_s}))
    assert "R_s: expected finite values, got 1 that are not" in found.problems
    assert found.values - found.finite == 1


def test_finds_a_share_beyond_one(table: Table, tmp_path: Path) -> None:
    """A passive film reflects at most what falls on it."""
    found = verify(lying(table, tmp_path / "film.npz", {"R_p": table.values("R_p") + np.float32(0.5)}))
    assert any(problem.startswith("R_p: expected a share from 0 to 1") for problem in found.problems)


def test_finds_energy_from_nowhere(table: Table, tmp_path: Path) -> None:
    """R + T <= 1 for each polarisation, even where R and T are possible on their own."""
    half = np.full_like(table.values("R_s"), 0.6)
    found = verify(lying(table, tmp_path / "film.npz", {"R_s": half, "T_s": half}))
    assert found.problems == ("R_s + T_s: expected at most 1, got 1.2",)


def changed_spec(table: Table, **fields: object) -> str:
    """Return the table's spec with some sections replaced."""
    return json.dumps(json.loads(table.provenance["spec"]) | fields)


def test_finds_an_id_that_is_not_the_specs(table: Table, tmp_path: Path) -> None:
    """The id is a hash over the spec: nobody can change one without the other."""
    stack = json.loads(table.provenance["spec"])["stack"]
    stack["layers"][0]["thickness_nm"] = 421.0
    found = verify(lying(table, tmp_path / "film.exr", spec=changed_spec(table, stack=stack)))
    assert len(found.problems) == 1
    assert "the id of the file's spec" in found.problems[0]


def test_labels_may_differ(table: Table, tmp_path: Path) -> None:
    """A name is for people and not part of the id."""
    assert verify(lying(table, tmp_path / "film.exr", spec=changed_spec(table, name="another name"))).good


@pytest.mark.parametrize("name", NAMES)
def test_cannot_know_the_id_of_other_kernels(held: Held, tmp_path: Path, name: str) -> None:
    """A file of another version is not bad for it: its id cannot be computed here, which is noted."""
    path = tmp_path / f"film{FORMATS[FormatName(name)].suffix}"
    found = verify(lying(held(name), path, kernels="0" * 64, id="1" * 64))
    assert found.good
    assert found.notes == ("computed by other kernels, so its id cannot be checked",)


@pytest.mark.parametrize(
    ("attributes", "problem"),
    [
        ({"id": "../../etc/passwd"}, "64 hexadecimal digits"),
        ({"spec": "{"}, "nacreous:spec"),
        ({"certificate": "none"}, "nacreous:certificate: expected an object"),
        ({"certificate": "[]"}, "nacreous:certificate: expected an object"),
        ({"certificate": "{}"}, "nacreous:certificate: expected the figures held_out_points"),
        ({"axis.x": '{"count": 8}'}, "axis.x: expected 9 texels as R_rgb has, got 8"),
        ({"axis.x": '{"count": 9}'}, "axis.x: expected cos_theta as the spec has it"),
        ({"axis.y": "[]"}, "nacreous:axis.y: expected 5 texels"),
        ({"colour.space": "ACEScg"}, "nacreous:colour.space: expected Rec.709"),
        ({"colour.illuminant": "A"}, "nacreous:colour.illuminant: expected D65"),
    ],
)
def test_finds_provenance_that_does_not_hold(
    table: Table, tmp_path: Path, attributes: dict[str, str], problem: str
) -> None:
    """Each attribute of the contract is looked at, whatever it holds, and a checksum excuses none."""
    found = verify(resealed_exr(table, tmp_path / "film.exr", **attributes))
    assert any(problem in message for message in found.problems)
    assert not any("checksum" in message for message in found.problems)


@pytest.mark.parametrize("axis", ["thickness_scale", "cos_theta", "wavelength_nm"])
@pytest.mark.parametrize("name", ["npz", "netcdf", "csv"])
def test_finds_an_axis_that_is_not_the_specs(table: Table, tmp_path: Path, name: str, axis: str) -> None:
    """The same values over other cosines are another film."""
    path = tmp_path / f"film{FORMATS[FormatName(name)].suffix}"
    coords = {**table.coords, axis: replace(table.coords[axis], values=table.values(axis) * 0.99)}
    write(replace(table, coords=coords), path)
    assert verify(path).problems == (f"{axis}: expected the axis of the spec, got another",)


# ---- rough surfaces ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "least"), [("E_r", 1.5), ("E_t_mean", 1.5), ("E_r", -0.1)])
def test_finds_an_albedo_that_is_no_share(albedo: Table, tmp_path: Path, name: str, least: float) -> None:
    """A passive surface gives back at most what falls on it, and at least nothing."""
    values = np.full_like(albedo.values(name), least)
    found = verify(lying(albedo, tmp_path / "film.npz", {name: values}))
    assert any(problem.startswith(f"{name}: expected a share from 0 to 1") for problem in found.problems)


def test_an_albedo_may_miss_1_by_its_quadrature(albedo: Table, tmp_path: Path) -> None:
    """E_r + E_t <= 1 + 1e-3: an integral over directions is not as exact as a film."""
    E_r = np.full_like(albedo.values("E_r"), 0.6)
    E_t = np.full_like(albedo.values("E_t"), 0.4 + 8e-4)
    assert verify(lying(albedo, tmp_path / "film.npz", {"E_r": E_r, "E_t": E_t})).good
    found = verify(lying(albedo, tmp_path / "film.npz", {"E_r": E_r, "E_t": E_t + np.float32(4e-4)}))
    assert found.problems == ("E_r + E_t: expected at most 1, got 1.0012",)


def test_finds_an_albedo_beyond_one_in_a_spectral_picture(albedo: Table, tmp_path: Path) -> None:
    """Channels are shares as well."""
    values = np.full_like(albedo.values("E_r"), 1.01)
    found = verify(lying(albedo, tmp_path / "film.spectral.exr", {"E_r": values}))
    assert found.problems == ("E_r: expected a share from 0 to 1, got 1.01 to 1.01",)


@pytest.mark.parametrize(("factor", "good"), [(1e4, True), (-1.0, False), (np.nan, False), (np.inf, False)])
def test_a_bsdf_is_finite_and_not_negative(bsdf: Table, tmp_path: Path, factor: float, good: bool) -> None:  # noqa: FBT001 - a parameter of the test
    """It has no largest value: a mirror's is infinite, a lobe's as high as it is narrow."""
    values = bsdf.values("f_t") * np.float32(factor)
    assert verify(lying(bsdf, tmp_path / "film.nc", {"f_t": values})).good == good


@pytest.mark.parametrize(
    ("attributes", "problem"),
    [
        (
            {"axis.x": '{"count": 3}'},
            "axis.x times nacreous:tiles.x: expected 20 texels as f_r_rgb has, got 15",
        ),
        (
            {"tiles.x": '{"count": 4}'},
            "axis.x times nacreous:tiles.x: expected 20 texels as f_r_rgb has, got 16",
        ),
        ({"tiles.y": "[]"}, "tiles.y: expected 18 texels as f_r_rgb has, got None"),
        ({"tiles.y": '{"count": 6}'}, "nacreous:tiles.y: expected roughness, phi_i as the spec has it"),
        ({"axis.y": '{"count": 3}'}, "nacreous:axis.y: expected theta_i as the spec has it"),
        ({"quantity": "E_r"}, 'nacreous:quantity: expected f_r or f_t, as the spec says, got "E_r"'),
        ({"certificate": "{}"}, "nacreous:certificate: expected the figures"),
    ],
)
def test_finds_an_atlas_that_does_not_hold(
    bsdf: Table, tmp_path: Path, attributes: dict[str, str], problem: str
) -> None:
    """A shader finds its texels by these attributes alone."""
    found = verify(resealed_exr(bsdf, tmp_path / "film.exr", **attributes))
    assert any(problem in message for message in found.problems)


@pytest.mark.parametrize("key", ["axis.x", "axis.y", "tiles.x", "tiles.y"])
def test_finds_an_attribute_of_an_atlas_that_is_gone(bsdf: Table, tmp_path: Path, key: str) -> None:
    """Without one of them nobody can read it."""
    found = verify(changed_exr(bsdf, tmp_path / "film.exr", **{key: None}))
    assert f"expected the attributes nacreous:{key}, got none" in found.problems


@pytest.mark.parametrize("axis", ["roughness", "phi_i", "theta_i", "theta_o", "phi"])
@pytest.mark.parametrize("suffix", [".npz", ".exr"])
def test_finds_angles_that_are_not_the_specs(bsdf: Table, tmp_path: Path, suffix: str, axis: str) -> None:
    """As arrays and as the description of tiles."""
    coords = {**bsdf.coords, axis: replace(bsdf.coords[axis], values=bsdf.values(axis) * 0.99)}
    write(replace(bsdf, coords=coords), tmp_path / f"film{suffix}")
    (problem,) = verify(tmp_path / f"film{suffix}").problems
    assert axis in problem
    assert "spec" in problem


def test_a_refined_albedo_keeps_the_ends_of_its_axes(albedo: Table, tmp_path: Path) -> None:
    """Between them refinement puts what it likes; other ends are another table."""
    fields = albedo.spec.model_dump(mode="json") | {"accuracy": {"delta_e": 1.0}}
    spec = Spec.from_document(fields)
    provenance = {**albedo.provenance, "id": table_id(spec), "spec": spec.model_dump_json()}
    finer = replace(albedo, spec=spec, provenance=provenance)
    for path in (tmp_path / "finer.exr", tmp_path / "finer.npz"):
        write(_over(finer, [0.8, 1.01, 1.2]), path)
        assert verify(path).problems == ()
        write(_over(finer, [0.8, 1.0, 1.3]), path)
        assert len(verify(path).problems) == 1


def _over(table: Table, thickness_scale: list[float]) -> Table:
    axis = replace(table.coords["thickness_scale"], values=np.array(thickness_scale))
    return replace(table, coords={**table.coords, "thickness_scale": axis})


# ---- changed after it was written --------------------------------------------------------------------------

PROMISED = (
    "id", "version", "spec", "certificate", "precision", "device", "kernels", "checksum", "quantity",
    "axis.x", "axis.y", "colour.space", "colour.illuminant", "colour.observer",
)  # fmt: skip


@pytest.mark.parametrize("key", PROMISED)
def test_finds_an_attribute_that_is_gone(table: Table, tmp_path: Path, key: str) -> None:
    """Everything that clients/README.md promises is required."""
    found = verify(changed_exr(table, tmp_path / "film.exr", **{key: None}))
    assert f"expected the attributes nacreous:{key}, got none" in found.problems


@pytest.mark.parametrize("key", PROMISED)
def test_finds_an_attribute_that_was_edited(table: Table, tmp_path: Path, key: str) -> None:
    """One character more is another checksum, where nothing else looks wrong as well."""
    edited = table.provenance.get(key, "R") + " "
    found = verify(changed_exr(table, tmp_path / "film.exr", **{key: edited}))
    assert any("nacreous:checksum" in problem for problem in found.problems)


@pytest.mark.parametrize("suffix", [".exr", ".spectral.exr"])
@pytest.mark.parametrize("change", [lambda plane: plane * np.float32(0.5), np.zeros_like, np.flipud])
def test_finds_pixels_that_were_edited(
    table: Table, tmp_path: Path, suffix: str, change: Callable[[np.ndarray], np.ndarray]
) -> None:
    """Values that a film might have are not those of this film."""
    path = tmp_path / f"film{suffix}"
    write(table, path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header = {key: value for key, value in file.header().items() if key != "channels"}
        planes = {name: change(np.array(channel.pixels)) for name, channel in file.channels().items()}
    with OpenEXR.File(header, {name: np.ascontiguousarray(plane) for name, plane in planes.items()}) as file:
        file.write(str(path))
    (problem,) = verify(path).problems
    assert problem.startswith("nacreous:checksum")


def test_finds_an_edited_npz(table: Table, tmp_path: Path) -> None:
    """Half of R obeys every law of energy."""
    path = tmp_path / "film.npz"
    write(table, path)
    with np.load(path) as archive:
        np.savez(path, **{**archive, "R_s": archive["R_s"] / 2})
    (problem,) = verify(path).problems
    assert problem.startswith("nacreous:checksum")


@pytest.mark.parametrize("edit", ["value", "unit"])
def test_finds_an_edited_netcdf(table: Table, tmp_path: Path, edit: str) -> None:
    """Through xarray, as a user would edit it; a unit is part of a value."""
    path = tmp_path / "film.nc"
    write(table, path)
    dataset = xarray.load_dataset(path, engine="h5netcdf")
    if edit == "value":
        dataset["R_s"][0, 1, 2] *= 0.5
    else:
        dataset["Delta"].attrs["units"] = "deg"
    dataset.to_netcdf(path, engine="h5netcdf")
    (problem,) = verify(path).problems
    assert problem.startswith("nacreous:checksum")


def test_finds_an_edited_csv(table: Table, tmp_path: Path) -> None:
    """One row less, as a spreadsheet leaves it; other line ends are no edit."""
    path = tmp_path / "film.csv"
    write(table, path)
    *lines, last, checksum = path.read_text("utf-8").splitlines()
    path.write_text("\r\n".join([*lines, last, checksum]), "utf-8")
    assert verify(path).good
    path.write_text("\n".join([*lines, checksum]), "utf-8")
    assert any(problem.startswith("nacreous:checksum") for problem in verify(path).problems)


def test_finds_an_edited_png(table: Table, tmp_path: Path) -> None:
    """One texel brighter by one step, saved with all the text it had."""
    path = tmp_path / "film.png"
    write(table, path)
    chunks = PngInfo()
    with Image.open(path) as image:
        pixels = np.array(image)
        for key, text in image.text.items():
            chunks.add_text(key, text)
    pixels[2, 3, 1] ^= 1
    Image.fromarray(pixels).save(path, pnginfo=chunks)
    (problem,) = verify(path).problems
    assert problem.startswith("nacreous:checksum")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("share", [0.0, 0.02, 0.5, 0.97])
def test_finds_a_file_cut_short(held: Held, tmp_path: Path, name: str, share: float) -> None:
    """What a broken copy leaves: one problem, no traceback."""
    path = tmp_path / f"film{FORMATS[name].suffix}"
    write(held(name), path)
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    assert verify(path).problems != ()


@pytest.mark.parametrize("name", NAMES)
def test_finds_a_file_that_is_something_else(tmp_path: Path, name: str) -> None:
    """A suffix alone makes no table."""
    path = tmp_path / f"film{FORMATS[name].suffix}"
    path.write_bytes(bytes(range(256)) * 16)
    assert len(verify(path).problems) == 1


def test_answers_for_what_is_no_file(tmp_path: Path) -> None:
    """A folder, a name that is not there, and a suffix that nobody knows."""
    (tmp_path / "film.tiff").touch()
    assert "No such file" in verify(tmp_path / "absent.exr").problems[0]
    assert "directory" in verify(tmp_path).problems[0]
    assert "expected a file name that ends in" in verify(tmp_path / "film.tiff").problems[0]
