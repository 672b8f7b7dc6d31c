"""``gltf``: the nearest film that glTF can show, on a sphere, and how far off it is.

glTF and the engines of the web have one thin film, KHR_materials_iridescence: one layer without dispersion or
absorption, by the approximation that `nacreous.optics.iridescence` describes. Its parameters are fitted to
the exact film (`nacreous.tables.fit.gltf`); they are those of the colours, not those of the stack. A
substrate that transmits becomes a dielectric base (KHR_materials_ior, KHR_materials_specular) that lets the
rest of the light straight through (KHR_materials_transmission), an opaque one a metallic base. Roughness is
that of the spec's `[surface]`, √alpha as glTF has it.

A table over thicknesses is fitted at the scale nearest to 1. ``materials[0].extras.nacreous`` holds

===================  =======================================================================================
``angles_deg``       angles of incidence of the colours below: 0, 45 and 70
``film_rgb``         linear Rec.709 reflectance of the film there, as the table has it
``gltf_rgb``         the same of the fitted material
``delta_e_2000``     CIEDE2000 of the two; ``delta_e_2000_max`` and ``_mean`` are over 0 to 75 degrees
``thickness_scale``  factor on the film's thickness that all of this belongs to
``verdict``          what that means, in a sentence
``provenance``       ``id``, ``version``, ``spec``, ``certificate`` and the rest, and ``checksum``, SHA-256
                     over all of the document but itself
===================  =======================================================================================

Where the verdict is bad, the lookup texture of the format ``exr`` shows the film as it is.
"""

import json
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import Contents, checksum, labelled
from nacreous.formats.gltf_sphere import sphere
from nacreous.formats.lookup import coloured_names
from nacreous.formats.specular import check_specular
from nacreous.optics.iridescence import Iridescence, iridescent_reflectance
from nacreous.tables.fit.gltf import GltfFit, fit_gltf
from nacreous.tables.fit.target import STATED_DEG, FitTarget, check_fittable
from nacreous.tables.measured.surface import check_isotropic
from nacreous.tables.spec import Spec, surface_of
from nacreous.tables.table import Table

__all__ = ["QUANTITIES", "SUFFIX", "check", "read", "write"]

SUFFIX = ".gltf"
QUANTITIES = frozenset({"fresnel"})
"""A fit is to R; an albedo or a BSDF has the facets in it already, which glTF adds by its own model."""

_MODEL = "KHR_materials_iridescence"
_NEAR, _VISIBLE = 2.0, 5.0
"""CIEDE2000 that is seen side by side, and at a glance."""
_ARRAYS = MappingProxyType({"film_rgb": (3, 3), "gltf_rgb": (3, 3), "delta_e_2000": (3,)})
_COLOUR_DIGITS, _DELTA_E_DIGITS = 5, 2
_DIGITS = 4
"""Decimals of the fitted parameters, which the fit has rounded already, in its own units."""


