"""The albedo of rough silver by three programs: one integral over all outgoing directions a sample.

Equation 12 with GGX facets and separable Smith masking, without film, is what Mitsuba's `roughconductor` has.
Every program takes 4096 facets: Mitsuba and NumPy by an even sequence of the two numbers that sampling takes,
for every angle and, as their integrand holds the spectrum, for every wavelength; Nacreous integrates the
geometry once.
"""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bench.timing import Missing
from mitsuba_surface import conductor, variant_fault
from nacreous.opencl.device import open_device
from nacreous.opencl.film_colour import Side
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.albedo.solver import albedo_solver
from nacreous.tables.computed import grid_of
from nacreous.tables.spec import Spec, roughness_values
from reference_facets import Surface, dot, masking_shadowing
from reference_surface import Coating, monte_carlo_albedo, reflected, sample_facet

FloatArray = NDArray[np.float64]

SILVER = "main/Ag/Johnson"
LARGEST_ERROR = 5e-3
"""A program that is further from the reference computes something else and is not timed."""
REFERENCE_SAMPLES, REFERENCE_STEP = 2**18, 20
"""Directions, and one wavelength in so many."""
RUNS = 5
VARIANT = "llvm_ad_spectral"


@dataclass(frozen=True)
class AlbedoWork:
    """The table wanted: E_r over (R, A, L)."""

    roughness: FloatArray
    cos_theta: FloatArray
    wavelength_nm: FloatArray

    @property
    def samples(self) -> int:
        """R A L."""
        return self.roughness.size * self.cos_theta.size * self.wavelength_nm.size

    @property
    def silver(self) -> NDArray[np.complex128]:
        """Index of the metal, (L,)."""
        return refractive_index(NamedMaterial(name=SILVER), self.wavelength_nm)


AlbedoProgram = Callable[[AlbedoWork], FloatArray]


@dataclass(frozen=True)
class AlbedoMeasurement:
    """What one program did."""

    name: str
    seconds: float
    largest_error: float


def albedo_work() -> AlbedoWork:
    """16 roughnesses, 32 angles, 80 wavelengths."""
    return AlbedoWork(np.linspace(0.05, 0.8, 16), np.linspace(0.1, 1, 32), np.linspace(380.0, 775.0, 80))


def albedo_measurements() -> list[AlbedoMeasurement | Missing]:
    """Check every program, then time it; ours comes last."""
    work = albedo_work()
    places, expected = reference_samples(work)
    programs: dict[str, AlbedoProgram] = {
        "NumPy, float64": by_numpy,
        "Nacreous, OpenCL on PoCL, float32": ours,
    }
    fault = variant_fault(VARIANT)
    first: list[AlbedoMeasurement | Missing]
    if fault:
        first = [Missing(f"Mitsuba 3, {VARIANT}", fault)]
    else:
        first = [measure_albedo(f"Mitsuba 3, {VARIANT}", by_mitsuba, work, places, expected)]
    return first + [measure_albedo(name, run, work, places, expected) for name, run in programs.items()]


def measure_albedo(
    name: str, program: AlbedoProgram, work: AlbedoWork, places: NDArray[np.int_], expected: FloatArray
) -> AlbedoMeasurement:
    """Check a program against the reference at the places (N, 2), then take the median of its times.

    Raises
    ------
    AssertionError
        Where the results disagree with the reference.
    """
    r, a = places.T
    error = float(np.abs(program(work)[r, a, ::REFERENCE_STEP] - expected).max())
    if not error <= LARGEST_ERROR:
        raise AssertionError(f"{name} is {error:.1e} off the reference, more than {LARGEST_ERROR:.0e}")
    return AlbedoMeasurement(name, statistics.median(_seconds(program, work) for _ in range(RUNS)), error)


def _seconds(program: AlbedoProgram, work: AlbedoWork) -> float:
    start = time.perf_counter()
    program(work)
    return time.perf_counter() - start


