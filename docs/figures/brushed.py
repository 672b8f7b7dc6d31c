"""Brushed objects: measured materials of several roughnesses and thicknesses, and pictures of them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import nacreous
from figures.hue import lab
from figures.lobe import Lobe, lobe_of_file, lobe_of_film, shown_width
from figures.tables import Tables, colours, table_at_angles
from nacreous import Spec
from nacreous.optics.surface import Surface, alphas_at

FloatArray = NDArray[np.float64]

RANGE_NM = {"start": 380, "stop": 740, "step": 10}
"""Of a measured file: a fringe of these films is over 60 nm wide, and the eye sees little beyond."""
FEW_BOUNCES = {"integrator": {"type": "path", "max_depth": 5}}
"""Of light among opaque objects: what comes later is dark."""
STATED_DEG = np.array([0.0, 30.0, 45.0, 60.0])


@dataclass(frozen=True)
class Brushed:
    """A surface of a preset with one roughness and one thickness of its film."""

    preset: str
    thickness_nm: float
    roughness: float

    @property
    def label(self) -> str:
        """Return what stands under its panel."""
        return f"film of {self.thickness_nm:.0f} nm, roughness {self.roughness:g}"

    @property
    def alphas(self) -> tuple[float, float]:
        """Return the roughness along x and y."""
        alphas = alphas_at(nacreous.preset(self.preset).surface, np.array([self.roughness]))[0]
        return float(alphas[0]), float(alphas[1])

    @property
    def spec(self) -> Spec:
        """Return the preset's stack and surface as a bsdf."""
        given = nacreous.preset(self.preset, (f"stack.layers.0.thickness_nm={self.thickness_nm}",))
        alpha_x, alpha_y = self.alphas
        surface = Surface(distribution=given.surface.distribution, alpha_x=alpha_x, alpha_y=alpha_y)
        document = given.model_dump(include={"stack"}, exclude_unset=True)
        document["surface"] = surface.model_dump(exclude_unset=True)
        return Spec.from_document(document | {"table": {"quantity": "bsdf", "wavelength_nm": RANGE_NM}})

    @property
    def exact_lobe(self) -> Lobe:
        """Return how wide the lobe of equation 12 is."""
        stack = self.spec.stack
        indices = [1.0, *(complex(each.n, each.k) for each in (stack.layers[0].material, stack.substrate))]
        return lobe_of_film(self.spec.surface, np.array(indices), self.thickness_nm)


def colour_lines(surfaces: Sequence[Brushed]) -> Iterator[str]:
    """Return a Markdown table of the colours of the films, each thickness once."""
    yield "| film | " + " | ".join(f"{each:.0f}°" for each in STATED_DEG) + " |"
    yield "|--:|" + "---|" * len(STATED_DEG)
    for surface in {each.thickness_nm: each for each in surfaces}.values():
        seen = colours(table_at_angles(surface.spec, STATED_DEG))
        words = " | ".join(str(lab(colour)) for colour in seen)
        yield f"| {surface.thickness_nm:.0f} nm | {words} |"


def lobe_lines(tables: Tables, surfaces: Sequence[Brushed]) -> Iterator[str]:
    """Return a Markdown table of how wide lobes are, in their files and exactly, each roughness once."""
    yield "| roughness | alpha along x, y | width along x: file, exact | width along y: file, exact |"
    yield "|--:|---|---|---|"
    for surface in {each.roughness: each for each in surfaces}.values():
        file, exact = lobe_of_file(tables.written(surface.spec, ".bsdf")), surface.exact_lobe
        alphas = ", ".join(f"{alpha:.3f}" for alpha in surface.alphas)
        along_x = f"{shown_width(file.x_deg)}, {shown_width(exact.x_deg)}"
        along_y = f"{shown_width(file.y_deg)}, {shown_width(exact.y_deg)}"
        yield f"| {surface.roughness:g} | {alphas} | {along_x} | {along_y} |"
