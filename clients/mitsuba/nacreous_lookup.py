"""The lookup textures of Nacreous for Mitsuba 3: RGB and spectra, read at a cosine and a thickness scale.

Texels are raw: nothing converts their colours. The first and the last of an axis hold the values at its ends,

    u = (x (N - 1) + 0.5) / N        x = 0 to 1 along an axis of N texels

Rows count from the top, as in Mitsuba's textures, so that no v is turned over. Clamped at the edges. Dr.Jit
filters them, and not the texture units of a GPU, which know 256 places between two texels.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import drjit as dr
import mitsuba as mi
import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["ColourTable", "LookupFile", "SpectralTable", "read_table"]


def read_table(file: LookupFile) -> ColourTable | SpectralTable:
    """Return the table that the current variant renders with; raises `ValueError` if the file has another."""
    return SpectralTable(file) if mi.is_spectral else ColourTable(file)


class LookupFile:
    """The channels and attributes of an EXR, checked to be of a film.

    Parameters
    ----------
    path : Path
    quantity : str
        Which one is expected, ``R`` or ``T``.
    """

    def __init__(self, path: Path, quantity: str) -> None:
        bitmap = mi.Bitmap(str(path))
        self.path, self.attributes = path, bitmap.metadata()
        if (got := self.attributes.get("nacreous:quantity", "no table of Nacreous")) != quantity:
            raise ValueError(
                f"expected {path.name} to hold {quantity} of a film, got {got}; "
                "tabulate it with table.quantity = fresnel"
            )
        self.spec = json.loads(self.attributes.get("nacreous:spec", "{}"))
        texels = np.asarray(bitmap, np.float32).reshape(bitmap.height(), bitmap.width(), -1)
        names = [field.name for field in bitmap.struct_()]
        self.channels = {name: texels[..., at] for at, name in enumerate(names)}

    def axis(self, side: str) -> LinearAxis | ExplicitAxis:
        """Return the axis of the columns, ``x``, or of the rows from the top, ``y``."""
        told = json.loads(self.attributes[f"nacreous:axis.{side}"])
        if told["mapping"] == "explicit":
            return ExplicitAxis(np.array(told["values"]))
        return LinearAxis(*told["range"], told["count"])


class ColourTable:
    """RGB over cos θ and thickness scale."""

    def __init__(self, file: LookupFile) -> None:
        space = file.attributes.get("nacreous:colour.space", "Rec.709")
        if set(file.channels) != set("RGB") or space != "Rec.709":
            raise ValueError(
                f"expected R, G, B of Rec.709, as {mi.variant()} renders, got {file.path.name} with "
                f"{len(file.channels)} channels of {space}; "
                "write film.exr with --format exr and colour.space = Rec.709"
            )
        texels = np.stack([file.channels[name] for name in "RGB"], axis=-1)
        self.texture = mi.Texture2f(mi.TensorXf(texels), use_accel=False)
        self.cos_theta, self.thickness_scale = file.axis("x"), file.axis("y")

    def at(
        self, _: mi.SurfaceInteraction3f, cos_theta: mi.Float, scale: mi.Float, active: mi.Bool
    ) -> mi.Color3f:
        """Return the colour by linear filtering, clamped at the edges."""
        place = mi.Point2f(self.cos_theta.coordinate(cos_theta), self.thickness_scale.coordinate(scale))
        return mi.Color3f(self.texture.eval(place, active))


class SpectralTable:
    """Spectra over cos θ and thickness scale, read at the wavelengths of a path."""

    def __init__(self, file: LookupFile) -> None:
        found = {name: re.fullmatch(r"T\.(\d+),(\d+)nm", name) for name in file.channels}
        spectrum = sorted((float(f"{m[1]}.{m[2]}"), name) for name, m in found.items() if m)
        if not spectrum:
            raise ValueError(
                f"expected spectra in {file.path.name}, as {mi.variant()} renders, got the channels "
                f"{', '.join(file.channels)}; write film.spectral.exr with --format spectral-exr"
            )
        texels = np.stack([file.channels[name] for _, name in spectrum], axis=-1)
        self.texture = mi.Texture3f(mi.TensorXf(texels[..., None]), use_accel=False)
        self.wavelength_nm = _sampled_axis(np.array([nm for nm, _ in spectrum]))
        self.cos_theta, self.thickness_scale = file.axis("x"), file.axis("y")

    def at(
        self, si: mi.SurfaceInteraction3f, cos_theta: mi.Float, scale: mi.Float, active: mi.Bool
    ) -> mi.Spectrum:
        """Return the spectrum by linear filtering, in wavelength as well, clamped at the edges."""
        u, v = self.cos_theta.coordinate(cos_theta), self.thickness_scale.coordinate(scale)
        places = [mi.Point3f(self.wavelength_nm.coordinate(nm), u, v) for nm in si.wavelengths]
        return mi.Spectrum([self.texture.eval(place, active)[0] for place in places])


@dataclass(frozen=True)
class LinearAxis:
    """Texels at equal steps, the first and the last at the ends."""

    first: float
    last: float
    count: int

    def coordinate(self, value: mi.Float) -> mi.Float:
        """Return the texture coordinate, between the centres of the outermost texels."""
        extent = self.last - self.first
        x = dr.clip((value - self.first) / extent, 0.0, 1.0) if extent else 0.0 * value
        return (x * (self.count - 1) + 0.5) / self.count


class ExplicitAxis:
    """Texels at ascending values (N,); they lie in a texture, from which scalar variants can gather too."""

    def __init__(self, values: np.ndarray) -> None:
        self.count = len(values)
        texels = mi.TensorXf(values.astype(np.float32)[:, None])
        self.values = mi.Texture1f(texels, use_accel=False, filter_mode=dr.FilterMode.Nearest)

    def value(self, index: mi.UInt32) -> mi.Float:
        """Return one of them."""
        return self.values.eval(mi.Vector1f((mi.Float(index) + 0.5) / self.count))[0]

    def coordinate(self, value: mi.Float) -> mi.Float:
        """Return the texture coordinate, between the centres of the outermost texels."""
        upper = dr.binary_search(0, self.count - 1, lambda index: self.value(index) <= value)
        upper = dr.maximum(upper, 1)
        below, above = self.value(upper - 1), self.value(upper)
        x = dr.clip((value - below) / (above - below), 0.0, 1.0)
        return (mi.Float(upper - 1) + x + 0.5) / self.count


def _sampled_axis(values: np.ndarray) -> LinearAxis | ExplicitAxis:
    """Return the cheaper axis where the steps are equal, to the six decimals of a channel's name."""
    even = np.linspace(values[0], values[-1], len(values))
    if np.allclose(values, even, rtol=0, atol=2e-6):
        return LinearAxis(*values[[0, -1]].tolist(), len(values))
    return ExplicitAxis(values)
