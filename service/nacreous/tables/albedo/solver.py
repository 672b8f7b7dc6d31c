"""The albedo of a rough surface: geometry once, film once, then a product.

E = integral of f cos_o d omega_o is, for the reflected and the transmitted light,
    E(roughness, angle, wavelength) = sum over the nodes of W(roughness, angle; node) F(node, wavelength),
W the geometry of the facets (kernels/albedo_weights.cl) and F the film at them: ten times the wavelengths
cost no more geometry. Light that the substrate disperses is refracted at three ratios of indices, between
which W is interpolated.

Multiple scattering among the facets, where it is asked for, is that of Kulla and Conty, "Revisiting
physically based shading at Imageworks", SIGGRAPH 2017, with the colour of Hill, "A multi-faceted exploration
(part 3)", 2018: what a mirror's facets would lose, 1 - E_w(mu), leaves after two or more reflections by the
film.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.albedo_weights import AlbedoProblem, albedo_weights
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import Microsurface, microsurface
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer, step_of
from nacreous.optics.facets import FacetRule
from nacreous.optics.surface import Surface, alphas_at
from nacreous.tables.colour import Colouring
from nacreous.tables.computed import asked_precision, grid_of
from nacreous.tables.facet_film import FacetFilm, cosine_weighted_nodes, facet_film
from nacreous.tables.film import Grid
from nacreous.tables.solver import probe
from nacreous.tables.spec import Spec, roughness_values, surface_of

__all__ = ["AlbedoGeometry", "AlbedoSolver", "albedo_solver", "check_albedo", "scattered_colour"]

FloatArray = NDArray[np.float64]

ENERGY_TOLERANCE = 1e-3
"""What an albedo may exceed 1 by before the surface's weights are refused."""

_RULES = {False: FacetRule(128, 32, 1), True: FacetRule(64, 32, 16)}
"""For isotropic and anisotropic surfaces: 4,096 facets for each azimuth of the light."""
_MOST_IN_SINGLE = 8192
"""Facets whose sum in single precision is exact to 1e-5."""
SETTLED = 2e-4
"""Change of an albedo on doubling the rule at which it is fine enough."""
_MOST_DOUBLINGS = {False: 2, True: 1}
MEAN_ANGLES = 24
"""Angles that a cosine-weighted mean takes."""
_SAME_INDEX = 1e-6
"""Spread of the ratio of indices that needs no interpolation."""
_PROBE_ANGLES = np.linspace(0.0, 1.0, 17)


@dataclass(frozen=True, eq=False)
class AlbedoGeometry:
    """How much light a surface takes at which node, at some roughnesses and angles.

    Parameters
    ----------
    reflection : float array, shape (R, A, K)
    transmission : float array, shape (J, R, A, K)
        At each of `ratios`.
    ratios : float array, shape (J,)
        Index of the incident medium over that of the substrate: one, or three equally spaced; none where
        nothing is transmitted.
    """

    reflection: FloatArray
    transmission: FloatArray
    ratios: FloatArray

    @property
    def mirror(self) -> FloatArray:
        """Albedo E_w of facets that reflect everything, shape (R, A)."""
        return np.asarray(self.reflection.sum(axis=-1), np.float64)

    def mean(self, weights: FloatArray) -> "AlbedoGeometry":
        """Return the geometry averaged over its angles, A = 1, with weights (A,)."""
        reflection, transmission = (
            np.einsum("...ak,a->...k", side, weights)[..., None, :]
            for side in (self.reflection, self.transmission)
        )
        return AlbedoGeometry(reflection, transmission, self.ratios)


