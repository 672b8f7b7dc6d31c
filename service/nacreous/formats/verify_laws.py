"""Whether the numbers of a file can be those of a passive surface."""

from collections.abc import Iterator, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from nacreous.formats.contents import Contents
from nacreous.formats.spec_axes import AXES

__all__ = ["check_densities", "check_energy", "check_finite", "check_shares", "quantities"]

_LEAST, _LARGEST = -1e-6, 1 + 2e-5
"""What single precision makes of a flux of 0 and 1 at worst."""
_LARGEST_ALBEDO = 1 + 1e-3
"""The same of an albedo, which is an integral over directions."""
_LARGEST_SHARES: Mapping[str, float] = MappingProxyType(
    dict.fromkeys(("R_s", "R_p", "T_s", "T_p", "R", "T"), _LARGEST)
    | dict.fromkeys(("E_r", "E_t", "E_r_mean", "E_t_mean"), _LARGEST_ALBEDO)
)
"""Shares of the incident flux, and how much they can be; colours and angles may be negative."""
_DENSITIES = ("f_r", "f_t")
"""Values per steradian, which have no largest."""
_PAIRS = (("R_s", "T_s"), ("R_p", "T_p"), ("E_r", "E_t"), ("E_r_mean", "E_t_mean"))
"""What is reflected and what is transmitted of the same light."""


def quantities(contents: Contents) -> dict[str, NDArray[np.number]]:
    """Return the numbers of a file that are not axes."""
    return {
        name: array
        for name, array in contents.arrays.items()
        if name not in AXES and array.dtype.kind in "biuf" and array.size
    }


def check_finite(contents: Contents) -> Iterator[str]:
    """Yield what holds infinities or NaN."""
    for name, array in quantities(contents).items():
        bad = int(np.count_nonzero(~np.isfinite(array)))
        if bad:
            yield f"{name}: expected finite values, got {bad} that are not"


def check_shares(contents: Contents) -> Iterator[str]:
    """Yield the shares of the light that are below 0 or above 1."""
    found = quantities(contents)
    for name in found.keys() & _LARGEST_SHARES.keys():
        least, largest = np.fmin.reduce(found[name], None), np.fmax.reduce(found[name], None)
        if least < _LEAST or largest > _LARGEST_SHARES[name]:
            yield f"{name}: expected a share from 0 to 1, got {least:.6g} to {largest:.6g}"


def check_densities(contents: Contents) -> Iterator[str]:
    """Yield the BSDFs that are negative, more than the rounding of their largest value explains."""
    found = quantities(contents)
    for name in found.keys() & set(_DENSITIES):
        least, largest = np.fmin.reduce(found[name], None), np.fmax.reduce(found[name], None)
        if least < _LEAST * max(largest, 1):
            yield f"{name}: expected values of 0 and more, got {least:.6g}"


def check_energy(contents: Contents) -> Iterator[str]:
    """Yield what reflects and transmits more light than there is."""
    found = quantities(contents)
    for reflected, transmitted in _PAIRS:
        r, t = (found.get(name, np.zeros(1)) for name in (reflected, transmitted))
        if r.shape == t.shape:
            largest = np.fmax.reduce(r + t, None)
            if largest > _LARGEST_SHARES[reflected]:
                yield f"{reflected} + {transmitted}: expected at most 1, got {largest:.6g}"
