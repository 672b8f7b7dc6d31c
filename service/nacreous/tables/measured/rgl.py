"""A bsdf in the parametrisation of Dupuy and Jakob 2018, which Mitsuba 3, pbrt-v4 and Falcor read.

A reader takes the half vector m of its two directions, finds the point s of a square that a density over
facets warps to it, and has

    f cos_o = S(s) ndf(m) / (4 sigma(i)),

each table linear between its samples. Any positive ndf, sigma and density make this exact at the samples, for
S is computed with the very tables that the reader divides by. They decide how smooth S is between them:

    ndf      the surface's D, and where it also scatters light diffusely a share of a constant;
    sigma    the projected area of the facets, so that S is about F G2 / G1;
    density  half the visible facets, max(0, i.m) D(m), and half a constant, both within the directions that
             reflect above the horizon. The constant gives the tails of a lobe room on the square: with the
             visible facets alone they would share its last row.

``luminance``, which readers sample before they warp, is the mean of f cos_o over this density, so that what
they sample follows f cos_o, whatever the density is.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.microfacets import microfacets
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer, step_of
from nacreous.opencl.warp import warped
from nacreous.optics.square_density import SquareDensities, bilinear
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.computed import Computed, axis, colouring_of, grid_of, wanted_parts
from nacreous.tables.facet_film import on_facets
from nacreous.tables.measured.certificate import MeasuredCertificate, certify
from nacreous.tables.measured.rgl_grid import (
    LADDERS,
    RglGrid,
    phi_of,
    theta_of,
    unit_of_phi,
    unit_of_theta,
    unit_vectors,
)
from nacreous.tables.measured.surface import Colours, Shades, Spectra
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Variable

__all__ = ["RglTable", "compute_rgl_colours", "compute_rgl_spectra"]

FloatArray = NDArray[np.float64]

MEDIAN_ERROR, P90_ERROR, ENERGY_ERROR = 1e-3, 6e-3, 5e-4
"""Relative errors of f along a lobe, and of all the light in it, at which a grid is fine enough.

Twice that for an anisotropic surface."""
_MOST_BYTES = {False: 20 * 2**20, True: 40 * 2**20}
"""Size beyond which no finer grid is tried: renderers keep the whole file in memory."""
_TAILS = {False: 0.5, True: 0.8}
"""Share of the square for facets off the lobe, of isotropic (False) and anisotropic (True) surfaces.

Half keeps the error of a diffusely lit pair of directions within 2 %, where the lobe alone leaves 90 % at
alpha 0.02, and costs the lobe nothing measurable. An anisotropic surface has few samples to a side, and those
about a flat lobe are what its error is made of."""
_LEAST_DENSITY = 1e-6
"""What keeps rows of a density above 0 where no facet reflects above the horizon."""
_LEAST_FACETS = 1e-30
"""Least ndf in 1 / sr: single precision ends at 1e-38."""
_LEAST_LUMINANCE = 1e-4
"""Least luminance, as a part of the mean of its slice: what has none is never sampled."""
_INSIDE = 1e-6
"""How far from the sides of the square its outermost samples are warped: the warp is steep at its sides."""
_HORIZON = 0.3
"""How far from the side where facets reflect along the horizon its samples are taken, in cells: S falls to 0
there so fast that a line to it would be too low all over the cell."""


def compute_rgl_spectra(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table at the spec's wavelengths; raises what `tabulate_table` raises."""
    nm = grid_of(spec).wavelength_nm
    axes = axis("wavelength_nm", nm, "nm", "vacuum wavelength")
    return _computed(device, spec, "spectra", axes, Spectra(nm), observer)


