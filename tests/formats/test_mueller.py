"""Mueller matrices: the fields that Mitsuba checks, and what a file would lose."""

from pathlib import Path

import numpy as np
import pytest

from measured_files import measured_file, measured_spec
from nacreous.errors import SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, check_holds
from nacreous.formats.verify import verify
from nacreous.tables.spec import Spec
from reference_tensor_file import tensor_fields


def changed_spec(**changes: dict[str, object]) -> Spec:
    """Return a rough film with other fields in some of its sections."""
    fields = measured_spec("rough").model_dump(mode="json")
    for section, values in changes.items():
        fields[section] |= values
    return Spec.from_document(fields)


def layered(**layer: object) -> dict[str, object]:
    """Return the layer of the film with other fields."""
    return {"layers": [{"material": {"n": 2.0}, "thickness_nm": 420} | layer]}


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a rough film on titanium."""
    return measured_file(changed_spec(), FormatName.MUELLER, tmp_path_factory.mktemp("mueller"))


def test_the_fields_are_those_that_mitsuba_checks(file: Path) -> None:
    """Types and shapes as measured_polarized.cpp requires them; it takes five wavelengths, whatever comes."""
    fields = tensor_fields(file)
    axes = [fields[name] for name in ("phi_d", "theta_d", "theta_h")]
    assert all(axis.dtype == np.dtype("<f4") and len(axis) == 1 for axis in axes)
    assert all((np.diff(axis[0]) > 0).all() for axis in axes)
    assert fields["wvls"].dtype == np.dtype("<u2")
    assert fields["wvls"].tolist() == [380, 480, 580, 680, 780]
    assert fields["M"].dtype == np.dtype("<f4")
    assert fields["M"].shape == (*(axis.shape[1] for axis in axes), 5, 4, 4)
    assert file.stat().st_size <= 149 * 10**6


def test_all_angles_are_there(file: Path) -> None:
    """Mitsuba holds the outermost samples: phi_d has to go all around, the others to a right angle."""
    fields = tensor_fields(file)
    np.testing.assert_allclose(fields["phi_d"][0][[0, -1]], [-np.pi, np.pi], rtol=1e-6)
    for name in ("theta_d", "theta_h"):
        np.testing.assert_allclose(fields[name][0][[0, -1]], [0, np.pi / 2], rtol=1e-6)


def test_every_matrix_is_finite_and_one_of_light(file: Path) -> None:
    """A NaN blackens the cells around it; polarised light is never more than light: |M_ij| <= M00."""
    matrices = tensor_fields(file)["M"].astype(np.float64)
    assert np.isfinite(matrices).all()
    assert (matrices[..., 0, 0] >= 0).all()
    assert (np.abs(matrices) <= matrices[..., :1, :1] * (1 + 1e-6)).all()


@pytest.mark.parametrize(
    ("asked", "taken"),
    [
        ([400.0, 450.0, 500.0, 620.0, 700.0], [400, 450, 500, 620, 700]),
        ([400.5, 450.0, 500.0, 620.0, 700.0], [401, 475, 550, 625, 700]),
        ({"start": 399.7, "stop": 701.2, "count": 40}, [400, 475, 550, 626, 701]),
    ],
)
def test_five_whole_wavelengths_are_taken(asked: object, taken: list[int], tmp_path: Path) -> None:
    """The spec's own where it lists five whole ones; five of its range, and none beyond it, otherwise."""
    spec = changed_spec(table={"wavelength_nm": asked})
    assert tensor_fields(measured_file(spec, FormatName.MUELLER, tmp_path))["wvls"].tolist() == taken


def test_a_file_is_good_and_the_same_every_time(file: Path, tmp_path: Path) -> None:
    """`verify` finds id, spec, certificate and checksum, and the same spec gives the same bytes."""
    found = verify(file)
    assert found.problems == ()
    assert found.format == "mueller"
    assert measured_file(changed_spec(), FormatName.MUELLER, tmp_path).read_bytes() == file.read_bytes()


@pytest.mark.parametrize(
    ("spec", "field", "told"),
    [
        (changed_spec(stack={"substrate": {"n": 1.5}}), "stack.substrate", "mbsdf.*transmission = .discard"),
        (changed_spec(surface={"alpha_x": 0.019}), "surface.alpha_x", "0.02.*fresnel.*exr"),
        (changed_spec(surface={"alpha_y": 0.2}), "surface.alpha_y", "take rgl"),
        (changed_spec(table={"roughness": [0.1, 0.2]}), "table.roughness", "one roughness.*got 2"),
        (changed_spec(stack=layered(thickness_sigma_nm=5.0)), "stack.layers", "needs a phase.*take rgl"),
        (changed_spec(stack=layered(coherent=False)), "stack.layers", "needs a phase.*take rgl"),
        (changed_spec(surface={"multiple_scattering": "kulla-conty"}), "surface.multiple_scattering", "rgl"),
        (
            changed_spec(surface={"distribution": "phong", "masking": "v-cavity"}),
            "surface.distribution",
            "take .blinn",
        ),
        (changed_spec(table={"wavelength_nm": [500.0, 502.0]}), "table.wavelength_nm", "five whole ones"),
    ],
)
def test_what_a_file_would_lose_is_refused(spec: Spec, field: str, told: str) -> None:
    """Transmitted light, phases that are averaged away, several surfaces: with what holds them."""
    with pytest.raises(SpecError, match=told) as refused:
        check_holds(FORMATS[FormatName.MUELLER], spec)
    assert refused.value.field == field
