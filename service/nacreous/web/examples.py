"""Requests that the documentation shows; a test sends each of them."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

__all__ = ["SPECS", "SPEC_IN_TOML", "SWEEPS"]

SPECS: Mapping[str, dict[str, Any]] = MappingProxyType(
    {
        "film on glass": {
            "name": "film on glass",
            "stack": {
                "incident": "air",
                "substrate": {"n": 1.5},
                "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
            },
        },
        "soap film over its thickness": {
            "stack": {
                "incident": "air",
                "substrate": "air",
                "layers": [{"material": "soap-water", "thickness_nm": 1000}],
            },
            "table": {
                "cos_theta": 32,
                "thickness_scale": {"start": 0.1, "stop": 1.0, "count": 16},
                "wavelength_nm": {"start": 400, "stop": 700, "step": 10},
            },
        },
        "oxide on a measured metal": {
            "stack": {
                "incident": "air",
                "substrate": "main/Ag/Johnson",
                "layers": [{"material": {"cauchy": [1.45, 0.0035]}, "thickness_nm": 120}],
            },
            "table": {"cos_theta": 16},
        },
    }
)

SPEC_IN_TOML = """\
name = "film on glass"

[stack]
incident = "air"
substrate = { n = 1.5 }
[[stack.layers]]
material = { n = 2.0 }
thickness_nm = 420.0
"""

SWEEPS: Mapping[str, dict[str, Any]] = MappingProxyType(
    {
        "three thicknesses of a coating": {
            "base": SPECS["film on glass"],
            "formats": ["exr"],
            "vary": {"stack.layers.0.thickness_nm": [100, 200, 300]},
        },
        "a preset at two angular resolutions": {
            "base": "coated-lens",
            "formats": ["npz"],
            "vary": {"table.cos_theta": [8, 16]},
        },
    }
)
