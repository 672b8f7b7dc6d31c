"""A rough surface as the kernels take it: its roughnesses, what it is built for, and its buffers."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import TileRunner, empty_table, row_tiles
from nacreous.opencl.upload import upload
from nacreous.optics.facets import FacetRule, facet_quadrature, is_isotropic

__all__ = ["Microsurface", "facet_rows", "microsurface", "surface_arguments"]

_DISTRIBUTIONS = ("ashikhmin-shirley", "blinn", "phong", "ggx", "beckmann")
_MASKINGS = ("v-cavity", "smith", "smith-separable")
"""In the order of the numbers in kernels/microfacet.clh."""

_CLOSED_FORMS = ("ggx", "beckmann")
"""Distributions whose projected area the kernels know."""
_NO_AREAS, _AREA_COSINES, _AREA_AZIMUTHS = (1, 1), 257, 17
"""Size of a table of areas; linear interpolation in it is within 1e-5 (tests/opencl/test_microfacets.py)."""
_AREA_RULE = FacetRule(128, 32, 1)


@dataclass(frozen=True, eq=False)
class Microsurface:
    """Everything that decides D and G; `microsurface` makes one.

    Parameters
    ----------
    distribution, masking : str
        As `nacreous.optics.surface` names them.
    alphas : float array, shape (R, 2)
        Roughness along x and y, for each of R roughnesses.
    areas : float array, shape (R, cosines, azimuths)
        Projected areas as kernels/microfacet.clh looks them up; zeros, one each, where it needs none.
    """

    distribution: str
    masking: str
    alphas: NDArray[np.float64]
    areas: NDArray[np.float64]

    def part(self, roughnesses: slice) -> "Microsurface":
        """Return the surface at some of its roughnesses."""
        return replace(self, alphas=self.alphas[roughnesses], areas=self.areas[roughnesses])

    @property
    def build_numbers(self) -> tuple[tuple[str, int], ...]:
        """What kernels/microfacet.clh is compiled for."""
        return _numbers(self.distribution, self.masking, self.areas.shape[1:])


def microsurface(
    device: Device, distribution: str, masking: str, alphas: NDArray[np.float64]
) -> Microsurface:
    """Return the surface of these roughnesses, (R, 2), its projected areas integrated where they must be."""
    areas = np.zeros((len(alphas), *_area_shape(distribution, masking, alphas)))
    if areas.shape[1:] != _NO_AREAS:
        numbers = _numbers(distribution, masking, areas.shape[1:])
        if is_isotropic(alphas):  # the same from x as from y
            areas[:] = _projected_areas(device, distribution, numbers, alphas, 1.0)[:, :, None]
        else:
            for column, x_share in enumerate(np.linspace(0, 1, _AREA_AZIMUTHS)):
                areas[:, :, column] = _projected_areas(device, distribution, numbers, alphas, x_share)
    return Microsurface(distribution, masking, alphas, areas)


def surface_arguments(device: Device, surface: Microsurface, precision: Precision) -> tuple[Any, Any]:
    """Upload what the kernels take first: ``alphas`` and ``areas``."""
    return (
        upload(device, surface.alphas, precision.dtype),
        upload(device, surface.areas, precision.dtype),
    )


def facet_rows(facets: NDArray[np.float64], lanes: int) -> NDArray[np.float64]:
    """Pad facets (R, 4, N) to whole lanes, (R, 4, stride), with copies of the last that weigh nothing."""
    missing = -facets.shape[-1] % lanes
    padded = np.pad(facets, ((0, 0), (0, 0), (0, missing)), mode="edge")
    padded[:, 3, facets.shape[-1] :] = 0
    return padded


def _numbers(distribution: str, masking: str, area_shape: tuple[int, ...]) -> tuple[tuple[str, int], ...]:
    return (
        ("DISTRIBUTION", _DISTRIBUTIONS.index(distribution)),
        ("MASKING", _MASKINGS.index(masking)),
        ("AREA_COSINES", area_shape[0]),
        ("AREA_AZIMUTHS", area_shape[1]),
    )


def _area_shape(distribution: str, masking: str, alphas: NDArray[np.float64]) -> tuple[int, int]:
    """Cosines and azimuths of the table of areas; an isotropic surface looks the same from any azimuth."""
    if masking == "v-cavity" or distribution in _CLOSED_FORMS:
        return _NO_AREAS
    return _AREA_COSINES, 2 if is_isotropic(alphas) else _AREA_AZIMUTHS


def _projected_areas(
    device: Device,
    distribution: str,
    numbers: tuple[tuple[str, int], ...],
    alphas: NDArray[np.float64],
    x_share: float,
) -> NDArray[np.float64]:
    """Run kernels/microfacet_area.cl in double precision over one column of each table, (R, cosines).

    The facets are those for light from the column's azimuth: nodes that are dense about another one leave an
    error of 4e-4 in flat directions.
    """
    precision = Precision.DOUBLE
    lanes = device.lanes(precision)
    kernel = kernel_of(device, Build("microfacet_area", precision, lanes, numbers))
    phi = np.arctan2(np.sqrt(1 - x_share) * alphas[0, 0], np.sqrt(x_share) * alphas[0, 1])
    rows = facet_rows(facet_quadrature(distribution, alphas, _AREA_RULE, float(phi)), lanes)
    arguments = (
        upload(device, alphas, precision.dtype),
        upload(device, rows, precision.dtype),
        np.int32(rows.shape[-1]),
        np.array(x_share, precision.dtype)[()],
    )
    areas = empty_table(len(alphas) * _AREA_COSINES, 1, precision.dtype)
    runner = TileRunner(device, kernel, (areas,), 1, (1,))
    for tile in row_tiles(len(areas), rows.shape[-1], areas.itemsize, None):
        runner.run(tile, (*arguments, *tile.bounds), (tile.rows,))
    return areas.reshape(len(alphas), _AREA_COSINES)
