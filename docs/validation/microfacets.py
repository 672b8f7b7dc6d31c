"""Rough silver against Mitsuba 3's own `roughconductor`.

Both compute f_r = D G F / (4 cos_i cos_o) with the separable Smith masking of B. Walter et al., Microfacet
Models for Refraction through Rough Surfaces, EGSR 2007; Mitsuba in single precision, from the index that it
is given. Its masking of the Beckmann distribution is Walter's rational approximation of Smith's function,
ours is the function itself: these two differ by what the approximation is wrong by.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mitsuba_surface import VARIANTS, bsdf_values, conductor, variant_fault
from nacreous.opencl.device import open_device
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.spec import Spec
from reference_surface import cosine_direction
from validation.comparison import Comparison
from validation.drawing import FAINT, GRID, INK, dress, figure
from validation.page import rounded, table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

SILVER = "main/Ag/Johnson"
PAIRS = 10_000
WAVELENGTH_NM = np.array([430.0, 520.0, 610.0, 700.0])
SURFACES = (("ggx", 0.1), ("ggx", 0.4), ("beckmann", 0.1), ("beckmann", 0.4))
INCIDENCE_DEG = 45.0
PLANE_DEG = np.linspace(-89, 89, 357)
LEAST_F = 1e-6
"""f_r in 1 / sr below which values are not compared: a lobe's maximum is 1e7 times as large."""
IN_PLANE_NM = np.array([520.0, 530.0])
"""The lobes are drawn at the first; a spectrum of Mitsuba has two samples or more."""


@dataclass(frozen=True, eq=False)
class Lobe:
    """One surface: f_r cos_o in the plane of incidence, and relative differences at random directions.

    Parameters
    ----------
    distribution, alpha : str and float
    ours, mitsuba : float arrays, shape (angles,)
        f_r cos_o over `PLANE_DEG`.
    differences : float array
        Relative, at random pairs of directions and all wavelengths.
    """

    distribution: str
    alpha: float
    ours: FloatArray
    mitsuba: FloatArray
    differences: FloatArray

    @property
    def name(self) -> str:
        """Return how the page calls the surface."""
        shown = {"ggx": "GGX", "beckmann": "Beckmann"}[self.distribution]
        return f"{shown}, alpha = {self.alpha:g}"


def measure() -> list[Lobe]:
    """Compare all surfaces in the first variant of Mitsuba that runs here; `RuntimeError` if none does."""
    import mitsuba

    variants = [variant for variant in reversed(VARIANTS) if not variant_fault(variant)]
    if not variants:
        raise RuntimeError(variant_fault(VARIANTS[-1]))
    mitsuba.set_variant(variants[0])
    return [_lobe(distribution, alpha) for distribution, alpha in SURFACES]


def _lobe(distribution: str, alpha: float) -> Lobe:
    i, o = random_pairs()
    ours, theirs = both(distribution, alpha, i, o, WAVELENGTH_NM)
    in_plane = [_in_plane(-INCIDENCE_DEG * np.ones_like(PLANE_DEG)), _in_plane(PLANE_DEG)]
    lobe = both(distribution, alpha, *in_plane, IN_PLANE_NM)
    our_lobe, their_lobe = (f[:, 0] * in_plane[1][:, 2] for f in lobe)
    return Lobe(distribution, alpha, our_lobe, their_lobe, relative_difference(ours, theirs))


def relative_difference(ours: FloatArray, theirs: FloatArray) -> FloatArray:
    """Return it where there is light to speak of, (samples,); a Beckmann lobe falls below any number."""
    lit = theirs >= LEAST_F
    return np.abs(ours[lit] / theirs[lit] - 1)


def random_pairs() -> tuple[FloatArray, FloatArray]:
    """Return incoming and outgoing directions above the surface, (PAIRS, 3) each."""
    u = np.random.default_rng(7).random((2, 2, PAIRS))
    return cosine_direction(u[0]), cosine_direction(u[1])


