"""f_r and f_t of a rough surface with a film at any directions: what tables and certificates are made with.

    f_r = diffuse_weight diffuse_reflectance / pi + specular_weight D G R(theta_d) / (4 cos_i cos_o)

(Wu and Zheng 2015, eq 12), f_t after Walter et al. 2007, eq 21, with the film's T. Both are per solid angle
and in terms of flux: f cos_o is the share of the light that goes to a direction, on either side.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import BsdfProblem, Pairs, bsdf_colours, bsdf_spectra
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import Microsurface
from nacreous.opencl.tiles import Observer
from nacreous.tables.albedo.solver import AlbedoSolver, albedo_solver, scattered_colour
from nacreous.tables.colour import Colouring
from nacreous.tables.spec import Spec, roughness_values

__all__ = ["BsdfSolver", "bsdf_solver"]

FloatArray = NDArray[np.float64]

SAME_INDEX = 1e-3
"""Difference of the indices of both media below which light passes straight on, all but unrefracted."""
_LEAST_LOSS = 1e-6
_MOST_COSINES = 512
"""Cosines at which a mirror's albedo is integrated; more are interpolated, which is within 1e-5."""


@dataclass(frozen=True, eq=False)
class BsdfSolver:
    """A rough surface with a film on a device.

    Parameters
    ----------
    albedo : AlbedoSolver
        The same surface's; it has the film, too.
    roughness : float array, shape (R,)
    facets : Microsurface
        At these roughnesses.
    """

    albedo: AlbedoSolver
    roughness: FloatArray
    facets: Microsurface

    def exact(self) -> "BsdfSolver":
        """Return the solver that errors are measured against: all in double precision."""
        return replace(self, albedo=self.albedo.exact())

    def sides(self, wavelength_nm: FloatArray) -> tuple[Side, ...]:
        """Reflection, and transmission where light is refracted.

        Between media of one index it passes straight on through every facet, in a single direction, which no
        table over directions holds; the albedo E_t has it.
        """
        incident, substrate = self.albedo.film.indices(wavelength_nm)
        straight = np.abs(incident - substrate).max() < SAME_INDEX
        return tuple(s for s in self.albedo.sides if s is Side.REFLECTION or not straight)

    def reflection(
        self, roughness: int, wi: FloatArray, wo: FloatArray, wavelength_nm: FloatArray
    ) -> NDArray[np.floating]:
        """f_r in 1 / sr at one place of the roughness axis, pairs (P, 3) and wavelengths (L,): (P, L)."""
        return self.spectra(_pairs(roughness, wi, wo), Side.REFLECTION, wavelength_nm)

    def transmission(
        self, roughness: int, wi: FloatArray, wo: FloatArray, wavelength_nm: FloatArray
    ) -> NDArray[np.floating]:
        """f_t in 1 / sr, as `reflection`; `wo` lie below the surface."""
        return self.spectra(_pairs(roughness, wi, wo), Side.TRANSMISSION, wavelength_nm)

    def spectra(
        self, pairs: Pairs, side: Side, wavelength_nm: FloatArray, observer: Observer | None = None
    ) -> NDArray[np.floating]:
        """f_r or f_t in 1 / sr, shape (P, L)."""
        solver = self.albedo
        film = solver.film.spectra(np.ones(1), wavelength_nm)[side][0]
        problem = self._problem(pairs, side, film, wavelength_nm)
        f = bsdf_spectra(solver.device, problem, solver.precision, observer=observer)
        f *= solver.surface.specular_weight
        if side is Side.REFLECTION:
            f += solver.diffuse / np.pi
            if solver.surface.multiple_scattering == "kulla-conty":
                f += self._scattered(pairs, wavelength_nm)
        return f

    def colours(
        self, pairs: Pairs, side: Side, colouring: Colouring, observer: Observer | None = None
    ) -> NDArray[np.floating]:
        """Linear colour of f_r or f_t in 1 / sr, shape (P, 3)."""
        solver, nm, weights = self.albedo, colouring.quadrature_nm, colouring.weights
        film = solver.film.spectra(np.ones(1), nm)[side][0]
        problem = self._problem(pairs, side, film, nm)
        colour = bsdf_colours(solver.device, problem, weights, solver.precision, observer=observer)
        colour *= solver.surface.specular_weight
        if side is Side.REFLECTION:
            colour += solver.diffuse / np.pi * weights.sum(axis=1)
            if solver.surface.multiple_scattering == "kulla-conty":
                colour += self._scattered(pairs, nm, weights)
        return colour

    def _problem(self, pairs: Pairs, side: Side, film: FloatArray, wavelength_nm: FloatArray) -> BsdfProblem:
        eta = self.albedo.film.indices(wavelength_nm)
        return BsdfProblem(self.facets, side, film, eta, pairs)

    def _scattered(
        self, pairs: Pairs, wavelength_nm: FloatArray, weights: FloatArray | None = None
    ) -> FloatArray:
        """Return what leaves after several reflections, (P, L) in 1 / sr, or its colour, (P, 3).

        (1 - E_w(i)) (1 - E_w(o)) F_ms / (pi (1 - mean E_w)), E_w the albedo of a perfect mirror's facets
        (Kulla and Conty 2017).
        """
        solver = self.albedo
        mirror_mean = solver.mirror_mean(self.roughness)  # (R,)
        film = solver.film.mean_reflectance(np.ones(1), wavelength_nm)
        colour = solver.surface.specular_weight * scattered_colour(film, mirror_mean)[:, 0]  # (R, L)
        if weights is not None:
            colour = colour @ weights.T
        lost = self._lost(pairs.roughness, pairs.incoming[:, 2]) * self._lost(
            pairs.roughness, pairs.outgoing[:, 2]
        )
        of_all = np.maximum(1 - mirror_mean, _LEAST_LOSS)[pairs.roughness]
        return (lost / (np.pi * of_all))[:, None] * colour[pairs.roughness]

    def _lost(self, roughness: NDArray[np.int32], cosine: FloatArray) -> FloatArray:
        """1 - E_w at each pair's roughness and cosine, (P,); of many cosines between those that are few."""
        distinct, place = np.unique(cosine, return_inverse=True)
        few = distinct if distinct.size <= _MOST_COSINES else np.linspace(0, 1, _MOST_COSINES) ** 2
        lost = np.maximum(1 - self.albedo.geometry(self.roughness, few, np.zeros(0)).mirror, 0)
        if few is not distinct:
            lost = np.stack([np.interp(np.sqrt(distinct), np.sqrt(few), row) for row in lost])
        return np.asarray(lost[roughness, place], np.float64)


def bsdf_solver(device: Device, spec: Spec) -> BsdfSolver:
    """Settle what the BSDF of a spec needs: its film at the facets, and their roughnesses.

    Raises
    ------
    SpecError
        A material cannot be used at a wavelength.
    """
    albedo, roughness = albedo_solver(device, spec), roughness_values(spec)
    return BsdfSolver(albedo, roughness, albedo.microsurface(roughness))


def _pairs(roughness: int, wi: FloatArray, wo: FloatArray) -> Pairs:
    return Pairs(np.full(len(wi), roughness, np.int32), wi, wo)
