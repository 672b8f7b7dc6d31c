"""A film evaluated at each wavelength of a path, in Dr.Jit: what a table is compared with in a rendering.

Equations 2, 3, 6, 8 and 10 of Wu & Zheng 2015, corrected (reference_paper.py), for one film between vacuum
and a substrate. Nothing is tabulated or interpolated, and nothing is taken from Nacreous's kernels.

Mitsuba is imported within the functions: the types of Dr.Jit depend on the variant.
"""

from dataclasses import dataclass
from typing import Any

from nacreous_bsdf import _plugin

Value = Any
"""A number or an array of Dr.Jit, real or complex."""


@dataclass(frozen=True)
class SingleFilm:
    """One film: complex indices of the film and of what it lies on, and the thickness."""

    index: complex
    substrate: complex
    thickness_nm: float


@dataclass(frozen=True)
class Waves:
    """One polarisation: coefficients of the amplitude at both boundaries, and Re(q_2) / q_0 of the flux."""

    r_1: Value
    t_1: Value
    r_2: Value
    t_2: Value
    flux_ratio: Value


@dataclass(frozen=True)
class DirectReflectance:
    """What the plugin asks for R, in place of a table."""

    film: SingleFilm

    def at(self, si: Value, cos_theta: Value, scale: Value, active: Value) -> Value:  # noqa: ARG002
        """Return R at the wavelengths of the paths."""
        return _spectrum(self.film, si, cos_theta, scale, _reflectance)


@dataclass(frozen=True)
class DirectTransmittance:
    """What the plugin asks for T, in place of a table."""

    film: SingleFilm

    def at(self, si: Value, cos_theta: Value, scale: Value, active: Value) -> Value:  # noqa: ARG002
        """Return T at the wavelengths of the paths."""
        return _spectrum(self.film, si, cos_theta, scale, _transmittance)


def register(name: str, film: SingleFilm) -> None:
    """Make the plugin of clients/mitsuba known to the variant under another name, with a film for its tables.

    It still reads a file, which says whether the film transmits.
    """
    import mitsuba as mi

    class DirectBSDF(_plugin()):
        def __init__(self, props: mi.Properties) -> None:
            super().__init__(props)
            self.surface.film.reflectance = DirectReflectance(film)
            if self.surface.film.transmits:
                self.surface.film.transmittance = DirectTransmittance(film)

    mi.register_bsdf(name, DirectBSDF)


def _spectrum(film: SingleFilm, si: Value, cos_theta: Value, scale: Value, share: Value) -> Value:
    import mitsuba as mi

    return mi.Spectrum([share(film, nm, cos_theta, scale) for nm in si.wavelengths])


def _reflectance(film: SingleFilm, wavelength_nm: Value, cos_theta: Value, scale: Value) -> Value:
    """Return the mean over s and p of the squared modulus of equation 2."""
    import drjit as dr

    waves, delta = _waves(film, wavelength_nm, cos_theta, scale)
    turn = dr.exp(_i() * delta)
    return sum(dr.squared_norm((w.r_1 + w.r_2 * turn) / (1 + w.r_1 * w.r_2 * turn)) for w in waves) / 2


def _transmittance(film: SingleFilm, wavelength_nm: Value, cos_theta: Value, scale: Value) -> Value:
    """Return the mean over s and p of equation 8, with the corrected prefactor."""
    import drjit as dr

    waves, delta = _waves(film, wavelength_nm, cos_theta, scale)
    turn, half = dr.exp(_i() * delta), dr.exp(_i() * delta * 0.5)
    return (
        sum(w.flux_ratio * dr.squared_norm(w.t_1 * w.t_2 * half / (1 + w.r_1 * w.r_2 * turn)) for w in waves)
        / 2
    )


def _waves(
    film: SingleFilm, wavelength_nm: Value, cos_theta: Value, scale: Value
) -> tuple[tuple[Waves, Waves], Value]:
    """Return s and p, and the phase of equation 6."""
    import drjit as dr
    import mitsuba as mi

    n = [mi.Complex2f(each.real, each.imag) for each in map(complex, (1.0, film.index, film.substrate))]
    sin_squared = 1 - dr.square(cos_theta)
    cos = [mi.Complex2f(cos_theta, 0), *(dr.sqrt(1 - sin_squared / (each * each)) for each in n[1:])]
    s = Waves(*_s(n[0], n[1], cos[0], cos[1]), *_s(n[1], n[2], cos[1], cos[2]), _flux(n, cos, cos[2]))
    p = Waves(
        *_p(n[0], n[1], cos[0], cos[1]), *_p(n[1], n[2], cos[1], cos[2]), _flux(n, cos, dr.conj(cos[2]))
    )
    return (s, p), 4 * dr.pi * scale * film.thickness_nm / wavelength_nm * n[1] * cos[1]


def _s(n_1: Value, n_2: Value, cos_1: Value, cos_2: Value) -> tuple[Value, Value]:
    """Equation 10, perpendicular: (r, t)."""
    total = n_1 * cos_1 + n_2 * cos_2
    return (n_1 * cos_1 - n_2 * cos_2) / total, 2 * n_1 * cos_1 / total


def _p(n_1: Value, n_2: Value, cos_1: Value, cos_2: Value) -> tuple[Value, Value]:
    """Equation 10, parallel: (r, t)."""
    total = n_2 * cos_1 + n_1 * cos_2
    return (n_2 * cos_1 - n_1 * cos_2) / total, 2 * n_1 * cos_1 / total


def _flux(n: list[Value], cos: list[Value], cos_2: Value) -> Value:
    """Return Re(n_2 cos theta_2) / (n_0 cos theta_0), of p with the conjugate of the cosine."""
    import drjit as dr

    return dr.real(n[2] * cos_2) / dr.real(n[0] * cos[0])


def _i() -> Value:
    import mitsuba as mi

    return mi.Complex2f(0, 1)
