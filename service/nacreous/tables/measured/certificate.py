"""What a measured file's numbers are worth: what a reader makes of them, against the bsdf itself.

Readers interpolate along paths of their own, so that no cell of directions has a middle to look at. Pairs are
drawn instead, always the same: along the lobe, as a renderer samples it, and all over the hemisphere.
"""

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.figures import Figures
from nacreous.tables.measured.drawn_pairs import all_over, along_the_lobe, f_cos
from nacreous.tables.measured.surface import Shades

__all__ = [
    "EXACT",
    "MbsdfCertificate",
    "MeasuredCertificate",
    "MuellerCertificate",
    "certify",
    "certify_nodes",
    "certify_transmission",
    "shortfall",
]

FloatArray = NDArray[np.float64]

_LOBE_SEED, _WIDE_SEED = 2, 1
NOTICED_MEDIAN, NOTICED_ENERGY = 0.05, 0.01
"""Errors of f along the lobe, and of all the light there, that are seen in a picture."""
EXACT = 1e-3
"""Relative error up to which M00 of a file of Mueller matrices is f, at a node, by its median, and in all."""
_DARK = 1e-6
"""Part of the largest f cos_o below which nothing is seen, and nothing compared."""


@dataclass(frozen=True)
class MeasuredCertificate(Figures):
    """Measured errors of a file, as a reader of its format evaluates it.

    Parameters
    ----------
    held_out_points : int
        Values that were compared, for light from up to 75 degrees and in the middle between wavelengths.
    grid_error_median, grid_error_p90 : float
        Relative error of f along the lobe at the wavelengths of the file, by quantile: what its grid of
        directions costs.
    lobe_error_median, lobe_error_p90, lobe_error_p99 : float
        Relative error of f along the lobe, by quantile.
    lobe_error_mean : float
        Mean of the relative error of f along the lobe, with its sign, over all wavelengths; faint directions
        count as much as bright ones.
    lobe_energy_error : float
        Relative difference of the light that goes there in all, with its sign.
    wide_error_median, wide_error_p90 : float
        Relative error of f all over the hemisphere, where it is not dark.
    film_error : float
        Largest error of R and T between the nodes that facets take them from.
    energy_max : float
        Largest albedo E_r + E_t.
    nonfinite : int
        Values that are not finite.
    """

    held_out_points: int
    grid_error_median: float
    grid_error_p90: float
    lobe_error_median: float
    lobe_error_p90: float
    lobe_error_p99: float
    lobe_error_mean: float
    lobe_energy_error: float
    wide_error_median: float
    wide_error_p90: float
    film_error: float
    energy_max: float
    nonfinite: int


@dataclass(frozen=True)
class MbsdfCertificate(MeasuredCertificate):
    """The same of a file that has transmission, too.

    Parameters
    ----------
    transmission_error_mean : float
        Mean absolute error of f_t cos_o over the mean of f_t cos_o, for light that leaves in all directions.
    transmission_energy_error : float
        Relative difference of the transmitted light in all, with its sign.
    """

    transmission_error_mean: float
    transmission_energy_error: float


@dataclass(frozen=True)
class MuellerCertificate(MeasuredCertificate):
    """The same of a file whose nodes are moved a little, so that the light between them is right.

    Parameters
    ----------
    grid_energy_error : float
        Relative difference of the light along the lobe in all at the wavelengths of the file, with its sign.
    wide_grid_error_median, wide_grid_error_p90 : float
        Relative error of f all over the hemisphere at the wavelengths of the file, where it is not dark.
    node_error_max : float
        Largest relative difference of a node from f, of those above the horizon that are not dark.
    """

    grid_energy_error: float
    wide_grid_error_median: float
    wide_grid_error_p90: float
    node_error_max: float


def certify_nodes(
    reflected: MeasuredCertificate,
    solver: BsdfSolver,
    shades: Shades,
    evaluate: Callable[[Pairs], FloatArray],
    nodes: Pairs,
) -> MuellerCertificate:
    """Add what f cos_o, (P, C), is worth at `nodes` themselves, and at the wavelengths of the file."""
    exact = solver.exact()
    along = along_the_lobe(exact, shades, _LOBE_SEED)
    wide, at_nodes = (
        _compared(f_cos(shades, exact, at), evaluate(at)) for at in (all_over(_WIDE_SEED), nodes)
    )
    return MuellerCertificate(
        **asdict(reflected),
        grid_energy_error=_energy_error(f_cos(shades, exact, along), evaluate(along)),
        wide_grid_error_median=float(np.median(wide.relative)),
        wide_grid_error_p90=float(np.quantile(wide.relative, 0.9)),
        node_error_max=float(at_nodes.relative.max()),
    )


