"""The rough surface that a file of a measured material describes: one roughness, one thickness, a bsdf."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.film_colour import Side
from nacreous.optics.stack import sample_stack
from nacreous.optics.surface import alphas_at
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.colour import Colouring
from nacreous.tables.computed import colouring_of, grid_of, wanted_parts
from nacreous.tables.facet_film import on_facets
from nacreous.tables.solver import TRANSMITTING_K
from nacreous.tables.spec import Spec, roughness_values, surface_of
from nacreous.tables.table import Part

__all__ = [
    "Colours",
    "Shades",
    "Spectra",
    "check_isotropic",
    "check_least_alpha",
    "check_one_roughness",
    "check_opaque",
    "check_rgb",
    "colours_of",
]

FloatArray = NDArray[np.float64]


class Shades(Protocol):
    """What is tabulated for each pair of directions: C wavelengths, or the components of a colour."""

    @property
    def count(self) -> int:
        """Number of values, C."""

    def reflected(self, solver: BsdfSolver, pairs: Pairs) -> FloatArray:
        """f_r in 1 / sr at pairs of directions (P,): (P, C)."""

    def held_out(self) -> "Shades":
        """Return what lies between those of the table, where there is anything."""

    def between(self, values: FloatArray) -> FloatArray:
        """Return what a reader makes of values (P, C) at those held out."""


@dataclass(frozen=True, eq=False)
class Spectra:
    """Values at wavelengths, which readers interpolate linearly.

    Parameters
    ----------
    wavelength_nm : float array, shape (C,)
    """

    wavelength_nm: FloatArray

    @property
    def count(self) -> int:
        """Number of wavelengths."""
        return self.wavelength_nm.size

    def reflected(self, solver: BsdfSolver, pairs: Pairs) -> FloatArray:
        """f_r in 1 / sr at pairs of directions (P,): (P, C)."""
        return np.asarray(solver.spectra(pairs, Side.REFLECTION, self.wavelength_nm), np.float64)

    def held_out(self) -> "Spectra":
        """Return the middles of neighbouring wavelengths."""
        return Spectra((self.wavelength_nm[1:] + self.wavelength_nm[:-1]) / 2)

    def between(self, values: FloatArray) -> FloatArray:
        """Return the means of neighbouring wavelengths."""
        return (values[:, 1:] + values[:, :-1]) / 2


@dataclass(frozen=True, eq=False)
class Colours:
    """The components of a linear colour.

    Parameters
    ----------
    colouring : Colouring
    """

    colouring: Colouring

    @property
    def count(self) -> int:
        """Three."""
        return 3

    def reflected(self, solver: BsdfSolver, pairs: Pairs) -> FloatArray:
        """Colour of f_r in 1 / sr at pairs of directions (P,): (P, 3)."""
        return np.asarray(solver.colours(pairs, Side.REFLECTION, self.colouring), np.float64)

    def held_out(self) -> "Colours":
        """Return the colours themselves: nothing lies between components."""
        return self

    def between(self, values: FloatArray) -> FloatArray:
        """Return the values themselves."""
        return values


def colours_of(spec: Spec, solver: BsdfSolver) -> Colours:
    """Settle how the colours of a surface are integrated; raises `SpecError` where it has none."""
    grid = grid_of(spec)
    wanted_parts({Part.COLOUR}, grid.wavelength_nm)
    colouring = colouring_of(spec, solver.albedo.film.solver, on_facets(grid))
    assert colouring is not None  # noqa: S101 - `wanted_parts` has refused a spec without colour
    return Colours(colouring)


def check_one_roughness(spec: Spec, format_name: str) -> None:
    """Refuse a spec of several roughnesses: the file is of one surface."""
    roughness = roughness_values(spec)
    if roughness.size != 1:
        expected = f"one roughness: a file of format {format_name} is of one surface"
        raise SpecError("table.roughness", expected, f"{roughness.size}", "write one file for each")


def check_opaque(spec: Spec, format_name: str, alternative: str) -> None:
    """Refuse a spec whose transmitted light the file would lose, unless the spec gives it up itself."""
    if spec.table.transmission == "discard":
        return
    nm = wavelength_values_nm(spec.table.wavelength_nm)
    if sample_stack(spec.stack, nm).index[-1].imag.max() < TRANSMITTING_K:
        raise SpecError(
            "stack.substrate",
            f"one that transmits nothing: a file of format {format_name} holds reflected light alone",
            "a transparent one",
            f'take {alternative}, or give the transmitted light up with table.transmission = "discard"',
        )


def check_isotropic(spec: Spec, format_name: str, alternative: str) -> None:
    """Refuse a spec of an anisotropic surface."""
    surface = surface_of(spec)
    if surface.anisotropic:
        expected = f"the same as alpha_x: a file of format {format_name} is of an isotropic surface"
        got = f"alpha_x / alpha_y = {surface.ratio:.4g}"
        raise SpecError("surface.alpha_y", expected, got, f"take {alternative}")


def check_least_alpha(spec: Spec, format_name: str, least: float, remedy: str) -> None:
    """Refuse a lobe that is narrower than the grid of the file."""
    alpha = float(alphas_at(surface_of(spec), roughness_values(spec)).min())
    if alpha < least:
        expected = f"an alpha of at least {least:g} for {format_name}, whose grid is wider than such a lobe"
        raise SpecError("surface.alpha_x", expected, f"{alpha:.4g}", remedy)


def check_rgb(spec: Spec, format_name: str) -> None:
    """Refuse colours that a reader would take for red, green and blue."""
    if spec.colour.space == "XYZ":
        expected = f"a space of red, green and blue for {format_name}"
        raise SpecError("colour.space", expected, '"XYZ"', 'take "Rec.709", which its readers expect')
