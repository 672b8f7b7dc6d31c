"""Mueller matrices of a rough surface over half and difference angles, for Mitsuba's `measured_polarized`.

Light that one facet reflects is f times the Mueller matrix of the film at theta_d, both in the frame whose
first axis is perpendicular to the plane of reflection. So the table is a product of what depends on the three
angles (the facets, f over R) and what depends on theta_d and the wavelength:

    M(theta_h, theta_d, phi_d; lambda) = g(theta_h, theta_d, phi_d) F(theta_d, lambda)

    F = | a  b  0  0 |     a = (R_s + R_p) / 2,   b = (R_s - R_p) / 2
        | b  a  0  0 |     c + i s = conj(r_p) r_s
        | 0  0  c -s |
        | 0  0  s  c |

Mitsuba's amplitudes have the same signs, r_p = -r_s at normal incidence, but the time factor exp(+i omega t)
and the index n - ik; ours are their conjugates. A diffuse term depolarises, and is in M00 alone.

Readers are linear along arbitrary axes and check by themselves which directions are above the surface, but a
NaN of a node blackens all cells around it. Nodes below the horizon therefore have g as it is at the horizon,
and the film as it is at their own theta_d. `mueller_nodes` places the nodes.

What is linear between samples of a curve lies on one side of it, by h^2 / 12 times the second derivative on
average. All samples are moved by that, summed over the three angles, but by no more than 0.9e-3 of
themselves: at its nodes a file is f within 1e-3, and the light is right as a whole.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.tiles import Observer, step_of
from nacreous.optics.stack import all_layers
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.computed import Computed, axis, grid_of
from nacreous.tables.film import Grid
from nacreous.tables.measured.certificate import EXACT, MuellerCertificate, certify, certify_nodes
from nacreous.tables.measured.half_difference import HalfDifference, half_difference_of
from nacreous.tables.measured.mueller_nodes import Nodes, facets_at, placing
from nacreous.tables.measured.multilinear import multilinear
from nacreous.tables.measured.surface import Spectra
from nacreous.tables.spec import Spec, surface_of
from nacreous.tables.table import Variable

__all__ = ["MuellerTable", "check_polarised", "compute_mueller", "mueller_wavelengths_nm"]

FloatArray = NDArray[np.float64]

WAVELENGTHS = 5
"""What Mitsuba reads, no more and no fewer."""
_GRIDS = ((25, 5_000), (29, 8_500), (37, 12_500))
"""Nodes of phi_d, and pairs of theta_d and theta_h, to choose from; they make 40, 79 and 148 MB."""
_DARK = 1e-30
"""What keeps a black surface from being divided by."""
_MOST_SHIFT = 0.9 * EXACT
"""Part of f by which its samples are moved at most; the rest is for the film between its own nodes."""
_NODES_CHECKED = 8192
"""Nodes that the certificate looks at."""


def compute_mueller(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table; raises what `tabulate_table` raises."""
    solver = bsdf_solver(device, spec)
    energy_max = check_albedo(solver.albedo, solver.roughness, grid_of(spec))
    shades = Spectra(mueller_wavelengths_nm(spec))
    table, certificate = _settled(solver, shades, energy_max, observer)
    dims = ("phi_d", "theta_d", "theta_h", "wavelength_nm", "stokes_o", "stokes_i")
    stokes = np.array(["I", "Q", "U", "V"])
    coords = {
        **axis("phi_d", table.phi_d, "rad", "azimuth of the light about the half vector"),
        **axis("theta_d", table.theta_d, "rad", "angle of the light to the half vector"),
        **axis("theta_h", table.theta_h, "rad", "angle of the half vector to the normal"),
        **axis("wavelength_nm", shades.wavelength_nm, "nm", "vacuum wavelength"),
        **axis("stokes_o", stokes, "", "component of the outgoing light"),
        **axis("stokes_i", stokes, "", "component of the incoming light"),
    }
    variables = {"M": Variable(dims, table.values, "1/sr", "Mueller matrix times f")}
    return Computed(coords, variables, certificate, solver.albedo.film.solver.precision)


