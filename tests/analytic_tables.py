"""Tables of rough surfaces whose value at every sample follows from the sample alone.

No surface is like that. A reader finds out with them whether a file has each sample where it says: no two
samples are equal, and `known` gives the value without the table.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib.metadata import version

import numpy as np

from nacreous.opencl.sources import kernels_hash
from nacreous.tables.certificate import certificate_fields
from nacreous.tables.identity import table_id
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table, Variable

FACTORS: Mapping[str, float] = {
    "roughness": 1.0,
    "thickness_scale": 0.31,
    "cos_theta": 0.17,
    "phi_i": 0.071,
    "theta_i": 0.053,
    "theta_o": 0.037,
    "phi": 0.023,
    "wavelength_nm": 1.9e-4,
    "channel": 0.011,
}
"""How much each axis counts."""
SIDES: Mapping[str, float] = {"E_r": 2.5, "E_t": 2.9, "f_r": 2.5, "f_t": 2.9}
"""Large enough that reflected and transmitted shares add up to less than 1."""
UNITS: Mapping[str, str] = {
    "wavelength_nm": "nm",
    "phi_i": "rad",
    "theta_i": "rad",
    "theta_o": "rad",
    "phi": "rad",
}

STACK = {
    "incident": "air",
    "substrate": {"n": 1.5},
    "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
}
WAVELENGTH_NM = [390.0, 500.0, 600.0, 710.0]
ALBEDO_AXES: Mapping[str, list[float]] = {
    "roughness": [0.1, 0.2, 0.4, 0.5],
    "thickness_scale": [0.8, 1.0, 1.2],
    "cos_theta": [0.0, 0.25, 0.5, 0.75, 1.0],
}
BSDF_AXES: Mapping[str, list[float]] = {
    "roughness": [0.1, 0.3],
    "phi_i": [0.0, 0.7, 1.4],
    "theta_i": [0.0, 0.5, 1.0],
    "theta_o": [0.0, 0.4, 0.8, 1.2],
    "phi": [-3.0, -1.5, 0.0, 1.5, 3.0],
}


def known(name: str, **sample: float) -> float:
    """Return the value of a variable, such as ``E_r`` or ``f_t_rgb``, at a sample; a channel is 0, 1 or 2."""
    return 1 / (SIDES[name.removesuffix("_rgb")] + sum(FACTORS[axis] * at for axis, at in sample.items()))


def analytic_albedo(**axes: list[float]) -> Table:
    """Return a table of E_r and E_t, their means and their colours; `axes` replace others of the spec."""
    table = _analytic("albedo", ("E_r", "E_t"), {}, {**ALBEDO_AXES, **axes})
    dims = ("roughness", "thickness_scale", "wavelength_nm")
    means = {
        f"{name}_mean": Variable(dims, table.values(name).mean(axis=2), "1", f"mean of {name}")
        for name in ("E_r", "E_t")
    }
    return replace(table, variables={**table.variables, **means})


def analytic_bsdf(**axes: list[float]) -> Table:
    """Return a table of f_r and f_t and their colours; `axes` replace others of the spec."""
    return _analytic("bsdf", ("f_r", "f_t"), {"alpha_x": 0.3, "alpha_y": 0.2}, {**BSDF_AXES, **axes})


def _analytic(
    quantity: str, names: Sequence[str], surface: Mapping[str, float], axes: Mapping[str, list[float]]
) -> Table:
    asked = {"quantity": quantity, "wavelength_nm": WAVELENGTH_NM, **axes}
    spec = Spec.from_document({"stack": STACK, "surface": dict(surface), "table": asked})
    samples = {name: np.array(values) for name, values in axes.items()}
    spectra = {name: _variable(name, samples, "wavelength_nm", WAVELENGTH_NM) for name in names}
    colours = {f"{name}_rgb": _variable(name, samples, "channel", range(3)) for name in names}
    return Table(spec, _coords(samples), {**spectra, **colours}, _provenance(spec))


def _variable(name: str, samples: Mapping[str, np.ndarray], last: str, values: Sequence[float]) -> Variable:
    axes = {**samples, last: np.array(values, np.float64)}
    grid = np.meshgrid(*axes.values(), indexing="ij")
    counted = sum(FACTORS[axis] * at for axis, at in zip(axes, grid, strict=True))
    return Variable(tuple(axes), (1 / (SIDES[name] + counted)).astype(np.float32), "1", f"known {name}")


def _coords(samples: Mapping[str, np.ndarray]) -> dict[str, Variable]:
    axes = {**samples, "wavelength_nm": np.array(WAVELENGTH_NM), "channel": np.array(["R", "G", "B"])}
    return {name: Variable((name,), values, UNITS.get(name, "1"), name) for name, values in axes.items()}


def _provenance(spec: Spec) -> dict[str, str]:
    figures = dict.fromkeys(certificate_fields(spec.table.quantity), 0.0)
    return {
        "id": table_id(spec),
        "version": version("nacreous"),
        "spec": spec.model_dump_json(),
        "certificate": json.dumps(figures),
        "precision": "single",
        "device": "none",
        "kernels": kernels_hash(),
    }
