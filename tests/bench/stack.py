"""The work that every program of the benchmark does."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class BenchStack:
    """A film and the table wanted of it: R and T, s and p, over (A, L)."""

    index: NDArray[np.complex128]  # (M+2, L)
    thickness_nm: NDArray[np.float64]  # (M,)
    wavelength_nm: NDArray[np.float64]  # (L,)
    cos_theta: NDArray[np.float64]  # (A,)

    @property
    def layer_evaluations(self) -> int:
        """M A L: layers times samples; both polarisations together count once."""
        return len(self.thickness_nm) * len(self.cos_theta) * len(self.wavelength_nm)

    def thinned(self, angle_step: int, wavelength_step: int) -> "BenchStack":
        """Keep one angle and one wavelength in so many, from the middle of each step."""
        wavelengths = slice(wavelength_step // 2, None, wavelength_step)
        return replace(
            self,
            index=self.index[:, wavelengths],
            wavelength_nm=self.wavelength_nm[wavelengths],
            cos_theta=self.cos_theta[angle_step // 2 :: angle_step],
        )


def bench_stack() -> BenchStack:
    """Ten dispersive layers, four of them absorbing, at 400 wavelengths and 1024 angles.

    Air; twice (low index, high index, thin metal, lower index, weakly absorbing oxide), of different
    thicknesses so that nothing repeats; glass. A Cauchy term makes every layer dispersive. Index, wavelength
    and cosine are exact in single precision, so that the error of a program is its arithmetic's alone.
    """
    wavelength_nm = np.linspace(380, 780, 400)
    n = np.array([1.46, 2.35, 0.15, 1.38, 2.1] * 2)[:, None]
    k = np.array([0.0, 0.0, 3.1, 0.0, 0.08] * 2)[:, None]
    layers = n * (1 + 2400 / wavelength_nm**2) + 1j * k
    outside = np.ones((1, wavelength_nm.size))
    return BenchStack(
        index=np.concatenate([outside, layers, 1.5 * outside]).astype(np.complex64).astype(np.complex128),
        thickness_nm=np.array([95.0, 60, 6, 100, 45, 80, 70, 8, 110, 55]),
        wavelength_nm=wavelength_nm.astype(np.float32).astype(np.float64),
        cos_theta=(np.arange(1024) + 0.5) / 1024,
    )
