"""Mueller matrices of the film against its amplitudes from the reference, and M00 against f."""

import json

import numpy as np
import pytest

from measured_files import measured_spec, measured_table, random_diffuse, random_incoming
from nacreous.formats.names import FormatName
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.optics.stack import sample_stack
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.measured.mueller import MuellerTable, mueller_film, tabulated
from nacreous.tables.spec import Spec
from reference import film

WAVELENGTH_NM = np.array([400.0, 480.0, 560.0, 640.0, 720.0])
GRID = (21, 52, 112)


def jones_to_mueller(r_s: complex, r_p: complex) -> np.ndarray:
    """Return the Mueller matrix of diag(r_s, r_p): A (J x J*) A^-1, R. Chipman et al. 2018, section 6.12."""
    to_stokes = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [0, 1, 1, 0], [0, 1j, -1j, 0]])
    jones = np.diag([r_s, r_p])
    return (to_stokes @ np.kron(jones, jones.conj()) @ np.linalg.inv(to_stokes)).real


@pytest.mark.parametrize("surface", ["ggx", "diffuse"])
def test_the_film_is_that_of_its_amplitudes(surface: str, device: Device) -> None:
    """From r_s and r_p of the reference, conjugated to Mitsuba's time factor: all 16 elements."""
    spec = measured_spec(surface)
    cosines = np.array([0.05, 0.3, 0.6, 0.9, 1.0])
    got = mueller_film(bsdf_solver(device, spec), cosines, WAVELENGTH_NM)
    index = sample_stack(spec.stack, WAVELENGTH_NM).index
    at = film(index, [420.0], WAVELENGTH_NM, cosines)
    expected = [
        [jones_to_mueller(s.conjugate(), p.conjugate()) for s, p in zip(*row, strict=True)]
        for row in zip(at.r_s, at.r_p, strict=True)
    ]
    np.testing.assert_allclose(got, expected, atol=2e-4)


def table_of(surface: str, device: Device) -> MuellerTable:
    """Return the table of a surface on the finest grid."""
    return tabulated(bsdf_solver(device, measured_spec(surface)), GRID, WAVELENGTH_NM, None)


@pytest.mark.parametrize("surface", ["narrow", "ggx", "rough", "diffuse"])
def test_m00_is_unpolarised_f(surface: str, device: Device) -> None:
    """Light that a diffuse surface or the lobe sends: M00 within 1e-3 of all the light, either on average."""
    solver, table = bsdf_solver(device, measured_spec(surface)), table_of(surface, device)
    i = random_incoming(4000, 1)
    for o in (random_diffuse(4000, 2), mirrored(i, surface)):
        above = o[:, 2] > 0.02
        pairs = Pairs(np.zeros(above.sum(), np.int32), i[above], o[above])
        f_cos = solver.spectra(pairs, Side.REFLECTION, WAVELENGTH_NM) * o[above, 2:]
        got = table.evaluate(pairs)
        assert abs(got.sum() / f_cos.sum() - 1) <= 1e-3
        seen = f_cos > 1e-3 * f_cos.max()
        assert np.median(np.abs(got[seen] / f_cos[seen] - 1)) <= 2.5e-3


def mirrored(i: np.ndarray, surface: str) -> np.ndarray:
    """Return directions about the mirror's, as wide as the lobe."""
    alpha = {"narrow": 0.02, "rough": 0.4}.get(surface, 0.1)
    tilt = alpha * np.random.default_rng(3).normal(size=(len(i), 2)) / np.sqrt(2)
    m = np.concatenate([tilt, np.ones((len(i), 1))], axis=1)
    m /= np.linalg.norm(m, axis=1, keepdims=True)
    return 2 * np.sum(i * m, axis=1, keepdims=True) * m - i


def test_diffuse_light_is_unpolarised(device: Device) -> None:
    """Lambert's term is in M00 alone: at dark places of the lobe all else is next to nothing."""
    values = table_of("diffuse", device).values[:, 0, -20].astype(np.float64)
    assert (np.abs(values[..., 1:, :]).max(axis=(-2, -1)) < 0.02 * values[..., 0, 0]).all()
    np.testing.assert_allclose(values[..., 0, 0], 0.2 * 0.5 / np.pi, rtol=0.02)


def test_a_surface_without_a_lobe_is_not_divided_by(device: Device) -> None:
    """Facets that reflect nothing leave Lambert's term, whatever the nodes of their lobe are."""
    fields = measured_spec("diffuse").model_dump(mode="json")
    fields["surface"] |= {"specular_weight": 0.0}
    values = tabulated(bsdf_solver(device, Spec.from_document(fields)), (5, 6, 7), WAVELENGTH_NM, None).values
    np.testing.assert_allclose(values[..., 0, 0], 0.2 * 0.5 / np.pi, rtol=1e-6)
    assert not values[..., 1:, :].any()


def test_the_certificate_is_of_what_a_reader_sees() -> None:
    """Few parts in a thousand along the lobe at the file's own wavelengths, and only finite values."""
    certificate = json.loads(
        measured_table(measured_spec("ggx"), FormatName.MUELLER).provenance["certificate"]
    )
    assert certificate["grid_error_median"] <= 1.5e-3
    assert certificate["grid_error_p90"] <= 1e-2
    assert certificate["nonfinite"] == 0
