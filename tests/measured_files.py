"""Measured files for real renderers and readers: the film they are of, and where to look at it."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table

FloatArray = NDArray[np.float64]

SURFACES: dict[str, dict[str, Any]] = {
    "narrow": {"distribution": "ggx", "masking": "smith", "alpha_x": 0.02},
    "ggx": {"distribution": "ggx", "masking": "smith", "alpha_x": 0.1},
    "rough": {"distribution": "beckmann", "masking": "smith", "alpha_x": 0.4},
    "ashikhmin-shirley": {"alpha_x": 0.1},
    "diffuse": {
        "alpha_x": 0.1,
        "specular_weight": 0.8,
        "diffuse_weight": 0.2,
        "diffuse_reflectance": 0.5,
    },
    "anisotropic": {"distribution": "ggx", "masking": "smith", "alpha_x": 0.1, "alpha_y": 0.3},
}
"""From the narrowest lobe that a file holds to a broad one."""

SUBSTRATES: dict[str, object] = {"titanium": "main/Ti/Johnson", "glass": {"n": 1.5, "k": 0.01}}
"""Under the film: one that its R nearly vanishes on at some wavelengths, and a dark one."""

STEEPEST = np.radians(75.0)
WAVELENGTH_NM = (380.0, 780.0)


def measured_spec(surface: str, substrate: object = "main/Ti/Johnson") -> Spec:
    """Return a film of 420 nm, n 2.0, on titanium, at 81 wavelengths: its R falls almost to 0 at some."""
    first, last = WAVELENGTH_NM
    layers = [{"material": {"n": 2.0}, "thickness_nm": 420}]
    return Spec.model_validate(
        {
            "stack": {"incident": "air", "substrate": substrate, "layers": layers},
            "surface": SURFACES[surface],
            "table": {"quantity": "bsdf", "wavelength_nm": {"start": first, "stop": last, "step": 5}},
        }
    )


def measured_table(spec: Spec, name: FormatName) -> Table:
    """Compute what a file of this format holds."""
    return tabulate_table(spec, sampling=FORMATS[name].sampling)


def measured_file(spec: Spec, name: FormatName, folder: Path) -> Path:
    """Write a measured file; return its path."""
    chosen = FORMATS[name]
    (path,) = chosen.write(measured_table(spec, name), folder / f"film{chosen.suffix}")
    return path


def directions(theta: FloatArray, phi: FloatArray) -> FloatArray:
    """Return unit vectors (P, 3) of angles (P,)."""
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)


def random_incoming(count: int, seed: int) -> FloatArray:
    """Return directions (count, 3) of light from up to 75 degrees, evenly over the solid angle."""
    random = np.random.default_rng(seed)
    cosine = random.uniform(np.cos(STEEPEST), 1, count)
    return directions(np.arccos(cosine), random.uniform(-np.pi, np.pi, count))


def random_diffuse(count: int, seed: int) -> FloatArray:
    """Return directions (count, 3) as a diffuse surface sends light."""
    random = np.random.default_rng(seed)
    return directions(np.arccos(np.sqrt(random.random(count))), random.uniform(-np.pi, np.pi, count))


def random_reflected(i: FloatArray, alpha: float, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return directions (P, 3) as GGX's facets reflect light from `i`, and 1 over their density (P,).

    Facets are drawn by D cos(theta_m), B. Walter et al. 2007, equations 35 and 14; weights are 0 below the
    horizon.
    """
    random = np.random.default_rng(seed)
    u, turn = random.random(len(i)), random.uniform(-np.pi, np.pi, len(i))
    tan_squared = alpha**2 * u / (1 - u)
    m = directions(np.arctan(np.sqrt(tan_squared)), turn)
    facing = np.sum(m * i, axis=-1)
    o = 2 * facing[:, None] * m - i
    density = (alpha / (alpha**2 + tan_squared)) ** 2 / (np.pi * m[:, 2] ** 3)
    weight = 4 * facing / density
    return o, np.where((facing > 0) & (o[:, 2] > 0), weight, 0.0)


def check_exact_where_light_goes(error: FloatArray, light: FloatArray) -> None:
    """Require of relative errors, with the light there: half in 0.5e-3, nine tenths and all light in 1e-3."""
    assert abs((error * light).sum() / light.sum()) <= 1e-3
    order = np.argsort(np.abs(error), axis=None)
    share = np.cumsum(light.ravel()[order]) / light.sum()
    median, p90 = np.interp([0.5, 0.9], share, np.abs(error).ravel()[order])
    assert median <= 0.5e-3
    assert p90 <= 1e-3
