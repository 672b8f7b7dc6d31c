"""Which angles to its facets a rough surface takes light at: the host of kernels/albedo_weights.cl."""

from itertools import product

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_problem import upload
from nacreous.opencl.microsurface import Microsurface, facet_rows, surface_arguments
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_table, row_tiles, step_of
from nacreous.optics.facets import FacetRule, facet_quadrature, incident_azimuths

__all__ = ["reflection_weights", "transmission_weights"]

_MOST_FACETS = 2**21
"""Facets that are held at a time, of all roughnesses together: 64 MB in double precision."""
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
) -> NDArray[np.float64]:
    """Share of the light from each angle that is reflected at each node, if every facet reflects all.

    Their product with the film's R at the nodes, cosines equally spaced over [0, 1], is the albedo; their
    sum is that of a perfect mirror's facets.

    An anisotropic surface's are averaged over the azimuths of the light.

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
) -> NDArray[np.float64]:
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
) -> NDArray[np.float64]:
    shape = (len(surface.alphas), len(cos_theta), nodes)
    require(f"weights of {' x '.join(map(str, shape))} nodes", int(np.prod(shape)) * 3 * 8)
    lanes = lanes or device.lanes(precision)
    numbers = (*surface.build_numbers, ("TRANSMISSION", transmission))
    kernel = kernel_of(device, Build("albedo_weights", precision, lanes, numbers))
    incidence = upload(device, np.maximum(cos_theta, LEAST_COSINE), precision.dtype)
    scalars = np.array(eta, precision.dtype)[()], np.int32(nodes)
    phi = incident_azimuths(surface.alphas, rule)
    groups = _groups(len(surface.alphas), phi.size * rule.facets(surface.alphas))
    weights = np.zeros(shape)
    for done, (group, p) in enumerate(product(groups, range(phi.size))):
        part = surface.part(group)
        facets = facet_rows(facet_quadrature(part.distribution, part.alphas, rule, phi[p]), lanes)
        arguments = (
            *surface_arguments(device, part, precision),
            upload(device, facets, precision.dtype),
            np.int32(facets.shape[-1]),
            incidence,
            np.int32(shape[1]),
            *np.array([np.cos(phi[p]), np.sin(phi[p])], precision.dtype),
            *scalars,
        )
        rows = empty_table(len(part.alphas) * shape[1], nodes, precision.dtype)
        runner = TileRunner(device, kernel, (rows,), nodes, (1,))
        told = step_of(observer, done, len(groups) * phi.size)
        for tile in row_tiles(len(rows), facets.shape[-1], nodes * rows.itemsize, told):
            runner.run(tile, (*arguments, *tile.bounds), (tile.rows,))
        weights[group] += rows.reshape(-1, *shape[1:]) / phi.size
    return weights


def _groups(roughnesses: int, facets: int) -> list[slice]:
    """Cut an axis of roughnesses into parts whose facets the device can hold."""
    size = max(1, _MOST_FACETS // facets)
    return [slice(first, first + size) for first in range(0, roughnesses, size)]
