"""A bsdf on the grid of the MERL database (W. Matusik, H. Pfister, M. Brand and L. McMillan 2003).

Ninety bins of theta_h, as wide as its square root: bin k reaches from k^2 to (k + 1)^2 parts in 8100 of a
right angle. Ninety of theta_d and 180 of phi_d, a degree each; phi_d ends after half a turn, because f stays
the same when its directions change places. The database's reader takes the value of the bin, so the table has
it in the bin's middle, where the error has no bias; the middle of theta_h is that of its square root.

A bin whose middle is below the horizon and whose corner is not has the value at the horizon. One that no
light above the surface reaches has no value: `reached` says which.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.tiles import Observer
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.computed import Computed, axis, grid_of
from nacreous.tables.measured.certificate import certify
from nacreous.tables.measured.half_difference import HalfDifference, half_difference_of, lower_cosine
from nacreous.tables.measured.surface import Colours, colours_of
from nacreous.tables.spec import Spec
from nacreous.tables.table import Variable

__all__ = ["BINS", "compute_merl", "reached"]

FloatArray = NDArray[np.float64]

BINS = (90, 90, 180)
"""Of theta_h, theta_d and phi_d."""
_RIGHT_ANGLE = np.pi / 2


def compute_merl(device: Device, spec: Spec, observer: Observer | None) -> Computed:
    """Compute the table in linear colours; raises what `tabulate_table` raises."""
    solver = bsdf_solver(device, spec)
    energy_max = check_albedo(solver.albedo, solver.roughness, grid_of(spec))
    shades = colours_of(spec, solver)
    table = MerlTable(_values(shades, solver, observer))
    certificate = certify(solver, shades, table.evaluate, energy_max)
    if observer is not None:
        observer(1.0)
    theta_h, theta_d, phi_d = _middles()
    coords = {
        **axis("theta_h", theta_h, "rad", "angle of the half vector to the normal"),
        **axis("theta_d", theta_d, "rad", "angle of the light to the half vector"),
        **axis("phi_d", phi_d, "rad", "azimuth of the light about the half vector"),
        **axis("channel", np.array(shades.colouring.system.channels), "", "component of the linear colour"),
    }
    dims = ("theta_h", "theta_d", "phi_d", "channel")
    variables = {"rgb": Variable(dims, table.values, "1/sr", "linear colour of the bsdf of reflected light")}
    return Computed(coords, variables, certificate, solver.albedo.film.solver.precision)


@dataclass(frozen=True, eq=False)
class MerlTable:
    """What a file holds, and how the database's reader evaluates it.

    Parameters
    ----------
    values : float array, shape (90, 90, 180, 3)
        f in 1 / sr; 0 where no light reaches.
    """

    values: NDArray[np.float32]

    def evaluate(self, pairs: Pairs) -> FloatArray:
        """Return f cos_o at pairs of directions, (P, 3): that of the bin they are in."""
        at = half_difference_of(pairs)
        shares = (
            np.sqrt(at.theta_h / _RIGHT_ANGLE),
            at.theta_d / _RIGHT_ANGLE,
            np.mod(at.phi_d, np.pi) / np.pi,
        )
        bins = tuple(
            np.clip((share * count).astype(int), 0, count - 1)
            for share, count in zip(shares, BINS, strict=True)
        )
        return np.asarray(self.values[bins] * pairs.outgoing[:, 2:], np.float64)


def reached() -> NDArray[np.bool_]:
    """Tell which bins light above the surface reaches, shape `BINS`.

    The lower cosine falls with theta_h, theta_d and |cos phi_d|, so that one corner of a bin decides.
    """
    theta_h, theta_d, phi_d = _edges()
    cosine = np.abs(np.cos(phi_d))
    flattest = np.minimum(cosine[:-1], cosine[1:])
    return lower_cosine(theta_h[:-1, None, None], theta_d[:-1, None], flattest) > 0


def _values(shades: Colours, solver: BsdfSolver, observer: Observer | None) -> NDArray[np.float32]:
    """Return the values in the middles of the bins, (90, 90, 180, 3), 0 in those that no light reaches."""
    require("a merl file's bins", 30 * 8 * int(np.prod(BINS)))
    inside = reached().ravel()
    middles = HalfDifference.grid(*_middles())
    seen = HalfDifference(middles.theta_h[inside], middles.theta_d[inside], middles.phi_d[inside])
    values = np.zeros((inside.size, shades.count), np.float32)
    values[inside] = shades.reflected(solver, seen.above().pairs())
    if observer is not None:
        observer(0.9)
    return values.reshape(*BINS, shades.count)


def _edges() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the ends of the bins, in radians."""
    h, d, phi = (np.linspace(0, 1, count + 1) for count in BINS)
    return h**2 * _RIGHT_ANGLE, d * _RIGHT_ANGLE, phi * np.pi


def _middles() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return where values are taken, in radians."""
    h, d, phi = ((np.arange(count) + 0.5) / count for count in BINS)
    return h**2 * _RIGHT_ANGLE, d * _RIGHT_ANGLE, phi * np.pi
