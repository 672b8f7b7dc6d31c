"""Pairs of directions to look at, drawn by a seed: along a lobe, as renderers sample it, and all over."""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.measured.rgl_grid import unit_vectors
from nacreous.tables.measured.surface import Shades

__all__ = ["all_over", "along_the_lobe", "f_cos"]

FloatArray = NDArray[np.float64]

_PAIRS, _CANDIDATES = 2048, 8
"""Pairs of each kind, and how many are drawn for one that is kept."""
_STEEPEST = np.radians(75.0)
"""Angle of incidence up to which is drawn."""


def f_cos(shades: Shades, solver: BsdfSolver, pairs: Pairs) -> FloatArray:
    """Return f cos_o at pairs (P,): (P, C)."""
    return np.asarray(shades.reflected(solver, pairs) * pairs.outgoing[:, 2:])


def all_over(seed: int) -> Pairs:
    """Outgoing light of a diffuse surface."""
    random = np.random.default_rng(seed)
    incoming = _incoming(random, _PAIRS)
    cosine = np.sqrt(random.random(_PAIRS))
    outgoing = unit_vectors(np.arccos(cosine), random.uniform(-np.pi, np.pi, _PAIRS))
    return Pairs(np.zeros(_PAIRS, np.int32), incoming, outgoing)


def along_the_lobe(solver: BsdfSolver, shades: Shades, seed: int) -> Pairs:
    """Outgoing light in proportion to f cos_o: of GGX's reflections some are kept, by what they count."""
    random = np.random.default_rng(seed)
    count = _CANDIDATES * _PAIRS
    incoming = _incoming(random, count)
    u, turn = random.random(count), random.uniform(-np.pi, np.pi, count)
    alpha_x, alpha_y = solver.facets.alphas[0]
    slope = np.sqrt(u / (1 - u))
    m = np.stack([alpha_x * slope * np.cos(turn), alpha_y * slope * np.sin(turn), np.ones(count)], axis=-1)
    m /= np.linalg.norm(m, axis=-1, keepdims=True)
    facing = np.sum(m * incoming, axis=-1)
    outgoing = 2 * facing[:, None] * m - incoming
    above = (facing > 0) & (outgoing[:, 2] > 1e-3)
    pairs = Pairs(np.zeros(int(above.sum()), np.int32), incoming[above], outgoing[above])
    x, y, z = m[above].T
    drawn = z / (np.pi * alpha_x * alpha_y * ((x / alpha_x) ** 2 + (y / alpha_y) ** 2 + z**2) ** 2)
    weight = f_cos(shades, solver, pairs).mean(axis=-1).clip(min=0) * 4 * facing[above] / drawn
    if not weight.any():  # a black surface
        weight = np.ones_like(weight)
    kept = random.choice(weight.size, _PAIRS, p=weight / weight.sum())
    return Pairs(pairs.roughness[kept], pairs.incoming[kept], pairs.outgoing[kept])


def _incoming(random: np.random.Generator, count: int) -> FloatArray:
    cosine = random.uniform(np.cos(_STEEPEST), 1, count)
    return unit_vectors(np.arccos(cosine), random.uniform(-np.pi, np.pi, count))