def mueller_wavelengths_nm(spec: Spec) -> FloatArray:
    """Return five whole nm: the spec's own, where it lists five such, or five spread over its range."""
    nm = wavelength_values_nm(spec.table.wavelength_nm)
    if nm.size == WAVELENGTHS and (nm == nm.round()).all():
        return nm
    whole = np.linspace(nm[0], nm[-1], WAVELENGTHS).round()
    # The ends may have been rounded to beyond the range in which materials are known.
    whole[[0, -1]] = np.ceil(nm[0]), np.floor(nm[-1])
    if (np.diff(whole) <= 0).any():
        expected = f"wavelengths over at least {WAVELENGTHS} nm: a file of format mueller has five whole ones"
        raise SpecError("table.wavelength_nm", expected, f"{nm[0]:g} to {nm[-1]:g} nm")
    return whole


def check_polarised(spec: Spec) -> None:
    """Refuse films without a phase, and light of which no facet says how it is polarised."""
    averaged = any(not layer.coherent or layer.thickness_sigma_nm for layer in all_layers(spec.stack))
    if averaged:
        raise SpecError(
            "stack.layers",
            "coherent layers without thickness_sigma_nm: a Mueller matrix needs a phase",
            "layers whose intensities are averaged",
            "take rgl, or make the layers coherent and even",
        )
    if surface_of(spec).distribution == "phong":
        expected = "a distribution of facets: a phong lobe has none whose plane of reflection would be known"
        raise SpecError("surface.distribution", expected, '"phong"', 'take "blinn", or rgl')
    if surface_of(spec).multiple_scattering != "none":
        expected = '"none": how light is polarised after several reflections is not modelled'
        raise SpecError("surface.multiple_scattering", expected, '"kulla-conty"', "take rgl")


@dataclass(frozen=True, eq=False)
class MuellerTable:
    """What a file holds, and how a reader evaluates it.

    Parameters
    ----------
    phi_d, theta_d, theta_h : float arrays, shape (P,), (D,), (H,)
        Nodes in radians.
    values : float array, shape (P, D, H, 5, 4, 4)
        Mueller matrices times f, 1 / sr.
    """

    phi_d: FloatArray
    theta_d: FloatArray
    theta_h: FloatArray
    values: NDArray[np.float32]

    def evaluate(self, pairs: Pairs) -> FloatArray:
        """Return M00 cos_o at pairs of directions, (P, 5)."""
        at = half_difference_of(pairs)
        axes = (self.phi_d, self.theta_d, self.theta_h)
        f = multilinear(self.values[..., 0, 0], axes, (at.phi_d, at.theta_d, at.theta_h))
        return f * pairs.outgoing[:, 2:]


def _settled(
    solver: BsdfSolver, shades: Spectra, energy_max: float, observer: Observer | None
) -> tuple[MuellerTable, MuellerCertificate]:
    """Take the smallest grid that is fine enough, or the largest that a file has room for."""
    where = placing(solver, shades)
    for place, counts in enumerate(_GRIDS):
        nodes = where.nodes(*counts)
        table = tabulated(solver, nodes, shades.wavelength_nm, step_of(observer, place, len(_GRIDS)))
        certificate = certify_nodes(
            certify(solver, shades, table.evaluate, energy_max),
            solver,
            shades,
            table.evaluate,
            some_nodes(nodes),
        )
        if _is_fine(certificate):
            break
    if observer is not None:
        observer(1.0)
    return table, certificate


def _is_fine(certificate: MuellerCertificate) -> bool:
    """Nine of ten values along the lobe, half of them elsewhere, and the light as a whole are exact."""
    errors = (certificate.grid_error_p90, certificate.wide_grid_error_median, certificate.grid_energy_error)
    return max(map(abs, errors)) <= EXACT


def some_nodes(nodes: Nodes) -> Pairs:
    """Return pairs of directions at nodes above the horizon, drawn, always the same."""
    random = np.random.default_rng(3)
    phi_d, theta_d, theta_h = (
        random.choice(axis, _NODES_CHECKED) for axis in (nodes.phi_d, nodes.theta_d, nodes.theta_h)
    )
    at = HalfDifference(theta_h, theta_d, phi_d)
    moved = at.above()
    above = (moved.theta_d == theta_d) & (moved.theta_h == theta_h)
    return HalfDifference(theta_h[above], theta_d[above], phi_d[above]).pairs()


