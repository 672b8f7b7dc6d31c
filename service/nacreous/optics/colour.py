"""From a spectrum to a linear colour, and how far apart two colours look.

A reflectance R becomes XYZ under the illuminant, normalised so that R = 1 is white, is adapted from the
illuminant's white to the white of the space (Bradford; Lam 1985) and multiplied by the space's matrix. All of
it is linear, so it folds into three weights a wavelength.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.cie import colour_matching_functions, illuminant_power

__all__ = ["ColourSystem", "colour_system", "lab"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class _Space:
    """Primaries and white of an RGB space, as CIE 1931 xy."""

    primaries: tuple[tuple[float, float], ...]
    white: tuple[float, float]


_SPACES = {
    "Rec.709": _Space(((0.64, 0.33), (0.30, 0.60), (0.15, 0.06)), (0.3127, 0.3290)),  # ITU-R BT.709-6
    "Rec.2020": _Space(((0.708, 0.292), (0.170, 0.797), (0.131, 0.046)), (0.3127, 0.3290)),  # ITU-R BT.2020-2
    "ACEScg": _Space(((0.713, 0.293), (0.165, 0.830), (0.128, 0.044)), (0.32168, 0.33767)),  # S-2014-004
}

_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])


@dataclass(frozen=True, eq=False)
class ColourSystem:
    """Illuminant, observer and space, ready to weigh a spectrum.

    Parameters
    ----------
    observer_nm, observer : arrays, shape (N,) and (3, N)
        Colour-matching functions.
    illuminant_nm, illuminant : arrays, shape (K,)
        Relative spectral power.
    from_xyz : array, shape (3, 3)
        From XYZ, of white Y = 1 under the illuminant, to the space.
    xyz_from_space : array, shape (3, 3)
        From the space to XYZ relative to its own `white`.
    white : array, shape (3,)
        XYZ of the space's white, (1, 1, 1) in the space if it is an RGB space.
    channels : tuple of str
    """

    observer_nm: FloatArray
    observer: FloatArray
    illuminant_nm: FloatArray
    illuminant: FloatArray
    from_xyz: FloatArray
    xyz_from_space: FloatArray
    white: FloatArray
    channels: tuple[str, str, str]

    @property
    def range_nm(self) -> tuple[float, float]:
        """First and last wavelength that contributes to a colour, in nm."""
        first = max(self.observer_nm[0], self.illuminant_nm[0])
        return float(first), float(min(self.observer_nm[-1], self.illuminant_nm[-1]))

    def weights(self, wavelength_nm: FloatArray) -> FloatArray:
        """Weights of shape (3, L): the colour of a spectrum R, shape (L,), is ``weights @ R``.

        The trapezoid rule over the wavelengths, which ascend. Each component is normalised, so that a
        spectrum of 1 is white on every grid.
        """
        weights = self.from_xyz @ _xyz_weights(self, wavelength_nm)
        total = self.white if self.channels == ("X", "Y", "Z") else np.ones(3)
        normalised: FloatArray = weights * (total / weights.sum(axis=1))[:, None]
        return normalised

    def to_xyz(self, colour: FloatArray) -> FloatArray:
        """XYZ relative to `white` of colours in the space, shape (..., 3) both."""
        return colour @ self.xyz_from_space.T


def colour_system(illuminant: str, observer: str, space: str) -> ColourSystem:
    """Assemble a colour system by name.

    Parameters
    ----------
    illuminant, observer : str
        Names of colour-science.
    space : str
        ``"Rec.709"``, ``"Rec.2020"``, ``"ACEScg"``, all linear, or ``"XYZ"``.

    Raises
    ------
    SpecError
        A name is unknown.
    """
    observer_nm, functions = colour_matching_functions(observer)
    illuminant_nm, power = illuminant_power(illuminant)
    xyz = ColourSystem(
        observer_nm, functions, illuminant_nm, power, np.eye(3), np.eye(3), np.ones(3), ("X", "Y", "Z")
    )
    first, last = xyz.range_nm
    source_white = _xyz_weights(xyz, np.arange(first, last + 0.5)).sum(axis=1)
    if space == "XYZ":
        return replace(xyz, white=source_white)
    white = _xyz_of(_SPACES[space].white)
    rgb_from_xyz = _rgb_from_xyz(_SPACES[space])
    return replace(
        xyz,
        from_xyz=rgb_from_xyz @ _adaptation(source_white, white),
        xyz_from_space=np.asarray(np.linalg.inv(rgb_from_xyz), np.float64),
        white=white,
        channels=("R", "G", "B"),
    )


def lab(xyz: FloatArray, white: FloatArray) -> FloatArray:
    """CIE 1976 L*a*b* of XYZ relative to `white`, shape (..., 3) (CIE 15:2018, 8.2.1)."""
    ratio = xyz / white
    cube, knee = (6 / 29) ** 3, (6 / 29) ** 2
    f = np.where(ratio > cube, np.cbrt(ratio), ratio / (3 * knee) + 4 / 29)
    x, y, z = f[..., 0], f[..., 1], f[..., 2]
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def _xyz_weights(system: ColourSystem, wavelength_nm: FloatArray) -> FloatArray:
    observer = np.stack(
        [np.interp(wavelength_nm, system.observer_nm, f, left=0, right=0) for f in system.observer]
    )
    power = np.interp(wavelength_nm, system.illuminant_nm, system.illuminant, left=0, right=0)
    weights = observer * power * _trapezoid_steps(wavelength_nm)  # (3, L)
    normalised: FloatArray = weights / weights[1].sum()
    return normalised


def _trapezoid_steps(x: FloatArray) -> FloatArray:
    gaps = np.diff(x)
    return np.concatenate([gaps[:1], gaps[:-1] + gaps[1:], gaps[-1:]]) / 2


def _xyz_of(xy: tuple[float, float]) -> FloatArray:
    x, y = xy
    return np.array([x / y, 1.0, (1 - x - y) / y])


def _rgb_from_xyz(space: _Space) -> FloatArray:
    """From XYZ to linear RGB: the columns of the inverse are the primaries, scaled to sum to the white."""
    primaries = np.stack([_xyz_of(xy) for xy in space.primaries], axis=1)
    scale = np.linalg.solve(primaries, _xyz_of(space.white))
    matrix: FloatArray = np.linalg.inv(primaries * scale)
    return matrix


def _adaptation(source: FloatArray, target: FloatArray) -> FloatArray:
    gain = (_BRADFORD @ target) / (_BRADFORD @ source)
    matrix: FloatArray = np.linalg.inv(_BRADFORD) @ (gain[:, None] * _BRADFORD)
    return matrix
