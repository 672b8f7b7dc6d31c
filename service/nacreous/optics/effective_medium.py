"""Effective media: the refractive index of a mixture much finer than the wavelength.

All rules mix the permittivities ε = (n + ik)² of a host and of inclusions of volume fraction f. These are
spheres (A. Sihvola, "Electromagnetic Mixing Formulas and Applications", IEE 1999, equations 3.27 and 9.4) or
lamellae side by side (S. M. Rytov, Sov. Phys. JETP 2, 466-475 (1956); Born and Wolf, section 15.5.2).
"""

import numpy as np
from numpy.typing import NDArray

__all__ = ["bruggeman", "lamellar", "maxwell_garnett"]

ComplexArray = NDArray[np.complex128]


def bruggeman(host: ComplexArray, inclusion: ComplexArray, fraction: float) -> ComplexArray:
    """Return the index of a Bruggeman mixture, in which both constituents play the same part.

    f (ε_i - ε) / (ε_i + 2 ε) + (1 - f) (ε_h - ε) / (ε_h + 2 ε) = 0 becomes z² - 2 b z - 1/2 = 0 for
    ε = n_i n_h z. The product of its roots is -1/2, so exactly one has Re z > 0. That one is physical: the
    permittivity of a mixture of passive media lies in the angle that theirs span, whose bisector is n_i n_h.

    Parameters
    ----------
    host, inclusion : complex array, shape (L,)
        Refractive indices n + ik, k >= 0.
    fraction : float
        Volume share of the inclusion, 0..1.
    """
    e_h, e_i = host**2, inclusion**2
    linear = fraction * (2 * e_i - e_h) + (1 - fraction) * (2 * e_h - e_i)
    b = linear / (4 * host * inclusion)
    root = np.sqrt(b * b + 0.5)
    # Both expressions are the same root; each is used where it does not subtract nearly equal numbers.
    z = np.where(b.real < 0, 0.5 / (root - b), root + b)
    return _passive(np.sqrt(host * inclusion * z))


def maxwell_garnett(host: ComplexArray, inclusion: ComplexArray, fraction: float) -> ComplexArray:
    """Return the index of a Maxwell Garnett mixture: separate inclusions within a connected host.

    ε = ε_h (1 + 3 f s / (1 - f s)) with s = (ε_i - ε_h) / (ε_i + 2 ε_h). Parameters as in `bruggeman`.
    """
    e_h, e_i = host**2, inclusion**2
    contrast = fraction * (e_i - e_h)
    return _passive(np.sqrt(e_h * (e_i + 2 * e_h + 2 * contrast) / (e_i + 2 * e_h - contrast)))


def lamellar(host: ComplexArray, inclusion: ComplexArray, fraction: float) -> ComplexArray:
    """Return the index of upright lamellae in a host, for unpolarised light along them: ridges on a wing.

    Light whose electric field is parallel to the lamellae meets ε_∥ = f ε_i + (1 - f) ε_h, light whose field
    crosses them 1/ε_⊥ = f/ε_i + (1 - f)/ε_h: form birefringence. Unpolarised light is given the mean of both
    permittivities, as one index must stand for them. Parameters as in `bruggeman`; the fraction is the width
    of a lamella over the distance from one to the next.

    What is left out: the lamellae diffract. The rule is the limit of a period far below the wavelength, and
    the 675 nm of the ridges of figure 2 (F. Wu and C. Zheng 2015) are not.
    """
    e_h, e_i = host**2, inclusion**2
    parallel = fraction * e_i + (1 - fraction) * e_h
    across = e_i * e_h / (fraction * e_h + (1 - fraction) * e_i)
    return _passive(np.sqrt((parallel + across) / 2))


def _passive(index: ComplexArray) -> ComplexArray:
    """Clear the rounding error that would make a lossless mixture amplify light."""
    return np.asarray(index.real + 1j * np.maximum(index.imag, 0.0))
