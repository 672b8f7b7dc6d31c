"""A bsdf on the grid of MDL's measured BSDF: both polar angles and the azimuth between, evenly divided.

The 90 degrees of either angle are N bins and the 180 between the azimuths 2 N; values lie in the bins'
middles, where a volume texture has its texels, and readers are linear between them. Half a turn is enough,
because an isotropic surface is its own mirror image. A lobe lies along the diagonal theta_i = theta_o, and is
twice as wide in theta_o as its facets' alpha: at its top the error is about (pi / (4 N alpha))^2.

MDL names directions by the way of the light: `theta_o` of this module is the angle at which light arrives,
theta_in there, and `theta_i` that of the eye. f_r is the same either way. f_t is in terms of flux, as MDL's
own refraction is: what the eye sees is not divided by the square of the index.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.tiles import Observer
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.bsdf.directions import DirectionGrid
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.computed import Computed, axis, grid_of
from nacreous.tables.measured.certificate import MbsdfCertificate, certify, certify_transmission
from nacreous.tables.measured.multilinear import multilinear
from nacreous.tables.measured.surface import Colours, colours_of
from nacreous.tables.spec import Spec
from nacreous.tables.table import Variable

__all__ = ["MbsdfTable", "compute_mbsdf"]

FloatArray = NDArray[np.float64]

_BINS = (48, 72, 100)
"""Numbers of bins to choose from; the last makes 24 MB a side."""
_LEAST_BINS_A_LOBE = 30
"""4 N alpha below which a number of bins is not tried: the lobe's top would be off by more than 1 %."""
_NAMES = {Side.REFLECTION: "f_r_rgb", Side.TRANSMISSION: "f_t_rgb"}
_P90_ERROR, _ENERGY_ERROR = 1e-2, 2e-3
"""Relative errors of f along a lobe, and of all its light, at which a grid is fine enough."""


def compute_mbsdf(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table in linear colours; raises what `tabulate_table` raises."""
    solver, grid = bsdf_solver(device, spec), grid_of(spec)
    energy_max = check_albedo(solver.albedo, solver.roughness, grid)
    shades, sides = colours_of(spec, solver), solver.sides(grid.wavelength_nm)
    tables, certificate = _settled(solver, shades, sides, energy_max, observer)
    dims, meaning = ("theta_o", "theta_i", "phi", "channel"), "linear colour of the bsdf"
    variables = {
        _NAMES[side]: Variable(dims, table.values, "1/sr", meaning) for side, table in tables.items()
    }
    coords = _coords(tables[Side.REFLECTION], shades)
    return Computed(coords, variables, certificate, solver.albedo.film.solver.precision)


def _coords(table: "MbsdfTable", shades: Colours) -> dict[str, Variable]:
    channels = np.array(shades.colouring.system.channels)
    return {
        **axis("theta_o", table.theta, "rad", "angle of the outgoing light to the normal, on its side"),
        **axis("theta_i", table.theta, "rad", "angle of the incoming light to the normal"),
        **axis("phi", table.phi, "rad", "azimuth of the outgoing light, from that of the incoming"),
        **axis("channel", channels, "", "component of the linear colour"),
    }


@dataclass(frozen=True, eq=False)
class MbsdfTable:
    """One side of a file, and how a reader evaluates it.

    Parameters
    ----------
    values : float array, shape (N, N, 2 N, 3)
        f in 1 / sr over theta_o, theta_i and phi.
    """

    values: NDArray[np.float32]

    @property
    def bins(self) -> int:
        """Number of bins of a polar angle, N."""
        return len(self.values)

    @property
    def theta(self) -> FloatArray:
        """Polar angles in radians, (N,)."""
        return _middles(self.bins) * (np.pi / 2)

    @property
    def phi(self) -> FloatArray:
        """Azimuths between both directions in radians, (2 N,)."""
        return _middles(2 * self.bins) * np.pi

    def evaluate(self, pairs: Pairs) -> FloatArray:
        """Return f cos_o at pairs of directions, (P, 3), as a linear volume texture gives it."""
        theta_i, theta_o = (
            np.arctan2(np.hypot(d[:, 0], d[:, 1]), abs(d[:, 2])) for d in (pairs.incoming, pairs.outgoing)
        )
        i, o = (np.arctan2(d[:, 1], d[:, 0]) for d in (pairs.incoming, pairs.outgoing))
        between = np.abs(np.arctan2(np.sin(o - i), np.cos(o - i)))
        f = multilinear(self.values, (self.theta, self.theta, self.phi), (theta_o, theta_i, between))
        return f * np.abs(pairs.outgoing[:, 2:])


def _settled(
    solver: BsdfSolver,
    shades: Colours,
    sides: tuple[Side, ...],
    energy_max: float,
    observer: Observer | None,
) -> tuple[dict[Side, MbsdfTable], MbsdfCertificate]:
    """Take the fewest bins that are fine enough, or the most that a file has room for."""
    alpha = float(solver.facets.alphas.min())
    worthwhile = [bins for bins in _BINS if 4 * bins * alpha >= _LEAST_BINS_A_LOBE] or [_BINS[-1]]
    for place, bins in enumerate(worthwhile):
        tables = {side: _tabulated(solver, shades, side, bins) for side in sides}
        certificate = _certified(solver, shades, tables, energy_max)
        if observer is not None:
            observer((place + 1) / len(worthwhile))
        if _is_fine(certificate):
            break
    if observer is not None:
        observer(1.0)
    return tables, certificate


def _certified(
    solver: BsdfSolver, shades: Colours, tables: dict[Side, MbsdfTable], energy_max: float
) -> MbsdfCertificate:
    exact, side = solver.exact(), Side.TRANSMISSION
    reflected = certify(solver, shades, tables[Side.REFLECTION].evaluate, energy_max)
    if side not in tables:
        return certify_transmission(reflected, _nothing, _nothing)

    def truth(pairs: Pairs) -> FloatArray:
        f = exact.colours(pairs, side, shades.colouring)
        return np.asarray(f * np.abs(pairs.outgoing[:, 2:]), np.float64)

    return certify_transmission(reflected, truth, tables[side].evaluate)


def _nothing(pairs: Pairs) -> FloatArray:
    return np.zeros((len(pairs.roughness), 3))


def _is_fine(certificate: MbsdfCertificate) -> bool:
    return (
        certificate.lobe_error_p90 <= _P90_ERROR
        and abs(certificate.lobe_energy_error) <= _ENERGY_ERROR
        and certificate.transmission_error_mean <= _P90_ERROR
    )


def _tabulated(solver: BsdfSolver, shades: Colours, side: Side, bins: int) -> MbsdfTable:
    require(f"an mbsdf block of {bins} x {bins} x {2 * bins} bins", 30 * 8 * 2 * bins**3)
    theta, phi = _middles(bins) * (np.pi / 2), _middles(2 * bins) * np.pi
    grid = DirectionGrid(np.zeros(1, np.int32), np.zeros(1), theta, theta, phi)
    f = solver.colours(grid.pairs(side), side, shades.colouring).reshape(bins, bins, 2 * bins, shades.count)
    return MbsdfTable(np.ascontiguousarray(f.swapaxes(0, 1), np.float32))


def _middles(bins: int) -> FloatArray:
    """Middles of equal bins of the unit interval."""
    return (np.arange(bins) + 0.5) / bins