@dataclass(frozen=True, eq=False)
class AlbedoSolver:
    """A rough surface with a film on a device.

    Parameters
    ----------
    device : Device
    surface : Surface
    film : FacetFilm
    rule : FacetRule
    precision : Precision
        Of the geometry, where its sums are short enough for single.
    """

    device: Device
    surface: Surface
    film: FacetFilm
    rule: FacetRule
    precision: Precision

    @property
    def sides(self) -> tuple[Side, ...]:
        """Reflection, and transmission where the substrate and the facets let light through."""
        return self.film.solver.sides if self.surface.distribution != "phong" else (Side.REFLECTION,)

    def exact(self) -> "AlbedoSolver":
        """Return the solver that errors are measured against: in double precision, with a doubled rule."""
        return replace(self, film=self.film.finer(), rule=self.rule.doubled(), precision=Precision.DOUBLE)

    def microsurface(self, roughness: FloatArray) -> Microsurface:
        """Facets at the places (R,) of a roughness axis."""
        alphas = alphas_at(self.surface, roughness)
        return microsurface(self.device, self.surface.distribution, self.surface.masking, alphas)

    def geometry(
        self,
        roughness: FloatArray,
        cos_theta: FloatArray,
        wavelength_nm: FloatArray,
        observer: Observer | None = None,
    ) -> AlbedoGeometry:
        """Integrate over the facets at every roughness (R,) and cosine (A,); the film plays no part in it.

        What is transmitted is left out where there are no wavelengths to refract.
        """
        facets = self.microsurface(roughness)
        many = self.rule.facets(facets.alphas) > _MOST_IN_SINGLE
        precision = Precision.DOUBLE if many else self.precision
        ratios = self._ratios(wavelength_nm)
        reflected = AlbedoProblem(facets, Side.REFLECTION, cos_theta, self.film.nodes, self.rule)
        refracted = [replace(reflected, side=Side.TRANSMISSION, eta=float(eta)) for eta in ratios]
        problems = [reflected, *refracted]
        reflection, *transmission = (
            albedo_weights(self.device, problem, precision, observer=step_of(observer, at, len(problems)))
            for at, problem in enumerate(problems)
        )
        shape = (ratios.size, *reflection.shape)
        return AlbedoGeometry(reflection, np.array(transmission).reshape(shape), ratios)

    def mean_geometry(self, roughness: FloatArray, wavelength_nm: FloatArray) -> AlbedoGeometry:
        """Cosine-weighted mean over the hemisphere, A = 1."""
        mu, weights = cosine_weighted_nodes(MEAN_ANGLES)
        return self.geometry(roughness, mu, wavelength_nm).mean(weights)

    def mirror_mean(self, roughness: FloatArray) -> FloatArray:
        """Cosine-weighted mean of E_w, shape (R,); 1 where light is not followed past its first facet."""
        if self.surface.multiple_scattering == "none":
            return np.ones(roughness.size)
        return np.minimum(self.mean_geometry(roughness, np.zeros(0)).mirror[:, 0], 1.0)

    def spectra(
        self,
        geometry: AlbedoGeometry,
        mirror_mean: FloatArray,
        thickness_scale: FloatArray,
        wavelength_nm: FloatArray,
    ) -> dict[Side, FloatArray]:
        """E_r and E_t, shape (R, S, A, L); E_t is 0 where nothing is transmitted."""
        film = self.film.spectra(thickness_scale, wavelength_nm)
        reflected = _product(geometry.reflection, film[Side.REFLECTION])
        if self.surface.multiple_scattering == "kulla-conty":
            reflected = reflected + self._scattered(geometry, mirror_mean, thickness_scale, wavelength_nm)
        transmitted = np.zeros_like(reflected)
        for weights, share in zip(geometry.transmission, self._shares(geometry, wavelength_nm), strict=True):
            transmitted += _product(weights, film[Side.TRANSMISSION] * share)
        weight = self.surface.specular_weight
        return {
            Side.REFLECTION: weight * reflected + self.diffuse,
            Side.TRANSMISSION: weight * transmitted,
        }

    def colours(
        self,
        geometry: AlbedoGeometry,
        mirror_mean: FloatArray,
        thickness_scale: FloatArray,
        colouring: Colouring,
        side: Side,
    ) -> FloatArray:
        """Linear colour of E_r or E_t, shape (R, S, A, 3)."""
        nm, weights = colouring.quadrature_nm, colouring.weights
        if side is Side.TRANSMISSION:
            shares = self._shares(geometry, nm)
            parts = [
                _product(W, self.film.colours(thickness_scale, nm, weights * share, side))
                for W, share in zip(geometry.transmission, shares, strict=True)
            ]
            return np.asarray(self.surface.specular_weight * np.sum(parts, axis=0))
        colour = _product(geometry.reflection, self.film.colours(thickness_scale, nm, weights, side))
        if self.surface.multiple_scattering == "kulla-conty":
            colour = colour + self._scattered(geometry, mirror_mean, thickness_scale, nm) @ weights.T
        return np.asarray(self.surface.specular_weight * colour + self.diffuse * weights.sum(axis=1))

    @property
    def diffuse(self) -> float:
        """Albedo of the diffuse term, c_a times its reflectance."""
        return self.surface.diffuse_weight * self.surface.diffuse_reflectance

    def _ratios(self, wavelength_nm: FloatArray) -> FloatArray:
        if Side.TRANSMISSION not in self.sides or wavelength_nm.size == 0:
            return np.zeros(0)
        incident, substrate = self.film.indices(wavelength_nm)
        ratio = incident / substrate
        least, most = float(ratio.min()), float(ratio.max())
        return np.array([ratio[0]]) if most - least < _SAME_INDEX else np.linspace(least, most, 3)

    def _shares(self, geometry: AlbedoGeometry, wavelength_nm: FloatArray) -> FloatArray:
        """Return what each ratio counts at each wavelength, (J, L): Lagrange's parabola, of sum 1."""
        if geometry.ratios.size < 2:
            return np.ones((geometry.ratios.size, wavelength_nm.size))
        incident, substrate = self.film.indices(wavelength_nm)
        x = 2 * (incident / substrate - geometry.ratios[0]) / (geometry.ratios[2] - geometry.ratios[0]) - 1
        shares: FloatArray = np.stack([x * (x - 1) / 2, (1 - x) * (1 + x), x * (x + 1) / 2])
        return shares

    def _scattered(
        self,
        geometry: AlbedoGeometry,
        mirror_mean: FloatArray,
        thickness_scale: FloatArray,
        wavelength_nm: FloatArray,
    ) -> FloatArray:
        """Albedo of what is reflected more than once, (R, S, A, L): (1 - E_w) F_ms."""
        film = self.film.mean_reflectance(thickness_scale, wavelength_nm)  # (S, L)
        lost = 1 - geometry.mirror  # (R, A)
        return np.asarray(lost[:, None, :, None] * scattered_colour(film, mirror_mean)[:, :, None])


