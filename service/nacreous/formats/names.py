"""The formats by name; light to import, so that the command line can name them before it needs them."""

from enum import StrEnum

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