def reference_samples(work: AlbedoWork) -> tuple[NDArray[np.int_], FloatArray]:
    """Brute force at the corners of the table and its middle: places (N, 2), albedos (N, L / step)."""
    last_r, last_a = work.roughness.size - 1, work.cos_theta.size - 1
    places = np.array([(0, 0), (0, last_a), (last_r, 0), (last_r, last_a), (last_r // 2, last_a // 2)])
    nm, index = work.wavelength_nm[::REFERENCE_STEP], work.silver[::REFERENCE_STEP]
    coating = Coating(np.stack([np.ones_like(index), index]), np.zeros(0), nm)
    albedos = []
    for r, a in places:
        alpha = float(work.roughness[r])
        surface = Surface("ggx", alpha, alpha, "smith-separable")
        mu = float(work.cos_theta[a])
        albedos.append(monte_carlo_albedo(surface, coating, mu, REFERENCE_SAMPLES, seed=1).E_r)
    return places, np.array(albedos)


def ours(work: AlbedoWork) -> FloatArray:
    """Nacreous in single precision, from a spec to an array."""
    spec = albedo_spec(work)
    grid, roughness = grid_of(spec), roughness_values(spec)
    solver = albedo_solver(open_device(), spec)
    geometry = solver.geometry(roughness, grid.cos_theta, grid.wavelength_nm)
    mirror_mean = solver.mirror_mean(roughness)
    sides = solver.spectra(geometry, mirror_mean, grid.thickness_scale, grid.wavelength_nm)
    return sides[Side.REFLECTION][:, 0]


def albedo_spec(work: AlbedoWork) -> Spec:
    """Return the work as a spec."""
    return Spec.model_validate(
        {
            "stack": {
                "incident": "vacuum",
                "substrate": SILVER,
                "layers": [{"material": {"n": 1.5}, "thickness_nm": 0.0}],
            },
            "surface": {"distribution": "ggx", "masking": "smith-separable"},
            "table": {
                "quantity": "albedo",
                "roughness": work.roughness.tolist(),
                "cos_theta": work.cos_theta.tolist(),
                "wavelength_nm": work.wavelength_nm.tolist(),
            },
        }
    )


def even_pairs() -> FloatArray:
    """Two numbers a direction, (2, 4096): an additive recurrence, whose steps solve x^3 = x + 1.

    A square grid of as many points errs ten times more: its columns fall on the lobe's edge together.
    """
    steps = 1.324717957244746 ** -np.arange(1.0, 3)[:, None]
    return (0.5 + steps * np.arange(4096)) % 1


def by_numpy(work: AlbedoWork) -> FloatArray:
    """Integrate at one roughness and angle after the other, for all wavelengths together."""
    return np.array(
        [[_numpy_albedo(alpha, mu, work.silver) for mu in work.cos_theta] for alpha in work.roughness]
    )


def _numpy_albedo(alpha: float, mu: float, index: NDArray[np.complex128]) -> FloatArray:
    surface = Surface("ggx", alpha, alpha, "smith-separable")
    h = sample_facet(surface, even_pairs())
    i = np.array([np.sqrt(1 - mu**2), 0, mu])
    o = reflected(i, h)
    cos_d, upper = dot(i, h), o[:, 2] > 0
    h, o, cos_d = h[upper], o[upper], cos_d[upper]
    weight = masking_shadowing(surface, i, o, h) * cos_d / (mu * h[:, 2])
    return weight @ _fresnel(index, cos_d[:, None]) / upper.size


def _fresnel(index: NDArray[np.complex128], cos: FloatArray) -> FloatArray:
    """Unpolarised reflectance of a metal in vacuum: Born & Wolf, section 1.5.2."""
    inside = np.sqrt(index**2 - (1 - cos**2))
    s = (cos - inside) / (cos + inside)
    p = (index**2 * cos - inside) / (index**2 * cos + inside)
    return (np.abs(s) ** 2 + np.abs(p) ** 2) / 2


def by_mitsuba(work: AlbedoWork) -> FloatArray:
    """Mitsuba's own sampling of what it sees, all angles and directions at once, four wavelengths each."""
    import mitsuba

    mitsuba.set_variant(VARIANT)
    blocks = work.wavelength_nm.reshape(-1, 4)
    return np.array([_mitsuba_albedos(alpha, work, blocks) for alpha in work.roughness])


def _mitsuba_albedos(alpha: float, work: AlbedoWork, blocks: FloatArray) -> FloatArray:
    """E_r at one roughness, (A, L)."""
    import drjit
    import mitsuba

    bsdf = conductor(alpha, alpha, work.silver, work.wavelength_nm)
    u, v = (np.tile(n, work.cos_theta.size).astype(np.float32) for n in even_pairs())
    mu = np.repeat(work.cos_theta, u.size // work.cos_theta.size)
    interaction = drjit.zeros(mitsuba.SurfaceInteraction3f, u.size)
    interaction.wi = mitsuba.Vector3f(np.stack([np.sqrt(1 - mu**2), 0 * mu, mu]).astype(np.float32))
    columns = []
    for wavelengths in blocks:
        interaction.wavelengths = mitsuba.UnpolarizedSpectrum(*wavelengths.tolist())
        _, weight = bsdf.sample(mitsuba.BSDFContext(), interaction, 0.5, mitsuba.Point2f(u, v))
        columns.append(np.array(weight).reshape(4, work.cos_theta.size, -1).mean(axis=-1).T)
    return np.concatenate(columns, axis=1)
