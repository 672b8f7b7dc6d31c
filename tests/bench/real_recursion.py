"""The same recursion in pairs of real arrays, with real arithmetic in clear layers: JAX at its fastest.

Compilers for CPUs make poor code of complex numbers. Written out in real and imaginary parts, and with half
of the work saved in layers that do not absorb, JAX runs it about twice as fast as `complex_recursion`. A
complex number is a pair (re, im).
"""

from collections.abc import Sequence
from types import ModuleType

import numpy as np

from bench.complex_recursion import TWO_PI, Array

Pair = tuple[Array, Array]


def film(
    xp: ModuleType,
    index: Pair,
    clear: Sequence[bool],
    thickness_nm: Sequence[float],
    wavelength_nm: Array,
    cos_theta: Array,
) -> tuple[Array, Array, Array, Array]:
    """R_s, R_p, T_s, T_p in single precision.

    Parameters
    ----------
    xp
        numpy or jax.numpy.
    index
        n and k, float32, (M+2, L) each.
    clear
        M flags: the layer neither absorbs nor totally reflects.
    thickness_nm
        M numbers.
    wavelength_nm, cos_theta
        float32, (L,) and (A, 1).
    """
    n, k = index
    beta_2 = n[0] * n[0] * (1 - cos_theta) * (1 + cos_theta)  # (A, L)
    kz_sub = xp.sqrt(n[-1] * n[-1] - beta_2)
    b_sub = (kz_sub, kz_sub / (n[-1] * n[-1]))
    zero = xp.zeros_like(beta_2)
    fields = [((zero + 1, zero), (b, zero)) for b in b_sub]
    decay = zero
    for j in range(len(thickness_nm), 0, -1):
        d_over_wavelength = thickness_nm[j - 1] / wavelength_nm
        if clear[j - 1]:
            fields = _clear_layer(xp, n[j], beta_2, d_over_wavelength, fields)
        else:
            fields, damping = _absorbing_layer(xp, (n[j], k[j]), beta_2, d_over_wavelength, fields)
            decay = decay + damping
    passed = xp.exp(-2 * decay)
    b_0 = (n[0] * cos_theta, cos_theta / n[0])
    s, p = (_intensities(*pair, a, b, passed) for pair, a, b in zip(fields, b_0, b_sub, strict=True))
    return s[0], p[0], s[1], p[1]


def _clear_layer(
    xp: ModuleType, n: Array, beta_2: Array, d_over_wavelength: Array, fields: list[tuple[Pair, Pair]]
) -> list[tuple[Pair, Pair]]:
    """Fields of s and p at the front of a layer whose kz is real."""
    n_2 = n * n
    kz = xp.sqrt(n_2 - beta_2)
    cos_delta, sin_delta = _cos_and_sin(xp, d_over_wavelength * kz)
    ahead = []
    for (E, H), weight in zip(fields, (np.float32(1), n_2), strict=True):
        sin_over_b, sin_b = sin_delta / kz * weight, sin_delta * kz / weight
        e_front = cos_delta * E[0] + sin_over_b * H[1], cos_delta * E[1] - sin_over_b * H[0]
        h_front = cos_delta * H[0] + sin_b * E[1], cos_delta * H[1] - sin_b * E[0]
        ahead.append((e_front, h_front))
    return ahead


def _absorbing_layer(
    xp: ModuleType, index: Pair, beta_2: Array, d_over_wavelength: Array, fields: list[tuple[Pair, Pair]]
) -> tuple[list[tuple[Pair, Pair]], Array]:
    """Fields of s and p at the front of a layer whose kz is complex, and the decay taken out of them."""
    n_2 = _times(index, index)
    kz = _square_root(xp, (n_2[0] - beta_2, n_2[1]))
    c, s = _cos_and_sin(xp, d_over_wavelength * kz[0])
    damping = TWO_PI * d_over_wavelength * kz[1]
    lost = xp.expm1(-2 * damping) * np.float32(0.5)
    ch, sh = 1 + lost, -lost
    cos_delta, sin_delta = (c * ch, -s * sh), (s * ch, c * sh)
    sin_over_kz, sin_kz = _times(sin_delta, _reciprocal(kz)), _times(sin_delta, kz)
    s_wave = _step(cos_delta, sin_over_kz, sin_kz, fields[0])
    p_wave = _step(cos_delta, _times(sin_over_kz, n_2), _times(sin_kz, _reciprocal(n_2)), fields[1])
    return [s_wave, p_wave], damping


def _step(cos_delta: Pair, sin_over_b: Pair, sin_b: Pair, fields: tuple[Pair, Pair]) -> tuple[Pair, Pair]:
    """Fields at the front of a layer from those at its back."""
    E, H = fields
    e_front = _minus_i_times(_times(cos_delta, E), _times(sin_over_b, H))
    h_front = _minus_i_times(_times(cos_delta, H), _times(sin_b, E))
    return e_front, h_front


def _intensities(E: Pair, H: Pair, b_0: Array, b_sub: Array, passed: Array) -> tuple[Array, Array]:
    """R and T from the fields at the front of the film."""
    q_re, q_im = b_0 * E[0] + H[0], b_0 * E[1] + H[1]
    m_re, m_im = b_0 * E[0] - H[0], b_0 * E[1] - H[1]
    scale = 1 / (q_re * q_re + q_im * q_im)
    return (m_re * m_re + m_im * m_im) * scale, 4 * b_0 * b_sub * scale * passed


def _cos_and_sin(xp: ModuleType, turns: Array) -> tuple[Array, Array]:
    phase = TWO_PI * (turns - xp.rint(turns))
    return xp.cos(phase), xp.sin(phase)


def _minus_i_times(a: Pair, b: Pair) -> Pair:
    """Subtract: a - i b."""
    return a[0] + b[1], a[1] - b[0]


def _times(a: Pair, b: Pair) -> Pair:
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def _reciprocal(z: Pair) -> Pair:
    scale = 1 / (z[0] * z[0] + z[1] * z[1])
    return z[0] * scale, -z[1] * scale


def _square_root(xp: ModuleType, z: Pair) -> Pair:
    """Root in the first quadrant of z with Im z >= 0, without cancellation."""
    x, y = z
    larger = xp.sqrt((xp.sqrt(x * x + y * y) + abs(x)) * np.float32(0.5))
    smaller = y / (2 * larger)
    return xp.where(x >= 0, larger, smaller), xp.where(x >= 0, smaller, larger)
