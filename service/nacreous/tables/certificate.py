"""Certificates by quantity: what every file of it states of its errors."""

from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType

from nacreous.tables.albedo.certificate import AlbedoCertificate
from nacreous.tables.bsdf.certificate import BsdfCertificate
from nacreous.tables.figures import Figures
from nacreous.tables.fresnel.certificate import FresnelCertificate
from nacreous.tables.measured.certificate import (
    MbsdfCertificate,
    MeasuredCertificate,
    MuellerCertificate,
)
from nacreous.tables.sampling import Sampling

__all__ = ["certificate_fields"]

_CERTIFICATES: Mapping[str, type[Figures]] = MappingProxyType(
    {"fresnel": FresnelCertificate, "albedo": AlbedoCertificate, "bsdf": BsdfCertificate}
)

_MEASURED: Mapping[Sampling, type[MeasuredCertificate]] = MappingProxyType(
    {Sampling.MBSDF: MbsdfCertificate, Sampling.MUELLER: MuellerCertificate}
)


def certificate_fields(quantity: str, sampling: Sampling = Sampling.AXES) -> tuple[str, ...]:
    """Return the names of the figures that a table of this quantity, sampled there, is certified with."""
    measured = _MEASURED.get(sampling, MeasuredCertificate)
    certificate = _CERTIFICATES[quantity] if sampling is Sampling.AXES else measured
    return tuple(field.name for field in fields(certificate))
