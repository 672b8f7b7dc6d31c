"""The kernels' field recursion in the complex arrays of NumPy or JAX: the same mathematics, written plainly.

The pair (E, H) is carried from the substrate outwards and the decay is taken out of each layer. Left out, to
the advantage of this version: the rescaling that films of many layers need, and the series at a critical
angle, which light that enters from air never meets.
"""

from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np

Array = Any
"""An array of NumPy or of JAX."""

TWO_PI = np.float32(2 * np.pi)


def film(
    xp: ModuleType, index: Array, thickness_nm: Sequence[float], wavelength_nm: Array, cos_theta: Array
) -> tuple[Array, Array, Array, Array]:
    """R_s, R_p, T_s, T_p in single precision.

    Parameters
    ----------
    xp
        numpy or jax.numpy.
    index
        complex64, (M+2, L); incident medium and substrate are transparent.
    thickness_nm
        M numbers.
    wavelength_nm, cos_theta
        float32, (L,) and (A, 1).
    """
    n_0 = index[0].real
    beta = n_0 * xp.sqrt((1 - cos_theta) * (1 + cos_theta))  # (A, L)
    b_sub = _admittances(index[-1].real, xp.sqrt((index[-1].real - beta) * (index[-1].real + beta)))
    fields = [(xp.ones_like(b) + 0j, b + 0j) for b in b_sub]
    decay = xp.zeros_like(beta)
    for n, d_nm in zip(index[-2:0:-1], reversed(thickness_nm), strict=True):
        kz = xp.sqrt((n - beta) * (n + beta))
        cos_delta, sin_delta, layer_decay = _cos_and_sin(xp, d_nm / wavelength_nm, kz)
        decay = decay + layer_decay
        sin_over_kz, sin_kz, n_2 = sin_delta * _reciprocal(kz), sin_delta * kz, n * n
        fields = [
            _step(cos_delta, sin_over_kz, sin_kz, fields[0]),
            _step(cos_delta, sin_over_kz * n_2, sin_kz * _reciprocal(n_2), fields[1]),
        ]
    passed = xp.exp(-2 * decay)
    s, p = (
        _intensities(*pair, b_0, b, passed)
        for pair, b_0, b in zip(fields, _admittances(n_0, n_0 * cos_theta), b_sub, strict=True)
    )
    return s[0], p[0], s[1], p[1]


def _admittances(n: Array, kz: Array) -> tuple[Array, Array]:
    """Ratio H / E of a wave for s and p."""
    return kz, kz / (n * n)


def _cos_and_sin(xp: ModuleType, d_over_wavelength: Array, kz: Array) -> tuple[Array, Array, Array]:
    """Cosine and sine of the complex phase delta, both times exp(-damping), and damping = Im delta."""
    turns = d_over_wavelength * kz.real
    phase = TWO_PI * (turns - xp.rint(turns))
    c, s = xp.cos(phase), xp.sin(phase)
    damping = TWO_PI * d_over_wavelength * kz.imag
    lost = xp.expm1(-2 * damping) / 2
    ch, sh = 1 + lost, -lost
    return c * ch - 1j * (s * sh), s * ch + 1j * (c * sh), damping


def _step(
    cos_delta: Array, sin_over_b: Array, sin_b: Array, fields: tuple[Array, Array]
) -> tuple[Array, Array]:
    """Fields at the front of a layer from those at its back."""
    E, H = fields
    return cos_delta * E - 1j * (sin_over_b * H), cos_delta * H - 1j * (sin_b * E)


def _intensities(E: Array, H: Array, b_0: Array, b_sub: Array, passed: Array) -> tuple[Array, Array]:
    """R and T from the fields at the front of the film."""
    scale = 1 / _squared_modulus(b_0 * E + H)
    return _squared_modulus(b_0 * E - H) * scale, 4 * b_0 * b_sub * scale * passed


def _squared_modulus(z: Array) -> Array:
    return z.real * z.real + z.imag * z.imag


def _reciprocal(z: Array) -> Array:
    """1 / z without the overflow guards of complex division, which cost more than the rest of a layer."""
    return z.conj() * (1 / _squared_modulus(z))