def check(spec: Spec) -> None:
    """Refuse a spec that cannot be fitted, or of what the material would lose; raises `SpecError`."""
    check_fittable(spec)
    check_isotropic(spec, "gltf", "materialx")
    check_specular(spec, "gltf")


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Fit the material, write it, and return the file; raises `FileFormatError` and `SpecError`."""
    transmits = len(coloured_names(table)) > 1
    target = FitTarget.of_table(table)
    fit = fit_gltf(target, table.spec.stack)
    document = _document(table, _material(table.spec, fit.film, transmits=transmits), _extras(target, fit))
    provenance = _provenance(document)
    provenance["checksum"] = _checksum(document)
    with replacing(path) as (temporary,):
        temporary.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return (path,)


def _document(table: Table, material: dict[str, Any], extras: dict[str, Any]) -> dict[str, Any]:
    provenance = {**table.provenance, "quantity": "R", "model": _MODEL}
    material["extras"] = {"nacreous": {**extras, "provenance": provenance}}
    return {
        "asset": {"version": "2.0", "generator": f"Nacreous {table.provenance['version']}"},
        "extensionsUsed": sorted(material["extensions"]),
        **sphere(),
        "materials": [material],
    }


# ---- the material ------------------------------------------------------------------------------------------


def _material(spec: Spec, film: Iridescence, *, transmits: bool) -> dict[str, Any]:
    iridescence = {
        "iridescenceFactor": round(float(film.factor), _DIGITS),
        "iridescenceIor": round(float(film.ior), _DIGITS),
        "iridescenceThicknessMaximum": round(float(film.thickness_nm), _DIGITS),
    }
    base = _dielectric(film.base_f0) if transmits else {}
    return {
        "name": "film",
        "pbrMetallicRoughness": {
            "baseColorFactor": [1.0, 1.0, 1.0, 1.0] if transmits else [*film.base_f0.tolist(), 1.0],
            "metallicFactor": 0.0 if transmits else 1.0,
            "roughnessFactor": round(float(np.sqrt(surface_of(spec).roughness or 0.0)), 6),
        },
        "extensions": {_MODEL: iridescence, **base},
    }


def _dielectric(base_f0: NDArray[np.float64]) -> dict[str, Any]:
    """Return the extensions that give a dielectric its F0: ((ior - 1) / (ior + 1))² times a colour."""
    brightest = float(base_f0.max())
    root = np.sqrt(brightest)
    tint = base_f0 / brightest if brightest else np.ones(3)
    return {
        "KHR_materials_ior": {"ior": float((1 + root) / (1 - root))},
        "KHR_materials_specular": {"specularColorFactor": tint.tolist()},
        "KHR_materials_transmission": {"transmissionFactor": 1.0},
    }


def _extras(target: FitTarget, fit: GltfFit) -> dict[str, Any]:
    shown = iridescent_reflectance(fit.film, np.cos(np.radians(STATED_DEG)))
    return {
        "thickness_scale": target.thickness_scale,
        "angles_deg": list(STATED_DEG),
        "film_rgb": np.round(target.at(STATED_DEG), _COLOUR_DIGITS).tolist(),
        "gltf_rgb": np.round(shown, _COLOUR_DIGITS).tolist(),
        "delta_e_2000": [round(fit.delta_e[angle], _DELTA_E_DIGITS) for angle in STATED_DEG],
        "delta_e_2000_max": round(fit.delta_e_max, _DELTA_E_DIGITS),
        "delta_e_2000_mean": round(fit.delta_e_mean, _DELTA_E_DIGITS),
        "verdict": _verdict(fit),
    }


def _verdict(fit: GltfFit) -> str:
    worst = max(fit.delta_e_max, *fit.delta_e.values())
    stated = ", ".join(f"{value:.1f} at {angle:g}" for angle, value in fit.delta_e.items())
    figure = f"CIEDE2000 is {worst:.1f} at worst from 0 to 75 degrees, {stated}"
    if worst <= _NEAR:
        return f"The formula of glTF shows this film: {figure}."
    if worst <= _VISIBLE:
        return f"The formula of glTF shows this film nearly: {figure}."
    return (
        f"The formula of glTF cannot represent this film: {figure}. "
        "Where that matters, use the lookup texture of the format exr."
    )


# ---- reading -----------------------------------------------------------------------------------------------


def read(path: Path) -> Contents:
    """Return the colours that the fit states, and the provenance; raises `FileFormatError`."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise FileFormatError(
            f"expected a glTF document, got one that cannot be read: {reason(error)}"
        ) from error
    try:
        arrays = {name: _array(document, name, shape) for name, shape in _ARRAYS.items()}
        provenance = {str(key): str(value) for key, value in _provenance(document).items()}
        return Contents(arrays, provenance, _checksum(document))
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        raise FileFormatError("expected materials[0].extras.nacreous of a fit, got none") from error


def _fit_of(document: dict[str, Any]) -> dict[str, Any]:
    extras: dict[str, Any] = document["materials"][0]["extras"]["nacreous"]
    return extras


def _array(document: dict[str, Any], name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    return np.array(_fit_of(document)[name], np.float64).reshape(shape)


def _provenance(document: dict[str, Any]) -> dict[str, str]:
    provenance: dict[str, str] = _fit_of(document)["provenance"]
    return provenance


def _checksum(document: dict[str, Any]) -> str:
    """Return the checksum over all of the document but the checksum that is in it."""
    provenance = dict(_provenance(document))
    provenance.pop("checksum", None)
    bare = json.loads(json.dumps(document))
    _fit_of(bare)["provenance"] = provenance
    return checksum(labelled(provenance).items(), [json.dumps(bare, sort_keys=True).encode()])
