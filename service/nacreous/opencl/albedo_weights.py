"""Which angles to its facets a rough surface takes light at: the host of kernels/albedo_weights.cl."""

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import Microsurface, facet_rows, surface_arguments
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_table, row_tiles, step_of
from nacreous.opencl.upload import upload
from nacreous.optics.facets import FacetRule, facet_quadrature, incident_azimuths

__all__ = ["AlbedoProblem", "albedo_weights"]

_MOST_FACETS = 2**21
"""Facets that are held at a time, of all roughnesses together: 64 MB in double precision."""
LEAST_COSINE = 1e-5
"""Cosine that stands for grazing incidence, where masking and light vanish together."""


@dataclass(frozen=True, eq=False)
class AlbedoProblem:
    """The geometry of an albedo.

    Parameters
    ----------
    surface : Microsurface
    side : Side
        Whether its facets reflect all light, or transmit all of it.
    cos_theta : float array, shape (A,)
    nodes : int
        Cosines at the facets, equally spaced over [0, 1], that the film is known at.
    rule : FacetRule
    eta : float
        Index of the incident medium over that of the substrate, by which transmitted light is refracted.
    """

    surface: Microsurface
    side: Side
    cos_theta: NDArray[np.float64]
    nodes: int
    rule: FacetRule
    eta: float = 1.0


def albedo_weights(
    device: Device,
    problem: AlbedoProblem,
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.float64]:
    """Share of the light from each angle that leaves by facets at each node, shape (R, A, nodes).

    Its product with the film's R or T at the nodes is the albedo; its sum is that of facets which reflect or
    transmit everything. An anisotropic surface's is the mean over the azimuths of the light.

    Raises
    ------
    BudgetError
        The array is larger than the byte budget; nothing is allocated.
    """
    surface, rule, nodes = problem.surface, problem.rule, problem.nodes
    shape = (len(surface.alphas), len(problem.cos_theta), nodes)
    require(f"weights of {' x '.join(map(str, shape))} nodes", int(np.prod(shape)) * 3 * 8)
    lanes = lanes or device.lanes(precision)
    numbers = (*surface.build_numbers, ("TRANSMISSION", problem.side.value))
    kernel = kernel_of(device, Build("albedo_weights", precision, lanes, numbers))
    incidence = upload(device, np.maximum(problem.cos_theta, LEAST_COSINE), precision.dtype)
    scalars = np.array(problem.eta, precision.dtype)[()], np.int32(nodes)
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
