"""Measured BSDFs for MDL: a reader that is not ours finds reflection and transmission."""

import json
from pathlib import Path

import numpy as np
import pytest

from measured_files import measured_file, measured_spec, random_diffuse, random_incoming
from nacreous.errors import SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, check_holds
from nacreous.formats.verify import verify
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.measured.surface import colours_of
from nacreous.tables.spec import Spec
from reference_mbsdf import read_mbsdf

GLASS = {"n": 1.5}


def changed_spec(**changes: dict[str, object]) -> Spec:
    """Return a rough film on glass with other fields in some of its sections."""
    fields = measured_spec("rough", GLASS).model_dump(mode="json")
    for section, values in changes.items():
        fields[section] |= values
    return Spec.from_document(fields)


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a rough film on glass."""
    return measured_file(changed_spec(), FormatName.MBSDF, tmp_path_factory.mktemp("mbsdf"))


def f_rgb(device: Device, side: Side, i: np.ndarray, o: np.ndarray) -> np.ndarray:
    """Return the colours of f_r or f_t at pairs of directions."""
    solver = bsdf_solver(device, changed_spec())
    colouring = colours_of(changed_spec(), solver).colouring
    return np.asarray(solver.colours(Pairs(np.zeros(len(i), np.int32), i, o), side, colouring))


@pytest.mark.parametrize(("side", "below"), [(Side.REFLECTION, 1), (Side.TRANSMISSION, -1)])
def test_a_plain_reader_finds_either_side(file: Path, device: Device, side: Side, below: int) -> None:
    """Light at one angle and the eye at another: within 1 % of the light on average, of either side."""
    data = read_mbsdf(file)[side.name.lower()]
    eye, light = random_incoming(400, 1), random_diffuse(400, 2) * [1, 1, below]
    expected = f_rgb(device, side, eye, light)
    got = np.stack([data.at(*pair) for pair in zip(light, eye, strict=True)])
    assert np.abs(got - expected).sum() <= 1e-2 * expected.sum()


def test_reflection_is_the_same_from_either_end(file: Path) -> None:
    """Helmholtz: the SDK takes the mean of f and f with its angles exchanged, which changes nothing."""
    values = read_mbsdf(file)["reflection"].values
    np.testing.assert_allclose(values, values.swapaxes(0, 1), rtol=2e-4, atol=1e-6)


def test_light_goes_where_there_is_any(file: Path) -> None:
    """Both sides together give back at most what falls on them, and of a clear film all but the shadowed."""
    eye = 5
    total = 0.0
    for side in read_mbsdf(file).values():
        theta = (np.arange(len(side.values)) + 0.5) / len(side.values) * np.pi / 2
        step = (np.pi / 2 / len(theta)) * (2 * np.pi / side.values.shape[2])
        total += np.einsum("tpc,t->c", side.values[:, eye], np.sin(theta) * np.cos(theta)) * step
    assert (total <= 1.01).all()
    assert (total >= 0.85).all()


def test_readers_skip_lines_of_text(file: Path) -> None:
    """The SDK reads lines of up to 1,023 bytes until one that names the numbers; ours are ASCII."""
    head = file.read_bytes().split(b"MBSDF_DATA_REFLECTION=\n")[0]
    lines = head.splitlines()
    assert max(map(len, lines)) < 1000
    assert head.isascii()
    carried = json.loads(b"".join(line.removeprefix(b"NACREOUS=") for line in lines[1:]))
    assert json.loads(carried["nacreous:spec"])["stack"]["substrate"]["n"] == 1.5
    assert json.loads(carried["nacreous:certificate"])["held_out_points"] > 1000


def test_nothing_is_transmitted_to_metal(tmp_path: Path) -> None:
    """One block, at whose end the file ends, as the SDK's own writer leaves it."""
    spec = measured_spec("rough")
    path = measured_file(spec, FormatName.MBSDF, tmp_path)
    assert set(read_mbsdf(path)) == {"reflection"}
    assert verify(path).problems == ()


def test_a_file_is_good_and_the_same_every_time(file: Path, tmp_path: Path) -> None:
    """`verify` finds id, spec, certificate and checksum, and the same spec gives the same bytes."""
    found = verify(file)
    assert found.problems == ()
    assert [shape.split()[0] for shape in found.shapes] == ["f_r_rgb", "f_t_rgb"]
    assert measured_file(changed_spec(), FormatName.MBSDF, tmp_path).read_bytes() == file.read_bytes()


def test_a_changed_file_is_found(file: Path, tmp_path: Path) -> None:
    """One bit of one number, a word of the spec, and a file that ends early."""
    changed = tmp_path / file.name
    data = bytearray(file.read_bytes())
    data[len(data) // 2] ^= 1
    changed.write_bytes(data)
    assert any("the file has been changed" in problem for problem in verify(changed).problems)
    changed.write_bytes(file.read_bytes().replace(b"thickness_nm", b"thickness_nm ", 1))
    assert verify(changed).problems != ()
    changed.write_bytes(data[: len(data) // 2])
    assert any("cannot be read" in problem for problem in verify(changed).problems)


@pytest.mark.parametrize(
    ("spec", "field", "told"),
    [
        (changed_spec(surface={"alpha_x": 0.049}), "surface.alpha_x", "0.05.*fresnel.*exr"),
        (changed_spec(surface={"alpha_y": 0.2}), "surface.alpha_y", "take rgl-rgb"),
        (changed_spec(table={"roughness": [0.1, 0.2]}), "table.roughness", "one roughness.*got 2"),
        (changed_spec(colour={"space": "XYZ"}), "colour.space", "red, green and blue"),
    ],
)
def test_what_a_file_would_lose_is_refused(spec: Spec, field: str, told: str) -> None:
    """A narrow lobe, directions of a surface, several surfaces: with what holds them."""
    with pytest.raises(SpecError, match=told) as refused:
        check_holds(FORMATS[FormatName.MBSDF], spec)
    assert refused.value.field == field
