"""Which angles to its facets a rough surface takes light at: the host of kernels/albedo_weights.cl."""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_problem import upload
from nacreous.opencl.microsurface import Microsurface, facet_rows, surface_arguments
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_table, row_tiles
from nacreous.optics.facets import FacetRule, facet_quadrature, incident_azimuths

__all__ = ["reflection_weights", "transmission_weights"]

LEAST_COSINE = 1e-5
"""Cosine that stands for grazing incidence, where masking and light vanish together."""


def reflection_weights(
    device: Device,
    surface: Microsurface,
    cos_theta: NDArray[np.float64],
    nodes: int,
    rule: FacetRule,
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.floating]:
    """Share of the light from each angle that is reflected at each node, if every facet reflects all.

    Their product with the film's R at the nodes, cosines equally spaced over [0, 1], is the albedo; their
    sum is that of a perfect mirror's facets.

    Returns
    -------
    float array, shape (R, A, nodes)

    Raises
    ------
    BudgetError
        The array is larger than the byte budget; nothing is allocated.
    """
    return _weights(device, surface, cos_theta, nodes, rule, precision, 0, 1.0, observer, lanes)


def transmission_weights(
    device: Device,
    surface: Microsurface,
    cos_theta: NDArray[np.float64],
    nodes: int,
    rule: FacetRule,
    precision: Precision,
    eta: float,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.floating]:
    """Share of the light that is refracted at each node, if every facet transmits all: (R, A, nodes).

    `eta` is the index of the incident medium over that of the substrate. Raises `BudgetError`.
    """
    return _weights(device, surface, cos_theta, nodes, rule, precision, 1, eta, observer, lanes)


def _weights(
    device: Device,
    surface: Microsurface,
    cos_theta: NDArray[np.float64],
    nodes: int,
    rule: FacetRule,
    precision: Precision,
    transmission: int,
    eta: float,
    observer: Observer | None,
    lanes: int | None,
) -> NDArray[np.floating]:
    rows = len(surface.alphas) * len(cos_theta)
    item = np.dtype(precision.dtype).itemsize
    require(f"weights of {rows:,} x {nodes:,} nodes", rows * nodes * item)
    lanes = lanes or device.lanes(precision)
    numbers = (*surface.build_numbers, ("TRANSMISSION", transmission))
    kernel = kernel_of(device, Build("albedo_weights", precision, lanes, numbers))
    facets = facet_rows(facet_quadrature(surface.distribution, surface.alphas, rule), lanes)
    phi = incident_azimuths(surface.alphas, rule)
    arguments = (
        *surface_arguments(device, surface, precision),
        upload(device, facets, precision.dtype),
        np.int32(facets.shape[-1]),
        upload(device, np.maximum(cos_theta, LEAST_COSINE), precision.dtype),
        np.int32(len(cos_theta)),
        upload(device, np.stack([np.cos(phi), np.sin(phi)], axis=-1), precision.dtype),
        np.int32(len(phi)),
        np.array(eta, precision.dtype)[()],
        np.int32(nodes),
    )
    weights = empty_table(rows, nodes, precision.dtype)
    runner = TileRunner(device, kernel, (weights,), nodes, (1,))
    for tile in row_tiles(rows, facets.shape[-1] * len(phi), nodes * item, observer):
        runner.run(tile, (*arguments, *tile.bounds), (tile.rows,))
    return weights.reshape(len(surface.alphas), len(cos_theta), nodes)
