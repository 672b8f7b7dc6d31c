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
and the film as it is at their own theta_d.

What is linear between samples of a curve lies on one side of it, by h^2 / 12 times the second derivative on
average. The samples over theta_h and theta_d are shifted by that, so that the light is right in all.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.bsdf import BsdfProblem, Pairs, bsdf_spectra
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer, step_of
from nacreous.optics.stack import all_layers
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.computed import Computed, axis, grid_of
from nacreous.tables.film import Grid
from nacreous.tables.measured.certificate import MeasuredCertificate, certify
from nacreous.tables.measured.half_difference import HalfDifference, half_difference_of
from nacreous.tables.measured.multilinear import multilinear
from nacreous.tables.measured.surface import Spectra
from nacreous.tables.spec import Spec, surface_of
from nacreous.tables.table import Variable

__all__ = ["MuellerTable", "check_polarised", "compute_mueller", "mueller_wavelengths_nm"]

FloatArray = NDArray[np.float64]

WAVELENGTHS = 5
"""What Mitsuba reads, no more and no fewer."""
_GRIDS = ((17, 32, 64), (21, 52, 112))
"""Nodes of phi_d, theta_d and theta_h to choose from; they make 11 and 39 MB."""
_MEDIAN_ERROR, _P90_ERROR = 1e-3, 6e-3
"""Relative errors of f along a lobe, at the wavelengths of the file, at which a grid is fine enough."""
_FINE = 8192
"""Angles at which the lobe is looked at to place nodes in it."""
_FEWEST_NODES = 4
"""Cosines of a film that a cubic needs."""
_DARK = 1e-30
"""What keeps a black surface from being divided by."""
_MOST_SHIFT = 0.02
"""Part of f by which its samples are shifted at most; dark tails bend beyond what this is for."""
_EVEN = 0.15
"""Share of the nodes that are even over all angles."""
_FAINT = 3e-5
"""Part of the lobe's peak below which nodes follow it less and less."""


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
) -> tuple[MuellerTable, MeasuredCertificate]:
    """Take the smallest grid that is fine enough, or the largest that a file has room for."""
    for place, counts in enumerate(_GRIDS):
        table = tabulated(solver, counts, shades.wavelength_nm, step_of(observer, place, len(_GRIDS)))
        certificate = certify(solver, shades, table.evaluate, energy_max)
        if certificate.grid_error_median <= _MEDIAN_ERROR and certificate.grid_error_p90 <= _P90_ERROR:
            break
    if observer is not None:
        observer(1.0)
    return table, certificate


def tabulated(
    solver: BsdfSolver, counts: tuple[int, int, int], nm: FloatArray, observer: Observer | None
) -> MuellerTable:
    """Compute a table with so many nodes of phi_d, theta_d and theta_h."""
    require(
        f"Mueller matrices at {' x '.join(map(str, counts))} nodes",
        (8 + 4) * 16 * nm.size * int(np.prod(counts)),
    )
    phi_d, theta_d = np.linspace(-np.pi, np.pi, counts[0]), np.linspace(0, np.pi / 2, counts[1])
    theta_h = _lobe_nodes(solver, counts[2])
    at = HalfDifference.grid(theta_h, theta_d, phi_d).above()
    g = _facets(solver, at.pairs()).reshape(theta_h.size, theta_d.size, phi_d.size).transpose(2, 1, 0)
    g *= _unbiased_lobe(solver, theta_h)
    film = _unbiased_film(solver, theta_d, mueller_film(solver, np.cos(theta_d), nm))
    values = g[..., None, None, None] * film[:, None]  # (P, D, H, L, 4, 4)
    values[..., 0, 0] += solver.albedo.diffuse / np.pi
    if observer is not None:
        observer(0.9)
    return MuellerTable(phi_d, theta_d, theta_h, values.astype(np.float32))


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


def _facets(solver: BsdfSolver, pairs: Pairs) -> FloatArray:
    """Return f of a surface whose facets reflect all light, without what is diffuse, (P,)."""
    film = np.ones((_FEWEST_NODES, 1))
    mirror = BsdfProblem(solver.facets, Side.REFLECTION, film, np.ones((2, 1)), pairs)
    f = bsdf_spectra(solver.albedo.device, mirror, Precision.DOUBLE)
    return np.asarray(f[:, 0] * solver.albedo.surface.specular_weight)


def _lobe_nodes(solver: BsdfSolver, count: int) -> FloatArray:
    """Return theta_h from 0 to a right angle, dense where the lobe bends.

    A linear interpolation errs by the square of the step times the second derivative: nodes lie as the root
    of the relative one.
    """
    theta = np.linspace(0, 1, _FINE) ** 2 * (np.pi / 2)
    lobe = _lobe(solver, theta)
    bend = np.abs(np.gradient(np.gradient(lobe, theta), theta)) / (lobe + _FAINT * max(lobe.max(), 1))
    density = np.sqrt(bend[1:] + bend[:-1]) * np.diff(theta)
    share = np.concatenate([[0], np.cumsum(density)]) / max(density.sum(), np.finfo(float).tiny)
    spread = (1 - _EVEN) * share + _EVEN * theta / theta[-1]
    nodes = np.interp(np.linspace(0, spread[-1], count), spread, theta)
    return np.asarray(nodes.astype(np.float32), np.float64)


def _lobe(solver: BsdfSolver, theta_h: FloatArray) -> FloatArray:
    """Return the lobe of light that comes back where it came from, over theta_h (H,)."""
    nothing = np.zeros_like(theta_h)
    seen = HalfDifference(theta_h, nothing, nothing).above().pairs()
    return np.asarray(_facets(solver, seen) * np.cos(theta_h) ** 2)


def _unbiased_lobe(solver: BsdfSolver, theta_h: FloatArray) -> FloatArray:
    """Return what the samples over theta_h, (H,), are multiplied with."""
    return _without_bias(theta_h, _lobe(solver, theta_h)[:, None])[:, 0]


def _unbiased_film(solver: BsdfSolver, theta_d: FloatArray, film: FloatArray) -> FloatArray:
    """Return the samples over theta_d, (D, L, 4, 4), as is right about the mirror direction."""
    nothing = np.zeros_like(theta_d)
    mirror = _facets(solver, HalfDifference(nothing, theta_d, nothing).above().pairs())
    return film * _without_bias(theta_d, mirror[:, None] * film[..., 0, 0])[..., None, None]


def _without_bias(nodes: FloatArray, values: FloatArray) -> FloatArray:
    """Return by what samples (N, C) of a curve have to be multiplied so that chords are right on average.

    A chord lies above the curve by h^2 / 12 times its second derivative, on average. The curve is even about
    the first node; about the last nothing is known. A common factor leaves every Mueller matrix one of light.
    """
    h = np.diff(nodes)[:, None]
    slope = np.diff(values, axis=0) / h
    above = np.zeros_like(values)
    above[1:-1] = (h[1:] ** 2 + h[:-1] ** 2) / 12 * np.diff(slope, axis=0) / (h[1:] + h[:-1])
    above[0] = h[0] / 6 * slope[0]
    return np.asarray(1 - np.clip(above / np.maximum(values, _DARK), -_MOST_SHIFT, _MOST_SHIFT))
