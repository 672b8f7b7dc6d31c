"""Files as of the MERL database: their bytes, a reader that is not ours, and what they carry unseen."""

from pathlib import Path

import numpy as np
import pytest

from measured_files import measured_file, measured_spec, random_diffuse, random_incoming
from nacreous.errors import SpecError
from nacreous.formats.merl import SCALES
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, check_holds
from nacreous.formats.verify import verify
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.device import Device, open_device
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.measured.surface import colours_of
from nacreous.tables.spec import Spec
from reference_merl import MerlMaterial, directions_at

LENGTH = 12 + 3 * 90 * 90 * 180 * 8


def changed_spec(**changes: dict[str, object]) -> Spec:
    """Return a rough film with other fields in some of its sections."""
    fields = measured_spec("ggx").model_dump(mode="json")
    for section, values in changes.items():
        fields[section] |= values
    return Spec.from_document(fields)


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a rough film on titanium."""
    return measured_file(measured_spec("ggx"), FormatName.MERL, tmp_path_factory.mktemp("merl"))


@pytest.fixture(scope="module")
def material(file: Path) -> MerlMaterial:
    """Read it."""
    return MerlMaterial.read(file)


def f_rgb(spec: Spec, device: Device, i: np.ndarray, o: np.ndarray) -> np.ndarray:
    """Return the colours of f_r, no component below 0, at pairs of directions."""
    solver = bsdf_solver(device, spec)
    pairs = Pairs(np.zeros(len(i), np.int32), i, o)
    return np.maximum(colours_of(spec, solver).reflected(solver, pairs), 0)


def middles(count: int) -> np.ndarray:
    """Return the angles in the middles of random bins, (count, 3), both directions well above the surface."""
    random = np.random.default_rng(1)
    bins = np.stack([random.integers(0, n, 8 * count) for n in (60, 75, 180)], axis=-1)
    h, d, phi = ((bins + 0.5) / [90, 90, 180]).T
    angles = np.stack([h**2 * np.pi / 2, d * np.pi / 2, phi * np.pi], axis=-1)
    pairs = [directions_at(*at, 0.0) for at in angles]
    return angles[[min(i[2], o[2]) > 0.05 for i, o in pairs]][:count]


def test_the_bytes_are_as_many_as_readers_expect(file: Path) -> None:
    """Three integers and three planes: readers check the first, and some take all that follows."""
    data = file.read_bytes()
    assert len(data) == LENGTH
    assert np.frombuffer(data, "<i4", 3).tolist() == [90, 90, 180]
    np.testing.assert_allclose(SCALES * 1500, [1, 1.15, 1.66])


def test_a_plain_reader_finds_the_bsdf_in_the_middle_of_its_bins(
    material: MerlMaterial, device: Device
) -> None:
    """At 300 middles, the half vector turned anywhere, and the directions exchanged: within 1e-4."""
    random = np.random.default_rng(2)
    pairs = [
        directions_at(*at, turn) for at, turn in zip(middles(300), random.uniform(0, 6, 300), strict=True)
    ]
    i, o = (np.stack(side) for side in zip(*pairs, strict=True))
    expected = f_rgb(measured_spec("ggx"), device, i, o)
    for light, eye in ((i, o), (o, i)):
        got = np.stack([material.at(*pair) for pair in zip(light, eye, strict=True)])
        np.testing.assert_allclose(got, expected, rtol=1e-4, atol=1e-6)


def test_a_plain_reader_finds_the_bsdf_anywhere(material: MerlMaterial, device: Device) -> None:
    """At random directions the bins' width is the error: a few per cent, and none of them without a value."""
    i, o = random_incoming(500, 3), random_diffuse(500, 4)
    got = np.stack([material.at(*pair) for pair in zip(i, o, strict=True)])
    expected = f_rgb(measured_spec("ggx"), device, i, o)
    assert (got >= 0).all()
    seen = expected > 1e-6 * expected.max()
    assert np.median(np.abs(got[seen] / expected[seen] - 1)) <= 0.03


