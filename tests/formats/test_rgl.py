"""Measured materials: the fields of the file, a reader that is not ours, and specs that it cannot hold."""

from pathlib import Path

import numpy as np
import pytest

import nacreous
from measured_files import SURFACES, measured_file, measured_spec, random_diffuse, random_incoming
from nacreous.errors import SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, check_holds
from nacreous.formats.verify import verify
from nacreous.opencl.device import Device
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.spec import Spec
from reference_tensor_file import MeasuredMaterial, tensor_fields

SMALL = {"start": 400, "stop": 700, "step": 20}


def small_spec(**surface: object) -> Spec:
    """Return a small isotropic material."""
    fields = measured_spec("ggx").model_dump(mode="json")
    fields["table"]["wavelength_nm"] = SMALL
    fields["surface"] = {"distribution": "ggx", "masking": "smith", "alpha_x": 0.1} | surface
    return Spec.from_document(fields)


@pytest.fixture(scope="module", params=[FormatName.RGL, FormatName.RGL_RGB])
def small_file(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a small material in both layouts."""
    return measured_file(small_spec(), request.param, tmp_path_factory.mktemp("rgl"))


def test_the_fields_are_those_that_readers_check(small_file: Path) -> None:
    """Types and shapes as Mitsuba's measured.cpp and pbrt-v4's MeasuredBxDFData require them."""
    fields = tensor_fields(small_file)
    spectral = "spectra" in fields
    q, i, n, n_again = fields["luminance"].shape
    assert (q, fields["theta_i"].shape, fields["phi_i"].shape) == (1, (i,), (1,))
    assert n == n_again
    assert fields["vndf"].shape[:2] == (1, i)
    assert min(*fields["ndf"].shape, *fields["sigma"].shape) >= 2
    channels = len(fields["wavelengths"]) if spectral else 3
    assert fields["spectra" if spectral else "rgb"].shape == (1, i, channels, n, n)
    assert ("wavelengths" in fields) == spectral
    floats = {"theta_i", "phi_i", "ndf", "sigma", "vndf", "luminance", "spectra", "rgb", "wavelengths"}
    assert {values.dtype for name, values in fields.items() if name in floats} == {np.dtype("<f4")}
    assert fields["jacobian"].tolist() == [1]
    assert (np.diff(fields["theta_i"]) > 0).all()
    assert fields["description"].tobytes().decode()


def test_anisotropic_light_comes_from_all_around(tmp_path: Path) -> None:
    """pbrt-v4 refuses a file whose phi_i spans less than -pi to pi, and takes two azimuths for isotropy."""
    spec = small_spec(alpha_y=0.2)
    phi_i = tensor_fields(measured_file(spec, FormatName.RGL_RGB, tmp_path))["phi_i"]
    assert len(phi_i) > 2
    np.testing.assert_allclose(phi_i[[0, -1]], [-np.pi, np.pi], rtol=1e-6)


def test_a_plain_reader_finds_the_bsdf(tmp_path: Path, device: Device) -> None:
    """The reader of tests/reference_tensor_file.py against f_r: most of 200 pairs within 0.5 %."""
    spec = small_spec()
    material = MeasuredMaterial.read(measured_file(spec, FormatName.RGL, tmp_path))
    i, o = random_incoming(200, 8), random_diffuse(200, 9)
    expected = bsdf_solver(device, spec).reflection(0, i, o, np.array([520.0]))[:, 0] * o[:, 2]
    got = np.array([material.f_cos(*pair, 520.0) for pair in zip(i, o, strict=True)])
    assert np.median(np.abs(got / expected - 1)) <= 5e-3


@pytest.mark.parametrize("name", [FormatName.RGL, FormatName.RGL_RGB])
def test_a_file_is_good_and_the_same_every_time(name: FormatName, tmp_path: Path) -> None:
    """`verify` finds id, certificate and checksum as they should be; the same spec gives the same bytes."""
    first, second = (tmp_path / folder for folder in ("first", "second"))
    for folder in (first, second):
        folder.mkdir()
    one, other = (measured_file(small_spec(), name, folder) for folder in (first, second))
    assert one.read_bytes() == other.read_bytes()
    assert verify(one).problems == ()
    assert verify(one).format == name


def test_a_changed_file_is_found(small_file: Path, tmp_path: Path) -> None:
    """One bit of one spectrum, and a file that ends early."""
    data = bytearray(small_file.read_bytes())
    data[len(data) // 2] ^= 1
    changed = tmp_path / small_file.name
    changed.write_bytes(data)
    assert any("the file has been changed" in problem for problem in verify(changed).problems)
    changed.write_bytes(data[: len(data) // 2])
    assert any("cannot be read" in problem for problem in verify(changed).problems)


def test_a_table_of_other_samples_is_computed_anew(tmp_path: Path) -> None:
    """`nacreous.write` of a dataset whose axes are the spec's: the directions are the format's."""
    fields = small_spec().model_dump(mode="json")
    fields["table"] |= {"theta_i": [0.3], "theta_o": [0.3], "phi": [3.0]}
    spec = Spec.from_document(fields)
    (path,) = nacreous.write(nacreous.tabulate(spec), tmp_path / "film.rgb.bsdf")
    assert path.read_bytes() == measured_file(spec, FormatName.RGL_RGB, tmp_path).read_bytes()


# ---- what a file would lose --------------------------------------------------------------------------------


def changed_spec(**changes: dict[str, object]) -> Spec:
    """Return the small material with other fields in some of its sections."""
    fields = small_spec().model_dump(mode="json")
    for section, values in changes.items():
        fields[section] |= values
    return Spec.from_document(fields)


@pytest.mark.parametrize("name", [FormatName.RGL, FormatName.RGL_RGB])
@pytest.mark.parametrize(
    ("spec", "field", "told"),
    [
        (changed_spec(stack={"substrate": {"n": 1.5}}), "stack.substrate", "mbsdf.*transmission = .discard"),
        (changed_spec(surface={"alpha_x": 0.019}), "surface.alpha_x", "0.02.*fresnel.*exr"),
        (changed_spec(table={"roughness": [0.1, 0.2]}), "table.roughness", "one roughness.*got 2"),
    ],
)
def test_what_a_file_would_lose_is_refused(name: FormatName, spec: Spec, field: str, told: str) -> None:
    """Transmitted light, a lobe narrower than the grid, several surfaces: with what holds them."""
    with pytest.raises(SpecError, match=told) as refused:
        check_holds(FORMATS[name], spec)
    assert refused.value.field == field


def test_transmitted_light_can_be_given_up() -> None:
    """`table.transmission = "discard"` is the spec's own word for it."""
    spec = changed_spec(stack={"substrate": {"n": 1.5}}, table={"transmission": "discard"})
    check_holds(FORMATS[FormatName.RGL], spec)


def test_colours_of_no_renderer_are_refused() -> None:
    """A renderer takes the three channels for red, green and blue."""
    spec = changed_spec(colour={"space": "XYZ"})
    with pytest.raises(SpecError, match="red, green and blue"):
        check_holds(FORMATS[FormatName.RGL_RGB], spec)
    check_holds(FORMATS[FormatName.RGL], spec)


def test_a_film_is_told_how_to_become_a_bsdf() -> None:
    """A preset of a smooth film names what has to be changed."""
    with pytest.raises(SpecError, match=r"rgl is for table\.quantity = .bsdf"):
        check_holds(FORMATS[FormatName.RGL], nacreous.preset("anodised-titanium"))


def test_every_surface_of_the_renderers_can_be_held() -> None:
    """The renderers' tests are of specs that a file holds."""
    for surface in SURFACES:
        check_holds(FORMATS[FormatName.RGL], measured_spec(surface))
