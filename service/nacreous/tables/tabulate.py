"""From a spec to a table."""

import functools
from collections.abc import Callable, Collection, Mapping
from importlib.metadata import version
from types import MappingProxyType

from nacreous.opencl.device import Device, open_device
from nacreous.opencl.sources import kernels_hash
from nacreous.opencl.tiles import Observer
from nacreous.tables.albedo.table import compute_albedo
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.bsdf.table import compute_bsdf
from nacreous.tables.computed import Computed, wanted_parts
from nacreous.tables.fresnel.table import compute_fresnel
from nacreous.tables.identity import table_id
from nacreous.tables.measured.mbsdf import compute_mbsdf
from nacreous.tables.measured.merl import compute_merl
from nacreous.tables.measured.mueller import compute_mueller
from nacreous.tables.measured.rgl import compute_rgl_colours, compute_rgl_spectra
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import LABELS, Spec
from nacreous.tables.table import Part, Table

__all__ = ["Observer", "tabulate_table"]

_QUANTITIES: Mapping[str, Callable[[Device, Spec, frozenset[Part], Observer | None], Computed]] = (
    MappingProxyType({"fresnel": compute_fresnel, "albedo": compute_albedo, "bsdf": compute_bsdf})
)

_MEASURED: Mapping[Sampling, Callable[[Device, Spec, Observer | None], Computed]] = MappingProxyType(
    {
        Sampling.RGL_SPECTRA: compute_rgl_spectra,
        Sampling.RGL_COLOURS: compute_rgl_colours,
        Sampling.MERL: compute_merl,
        Sampling.MBSDF: compute_mbsdf,
        Sampling.MUELLER: compute_mueller,
    }
)
"""What is sampled where readers of measured materials want it: a bsdf each."""


def tabulate_table(
    spec: Spec,
    parts: Collection[Part] | None = None,
    *,
    sampling: Sampling = Sampling.AXES,
    observer: Observer | None = None,
) -> Table:
    """Compute a table.

    Parameters
    ----------
    spec : Spec
    parts : collection of Part, optional
        What is computed along the spec's axes; everything that the spec has, without it. A spec whose
        wavelengths do not span the visible has no colour.
    sampling : Sampling
        Along the axes of the spec, or where the readers of a file want it; the latter is one whole.
    observer : callable, optional
        Told the fraction done; what it raises ends the work.

    Raises
    ------
    SpecError
        A material, a name, an axis or a surface of the spec cannot be used.
    BudgetError
        The table is larger than the byte budget; nothing has been allocated.
    DeviceError, NumericalError
    """
    device = open_device()
    if sampling is Sampling.AXES:
        wanted = wanted_parts(parts, wavelength_values_nm(spec.table.wavelength_nm))
        computed = _QUANTITIES[spec.table.quantity](device, spec, wanted, observer)
    else:
        computed = _MEASURED[sampling](device, spec, observer)
    return Table(spec, computed.coords, computed.variables, _provenance(spec, device, computed), sampling)


@functools.cache
def _version() -> str:
    return version("nacreous")  # which reads a file of the installation


def _provenance(spec: Spec, device: Device, computed: Computed) -> dict[str, str]:
    return {
        "id": table_id(spec),
        "version": _version(),
        "spec": spec.model_dump_json(exclude=set(LABELS)),  # the same id is the same bytes
        "certificate": computed.certificate.to_json(),
        "precision": computed.precision.name.lower(),
        "device": f"{device.info.platform}, {device.info.name}, {device.info.version}",
        "kernels": kernels_hash(),
    }
