"""A bsdf in the parametrisation of Dupuy and Jakob 2018, which Mitsuba 3, pbrt-v4 and Falcor read.

A reader takes the half vector m of its two directions, finds the point s of a square that a density over
facets warps to it, and has

    f cos_o = S(s) ndf(m) / (4 sigma(i)),

each table linear between its samples. Any positive ndf, sigma and density make this exact at the samples, for
S is computed with the very tables that the reader divides by. They decide how smooth S is between them:

    ndf      the surface's D, and where it also scatters light diffusely a share of a constant;
    sigma    the projected area of the facets, so that S is about F G2 / G1;
    density  the visible facets, max(0, i.m) D(m), and for the most part one that is wide, 1 / (cos_o + 1/2),
             both within the directions that reflect above the horizon. It gives the tails of a lobe room on
             the square: with the visible facets alone they would share its last row.

Samples are moved a little in the end (`rgl_middles`), so that lines between them are right on average.
``luminance``, which readers sample before they warp, is the mean of f cos_o over this density, so that what
they sample follows f cos_o, whatever the density is.
"""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer, step_of
from nacreous.opencl.warp import warped
from nacreous.optics.square_density import SquareDensities, bilinear
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.computed import Computed, axis, grid_of
from nacreous.tables.measured.certificate import MeasuredCertificate, certify
from nacreous.tables.measured.rgl_grid import (
    LADDERS,
    RglGrid,
    phi_of,
    square_points,
    theta_of,
    unit_vectors,
)
from nacreous.tables.measured.rgl_middles import without_bias
from nacreous.tables.measured.rgl_table import RglTable, jacobian
from nacreous.tables.measured.rgl_warp import (
    facet_tables,
    reflected_f_cos,
    reflected_pairs,
    warp_densities,
)
from nacreous.tables.measured.surface import Shades, Spectra, colours_of
from nacreous.tables.spec import Spec
from nacreous.tables.table import Variable

__all__ = ["compute_rgl_colours", "compute_rgl_spectra", "rgl_table"]

FloatArray = NDArray[np.float64]

MEDIAN_ERROR, P90_ERROR, MEAN_ERROR, ENERGY_ERROR = 1e-3, 6e-3, 2e-3, 5e-4
"""Relative errors of f along a lobe, and of all the light in it, at which a grid is fine enough.

Twice that for an anisotropic surface."""
WIDE_MEDIAN_ERROR, WIDE_P90_ERROR = 2.5e-3, 8e-3
"""The same of f all over the hemisphere, in the middle between wavelengths."""
_MOST_BYTES = {False: 20 * 10**6, True: 40 * 10**6}
"""Size beyond which no finer grid is tried: renderers keep the whole file in memory."""
_LEAST_LUMINANCE = 1e-4
"""Least luminance, as a part of the mean of its slice: what has none is never sampled."""
_INSIDE = 1e-6
"""How far from the sides of the square its outermost samples are warped: the warp is steep at its sides."""


def compute_rgl_spectra(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table at the spec's wavelengths; raises what `tabulate_table` raises."""
    nm = grid_of(spec).wavelength_nm
    axes = axis("wavelength_nm", nm, "nm", "vacuum wavelength")
    return _computed(device, spec, "spectra", axes, Spectra(nm), observer)


def compute_rgl_colours(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table in linear colours; raises what `tabulate_table` raises."""
    shades = colours_of(spec, bsdf_solver(device, spec))
    channels = np.array(shades.colouring.system.channels)
    axes = axis("channel", channels, "", "component of the linear colour")
    return _computed(device, spec, "rgb", axes, shades, observer)


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
) -> tuple[RglTable, MeasuredCertificate]:
    """Take the first grid of the ladder that is fine enough, or the best that a file has room for."""
    anisotropic = solver.albedo.surface.anisotropic
    ladder = [
        grid
        for place, grid in enumerate(LADDERS[anisotropic])
        if place == 0 or 4 * grid.numbers(shades.count) <= _MOST_BYTES[anisotropic]
    ]
    tried = []
    for place, grid in enumerate(ladder):
        table = rgl_table(solver, grid, shades, step_of(observer, place, len(ladder)))
        certificate = certify(solver, shades, table.evaluate, energy_max)
        if _is_fine(certificate, 2 if anisotropic else 1):
            return table, certificate
        tried.append((table, certificate))
    return min(tried, key=_worst)


def _worst(tried: tuple[RglTable, MeasuredCertificate]) -> float:
    """Return by how much the error that misses its target most does so."""
    certificate = tried[1]
    return max(
        certificate.grid_error_p90 / P90_ERROR,
        certificate.wide_error_p90 / WIDE_P90_ERROR,
        abs(certificate.lobe_error_mean) / MEAN_ERROR,
        abs(certificate.lobe_energy_error) / ENERGY_ERROR,
    )


def _is_fine(certificate: MeasuredCertificate, slack: float) -> bool:
    return (
        certificate.grid_error_median <= slack * MEDIAN_ERROR
        and certificate.grid_error_p90 <= slack * P90_ERROR
        and abs(certificate.lobe_error_mean) <= slack * MEAN_ERROR
        and abs(certificate.lobe_energy_error) <= slack * ENERGY_ERROR
        and certificate.wide_error_median <= slack * WIDE_MEDIAN_ERROR
        and certificate.wide_error_p90 <= slack * WIDE_P90_ERROR
    )


def rgl_table(solver: BsdfSolver, grid: RglGrid, shades: Shades, observer: Observer | None) -> RglTable:
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
    table = _sampled(solver, grid, shades)
    if observer is not None:
        observer(0.6)
    return without_bias(solver, shades, table)


def _sampled(solver: BsdfSolver, grid: RglGrid, shades: Shades) -> RglTable:
    """Return the table that is exact at its samples."""
    slices = len(grid.incoming)
    ndf, sigma = facet_tables(solver, grid)
    densities = SquareDensities.of(warp_densities(solver, shades, grid, ndf))
    points = np.clip(square_points(np.linspace(0, 1, grid.samples)), _INSIDE, 1 - _INSIDE)
    places = np.asarray(warped(solver.albedo.device, densities, points, Precision.DOUBLE), np.float64)
    pairs, above = reflected_pairs(grid.incoming, places)
    f_cos = reflected_f_cos(solver, shades, pairs, above)
    x, y = places.reshape(-1, 2).T
    values = f_cos / jacobian(ndf, sigma, pairs.incoming, x, y)[:, None]
    luminance = _luminance(f_cos, pairs, x, densities, places)
    return RglTable(
        grid,
        ndf,
        sigma,
        densities,
        luminance.reshape(slices, grid.samples, grid.samples),
        values.reshape(slices, grid.samples, grid.samples, shades.count),
    )


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
