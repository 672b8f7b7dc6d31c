"""The BSDF plugin of clients/mitsuba as the tests use it: its tables, its variants, and what it is asked.

Mitsuba is imported within the functions, so that tests are collected where it is not installed.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import nacreous
from mitsuba_surface import variant_fault

FloatArray = NDArray[np.float64]
Bsdf = Any
"""A BSDF of Mitsuba, whose type depends on the variant."""

CLIENT = Path(__file__).parents[1] / "clients/mitsuba"
VARIANTS = ("scalar_rgb", "scalar_spectral", "llvm_ad_rgb", "llvm_ad_spectral")
WAVELENGTHS_NM = np.array([400.0, 455.0, 633.3, 780.0])
"""What a path carries in the tests: on the samples of a table in steps of 10 nm, and between them."""


def use_variant(variant: str) -> None:
    """Choose a variant and make the plugin known to it; skip, with the reason, what does not run here."""
    if fault := variant_fault(variant):
        pytest.skip(fault)
    import mitsuba as mi

    if str(CLIENT) not in sys.path:
        sys.path.append(str(CLIENT))
    import nacreous_bsdf

    mi.set_variant(variant)
    nacreous_bsdf.register()


def table_file(folder: Path, variant: str, spec: dict[str, Any], name: str = "film") -> Path:
    """Return the file of R of a spec, in the format that a variant reads; it is written once."""
    file = folder / f"{name}{'.spectral.exr' if 'spectral' in variant else '.exr'}"
    return file if file.is_file() else nacreous.write(nacreous.tabulate(spec), file)[0]


def film(file: Path, **parameters: object) -> Bsdf:
    """Return the plugin with a table."""
    import mitsuba as mi

    return mi.load_dict({"type": "nacreous", "filename": str(file), **parameters})


def interaction(wi: FloatArray) -> Any:  # noqa: ANN401 - a type of the variant
    """Return an interaction with light from ω_i: one (3,), or in a vectorised variant several (P, 3)."""
    import drjit as dr
    import mitsuba as mi

    si = dr.zeros(mi.SurfaceInteraction3f, len(wi) if wi.ndim == 2 else 1)
    si.wi = vector(wi)
    if mi.is_spectral:
        si.wavelengths = mi.UnpolarizedSpectrum(WAVELENGTHS_NM.tolist())
    return si


def vector(values: FloatArray) -> Any:  # noqa: ANN401 - a type of the variant
    """Return directions, (3,) or (P, 3), as Mitsuba has them."""
    import mitsuba as mi

    return mi.Vector3f(values.tolist() if values.ndim == 1 else values.T.astype(np.float32))


def context(mode: str = "Radiance", component: int | None = None) -> Any:  # noqa: ANN401 - a type of the variant
    """Return what is asked for: a mode of transport, and one lobe or all."""
    import mitsuba as mi

    ctx = mi.BSDFContext(getattr(mi.TransportMode, mode))
    if component is not None:
        ctx.component = component
    return ctx


def direction(cos_theta: float, phi: float = 0.4) -> FloatArray:
    """Return a unit vector, below the surface for a negative cosine."""
    sin_theta = np.sqrt(1 - cos_theta**2)
    return np.array([sin_theta * np.cos(phi), sin_theta * np.sin(phi), cos_theta])


def random_directions(count: int, seed: int) -> FloatArray:
    """Return directions all over the sphere, (count, 3)."""
    normal = np.random.default_rng(seed).normal(size=(count, 3))
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def array(values: object) -> FloatArray:
    """Return numbers of Mitsuba as NumPy has them: spectra as (P, channels), others as (P,)."""
    got = np.array(values, np.float64)
    return got.T if got.ndim == 2 else got