def compute_rgl_colours(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table in linear colours; raises what `tabulate_table` raises."""
    grid = grid_of(spec)
    wanted_parts({Part.COLOUR}, grid.wavelength_nm)
    colouring = colouring_of(spec, bsdf_solver(device, spec).albedo.film.solver, on_facets(grid))
    assert colouring is not None  # noqa: S101 - `wanted_parts` has refused a spec without colour
    axes = axis("channel", np.array(colouring.system.channels), "", "component of the linear colour")
    return _computed(device, spec, "rgb", axes, Colours(colouring), observer)


def _computed(
    device: Device,
    spec: Spec,
    name: str,
    channels: dict[str, Variable],
    shades: Shades,
    observer: Observer | None,
) -> Computed:
    solver = bsdf_solver(device, spec)
    energy_max = check_albedo(solver.albedo, solver.roughness, grid_of(spec))
    (channel,) = channels
    table, certificate = _settled(solver, shades, energy_max, observer)
    if observer is not None:
        observer(1.0)
    coords = {
        **axis("phi_i", table.grid.phi_i, "rad", "azimuth of the incoming light, from x"),
        **axis("theta_i", table.grid.theta_i, "rad", "angle of the incoming light to the normal"),
        **channels,
    }
    return Computed(coords, table.variables(name, channel), certificate, solver.albedo.film.solver.precision)


def _settled(
    solver: BsdfSolver, shades: Shades, energy_max: float, observer: Observer | None
) -> tuple["RglTable", MeasuredCertificate]:
    """Take the first grid of the ladder that is fine enough, or the best that a file has room for."""
    anisotropic = solver.albedo.surface.anisotropic
    ladder = [
        grid
        for place, grid in enumerate(LADDERS[anisotropic])
        if place == 0 or 4 * grid.numbers(shades.count) <= _MOST_BYTES[anisotropic]
    ]
    tried = []
    for place, grid in enumerate(ladder):
        table = tabulated(solver, grid, shades, step_of(observer, place, len(ladder)))
        certificate = certify(solver, shades, table.evaluate, energy_max)
        if _is_fine(certificate, 2 if anisotropic else 1):
            return table, certificate
        tried.append((table, certificate))
    return min(tried, key=_p90)


def _p90(tried: tuple["RglTable", MeasuredCertificate]) -> float:
    return tried[1].grid_error_p90


def _is_fine(certificate: MeasuredCertificate, slack: float) -> bool:
    return (
        certificate.grid_error_median <= slack * MEDIAN_ERROR
        and certificate.grid_error_p90 <= slack * P90_ERROR
        and abs(certificate.lobe_energy_error) <= slack * ENERGY_ERROR
    )


@dataclass(frozen=True, eq=False)
class RglTable:
    """What a file holds, and how a reader evaluates it.

    Parameters
    ----------
    grid : RglGrid
    ndf, sigma : float arrays, shape (G, K)
        Distribution of facets in 1 / sr, and their projected area, over azimuth and tilt.
    densities : SquareDensities
        S densities of H rows and W columns.
    luminance : float array, shape (S, N, N)
    values : float array, shape (S, N, N, C)
    """

    grid: RglGrid
    ndf: FloatArray
    sigma: FloatArray
    densities: SquareDensities
    luminance: FloatArray
    values: FloatArray

    def evaluate(self, pairs: Pairs) -> FloatArray:
        """Return f cos_o at pairs of directions as a reader has it, (P, C)."""
        m = pairs.incoming + pairs.outgoing
        m = m / np.linalg.norm(m, axis=-1, keepdims=True)
        theta_i, phi_i = _angles(pairs.incoming)
        theta_m, phi_m = _angles(m)
        x, y = unit_of_theta(theta_m), unit_of_phi(phi_m - phi_i if self.grid.isotropic else phi_m)
        slices, weights = _slices(self.grid, theta_i, phi_i)
        s = self.densities.inverse(x, y, slices, weights)
        values = bilinear(self.values, *s, slices, weights)
        ndf = _looked_up(self.ndf, x, y)
        sigma = _looked_up(self.sigma, unit_of_theta(theta_i), unit_of_phi(phi_i))
        return np.asarray(values * (ndf / (4 * sigma))[:, None])

    def variables(self, name: str, channel: str) -> dict[str, Variable]:
        """Return the arrays of a file, in the order of their axes there."""
        slices = (self.grid.azimuths, self.grid.tilts)
        incoming = ("phi_i", "theta_i")
        stored = np.moveaxis(self.values, -1, 1).reshape(*slices, -1, *self.luminance.shape[1:])
        densities = self.densities.density.reshape(*slices, *self.densities.density.shape[1:])
        luminance = self.luminance.reshape(*slices, *self.luminance.shape[1:])
        facets, square = ("phi_m", "theta_m"), ("v", "u")
        return {
            "ndf": Variable(facets, _single(self.ndf), "1/sr", "distribution of facets"),
            "sigma": Variable(facets, _single(self.sigma), "1", "projected area of facets"),
            "vndf": Variable((*incoming, "row", "column"), _single(densities), "1", "density of the warp"),
            "luminance": Variable((*incoming, *square), _single(luminance), "1", "what is sampled first"),
            name: Variable((*incoming, channel, *square), _single(stored), "1", "f cos_o 4 sigma / ndf"),
        }


def tabulated(solver: BsdfSolver, grid: RglGrid, shades: Shades, observer: Observer | None) -> RglTable:
    """Compute a table on a grid.

    Raises
    ------
    BudgetError
        It is larger than the byte budget; nothing is allocated.
    """
    slices, square = grid.azimuths * grid.tilts, grid.samples**2
    require(
        f"a measured bsdf of {slices:,} x {square:,} x {shades.count:,} numbers",
        24 * grid.numbers(shades.count),
    )
    ndf, sigma = _facets(solver, grid)
    densities = SquareDensities.of(_density(solver, shades, grid, ndf))
    last = 1 - _HORIZON / (grid.samples - 1)
    points = np.clip(_square(grid.samples), _INSIDE, [last, 1 - _INSIDE])
    places = np.asarray(warped(solver.albedo.device, densities, points, Precision.DOUBLE), np.float64)
    pairs, above = _reflected(grid, places)
    f_cos = _f_cos(solver, shades, pairs, above)
    if observer is not None:
        observer(0.8)
    x, y = places.reshape(-1, 2).T
    theta, phi = _angles(grid.incoming)
    shown = 4 * _looked_up(sigma, unit_of_theta(theta), unit_of_phi(phi)).repeat(square)
    values = f_cos * (shown / _looked_up(ndf, x, y))[:, None]
    luminance = _luminance(f_cos, pairs, x, densities, places)
    return RglTable(
        grid,
        ndf,
        sigma,
        densities,
        luminance.reshape(slices, grid.samples, grid.samples),
        values.reshape(slices, grid.samples, grid.samples, shades.count),
    )


def _facets(solver: BsdfSolver, grid: RglGrid) -> tuple[FloatArray, FloatArray]:
    """Return ndf and sigma, (G, K) each; Phong's lobe is none of facets, and has constants."""
    surface, shape = solver.albedo.surface, (grid.facet_azimuths, grid.facet_tilts)
    if surface.distribution == "phong":
        return np.full(shape, 1 / np.pi), np.ones(shape)
    x, y = np.meshgrid(np.linspace(0, 1, shape[1]), np.linspace(0, 1, shape[0]))
    upright = unit_vectors(np.minimum(theta_of(x), np.pi / 2 - 1e-6), phi_of(y)).reshape(-1, 3)
    found = microfacets(solver.albedo.device, solver.facets, upright, Precision.DOUBLE)
    density, area = (np.asarray(values[0], np.float64).reshape(shape) for values in found)
    diffuse = solver.albedo.diffuse
    if surface.multiple_scattering == "kulla-conty":
        diffuse += 1 - float(solver.albedo.mirror_mean(solver.roughness)[0])
    return np.maximum(density, _LEAST_FACETS) + diffuse / np.pi, area


def _density(solver: BsdfSolver, shades: Shades, grid: RglGrid, ndf: FloatArray) -> FloatArray:
    """Return the density of each slice over the unit square of facets, (S, H, W)."""
    x, y = np.meshgrid(np.linspace(0, 1, grid.columns), np.linspace(0, 1, grid.rows))
    theta = theta_of(x)
    stretch = x * np.sin(theta)
    places = np.broadcast_to(np.stack([x, y], -1).reshape(-1, 2), (len(grid.incoming), x.size, 2))
    pairs, above = _reflected(grid, places)
    if solver.albedo.surface.distribution == "phong":
        seen = _f_cos(solver, shades, pairs, above).mean(axis=1).reshape(-1, *x.shape)
    else:
        seen = _looked_up(ndf, x.ravel(), y.ravel()).reshape(x.shape)
    m = unit_vectors(theta, phi_of(y))
    facing = np.maximum(np.einsum("hwc,sc->shw", m, grid.incoming), 0)
    within = above.reshape(facing.shape)
    lobe, tails = (
        _normalised(np.where(within, facing * seen * stretch, 0)),
        _normalised(_neighbours_too(within)),
    )
    share = _TAILS[not grid.isotropic]
    return (1 - share) * lobe + share * tails + _LEAST_DENSITY


def _f_cos(solver: BsdfSolver, shades: Shades, pairs: Pairs, above: NDArray[np.bool_]) -> FloatArray:
    """Return f cos_o, (P, C); 0 where the light does not leave the surface."""
    seen = Pairs(pairs.roughness[above], pairs.incoming[above], pairs.outgoing[above])
    f_cos = np.zeros((above.size, shades.count))
    f_cos[above] = shades.reflected(solver, seen) * seen.outgoing[:, 2:]
    return f_cos


def _neighbours_too(within: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Add to each row and column of (S, H, W) those beside it: a cell that the horizon crosses is within."""
    wide = within | np.roll(within, 1, axis=1) | np.roll(within, -1, axis=1)
    wide[..., 1:] |= wide[..., :-1].copy()
    return wide


def _normalised(values: NDArray[np.floating | np.bool_]) -> FloatArray:
    """Values (S, H, W) over the mean of their slice; 0 where that is 0."""
    mean = values.mean(axis=(1, 2), keepdims=True)
    return np.asarray(np.divide(values, mean, out=np.zeros(values.shape), where=mean > 0))


def _square(samples: int) -> FloatArray:
    """Points of the square, (N^2, 2), x fastest."""
    x, y = np.meshgrid(np.linspace(0, 1, samples), np.linspace(0, 1, samples))
    return np.stack([x.ravel(), y.ravel()], axis=-1)


def _reflected(grid: RglGrid, places: FloatArray) -> tuple[Pairs, NDArray[np.bool_]]:
    """Return the directions that facets at places (S, N^2, 2) reflect to, and which leave the surface."""
    m = unit_vectors(theta_of(places[..., 0]), phi_of(places[..., 1]))
    incoming = np.broadcast_to(grid.incoming[:, None], m.shape)
    facing = np.sum(m * incoming, axis=-1, keepdims=True)
    outgoing = (2 * facing * m - incoming).reshape(-1, 3)
    above = (outgoing[:, 2] > 0) & (facing.ravel() > 0)
    return Pairs(np.zeros(len(outgoing), np.int32), incoming.reshape(-1, 3), outgoing), above


def _luminance(
    f_cos: FloatArray, pairs: Pairs, x: FloatArray, densities: SquareDensities, places: FloatArray
) -> FloatArray:
    """Return mean f cos_o over the density of outgoing directions, (S, N^2), above 0 everywhere.

    A solid angle of outgoing directions is 4 i.m times that of facets, and that is 2 pi^2 x sin(theta_m)
    times the area of the square of facets.
    """
    m = unit_vectors(theta_of(x), phi_of(places[..., 1].ravel()))
    facing = np.sum(m * pairs.incoming, axis=-1)
    stretch = 2 * np.pi**2 * x * np.sin(theta_of(x)) * 4 * np.maximum(facing, 0)
    slices, count = places.shape[:2]
    which = np.arange(slices).repeat(count)[:, None]
    density = bilinear(
        densities.density[..., None], x, places[..., 1].ravel(), which, np.ones((which.size, 1))
    )[:, 0]
    luminance = (f_cos.mean(axis=1) * stretch / density).reshape(slices, count)
    mean = luminance.mean(axis=1, keepdims=True)
    return np.asarray(np.maximum(luminance, _LEAST_LUMINANCE * np.where(mean > 0, mean, 1)))


def _angles(directions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Polar angle and azimuth in radians of unit vectors (P, 3), exact at the normal."""
    x, y, z = directions.T
    return np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)


def _slices(grid: RglGrid, theta: FloatArray, phi: FloatArray) -> tuple[NDArray[np.int_], FloatArray]:
    """Return the slices about incoming directions, (P, 2) or (P, 4), and their weights."""
    lower, upper_share = _interval(grid.theta_i, theta)
    tilts = ((lower, 1 - upper_share), (lower + 1, upper_share))
    if grid.isotropic:
        around = [(np.zeros_like(lower), np.ones_like(theta))]
    else:
        first, share = _interval(grid.phi_i, phi)
        around = [(first, 1 - share), (first + 1, share)]
    corners = [(q * grid.tilts + i, a * b) for q, a in around for i, b in tilts]
    return np.stack([c[0] for c in corners], -1), np.stack([c[1] for c in corners], -1)


def _interval(axis_values: FloatArray, at: FloatArray) -> tuple[NDArray[np.int_], FloatArray]:
    """Return the interval of an axis that a value lies in, or is nearest to, and its place there."""
    first = np.clip(np.searchsorted(axis_values, at, side="right") - 1, 0, axis_values.size - 2)
    width = axis_values[first + 1] - axis_values[first]
    return first, np.clip((at - axis_values[first]) / width, 0, 1)


def _looked_up(table: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Bilinear values of one table, (H, W), at points of the square, (P,)."""
    one = np.zeros((x.size, 1), np.int_)
    return bilinear(table[None, ..., None], x, y, one, np.ones((x.size, 1)))[:, 0]


def _single(values: FloatArray) -> NDArray[np.float32]:
    return np.ascontiguousarray(values, np.float32)
