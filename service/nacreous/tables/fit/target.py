"""What a simpler model is fitted to: the colours of a film over its angles, as an eye compares them."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.optics.colour import ColourSystem, colour_system, lab
from nacreous.optics.delta_e import delta_e_2000
from nacreous.tables.axes import cos_theta_values
from nacreous.tables.rec709 import rec709
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

__all__ = ["FITTED_DEG", "STATED_DEG", "Comparison", "FitTarget", "check_fittable"]

FloatArray = NDArray[np.float64]

STATED_DEG = (0.0, 45.0, 70.0)
"""Angles of incidence at which a fit says how far off it is."""
FEWEST_COSINES = 9
"""Cosines that a fit takes its colours between, at least.

Over six presets, linear colours interpolated between 9 of them are within 2e-2 of the film's, between 17
within 5e-3, and between 33 within 6e-4."""
FITTED_DEG = tuple(np.arange(0.0, 76.0, 5.0).tolist())
"""Angles that a fit minimises the colour differences over; beyond them every surface turns white."""


@dataclass(frozen=True, eq=False)
class FitTarget:
    """Colours of a film.

    Parameters
    ----------
    cos_theta : float array, shape (A,)
        Ascending, from cos 75 degrees or less to 1.
    colour : float array, shape (A, 3)
        Linear Rec.709 of the unpolarised reflectance.
    thickness_scale : float
        Factor on the thickness of every layer that the colours belong to.
    """

    cos_theta: FloatArray
    colour: FloatArray
    thickness_scale: float = 1.0

    @classmethod
    def of_table(cls, table: Table) -> Self:
        """Return the colours of a `fresnel` table, at the thickness nearest to that of its spec.

        Raises
        ------
        SpecError
            The table's angles do not reach from normal incidence to 75 degrees.
        """
        check_fittable(table.spec)
        scales = table.values("thickness_scale")
        nearest = int(np.argmin(np.abs(np.log(scales))))
        colour = np.asarray(table.values("R_rgb")[nearest], np.float64)
        shown = np.asarray(rec709(colour, table.spec.colour), np.float64)
        return cls(table.values("cos_theta"), shown, float(scales[nearest]))

    def at(self, angles_deg: tuple[float, ...]) -> FloatArray:
        """Linear Rec.709 at angles of incidence, (A, 3), interpolated as a reader of the table does."""
        cosines = np.cos(np.radians(angles_deg))
        channels = [np.interp(cosines, self.cos_theta, channel) for channel in self.colour.T]
        return np.stack(channels, axis=-1)

    def comparison(self, angles_deg: tuple[float, ...]) -> "Comparison":
        """Return what compares a model with the film at angles of incidence."""
        screen = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
        return Comparison(screen, lab(screen.to_xyz(self.at(angles_deg)), screen.white))


@dataclass(frozen=True, eq=False)
class Comparison:
    """The film's colours at some angles, to compare a model's with.

    Parameters
    ----------
    screen : ColourSystem
        Linear Rec.709.
    film : float array, shape (A, 3)
        L*a*b* of the film.
    """

    screen: ColourSystem
    film: FloatArray

    def delta_e(self, shown: FloatArray) -> FloatArray:
        """CIEDE2000 of linear Rec.709 colours that a model shows, (..., A, 3): (..., A)."""
        return delta_e_2000(self._lab(shown), self.film)

    def lab_difference(self, shown: FloatArray) -> FloatArray:
        """L*a*b* of the same less that of the film: (..., A, 3), smooth where both are equal."""
        return self._lab(shown) - self.film

    def _lab(self, shown: FloatArray) -> FloatArray:
        return lab(self.screen.to_xyz(shown), self.screen.white)


def check_fittable(spec: Spec) -> None:
    """Refuse a spec whose table lacks the angles that a fit is over; raises `SpecError`."""
    cosines = cos_theta_values(spec.table.cos_theta)
    if cosines[0] > np.cos(np.radians(FITTED_DEG[-1])) or cosines[-1] < 1:
        remedy = "table.cos_theta = 64 has all angles"
        expected = f"cosines from {np.cos(np.radians(FITTED_DEG[-1])):.3f} or less to 1, for a fit"
        raise SpecError("table.cos_theta", expected, f"{cosines[0]:g} to {cosines[-1]:g}", remedy)
    if cosines.size < FEWEST_COSINES:
        expected = f"at least {FEWEST_COSINES} cosines, between which the fit takes its colours from"
        raise SpecError("table.cos_theta", expected, f"{cosines.size}", "table.cos_theta = 64 is enough")
