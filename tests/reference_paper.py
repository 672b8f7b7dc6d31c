"""Equations of Wu & Zheng 2015 as printed and corrected: 2, 3, 7, 8 for a film, 4, 5 for several, 9, 10, 13.

The tests show that the corrected forms agree with the kernels and that the printed ones do not. r_1, t_1
belong to the first boundary, r_2, t_2 to the second (equation 10); delta is the phase of equation 6, complex
where the film absorbs. Everything is elementwise.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]


class SingleFilm(NamedTuple):
    """One polarisation of one film: the quantities that equations 2 to 8 are made of."""

    r_1: Complex
    r_2: Complex
    t_1: Complex
    t_2: Complex
    delta: Complex
    flux_ratio: Real
    """Re(n_2 cos theta_2) / (n_0 cos theta_0) for s, with the conjugate of the cosine for p."""
    printed_flux_ratio: Real
    """n_2 cos theta_1 / (n_0 cos theta_0), the prefactor that equation 8 prints."""


def single_film(
    index: tuple[complex, complex, complex], thickness_nm: float, wavelength_nm: Real, cos_theta: float
) -> tuple[SingleFilm, SingleFilm]:
    """Equations 6 and 10 for a film of index[1] between index[0] and index[2]: (s, p)."""
    n = np.asarray(index, complex)
    cos = np.sqrt(1 - (n[0] / n) ** 2 * (1 - cos_theta**2))  # Snell's law
    delta = 4 * np.pi / wavelength_nm * n[1] * thickness_nm * cos[1]
    printed_flux_ratio = (n[2] * cos[1] / (n[0] * cos[0])).real
    (r_1s, t_1s), (r_2s, t_2s) = (equation_10_perpendicular(*n[j : j + 2], *cos[j : j + 2]) for j in (0, 1))
    (r_1p, t_1p), (r_2p, t_2p) = (equation_10_parallel(*n[j : j + 2], *cos[j : j + 2]) for j in (0, 1))
    s_flux, p_flux = ((n[2] * c).real / (n[0] * cos[0]).real for c in (cos[2], cos[2].conj()))
    return (
        SingleFilm(r_1s, r_2s, t_1s, t_2s, delta, s_flux, printed_flux_ratio),
        SingleFilm(r_1p, r_2p, t_1p, t_2p, delta, p_flux, printed_flux_ratio),
    )


def equation_2(f: SingleFilm) -> Complex:
    """Amplitude of reflection; printed correctly."""
    wave = np.exp(1j * f.delta)
    return (f.r_1 + f.r_2 * wave) / (1 + f.r_1 * f.r_2 * wave)


def equation_3_printed(f: SingleFilm) -> Complex:
    """Amplitude of transmission as printed: the coefficients are added and the half phase is missing."""
    return (f.t_1 + f.t_2) / (1 + f.r_1 * f.r_2 * np.exp(1j * f.delta))


def equation_3(f: SingleFilm) -> Complex:
    """Amplitude of transmission, corrected: t_1 t_2, and exp(i delta / 2) for the one passage."""
    return f.t_1 * f.t_2 * np.exp(0.5j * f.delta) / (1 + f.r_1 * f.r_2 * np.exp(1j * f.delta))


def equation_7_printed(f: SingleFilm) -> Complex:
    """Reflectance as printed: squares instead of squared moduli, so that it is complex for complex r."""
    cross = 2 * f.r_1 * f.r_2 * np.cos(f.delta)
    return (f.r_1**2 + f.r_2**2 + cross) / (1 + f.r_1**2 * f.r_2**2 + cross)


def equation_7(f: SingleFilm) -> Real:
    """Reflectance corrected for complex r_1, r_2 and delta."""
    wave_2 = f.r_2 * np.exp(1j * f.delta)
    numerator = np.abs(f.r_1) ** 2 + np.abs(wave_2) ** 2 + 2 * np.real(f.r_1.conj() * wave_2)
    return np.asarray(numerator / _bounces(f))


def equation_8_printed(f: SingleFilm) -> Complex:
    """Transmittance as printed: the angle of the film in the prefactor, squares instead of squared moduli."""
    cross = 2 * f.r_1 * f.r_2 * np.cos(f.delta)
    return f.printed_flux_ratio * f.t_1**2 * f.t_2**2 / (1 + f.r_1**2 * f.r_2**2 + cross)


def equation_8(f: SingleFilm) -> Real:
    """Transmittance corrected: the angle of the substrate in the prefactor, the decay of one passage."""
    return np.asarray(f.flux_ratio * np.abs(f.t_1 * f.t_2) ** 2 * np.exp(-f.delta.imag) / _bounces(f))


def _bounces(f: SingleFilm) -> Real:
    """Denominator of equations 7 and 8: the squared modulus of that of equation 2."""
    product = f.r_1 * f.r_2 * np.exp(1j * f.delta)
    bounces: Real = 1 + np.abs(product) ** 2 + 2 * np.real(product)
    return bounces


class Multilayer(NamedTuple):
    """One polarisation of several films: what equations 4 and 5 are made of, from the outside inwards."""

    r: list[Complex]
    t: list[Complex]
    delta: list[Complex]


def multilayer(
    index: Sequence[complex], thickness_nm: Sequence[float], wavelength_nm: Real, cos_theta: float
) -> tuple[Multilayer, Multilayer]:
    """Equations 6 and 10 for every boundary and layer: (s, p)."""
    n = np.asarray(index, complex)
    cos = np.sqrt(1 - (n[0] / n) ** 2 * (1 - cos_theta**2))  # Snell's law
    layers = zip(n[1:-1], cos[1:-1], thickness_nm, strict=True)
    delta = [4 * np.pi / wavelength_nm * n_j * H_j * cos_j for n_j, cos_j, H_j in layers]
    boundaries = [(*n[j : j + 2], *cos[j : j + 2]) for j in range(n.size - 1)]
    s = [equation_10_perpendicular(*boundary) for boundary in boundaries]
    p = [equation_10_parallel(*boundary) for boundary in boundaries]
    return _multilayer(s, delta), _multilayer(p, delta)


def _multilayer(boundaries: Sequence[tuple[Complex, Complex]], delta: list[Complex]) -> Multilayer:
    return Multilayer([r for r, _ in boundaries], [t for _, t in boundaries], delta)


def equation_4(m: Multilayer) -> Complex:
    """Amplitude of reflection, with r_(M+1) read as that of all that lies below."""
    return _composed(m, [np.ones_like(delta) for delta in m.delta])[0]


def equation_5_printed(m: Multilayer) -> Complex:
    """Amplitude of transmission as printed, without the phase of a passage."""
    return _composed(m, [np.ones_like(delta) for delta in m.delta])[1]


def equation_5(m: Multilayer) -> Complex:
    """Amplitude of transmission, with exp(i delta / 2) for the passage of each layer."""
    return _composed(m, [np.exp(0.5j * delta) for delta in m.delta])[1]


def _composed(m: Multilayer, passages: list[Complex]) -> tuple[Complex, Complex]:
    r, t = m.r[-1], m.t[-1]
    for r_j, t_j, delta, passage in zip(m.r[-2::-1], m.t[-2::-1], m.delta[::-1], passages[::-1], strict=True):
        bounces = 1 + r_j * r * np.exp(1j * delta)
        r, t = (r_j + r * np.exp(1j * delta)) / bounces, t_j * t * passage / bounces
    return r, t


def equation_9_printed(optical_path_nm: float, orders: Sequence[int]) -> Real:
    """Wavelengths that 2 n_1 H cos theta_1 = m lambda names."""
    return optical_path_nm / np.asarray(orders, float)


def equation_9(optical_path_nm: float, orders: Sequence[int]) -> Real:
    """Wavelengths of the maxima where one of the two reflections turns the phase: (m + 1/2) lambda."""
    return optical_path_nm / (np.asarray(orders, float) + 0.5)


def equation_10_perpendicular(
    n_1: complex, n_2: complex, cos_1: complex, cos_2: complex
) -> tuple[Complex, Complex]:
    """Equation 10, s: (r, t)."""
    total = n_1 * cos_1 + n_2 * cos_2
    return np.asarray((n_1 * cos_1 - n_2 * cos_2) / total), np.asarray(2 * n_1 * cos_1 / total)


def equation_10_parallel(
    n_1: complex, n_2: complex, cos_1: complex, cos_2: complex
) -> tuple[Complex, Complex]:
    """Equation 10, p: (r, t)."""
    total = n_2 * cos_1 + n_1 * cos_2
    return np.asarray((n_2 * cos_1 - n_1 * cos_2) / total), np.asarray(2 * n_1 * cos_1 / total)


def equation_13_printed(i: Real, o: Real, h: Real) -> float:
    """Masking as printed, with omega_o . omega_h below both terms; directions are unit vectors (3,)."""
    tilt = 2 * h[2] / abs(o @ h)
    return float(min(1, tilt * abs(o[2]), tilt * abs(i[2])))


def equation_13(i: Real, o: Real, h: Real) -> float:
    """Masking of Torrance and Sparrow for reflection and refraction: each direction over its own cosine."""
    return float(min(1, 2 * h[2] * abs(o[2]) / abs(o @ h), 2 * h[2] * abs(i[2]) / abs(i @ h)))