def test_every_direction_above_the_surface_has_a_value(material: MerlMaterial) -> None:
    """Grazing ones as well, whose bins are partly below the horizon; far below a number is negative."""
    random = np.random.default_rng(5)
    turn, cosine = random.uniform(-np.pi, np.pi, (2, 2000)), random.uniform(1e-6, 0.02, (2, 2000))
    sine = np.sqrt(1 - cosine**2)
    i, o = np.moveaxis(np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine], axis=-1), 0, 0)
    assert all((material.at(*pair) >= 0).all() for pair in zip(i, o, strict=True))
    assert (material.f[:, 60:, 80:, 0] < 0).all()


def test_a_file_is_good_and_the_same_every_time(file: Path, tmp_path: Path) -> None:
    """`verify` finds id, spec, certificate and checksum, and the same spec gives the same bytes."""
    found = verify(file)
    assert found.problems == ()
    assert found.format == "merl"
    assert len(found.id) == 64
    assert measured_file(measured_spec("ggx"), FormatName.MERL, tmp_path).read_bytes() == file.read_bytes()


@pytest.mark.parametrize("share", [0.01, 0.5, 0.999])
def test_a_changed_file_is_found(file: Path, tmp_path: Path, share: float) -> None:
    """A value that is doubled, in any place that has one, and a file that ends early."""
    values = np.frombuffer(file.read_bytes()[12:], "<f8").copy()
    (with_value,) = np.nonzero(values > 0)
    values[with_value[int(share * with_value.size)]] *= 2
    changed = tmp_path / file.name
    changed.write_bytes(file.read_bytes()[:12] + values.tobytes())
    assert any("the file has been changed" in problem for problem in verify(changed).problems)
    changed.write_bytes(changed.read_bytes()[:-8])
    assert any("cannot be read" in problem for problem in verify(changed).problems)


def test_the_databases_own_files_are_told_apart(tmp_path: Path) -> None:
    """A file that somebody else has measured carries no provenance: one problem, and no traceback."""
    (tmp_path / "gold.binary").write_bytes(
        np.array([90, 90, 180], "<i4").tobytes() + np.full(3 * 90 * 90 * 180, -1.0).tobytes()
    )
    (problem,) = verify(tmp_path / "gold.binary").problems
    assert "written by Nacreous" in problem


def test_colours_outside_the_space_have_no_negative_component(tmp_path: Path) -> None:
    """Weak quarter waves reflect one green that Rec.709 has not; a negative red would be no value at all."""
    layers = [{"material": {"n": n}, "thickness_nm": 530 / 4 / n} for n in (1.6, 1.5)]
    stack = {
        "incident": {"n": 1.5},
        "layers": [{"repeat": 12, "layers": layers}],
        "substrate": {"n": 1.5, "k": 0.002},
    }
    spec = changed_spec(stack=stack)
    i, o = random_incoming(200, 6), random_diffuse(200, 7)
    solver = bsdf_solver(open_device(), spec)
    colours = colours_of(spec, solver).reflected(solver, Pairs(np.zeros(200, np.int32), i, o))
    assert (colours < 0).any()
    material = MerlMaterial.read(measured_file(spec, FormatName.MERL, tmp_path))
    assert all((material.at(*pair) >= 0).all() for pair in zip(i, o, strict=True))


@pytest.mark.parametrize(
    ("spec", "field", "told"),
    [
        (changed_spec(stack={"substrate": {"n": 1.5}}), "stack.substrate", "mbsdf.*transmission = .discard"),
        (changed_spec(surface={"alpha_x": 0.019}), "surface.alpha_x", "0.02.*fresnel.*exr"),
        (changed_spec(surface={"alpha_y": 0.2}), "surface.alpha_y", "take rgl-rgb"),
        (changed_spec(table={"roughness": [0.1, 0.2]}), "table.roughness", "one roughness.*got 2"),
        (changed_spec(colour={"space": "XYZ"}), "colour.space", "red, green and blue"),
    ],
)
def test_what_a_file_would_lose_is_refused(spec: Spec, field: str, told: str) -> None:
    """Transmitted light, a narrow lobe, directions of a surface, several surfaces: with what holds them."""
    with pytest.raises(SpecError, match=told) as refused:
        check_holds(FORMATS[FormatName.MERL], spec)
    assert refused.value.field == field
