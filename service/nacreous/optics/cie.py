"""Standard observers and illuminants of the CIE.

The common ones ship as two small tables, written from colour-science by `write_tables`, because importing
colour-science takes longer than computing a lookup texture. Every other name is looked up there.
"""

import functools
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.optics.value import did_you_mean

__all__ = ["colour_matching_functions", "illuminant_power", "write_tables"]

FloatArray = NDArray[np.float64]

OBSERVERS = ("CIE 1931 2 Degree Standard Observer", "CIE 1964 10 Degree Standard Observer")
ILLUMINANTS = ("A", "C", "D50", "D55", "D65", "D75", "E")

_OBSERVER_TABLE = Path(__file__).with_name("cie_observers.csv")
_ILLUMINANT_TABLE = Path(__file__).with_name("cie_illuminants.csv")


def colour_matching_functions(observer: str) -> tuple[FloatArray, FloatArray]:
    """Wavelengths in nm, shape (N,), and x, y and z of the observer, shape (3, N).

    Raises
    ------
    SpecError
        colour-science has no observer of this name.
    """
    if observer in OBSERVERS:
        table = _shipped(_OBSERVER_TABLE)
        first = 1 + 3 * OBSERVERS.index(observer)
        return table[:, 0], table[:, first : first + 3].T
    colour = _colour_science()
    names = {name for name in colour.MSDS_CMFS if "Standard Observer" in name or "Cone" in name}
    if observer not in names:
        raise _unknown("colour.observer", "a standard observer", observer, names, OBSERVERS)
    functions = colour.MSDS_CMFS[observer]
    return np.asarray(functions.wavelengths), np.asarray(functions.values).T


def illuminant_power(illuminant: str) -> tuple[FloatArray, FloatArray]:
    """Wavelengths in nm and relative spectral power of the illuminant, both of shape (N,).

    Raises
    ------
    SpecError
        colour-science has no illuminant of this name.
    """
    if illuminant in ILLUMINANTS:
        table = _shipped(_ILLUMINANT_TABLE)
        return table[:, 0], table[:, 1 + ILLUMINANTS.index(illuminant)]
    colour = _colour_science()
    if illuminant not in colour.SDS_ILLUMINANTS:
        names = set(colour.SDS_ILLUMINANTS)
        raise _unknown("colour.illuminant", "an illuminant", illuminant, names, ILLUMINANTS)
    power = colour.SDS_ILLUMINANTS[illuminant]
    return np.asarray(power.wavelengths), np.asarray(power.values)


@functools.cache
def _shipped(path: Path) -> FloatArray:
    """Read a table, once; nobody may write to it."""
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    table.flags.writeable = False
    return table


def write_tables() -> None:
    """Write the two shipped tables from colour-science's data."""
    colour = _colour_science()
    observers = [colour.MSDS_CMFS[name] for name in OBSERVERS]
    columns = [observers[0].wavelengths, *(row for o in observers for row in np.asarray(o.values).T)]
    header = "nm," + ",".join(f"{axis} {name}" for name in OBSERVERS for axis in "xyz")
    np.savetxt(_OBSERVER_TABLE, np.stack(columns, 1), "%.12g", ",", header=header, comments="")
    powers = [colour.SDS_ILLUMINANTS[name] for name in ILLUMINANTS]
    nm = powers[0].wavelengths
    rows = [nm, *(np.interp(nm, power.wavelengths, power.values) for power in powers)]
    header = "nm," + ",".join(ILLUMINANTS)
    np.savetxt(_ILLUMINANT_TABLE, np.stack(rows, 1), "%.12g", ",", header=header, comments="")


def _colour_science() -> Any:  # noqa: ANN401 - it has no types
    """Return colour-science, which warns on import of optional packages that nothing here uses."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    return colour


def _unknown(field: str, expected: str, got: str, known: set[str], common: tuple[str, ...]) -> SpecError:
    """Return the error of a name that is not known: names close to it, or else the common ones."""
    listed = f"{', '.join(common[:-1])} and {common[-1]}"
    remedy = did_you_mean(got, known, otherwise=f"common names are {listed}")
    return SpecError(field, f"{expected} known to colour-science", repr(got), remedy)
