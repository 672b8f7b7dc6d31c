"""Mueller matrices of the film against its amplitudes from the reference, and M00 against f."""

import json
from dataclasses import asdict, replace

import numpy as np
import pytest

from measured_files import (
    SURFACES,
    FloatArray,
    check_exact_where_light_goes,
    measured_spec,
    measured_table,
    random_diffuse,
    random_incoming,
    random_reflected,
)
from nacreous.formats.names import FormatName
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.device import Device
from nacreous.optics.stack import sample_stack
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.measured.certificate import certify, certify_nodes, shortfall
from nacreous.tables.measured.half_difference import HalfDifference
from nacreous.tables.measured.mueller import MuellerTable, mueller_film, some_nodes, tabulated
from nacreous.tables.measured.mueller_nodes import placing
from nacreous.tables.measured.surface import Spectra
from nacreous.tables.spec import Spec
from reference import film

WAVELENGTH_NM = np.array([400.0, 480.0, 560.0, 640.0, 720.0])
SMALLEST, LARGEST = (25, 5_000), (37, 12_500)


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


def table_of(surface: str, device: Device, grid: tuple[int, int] = LARGEST) -> MuellerTable:
    """Return the table of a surface on a grid."""
    solver = bsdf_solver(device, measured_spec(surface))
    return tabulated(solver, placing(solver, Spectra(WAVELENGTH_NM)).nodes(*grid), WAVELENGTH_NM, None)


def f_cos(solver: BsdfSolver, i: FloatArray, o: FloatArray) -> FloatArray:
    """Return f cos_o in double precision, (P, 5)."""
    return solver.exact().reflection(0, i, o, WAVELENGTH_NM) * o[:, 2:]


@pytest.mark.parametrize("grid", [SMALLEST, LARGEST])
@pytest.mark.parametrize("surface", ["narrow", "ggx", "rough", "diffuse"])
def test_m00_is_unpolarised_f_at_every_node(surface: str, grid: tuple[int, int], device: Device) -> None:
    """All nodes above the horizon of some theta_h, whatever the grid: within 1e-3 of f itself."""
    solver, table = bsdf_solver(device, measured_spec(surface)), table_of(surface, device, grid)
    for place in (0, 1, 10, 25, 40):
        theta_h = table.theta_h[place : place + 1]
        pairs = HalfDifference.grid(theta_h, table.theta_d, table.phi_d).pairs()
        above = np.minimum(pairs.incoming[:, 2], pairs.outgoing[:, 2]) > 1.5e-3
        expected = f_cos(solver, pairs.incoming[above], pairs.outgoing[above]) / pairs.outgoing[above, 2:]
        m00 = table.values[:, :, place, :, 0, 0].transpose(1, 0, 2).reshape(-1, WAVELENGTH_NM.size)[above]
        assert above.mean() > 0.4
        np.testing.assert_allclose(m00, expected, rtol=1e-3)


@pytest.mark.parametrize("surface", ["narrow", "ggx", "rough", "diffuse"])
def test_m00_is_unpolarised_f_along_the_lobe(surface: str, device: Device) -> None:
    """Between the nodes: median within 0.5e-3, nine of ten and the light as a whole within 1e-3 of f."""
    solver, table = bsdf_solver(device, measured_spec(surface)), table_of(surface, device)
    i = random_incoming(20_000, 1)
    o, weight = random_reflected(i, SURFACES[surface]["alpha_x"], 3)
    lit = weight > 0
    expected = f_cos(solver, i[lit], o[lit])
    got = table.evaluate(Pairs(np.zeros(lit.sum(), np.int32), i[lit], o[lit]))
    check_exact_where_light_goes(got / expected - 1, expected * weight[lit, None])


@pytest.mark.parametrize(
    ("surface", "median"), [("ggx", 1e-3), ("rough", 1e-3), ("diffuse", 1e-3), ("narrow", 3e-3)]
)
def test_m00_is_unpolarised_f_all_over(surface: str, median: float, device: Device) -> None:
    """Light that a diffuse surface sends, in the tails of the lobe: within 1e-3 as a whole, and mostly."""
    solver, table = bsdf_solver(device, measured_spec(surface)), table_of(surface, device)
    i, o = random_incoming(4000, 1), random_diffuse(4000, 2)
    expected = f_cos(solver, i, o)
    got = table.evaluate(Pairs(np.zeros(len(i), np.int32), i, o))
    assert abs(got.sum() / expected.sum() - 1) <= 1e-3
    assert np.median(np.abs(got / expected - 1)) <= median


def test_diffuse_light_is_unpolarised(device: Device) -> None:
    """Lambert's term is in M00 alone: at dark places of the lobe all else is next to nothing."""
    table = table_of("diffuse", device)
    values = table.values[:, 0, np.searchsorted(table.theta_h, 1.3)].astype(np.float64)
    assert (np.abs(values[..., 1:, :]).max(axis=(-2, -1)) < 0.02 * values[..., 0, 0]).all()
    np.testing.assert_allclose(values[..., 0, 0], 0.2 * 0.5 / np.pi, rtol=0.02)


def test_a_surface_without_a_lobe_is_not_divided_by(device: Device) -> None:
    """Facets that reflect nothing leave Lambert's term, whatever the nodes of their lobe are."""
    fields = measured_spec("diffuse").model_dump(mode="json")
    fields["surface"] |= {"specular_weight": 0.0}
    solver = bsdf_solver(device, Spec.from_document(fields))
    nodes = placing(solver, Spectra(WAVELENGTH_NM)).nodes(5, 42)
    values = tabulated(solver, nodes, WAVELENGTH_NM, None).values
    np.testing.assert_allclose(values[..., 0, 0], 0.2 * 0.5 / np.pi, rtol=1e-6)
    assert not values[..., 1:, :].any()


def test_the_certificate_is_of_what_a_reader_sees() -> None:
    """At the file's own wavelengths M00 is f within 1e-3: nodes, nine of ten of the lobe, all its light."""
    certificate = json.loads(
        measured_table(measured_spec("ggx"), FormatName.MUELLER).provenance["certificate"]
    )
    assert certificate["node_error_max"] <= 1e-3
    assert certificate["grid_error_median"] <= 0.5e-3
    assert certificate["grid_error_p90"] <= 1e-3
    assert abs(certificate["grid_energy_error"]) <= 1e-3
    assert certificate["wide_grid_error_median"] <= 1e-3
    assert certificate["nonfinite"] == 0


def test_nodes_that_are_off_are_certified_and_told(device: Device) -> None:
    """A table that is too bright by 1 % says so, of its nodes as well, and one that is not says nothing."""
    solver, shades = bsdf_solver(device, measured_spec("ggx")), Spectra(WAVELENGTH_NM)
    nodes = placing(solver, shades).nodes(*LARGEST)
    table = tabulated(solver, nodes, WAVELENGTH_NM, None)
    told = []
    for factor in (1.0, 1.01):
        brighter = replace(table, values=table.values * np.float32(factor))
        certificate = certify(solver, shades, brighter.evaluate, 1.0)
        certificate = certify_nodes(certificate, solver, shades, brighter.evaluate, some_nodes(nodes))
        told.append(shortfall(asdict(certificate)))
    assert certificate.node_error_max == pytest.approx(0.01, abs=1e-3)
    assert certificate.grid_energy_error == pytest.approx(0.01, abs=1e-3)
    assert told[0] == ""
    assert "the largest grid is too coarse" in told[1]
