"""Brushed objects: measured materials for a grid of roughnesses and thicknesses, and their panels."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import nacreous
from figures.pictures import exposed, labelled, side_by_side, stacked
from figures.tables import Tables
from nacreous import Spec
from nacreous.optics.surface import alphas_at
from nacreous.tables.sampling import Sampling
from nacreous.tables.tabulate import tabulate_table

FloatArray = NDArray[np.float64]

RANGE_NM = {"start": 380, "stop": 740, "step": 10}
"""Of a measured file; fringes of these films are 100 nm wide, and the eye sees little beyond."""


@dataclass(frozen=True)
class Grid:
    """A preset's roughnesses, down, and thicknesses in nm, across."""

    preset: str
    roughnesses: tuple[float, ...]
    thicknesses_nm: tuple[float, ...]


def brushed_spec(preset: str, thickness_nm: float, roughness: float) -> Spec:
    """Return a preset's stack and surface as a bsdf of one thickness and one roughness."""
    given = nacreous.preset(preset, (f"stack.layers.0.thickness_nm={thickness_nm}",))
    ((alpha_x, alpha_y),) = alphas_at(given.surface, np.array([roughness])).tolist()
    document = given.model_dump(include={"stack"}, exclude_unset=True)
    surface = {"distribution": given.surface.distribution, "alpha_x": alpha_x, "alpha_y": alpha_y}
    table = {"quantity": "bsdf", "wavelength_nm": RANGE_NM}
    return Spec.from_document({**document, "surface": surface, "table": table})


def measured_file(tables: Tables, spec: Spec, name: str) -> Path:
    """Return the ``.bsdf`` of a spec, sampled where Mitsuba reads it and nowhere else."""
    file = tables.folder / f"{name}.bsdf"
    if not file.is_file():
        tables.folder.mkdir(parents=True, exist_ok=True)
        nacreous.write(tabulate_table(spec, sampling=Sampling.RGL_SPECTRA), file)
    return file


def panels(grid: Grid, rendered: Callable[[float, float], FloatArray], stops: float) -> Image.Image:
    """Return the grid as one picture, with both numbers under each panel."""
    rows = [
        side_by_side([_panel(rendered(thickness, roughness), stops, thickness, roughness)
                      for thickness in grid.thicknesses_nm])
        for roughness in grid.roughnesses
    ]  # fmt: skip
    return stacked(rows)


def _panel(linear: FloatArray, stops: float, thickness_nm: float, roughness: float) -> Image.Image:
    return labelled(exposed(linear, stops), f"film of {thickness_nm:.0f} nm, roughness {roughness:g}")