def both(
    distribution: str, alpha: float, i: FloatArray, o: FloatArray, wavelength_nm: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """f_r of ours and of Mitsuba's, (pairs, wavelengths) each."""
    index = refractive_index(NamedMaterial(name=SILVER), wavelength_nm)
    solver = bsdf_solver(open_device(), spec(distribution, alpha))
    theirs = conductor(alpha, alpha, index, wavelength_nm, distribution)
    ours = np.asarray(solver.reflection(0, i, o, wavelength_nm), np.float64)
    return ours, bsdf_values(theirs, i, o, wavelength_nm)


def spec(distribution: str, alpha: float) -> Spec:
    """Return silver under a layer of no thickness, lit from vacuum."""
    nothing = {"material": {"n": 1.5}, "thickness_nm": 0.0}
    return Spec.model_validate(
        {
            "stack": {"incident": "vacuum", "substrate": SILVER, "layers": [nothing]},
            "surface": {"distribution": distribution, "masking": "smith-separable", "alpha_x": alpha},
            "table": {"quantity": "bsdf"},
        }
    )


def _in_plane(theta_deg: FloatArray) -> FloatArray:
    theta = np.radians(theta_deg)
    return np.stack([np.sin(theta), np.zeros_like(theta), np.cos(theta)], axis=-1)


def headline(lobes: list[Lobe]) -> str:
    """Say the largest difference of each distribution."""
    largest = {name: rounded(max(_of(lobes, name))) for name in ("ggx", "beckmann")}
    return f"f_r within {largest['ggx']} for GGX, {largest['beckmann']} for Beckmann, relatively"


def _of(lobes: list[Lobe], distribution: str) -> list[float]:
    return [lobe.differences.max() for lobe in lobes if lobe.distribution == distribution]


def numbers(lobes: list[Lobe]) -> str:
    """Say how far apart both are."""
    header = "surface | median difference: | 99 of 100 within: | largest:"
    rows = [" | ".join([lobe.name, *_figures(lobe.differences)]) for lobe in lobes]
    intro = (
        f"Relative differences of f_r at {PAIRS:,} random pairs of directions and {WAVELENGTH_NM.size} "
        f"wavelengths, where f_r is {rounded(LEAST_F)} / sr or more."
    )
    return f"{intro}\n\n{table(header, rows)}"


def _figures(differences: FloatArray) -> list[str]:
    return [rounded(value) for value in (*np.quantile(differences, (0.5, 0.99)), differences.max())]


COLOURS = ("#2f6fb4", "#8db4dc", "#c2571a", "#e5ab83")


def draw(lobes: list[Lobe]) -> "Figure":
    """Draw the lobes, ours as lines and Mitsuba's as dots, and how far apart they are."""
    drawn = figure(4.8)
    above, below = drawn.add_axes((0.08, 0.42, 0.9, 0.5)), drawn.add_axes((0.08, 0.1, 0.9, 0.24))
    for lobe, colour in zip(lobes, COLOURS, strict=True):
        above.plot(PLANE_DEG, lobe.ours, color=colour, lw=1.8, label=lobe.name)
        few = slice(3, None, 10)
        above.scatter(PLANE_DEG[few], lobe.mitsuba[few], s=11, color=INK, linewidths=0, zorder=3)
        lit = lobe.mitsuba >= LEAST_F
        below.plot(PLANE_DEG[lit], relative_difference(lobe.ours, lobe.mitsuba), color=colour, lw=1.3)
    _dress(above, below)
    return drawn


def _dress(above: "Axes", below: "Axes") -> None:
    title = f"Silver lit at {INCIDENCE_DEG:.0f}°, {IN_PLANE_NM[0]:.0f} nm: Nacreous as lines, Mitsuba as dots"
    dress(above, title, "", r"$f_r \cos\theta_o$, 1 / sr")
    dress(below, "", "angle of outgoing light in the plane of incidence, degrees", "relative difference")
    for axes in (above, below):
        axes.set_yscale("log")
        axes.set_xlim(-90, 90)
        axes.set_xticks(range(-90, 91, 30))
        axes.grid(color=GRID, lw=0.7)
    above.set_ylim(1e-4, 100)
    below.set_ylim(1e-8, 1e-1)
    above.axvline(INCIDENCE_DEG, color=FAINT, lw=0.8, ls=(0, (1, 2)))
    above.legend(frameon=False, fontsize=9, loc="upper left", labelcolor=INK)


COMPARISON = Comparison(
    name="microfacets",
    title="Rough surfaces",
    against="Mitsuba 3, `roughconductor`",
    measure=measure,
    headline=headline,
    numbers=numbers,
    draw=draw,
    palette=128,
)
