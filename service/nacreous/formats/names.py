"""The formats by name; light to import, so that the command line can name them before it needs them."""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

__all__ = ["FormatName"]


class FormatName(StrEnum):
    """What a user calls a format; `nacreous.formats.registry` says the rest."""

    EXR = "exr"
    SPECTRAL_EXR = "spectral-exr"
    NPZ = "npz"
    NETCDF = "netcdf"
    CSV = "csv"
    PNG = "png"
    RGL = "rgl"
    RGL_RGB = "rgl-rgb"
    MERL = "merl"
    MBSDF = "mbsdf"
    MUELLER = "mueller"
    ZARR = "zarr"
    MATERIALX = "materialx"
    GLTF = "gltf"

    @property
    def advice(self) -> str:
        """For whom the format is, in one line."""
        return _ADVICE[self]


_ADVICE: Mapping[FormatName, str] = MappingProxyType(
    {
        FormatName.EXR: "lookup texture for any renderer: linear colour, float32",
        FormatName.SPECTRAL_EXR: "spectra for spectral renderers; more channels than Blender can load",
        FormatName.NPZ: "every array of the table for NumPy",
        FormatName.NETCDF: "the table with units for xarray and other scientific programs",
        FormatName.CSV: "the spectra, one row a sample, for spreadsheets",
        FormatName.PNG: "a picture of the lookup texture to look at, 8-bit sRGB",
        FormatName.RGL: "measured material with spectra for Mitsuba 3 and pbrt-v4, reflection alone",
        FormatName.RGL_RGB: "measured material in RGB for Mitsuba 3 and Falcor, reflection alone",
        FormatName.MERL: "isotropic bsdf in RGB as the MERL database has it, reflection alone",
        FormatName.MBSDF: "isotropic bsdf in RGB for hosts of MDL, transmission included",
        FormatName.MUELLER: "Mueller matrices at five wavelengths for Mitsuba 3, reflection alone",
        FormatName.ZARR: "the table with units as a zipped Zarr 3 group, for xarray and dask",
        FormatName.MATERIALX: "a material for Maya, Houdini and USD that reads the lookup texture beside it",
        FormatName.GLTF: "the nearest film that glTF and three.js can show, and how far off it is",
    }
)