def tabulated(solver: BsdfSolver, nodes: Nodes, nm: FloatArray, observer: Observer | None) -> MuellerTable:
    """Compute a table at nodes; raises `BudgetError` where it is larger than the byte budget."""
    counts = (nodes.phi_d.size, nodes.theta_d.size, nodes.theta_h.size)
    # The matrices, one more of their parts, and a quarter of M00 and its curvatures in double precision.
    require(
        f"Mueller matrices at {' x '.join(map(str, counts))} nodes", (2 * 64 + 16) * nm.size * nodes.count
    )
    # A right angle is rounded up in single precision.
    film = mueller_film(solver, np.cos(nodes.theta_d).clip(min=0), nm)
    g = _facets(solver, nodes)
    diffuse = solver.albedo.diffuse / np.pi
    kept = _without_bias(nodes, g * film[None, :, None, :, 0, 0] + diffuse)  # (Q, D, H, L)
    facets = (g * kept).astype(np.float32)[nodes.folded]
    values = facets[..., None, None] * film.astype(np.float32)[:, None]  # (P, D, H, L, 4, 4)
    values[..., 0, 0] += (kept * diffuse).astype(np.float32)[nodes.folded]
    if observer is not None:
        observer(0.9)
    return MuellerTable(nodes.phi_d, nodes.theta_d, nodes.theta_h, values)


def mueller_film(solver: BsdfSolver, cosines: FloatArray, nm: FloatArray) -> FloatArray:
    """Return the film's Mueller matrices at cosines (D,) and wavelengths (L,): (D, L, 4, 4).

    The kernel has tan(psi) exp(i Delta) = -r_p / r_s, so that conj(r_p) r_s is -|r_p r_s| exp(-i Delta).
    """
    film, grid = solver.albedo.film.solver, Grid(np.ones(1), cosines, nm)
    R = film.exact_intensities(grid)
    phase = np.asarray(film.ellipsometry(grid)["Delta"][0], np.float64)
    R_s, R_p = R["R_s"][0], R["R_p"][0]
    crossed = -np.sqrt(R_s * R_p) * np.exp(-1j * phase)
    matrix = np.zeros((*phase.shape, 4, 4))
    matrix[..., [0, 1], [0, 1]] = ((R_s + R_p) / 2)[..., None]
    matrix[..., [0, 1], [1, 0]] = ((R_s - R_p) / 2)[..., None]
    matrix[..., [2, 3], [2, 3]] = crossed.real[..., None]
    matrix[..., 3, 2], matrix[..., 2, 3] = crossed.imag, -crossed.imag
    return matrix


def _facets(solver: BsdfSolver, nodes: Nodes) -> FloatArray:
    """Return f of facets that reflect all light over a quarter of azimuths, (Q, D, H, 1)."""
    g = facets_at(solver, HalfDifference.grid(nodes.theta_h, nodes.theta_d, nodes.quarter))
    counts = (nodes.theta_h.size, nodes.theta_d.size, nodes.quarter.size)
    return g.reshape(counts).transpose(2, 1, 0)[..., None]


def _without_bias(nodes: Nodes, m00: FloatArray) -> FloatArray:
    """Return by what samples (Q, D, H, L) have to be multiplied so that cells are right on average.

    A common factor leaves every Mueller matrix one of light.
    """
    above = sum(
        _chords_above(angle, m00, axis)
        for axis, angle in enumerate((nodes.quarter, nodes.theta_d, nodes.theta_h))
    )
    return np.asarray(1 - np.clip(above / np.maximum(m00, _DARK), -_MOST_SHIFT, _MOST_SHIFT))


def _chords_above(nodes: FloatArray, values: FloatArray, axis: int) -> FloatArray:
    """Return how far chords along an axis lie above a curve, on average about each node.

    That is h^2 / 12 times the second derivative. The curve is taken to be even about its ends, which it is in
    phi_d; of theta_d and theta_h, the last is a right angle, where no light is.
    """
    curve = np.moveaxis(values, axis, 0)
    h = np.diff(nodes).reshape(-1, *[1] * (values.ndim - 1))
    slope = np.diff(curve, axis=0) / h
    above = np.empty_like(curve)
    above[1:-1] = (h[1:] ** 2 + h[:-1] ** 2) / 12 * np.diff(slope, axis=0) / (h[1:] + h[:-1])
    above[0], above[-1] = h[0] / 6 * slope[0], -h[-1] / 6 * slope[-1]
    return np.moveaxis(above, 0, axis)