def scattered_colour(film: FloatArray, mirror: FloatArray) -> FloatArray:
    """F_ms = F^2 E / (1 - F (1 - E)), (R, S, L), of a film's mean F, (S, L), and a mirror's mean E, (R,).

    The light that facets catch again has been reflected once, and leaves them with chance E each time it is
    reflected once more (Hill 2018).
    """
    E = mirror[:, None, None]
    return film**2 * E / (1 - film * (1 - E))


def albedo_solver(device: Device, spec: Spec) -> AlbedoSolver:
    """Settle what the albedo of a spec needs: its film at the facets, and a rule for them.

    Raises
    ------
    SpecError
        A material cannot be used at a wavelength.
    """
    asked, grid, surface = asked_precision(spec), grid_of(spec), surface_of(spec)
    film = facet_film(device, spec.stack, grid, asked)
    if spec.table.transmission == "discard":
        film = film.opaque()
    solver = AlbedoSolver(device, surface, film, _RULES[surface.anisotropic], asked)
    return _settled(solver, roughness_values(spec), grid)


def _settled(solver: AlbedoSolver, roughness: FloatArray, grid: Grid) -> AlbedoSolver:
    """Double the rule until the albedo no longer changes: a thick film has fringes over the facets.

    It is tried at a few roughnesses of (R,), at the largest thickness scale and the shortest wavelength.
    """
    film = solver.film.spectra(grid.thickness_scale[-1:], grid.wavelength_nm[:1])[Side.REFLECTION]

    def albedo(solver: AlbedoSolver) -> FloatArray:
        geometry = solver.geometry(probe(roughness, 3), _PROBE_ANGLES[::4], np.zeros(0))
        return _product(geometry.reflection, film)

    before = albedo(solver)
    for _ in range(_MOST_DOUBLINGS[solver.surface.anisotropic]):
        finer = replace(solver, rule=solver.rule.doubled())
        after = albedo(finer)
        if np.abs(after - before).max() <= SETTLED:
            break
        solver, before = finer, after
    return solver


def check_albedo(solver: AlbedoSolver, roughness: FloatArray, grid: Grid) -> float:
    """Return the largest E_r + E_t, as far as a few samples of each axis can tell.

    Raises
    ------
    SpecError
        It exceeds 1: the surface would give more light than it gets.
    """
    roughness, nm = probe(roughness, 5), probe(grid.wavelength_nm, 32)
    geometry = solver.geometry(roughness, _PROBE_ANGLES, nm)
    sides = solver.spectra(geometry, solver.mirror_mean(roughness), probe(grid.thickness_scale, 3), nm)
    total = sides[Side.REFLECTION] + sides[Side.TRANSMISSION]
    most = float(total.max())
    if most > 1 + ENERGY_TOLERANCE:
        r, _, a, _ = np.unravel_index(int(total.argmax()), total.shape)
        raise SpecError(
            "surface",
            "weights whose albedo is at most 1",
            f"an albedo of {most:.3f} at cos_theta {_PROBE_ANGLES[a]:g} and roughness {roughness[r]:.3g}",
            "reduce specular_weight, diffuse_weight or diffuse_reflectance",
        )
    return most


def _product(weights: FloatArray, film: FloatArray) -> FloatArray:
    """Weights (R, A, K) times film (S, K, C): (R, S, A, C)."""
    return np.asarray(np.matmul(weights[:, None], film[None]), np.float64)