def _energy_error(truth: FloatArray, got: FloatArray) -> float:
    """Return the relative difference of integrals of f cos_o, (P, C), at pairs drawn by its mean over C."""
    density = truth.mean(axis=1)
    lit = density > 0
    if not lit.any():  # a black surface
        return 0.0
    each = 1 / density[lit, None]
    return float((got[lit] * each).sum() / (truth[lit] * each).sum() - 1)


def certify_transmission(
    reflected: MeasuredCertificate,
    truth: Callable[[Pairs], FloatArray],
    evaluate: Callable[[Pairs], FloatArray],
) -> MbsdfCertificate:
    """Add what `evaluate` makes of f_t cos_o, (P, C), against the `truth`, 0 and 0 where there is none."""
    above = all_over(_WIDE_SEED)
    pairs = Pairs(above.roughness, above.incoming, above.outgoing * np.array([1.0, 1.0, -1.0]))
    f, got = truth(pairs), evaluate(pairs)
    total = max(float(f.sum()), np.finfo(float).tiny)
    return MbsdfCertificate(
        **asdict(reflected),
        transmission_error_mean=float(np.abs(got - f).sum() / total),
        transmission_energy_error=float((got - f).sum() / total),
    )


def shortfall(certificate: Mapping[str, Any]) -> str:
    """Say what a reader will notice of a file's errors; empty where they are small, or of other tables."""
    if "node_error_max" in certificate:
        return _missed(certificate)
    median, energy = certificate.get("lobe_error_median", 0.0), certificate.get("lobe_energy_error", 0.0)
    if median <= NOTICED_MEDIAN and abs(energy) <= NOTICED_ENERGY:
        return ""
    return (
        f"the grid that readers fix is too coarse for this film or its lobe: f is off by {median:.1%} "
        f"(median along the lobe), all the light there by {energy:+.1%}; a fresnel texture with the "
        "renderer's own facets follows it"
    )


def _missed(certificate: Mapping[str, Any]) -> str:
    """Say what a file of Mueller matrices misses of its 1e-3, wavelengths between its five apart."""
    node, median = certificate["node_error_max"], certificate["grid_error_median"]
    energy = certificate["grid_energy_error"]
    if max(node, median, abs(energy)) <= EXACT:
        return ""
    return (
        "the largest grid is too coarse for this film or its lobe: at the file's wavelengths f is off by "
        f"{median:.2%} (median along the lobe), all the light there by {energy:+.2%}, and nodes by up to "
        f"{node:.2%}"
    )


def certify(
    solver: BsdfSolver, shades: Shades, evaluate: Callable[[Pairs], FloatArray], energy_max: float
) -> MeasuredCertificate:
    """Compare f cos_o as `evaluate` reads it, (P, C), with the bsdf in double precision."""
    exact, held_out = solver.exact(), shades.held_out()
    along, over = along_the_lobe(exact, shades, _LOBE_SEED), all_over(_WIDE_SEED)
    read = evaluate(along)
    grid = _compared(f_cos(shades, exact, along), read)
    lobe = _compared(f_cos(held_out, exact, along), shades.between(read))
    wide = _compared(f_cos(held_out, exact, over), shades.between(evaluate(over)))
    errors = np.concatenate([lobe.relative, wide.relative])
    return MeasuredCertificate(
        held_out_points=int(errors.size),
        grid_error_median=float(np.median(grid.relative)),
        grid_error_p90=float(np.quantile(grid.relative, 0.9)),
        lobe_error_median=float(np.median(lobe.relative)),
        lobe_error_p90=float(np.quantile(lobe.relative, 0.9)),
        lobe_error_p99=float(np.quantile(lobe.relative, 0.99)),
        lobe_error_mean=(grid.mean + 2 * lobe.mean) / 3,  # Simpson's rule from wavelength to wavelength
        lobe_energy_error=lobe.energy,
        wide_error_median=float(np.median(wide.relative)),
        wide_error_p90=float(np.quantile(wide.relative, 0.9)),
        film_error=solver.albedo.film.error,
        energy_max=energy_max,
        nonfinite=int(np.count_nonzero(~np.isfinite(errors))),
    )


@dataclass(frozen=True, eq=False)
class _Compared:
    """Relative errors, flat, their mean with its sign, and the relative difference of the sums."""

    relative: FloatArray
    mean: float
    energy: float


def _compared(truth: FloatArray, got: FloatArray) -> _Compared:
    seen = truth > _DARK * truth.max()
    if not seen.any():  # a black surface
        return _Compared(np.zeros(1), 0.0, 0.0)
    error = got[seen] / truth[seen] - 1
    return _Compared(np.abs(error), float(error.mean()), float(got[seen].sum() / truth[seen].sum() - 1))
