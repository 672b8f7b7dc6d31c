"""Rough conductors and dielectrics of Mitsuba 3 at directions and wavelengths: the witness of our surfaces.

Mitsuba's `eval` is f times cos_o, in single precision; these functions take the cosine out again. Its GGX is
that of Walter et al. 2007 with the product of both maskings ("smith-separable"); the masking of its Beckmann
is a rational approximation and no witness. Its conductors take eta and k as positive
numbers, as ours do. A `roughdielectric` counts flux, as ours does, under `TransportMode.Importance`; under
`Radiance` it is divided by (eta_o / eta_i)^2.

The variant is chosen by the caller's `mitsuba.set_variant`: one with "spectral" in its name.
"""

import subprocess
import sys
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

VARIANTS = ("scalar_spectral", "llvm_ad_spectral")

Bsdf = Any
"""A BSDF plugin of Mitsuba, whose types depend on the variant."""

Mitsuba = Any
"""Any other value of Mitsuba, likewise."""

_PROBE = "import mitsuba as mi; mi.set_variant({!r}); print(mi.Float(1) + 1)"


@cache
def variant_fault(variant: str) -> str:
    """Say why a variant of Mitsuba does not run here; empty where it runs.

    It is tried in a process of its own: with LLVM 15 or 16 Dr.Jit ends the process instead of raising.
    """
    done = subprocess.run([sys.executable, "-c", _PROBE.format(variant)], capture_output=True, text=True)
    if done.returncode == 0:
        return ""
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    reason = lines[-1] if lines else f"the process ended with {done.returncode}"
    return f"Mitsuba's {variant} does not run ({reason}); LLVM 19 is Debian's package libllvm19"


def conductor(
    alpha_x: float,
    alpha_y: float,
    index: NDArray[np.complex128],
    wavelength_nm: NDArray[np.float64],
    distribution: str = "ggx",
) -> Bsdf:
    """Return a `roughconductor` of an index n + ik (L,) given at ascending wavelengths (L,)."""
    return _load(
        type="roughconductor",
        distribution=distribution,
        alpha_u=alpha_x,
        alpha_v=alpha_y,
        eta=_spectrum(index.real, wavelength_nm),
        k=_spectrum(index.imag, wavelength_nm),
    )


def dielectric(alpha: float, n_incident: float, n_substrate: float) -> Bsdf:
    """Return a `roughdielectric`, GGX, isotropic, of constant index."""
    return _load(
        type="roughdielectric", distribution="ggx", alpha=alpha, ext_ior=n_incident, int_ior=n_substrate
    )


