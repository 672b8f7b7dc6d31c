"""The material of glTF that looks most like a film: KHR_materials_iridescence with fitted parameters.

CIEDE2000 at 0 to 75 degrees, in steps of 5, is minimised in the mean square, each angle weighted with its
cosine: so much of a surface's area is seen. The search begins with a grid of films of every index and
thickness, all at once, and goes on by least squares from the best of them and from the film as it is, so that
a fit is never worse than copying its numbers. The squares are those of differences in L*a*b* first, because
CIEDE2000 has no derivative where two colours are equal.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.colour import colour_system
from nacreous.optics.iridescence import Iridescence, iridescent_reflectance
from nacreous.optics.stack import Stack, all_layers, sample_stack
from nacreous.tables.fit.target import FITTED_DEG, STATED_DEG, FitTarget

__all__ = ["GltfFit", "fit_gltf", "naive_film"]

FloatArray = NDArray[np.float64]
Residuals = Callable[[FloatArray], FloatArray]

_IOR = (1.0, 3.0)
_THICKNESS_NM = (0.0, 1200.0)
_BASE_F0 = (0.0, 0.95)
"""Bounds: indices that engines offer, thicknesses beyond which no Gaussian sees a fringe, and any base."""
_GREYS = (0.0, 0.01, 0.04, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.92)
_GRID_STEPS = (21, 61)
"""Indices 0.1 apart, and thicknesses 20 nm apart: less than a sixth of a fringe."""
_STARTS, _POLISHED = 8, 2
_APART_NM, _APART_IOR = 40.0, 0.25
"""How far starts are apart: nearer ones end in the same minimum."""
_DIGITS = 4
"""Decimals of each parameter in a file, and of thicknesses in nm one less."""


@dataclass(frozen=True, eq=False)
class GltfFit:
    """A fitted material.

    Parameters
    ----------
    film : Iridescence
        The parameters, of one film.
    delta_e : dict of float to float
        CIEDE2000 against the film at each of `STATED_DEG`.
    delta_e_max, delta_e_mean : float
        Over all of `FITTED_DEG`.
    """

    film: Iridescence
    delta_e: dict[float, float]
    delta_e_max: float
    delta_e_mean: float


def fit_gltf(target: FitTarget, stack: Stack) -> GltfFit:
    """Fit the material to a target; `stack` gives one of the films that the search starts from."""
    delta_e, lab_difference = _residuals(target)
    naive = _vector(naive_film(stack, target.thickness_scale))
    near = [_refined(lab_difference, start) for start in (naive, *_starts(target))]
    best = sorted(near, key=lambda vector: _squares(delta_e(vector)))[:_POLISHED]
    ends = [naive, *best, *(_refined(delta_e, vector) for vector in best)]
    return _described(target, min(map(_rounded, ends), key=lambda vector: _squares(delta_e(vector))))


def _squares(residuals: FloatArray) -> float:
    return float((residuals**2).sum())


def naive_film(stack: Stack, thickness_scale: float = 1.0) -> Iridescence:
    """Return the parameters that a reader of the stack's numbers would write down.

    The layer of the longest optical path, its index at 550 nm, and the colour of the bare substrate in air.
    """
    layers = all_layers(stack)
    visible_nm = np.arange(400.0, 701.0, 5.0)
    index = sample_stack(stack, visible_nm).index  # (M + 2, L)
    middle = index[1:-1, visible_nm.size // 2].real
    thickest = int(np.argmax(middle * [layer.thickness_nm for layer in layers]))
    bare = np.abs((1 - index[-1]) / (1 + index[-1])) ** 2
    weights = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709").weights(visible_nm)
    return Iridescence(
        ior=np.array(middle[thickest]),
        thickness_nm=np.array(layers[thickest].thickness_nm * thickness_scale),
        base_f0=weights @ bare,
        factor=np.array(1.0),
    )


def _described(target: FitTarget, vector: FloatArray) -> GltfFit:
    stated, fitted = (_differences(target, angles)(vector) for angles in (STATED_DEG, FITTED_DEG))
    by_angle = dict(zip(STATED_DEG, stated.tolist(), strict=True))
    return GltfFit(_film(vector), by_angle, float(fitted.max()), float(fitted.mean()))


def _differences(target: FitTarget, angles_deg: tuple[float, ...]) -> Residuals:
    """Return CIEDE2000 at angles, (..., A), of vectors (..., 6)."""
    comparison, cosines = target.comparison(angles_deg), np.cos(np.radians(angles_deg))
    return lambda vector: comparison.delta_e(iridescent_reflectance(_film(vector), cosines))


# ---- the search --------------------------------------------------------------------------------------------
# A vector is ior, thickness in units of the least squares' step, F0 of red, green and blue, and the factor.

_UNIT_NM = 200.0
_BASE = slice(2, 5)
_LEAST = np.array([_IOR[0], _THICKNESS_NM[0] / _UNIT_NM, *[_BASE_F0[0]] * 3, 0.0])
_MOST = np.array([_IOR[1], _THICKNESS_NM[1] / _UNIT_NM, *[_BASE_F0[1]] * 3, 1.0])


def _film(vector: FloatArray) -> Iridescence:
    return Iridescence(vector[..., 0], vector[..., 1] * _UNIT_NM, vector[..., _BASE], vector[..., 5])


def _vector(film: Iridescence) -> FloatArray:
    vector = np.array([film.ior, film.thickness_nm / _UNIT_NM, *film.base_f0, film.factor])
    bounded: FloatArray = np.clip(vector, _LEAST, _MOST)
    return bounded


def _rounded(vector: FloatArray) -> FloatArray:
    """Return the parameters as a file has them."""
    film = _film(np.round(vector, _DIGITS))
    return _vector(replace(film, thickness_nm=np.round(film.thickness_nm, _DIGITS - 1)))


def _residuals(target: FitTarget) -> tuple[Residuals, Residuals]:
    """Return CIEDE2000 of vectors, and differences in L*a*b*, weighted."""
    comparison, cosines = target.comparison(FITTED_DEG), np.cos(np.radians(FITTED_DEG))
    weights = np.sqrt(cosines)

    def delta_e(vector: FloatArray) -> FloatArray:
        return weights * comparison.delta_e(iridescent_reflectance(_film(vector), cosines))

    def lab_difference(vector: FloatArray) -> FloatArray:
        shown = iridescent_reflectance(_film(vector), cosines)
        return (weights[:, None] * comparison.lab_difference(shown)).ravel()

    return delta_e, lab_difference


def _starts(target: FitTarget) -> list[FloatArray]:
    """Return the best films of a grid, none of them next to another."""
    comparison, cosines = target.comparison(FITTED_DEG), np.cos(np.radians(FITTED_DEG))
    grid = _coloured(_grid(), target.at(FITTED_DEG), cosines)  # (N, 6)
    delta_e = comparison.delta_e(iridescent_reflectance(_film(grid), cosines))
    ranked = grid[np.argsort(delta_e**2 @ cosines, kind="stable")]
    return list(islice(_apart(ranked), _STARTS))


def _grid() -> FloatArray:
    """Films of every index and thickness on every grey base: (N, greys, 6)."""
    ior, thickness = (
        np.linspace(*ends, steps) for ends, steps in zip((_IOR, _THICKNESS_NM), _GRID_STEPS, strict=True)
    )
    axes = np.meshgrid(ior, thickness / _UNIT_NM, _GREYS, indexing="ij")
    at_ior, at_thickness, grey = (axis.reshape(-1, len(_GREYS)) for axis in axes)
    return np.stack([at_ior, at_thickness, grey, grey, grey, np.ones_like(grey)], axis=-1)


def _coloured(grid: FloatArray, film: FloatArray, cos_theta: FloatArray) -> FloatArray:
    """Give each film the base, (N, 6), whose red, green and blue are the greys that suit these best.

    A channel of the colour follows from that of the base, but for the phase, so each is chosen on its own.
    """
    shown = iridescent_reflectance(_film(grid), cos_theta)  # (N, greys, A, 3)
    apart = (cos_theta[:, None] * (np.cbrt(shown) - np.cbrt(film)) ** 2).sum(axis=-2)  # (N, greys, 3)
    coloured = grid[:, 0].copy()
    coloured[:, _BASE] = np.array(_GREYS)[apart.argmin(axis=1)]
    return coloured


def _apart(ranked: FloatArray) -> Iterator[FloatArray]:
    """Yield the vectors that are not next to one that was yielded before."""
    kept: list[FloatArray] = []
    for vector in ranked:
        near = [
            abs(vector[0] - other[0]) < _APART_IOR and abs(vector[1] - other[1]) * _UNIT_NM < _APART_NM
            for other in kept
        ]
        if not any(near):
            kept.append(vector)
            yield vector


def _refined(residuals: Residuals, start: FloatArray) -> FloatArray:
    from scipy.optimize import least_squares  # type: ignore[import-untyped]

    inside = np.clip(start, _LEAST + 1e-3, _MOST - 1e-3)  # on a bound its first step would be none
    found = least_squares(residuals, inside, bounds=(_LEAST, _MOST), max_nfev=40, diff_step=1e-5)
    best: FloatArray = found.x
    return best
