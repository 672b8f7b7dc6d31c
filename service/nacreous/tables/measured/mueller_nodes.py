"""Where `measured_polarized` needs nodes: it is linear between them, and searches all three axes for them.

A chord over a step h is off by h^2 f'' / 12 on average. f'' / f is looked at where light goes, and along each
angle by itself:

- theta_h has the lobe, and needs most nodes, about its slope;
- theta_d has the film's fringes and 1 / (4 cos_i cos_o), and needs most of them towards grazing;
- phi_d matters little within a lobe, and much towards the horizon: where the half vector is far from the
  normal, only azimuths about a right angle are above it.

f of an isotropic surface is even in phi_d, and the same for both directions exchanged: its period is pi. The
reader takes phi_d from -pi to pi as it comes, so that the quarter has to be repeated four times.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import BsdfProblem, Pairs, bsdf_spectra
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.measured.drawn_pairs import all_over, along_the_lobe
from nacreous.tables.measured.half_difference import HalfDifference, half_difference_of, lower_cosine
from nacreous.tables.measured.surface import Shades

__all__ = ["Nodes", "Placing", "facets_at", "placing"]

FloatArray = NDArray[np.float64]

_FINE = 8192
"""Angles at which the density of nodes is known."""
_BINS = 16
"""Ranges of an angle over which its second derivatives are summed."""
_SEEDS = (11, 12)
"""Pairs that the certificate does not look at."""
_STEP = 5e-3
"""Step in radians of second derivatives: far below a fringe, far above what double precision rounds."""
_LEAST_COSINE = 0.03
"""Cosine of the lower direction from which on both steps are above the horizon."""
_EVEN = 0.25
"""Share of the nodes that are even over all angles: light is grazing, too."""
_EVEN_LOBE = 0.15
"""The same of the first guess of theta_h, which follows the lobe alone."""
_FAINT = 3e-4
"""Part of the lobe's peak below which nodes follow it less and less."""
_DULL = 0.1
"""Part of the mean over wavelengths below which an error at one of them counts less and less."""
_RATIOS = (0.5, 4.0)
"""Fewest and most nodes of theta_h for one of theta_d."""
_FEWEST_NODES = 4
"""Cosines of a film that a cubic needs."""


@dataclass(frozen=True, eq=False)
class Nodes:
    """Nodes in radians, as single precision has them.

    Parameters
    ----------
    quarter : float array, shape (Q,)
        phi_d from 0 to a right angle.
    theta_d, theta_h : float arrays, shape (D,), (H,)
        From 0 to a right angle.
    """

    quarter: FloatArray
    theta_d: FloatArray
    theta_h: FloatArray

    @property
    def phi_d(self) -> FloatArray:
        """All azimuths from -pi to pi, (4 Q - 3,)."""
        half = np.concatenate([self.quarter, np.pi - self.quarter[-2::-1]])
        return _single(np.concatenate([-half[:0:-1], half]))

    @property
    def folded(self) -> NDArray[np.int_]:
        """Place in the quarter of each azimuth, (4 Q - 3,)."""
        last = self.quarter.size - 1
        from_fold = np.abs(np.arange(-2 * last, 2 * last + 1))
        return np.asarray(np.minimum(from_fold, 2 * last - from_fold))

    @property
    def count(self) -> int:
        """Number of nodes of all three axes together."""
        return self.folded.size * self.theta_d.size * self.theta_h.size