def bsdf_values(
    bsdf: Bsdf, i: NDArray[np.float64], o: NDArray[np.float64], wavelength_nm: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Evaluate f, 1/sr, for directions i and o (P, 3) at the wavelengths (L,): (P, L).

    A wavelength at which the index was given is met exactly, any other by linear interpolation.
    """
    import mitsuba as mi

    width = 4  # wavelengths that Mitsuba carries along one path
    padded = np.pad(wavelength_nm, (0, -len(wavelength_nm) % width), mode="edge").reshape(-1, width)
    evaluate = _one_by_one if mi.variant().startswith("scalar") else _all_at_once
    values = [evaluate(bsdf, i, o, block) for block in padded]
    return np.concatenate(values, axis=1)[:, : len(wavelength_nm)] / np.abs(o[:, 2:])


def _one_by_one(
    bsdf: Bsdf, i: NDArray[np.float64], o: NDArray[np.float64], wavelengths: NDArray[np.float64]
) -> NDArray[np.float64]:
    import mitsuba as mi

    context = mi.BSDFContext(mi.TransportMode.Importance)
    interaction = mi.SurfaceInteraction3f()
    interaction.wavelengths = wavelengths.tolist()
    values = []
    for wi, wo in zip(i.tolist(), o.tolist(), strict=True):
        interaction.wi = wi
        values.append(np.array(bsdf.eval(context, interaction, wo), np.float64))
    return np.stack(values)


def _all_at_once(
    bsdf: Bsdf, i: NDArray[np.float64], o: NDArray[np.float64], wavelengths: NDArray[np.float64]
) -> NDArray[np.float64]:
    import drjit
    import mitsuba as mi

    context = mi.BSDFContext(mi.TransportMode.Importance)
    interaction = drjit.zeros(mi.SurfaceInteraction3f, len(i))
    interaction.wavelengths = mi.UnpolarizedSpectrum(*wavelengths.tolist())
    interaction.wi = mi.Vector3f(i.T.astype(np.float32))
    values = bsdf.eval(context, interaction, mi.Vector3f(o.T.astype(np.float32)))
    return np.array(values, np.float64).T


def spectral_values(
    bsdf: Bsdf, i: NDArray[np.float64], o: NDArray[np.float64], wavelength_nm: NDArray[np.float64] | None
) -> NDArray[np.float64]:
    """Evaluate f cos_o for directions i and o (P, 3) at four wavelengths, or in RGB without any: (P, C)."""
    import mitsuba as mi

    if mi.variant().startswith("scalar"):
        assert wavelength_nm is not None
        return _one_by_one(bsdf, i, o, wavelength_nm)
    return np.array(bsdf.eval(_context(), _interaction(i, wavelength_nm), _vectors(o)), np.float64).T


def mueller_values(
    bsdf: Bsdf, i: NDArray[np.float64], o: NDArray[np.float64], wavelength_nm: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Evaluate Mueller matrices times f cos_o at four wavelengths, in a polarised variant: (P, 4, 4, 4)."""
    import mitsuba as mi

    if mi.variant().startswith("scalar"):
        interaction = mi.SurfaceInteraction3f()
        interaction.wavelengths = wavelength_nm.tolist()
        values = []
        for wi, wo in zip(i.tolist(), o.tolist(), strict=True):
            interaction.wi = wi
            values.append(np.array(bsdf.eval(_context(), interaction, wo), np.float64))
        return np.stack(values)
    values = bsdf.eval(_context(), _interaction(i, wavelength_nm), _vectors(o))
    return np.moveaxis(np.array(values, np.float64), -1, 0)


def sampled(
    bsdf: Bsdf, i: NDArray[np.float64], wavelength_nm: NDArray[np.float64] | None, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Sample the material: outgoing directions (P, 3), of length 1, and weights f cos_o / density (P, C)."""
    import mitsuba as mi

    u = np.random.default_rng(seed).random((2, len(i))).astype(np.float32)
    if mi.variant().startswith("scalar"):
        assert wavelength_nm is not None
        return _sampled_one_by_one(bsdf, i, wavelength_nm, u)
    sample, weight = bsdf.sample(_context(), _interaction(i, wavelength_nm), 0.5, mi.Point2f(u))
    o = np.array(sample.wo, np.float64).T
    return o / np.linalg.norm(o, axis=-1, keepdims=True), np.array(weight, np.float64).T


def _sampled_one_by_one(
    bsdf: Bsdf, i: NDArray[np.float64], wavelength_nm: NDArray[np.float64], u: NDArray[np.float32]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    import mitsuba as mi

    interaction = mi.SurfaceInteraction3f()
    interaction.wavelengths = wavelength_nm.tolist()
    directions, weights = [], []
    for wi, point in zip(i.tolist(), u.T.tolist(), strict=True):
        interaction.wi = wi
        sample, weight = bsdf.sample(_context(), interaction, 0.5, point)
        directions.append(np.array(sample.wo, np.float64))
        weights.append(np.array(weight, np.float64))
    o = np.stack(directions)
    return o / np.linalg.norm(o, axis=-1, keepdims=True), np.stack(weights)


def _context() -> Mitsuba:
    import mitsuba as mi

    return mi.BSDFContext()


def _interaction(i: NDArray[np.float64], wavelength_nm: NDArray[np.float64] | None) -> Mitsuba:
    import drjit
    import mitsuba as mi

    interaction = drjit.zeros(mi.SurfaceInteraction3f, len(i))
    if wavelength_nm is not None:
        interaction.wavelengths = mi.UnpolarizedSpectrum(*wavelength_nm.tolist())
    interaction.wi = _vectors(i)
    return interaction


def _vectors(directions: NDArray[np.float64]) -> Mitsuba:
    import mitsuba as mi

    return mi.Vector3f(directions.T.astype(np.float32))


def _load(**plugin: object) -> Bsdf:
    import mitsuba as mi

    return mi.load_dict(plugin)


def _spectrum(values: NDArray[np.float64], wavelength_nm: NDArray[np.float64]) -> dict[str, str]:
    """Return a spectrum that is linear between its samples."""
    return {
        "type": "irregular",
        "wavelengths": ", ".join(map(repr, wavelength_nm.tolist())),
        "values": ", ".join(map(repr, values.tolist())),
    }
