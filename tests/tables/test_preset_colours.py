"""Colours that everybody can check: oxide on silicon, anodised titanium, wings, the paper's spheres."""

from dataclasses import dataclass

import numpy as np
import pytest

from nacreous.optics.colour import colour_system, lab
from nacreous.tables.presets import preset
from nacreous.tables.table import Part
from nacreous.tables.tabulate import tabulate_table


@dataclass(frozen=True)
class Named:
    """A colour name as a sector of CIELAB: hue from `first` to `last` degrees, and bounds."""

    thickness_nm: int
    name: str
    first: float
    last: float
    most_chroma: float = 200.0
    most_lightness: float = 100.0

    def holds(self, lightness: float, chroma: float, hue: float) -> bool:
        """Whether a colour may be called so."""
        within = (hue - self.first) % 360 <= (self.last - self.first) % 360
        return within and chroma <= self.most_chroma and lightness <= self.most_lightness


GREY = (0.0, 359.9)

SILICA_ON_SILICON = (
    Named(100, "dark violet", 300, 340, most_lightness=45),
    Named(120, "royal blue", 260, 300),
    Named(150, "light blue", 240, 275),
    Named(170, "metallic", *GREY, most_chroma=12),
    Named(200, "light gold", 85, 120),
    Named(250, "orange", 40, 85),
    Named(270, "red-violet", 300, 345),
    Named(310, "blue", 255, 300),
    Named(340, "light green", 150, 205),
    Named(390, "yellow", 85, 115),
    Named(420, "pink", 330, 30),
    Named(480, "blue-violet", 290, 320),
    Named(520, "green", 150, 200),
    Named(600, "pink", 325, 350),
)
"""Pliskin & Conrad 1964, as every cleanroom has it on the wall: daylight, seen perpendicularly."""

ANODISED_TITANIUM = (
    Named(20, "gold", 60, 95),
    Named(40, "purple", 305, 340),
    Named(50, "blue", 250, 290),
    Named(80, "silver", *GREY, most_chroma=12),
    Named(120, "yellow", 85, 110),
    Named(140, "pink", 330, 20),
    Named(160, "violet", 295, 330),
    Named(180, "cyan", 185, 230),
)
"""Diamanti et al. 2008 and the jewellers' charts, by thickness: daylight, seen perpendicularly."""


@pytest.mark.parametrize(
    ("name", "sequence"), [("silica-on-silicon", SILICA_ON_SILICON), ("anodised-titanium", ANODISED_TITANIUM)]
)
def test_the_colours_come_in_order(name: str, sequence: tuple[Named, ...]) -> None:
    """Each colour is found within 20 nm of its thickness, and beyond the one before it."""
    thicknesses = np.arange(5, 625, 5)
    seen = _lightness_chroma_hue(name, thicknesses)
    reached = 0
    for colour in sequence:
        near = np.flatnonzero(np.abs(thicknesses - colour.thickness_nm) <= 20)
        there = [thicknesses[i] for i in near if colour.holds(*seen[i]) and thicknesses[i] > reached]
        assert there, f"no {colour.name} near {colour.thickness_nm} nm: {seen[near].round()}"
        reached = there[0]


def _lightness_chroma_hue(name: str, thicknesses_nm: np.ndarray) -> np.ndarray:
    """CIELAB of a preset's one layer at normal incidence, (thicknesses, 3)."""
    mean = preset(name).stack.layers[0].thickness_nm
    scales = ", ".join(f"{d / mean:.12g}" for d in thicknesses_nm)
    overrides = [f"table.thickness_scale=[{scales}]", "table.cos_theta=[0.5, 1.0]"]
    table = tabulate_table(preset(name, overrides), [Part.COLOUR])
    system = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
    L, a, b = lab(system.to_xyz(table.values("R_rgb")[:, -1].astype(float)), system.white).T  # noqa: N806
    return np.stack([L, np.hypot(a, b), np.degrees(np.arctan2(b, a)) % 360], axis=1)


@pytest.mark.parametrize(
    ("figure", "normal", "oblique"),
    [
        ("paper/figure-3", (0.111, 0.085, 0.147), (0.246, 0.080, 0.194)),
        ("paper/figure-4", (0.012, 0.160, 0.081), (0.118, 0.099, 0.155)),
    ],
)
def test_the_papers_spheres(figure: str, normal: tuple[float, ...], oblique: tuple[float, ...]) -> None:
    """Linear sRGB under D65 of 420 and 450 nm of n = 2.0 on glass, head on and at 45 degrees."""
    angles = f"table.cos_theta=[{np.cos(np.pi / 4):.15g}, 1.0]"
    table = tabulate_table(preset(figure, [angles]), [Part.COLOUR])
    np.testing.assert_allclose(table.values("R_rgb")[0], [oblique, normal], rtol=0, atol=1e-3)


def test_the_papers_wings() -> None:
    """Six pairs of ridge and gap peak at 403, 504, 605 and 681 nm with 0.71 (Vukusic 1999: up to 0.75)."""
    overrides = ["table.cos_theta=[0.5, 1.0]", "table.wavelength_nm={start=350, stop=750, step=1}"]
    table = tabulate_table(preset("paper/figure-8", overrides), [Part.SPECTRUM])
    R = (table.values("R_s")[:, -1] + table.values("R_p")[:, -1]) / 2
    np.testing.assert_allclose(table.values("wavelength_nm")[R.argmax(axis=1)], [403, 504, 605, 681], atol=1)
    np.testing.assert_allclose(R.max(axis=1), 0.71, atol=0.01)