@dataclass(frozen=True, eq=False)
class Placing:
    """Where the nodes of a surface belong, however many there are.

    Parameters
    ----------
    phi_d, theta_d, theta_h : float arrays, shape (F,)
        Angles from 0 to a right angle, between which there are equally many nodes.
    ratio : float
        Nodes of theta_h for one of theta_d, so that both cost the lobe the same.
    """

    phi_d: FloatArray
    theta_d: FloatArray
    theta_h: FloatArray
    ratio: float

    def nodes(self, azimuths: int, polar: int) -> Nodes:
        """Return so many azimuths, 4 k + 1, and about so many pairs of theta_d and theta_h."""
        across = round(np.sqrt(polar / self.ratio))
        counts = ((azimuths + 3) // 4, across, round(polar / across))
        return Nodes(*map(_picked, (self.phi_d, self.theta_d, self.theta_h), counts))


def placing(solver: BsdfSolver, shades: Shades) -> Placing:
    """Find where the nodes belong from second derivatives along the lobe and all over the hemisphere."""
    exact = solver.exact()
    lobe = _Bent.at(exact, shades, along_the_lobe(exact, shades, _SEEDS[0]))
    wide = _Bent.at(exact, shades, all_over(_SEEDS[1]))
    even = np.linspace(0, np.pi / 2, _FINE)
    phi_d, theta_d, theta_h = (
        _spread((lobe, wide), place, first) for place, first in enumerate((even, even, _lobe_spread(solver)))
    )
    costs = [lobe.cost(1, theta_d), lobe.cost(2, theta_h)]
    ratio = np.sqrt(costs[1] / costs[0]) if all(costs) else 1.0
    return Placing(phi_d, theta_d, theta_h, float(np.clip(ratio, *_RATIOS)))


def facets_at(solver: BsdfSolver, at: HalfDifference) -> FloatArray:
    """Return f of a surface whose facets reflect all light, without what is diffuse, (P,).

    Below the horizon f is as it is at the horizon.
    """
    film = np.ones((_FEWEST_NODES, 1))
    mirror = BsdfProblem(solver.facets, Side.REFLECTION, film, np.ones((2, 1)), at.above().pairs())
    f = bsdf_spectra(solver.albedo.device, mirror, Precision.DOUBLE)
    return np.asarray(f[:, 0] * solver.albedo.surface.specular_weight)


@dataclass(frozen=True, eq=False)
class _Bent:
    """Folded angles (3, P) phi_d, theta_d, theta_h of pairs, and |f'' / f| along each of them, (3, P)."""

    angles: FloatArray
    bends: FloatArray

    @classmethod
    def at(cls, solver: BsdfSolver, shades: Shades, pairs: Pairs) -> "_Bent":
        at = half_difference_of(pairs)
        seen = lower_cosine(at.theta_h, at.theta_d, np.cos(at.phi_d)) > _LEAST_COSINE
        angles = np.stack([at.phi_d, at.theta_d, at.theta_h])[:, seen]
        f = _f_at(solver, shades, angles)
        faint = max(_FAINT * f.max(), np.finfo(float).tiny)
        scale = f + _DULL * f.mean(axis=1, keepdims=True) + faint
        bends = []
        for step in _STEP * np.eye(3)[..., None]:
            sides = _f_at(solver, shades, angles + step) + _f_at(solver, shades, angles - step)
            bends.append((np.abs(sides - 2 * f) / scale).mean(axis=1) / _STEP**2)
        angles[0] = np.arccos(np.abs(np.cos(angles[0])))
        return cls(angles, np.stack(bends))

    def cost(self, place: int, spread: FloatArray) -> float:
        """Return the mean error along an axis, times its nodes squared."""
        steps = np.diff(spread) * spread.size
        step = np.interp(self.angles[place], (spread[1:] + spread[:-1]) / 2, steps)
        return float((self.bends[place] * step**2).mean() / 12)


def _f_at(solver: BsdfSolver, shades: Shades, angles: FloatArray) -> FloatArray:
    phi_d, theta_d, theta_h = angles
    return shades.reflected(solver, HalfDifference(theta_h, theta_d, phi_d).pairs())


def _spread(bent: Sequence[_Bent], place: int, first: FloatArray) -> FloatArray:
    """Return angles with equally many nodes between them, from a `first` guess of them.

    The mean error over all pairs is least with nodes as dense as the third root of the bend times the density
    of pairs, by whatever the angle is counted: here by the share of the nodes that the guess has below it.
    """
    shares, edges = np.linspace(0, 1, _FINE), np.linspace(0, 1, _BINS + 1)
    bend = np.zeros(_BINS)
    for pairs in bent:
        at = np.interp(pairs.angles[place], first, shares)
        step = np.interp(at, shares, np.gradient(first, shares))
        bend += np.histogram(at, edges, weights=pairs.bends[place] * step**2)[0]
    smooth = np.convolve(np.pad(np.cbrt(bend), 1, mode="edge"), [0.25, 0.5, 0.25], "valid")
    density = np.interp(shares, (edges[1:] + edges[:-1]) / 2, smooth)
    return np.interp(_shared(shares, density, _EVEN), shares, first)


def _lobe_spread(solver: BsdfSolver) -> FloatArray:
    """Return theta_h with equally many nodes between them, by the lobe of light that comes straight back."""
    theta = np.linspace(0, 1, _FINE) ** 2 * (np.pi / 2)
    nothing = np.zeros_like(theta)
    lobe = facets_at(solver, HalfDifference(theta, nothing, nothing)) * np.cos(theta) ** 2
    bend = np.abs(np.gradient(np.gradient(lobe, theta), theta)) / (lobe + _FAINT * max(lobe.max(), 1))
    return _shared(theta, np.sqrt(bend), _EVEN_LOBE)


def _shared(theta: FloatArray, density: FloatArray, even: float) -> FloatArray:
    """Return angles with equally many nodes between them; `even` of them are so over all angles."""
    steps = (density[1:] + density[:-1]) / 2 * np.diff(theta)
    share = np.concatenate([[0], np.cumsum(steps)]) / max(steps.sum(), np.finfo(float).tiny)
    spread = (1 - even) * share + even * theta / theta[-1]
    return np.interp(np.linspace(0, spread[-1], _FINE), spread, theta)


def _picked(spread: FloatArray, count: int) -> FloatArray:
    """Return nodes at equal shares."""
    shares = np.linspace(0, 1, spread.size)
    return _single(np.interp(np.linspace(0, 1, count), shares, spread))


def _single(angle: FloatArray) -> FloatArray:
    """Return the angles that a file of single precision has."""
    return np.asarray(angle.astype(np.float32), np.float64)
