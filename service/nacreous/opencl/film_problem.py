"""A film as the kernels take it: plain arrays in double precision."""

import functools
import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["THICK", "FilmProblem", "Segment"]

THICK = 0
"""`Segment.repeat` of one thick layer, across which intensities are added."""


@dataclass(frozen=True)
class Segment:
    """Layers `first` to `stop` - 1, crossed `repeat` times; `THICK` for one incoherent layer."""

    first: int
    stop: int
    repeat: int


@dataclass(frozen=True, eq=False)
class FilmProblem:
    """Everything that decides R and T.

    Parameters
    ----------
    wavelength_nm : float array, shape (L,)
    index : complex array, shape (M + 2, L)
        n + ik of the incident medium (k = 0), each layer once, and the substrate.
    segments : tuple of Segment
        The stack from the substrate outwards; together they hold each layer once.
    thickness_nm : float array, shape (S, V, M)
        For each thickness scale, V variants that are averaged.
    weights : float array, shape (V,)
        Of sum 1.
    cos_theta : float array, shape (A,)
    """

    wavelength_nm: NDArray[np.float64]
    index: NDArray[np.complex128]
    segments: tuple[Segment, ...]
    thickness_nm: NDArray[np.float64]
    weights: NDArray[np.float64]
    cos_theta: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, int, int]:
        """Thickness scales, angles and wavelengths: (S, A, L)."""
        return len(self.thickness_nm), len(self.cos_theta), len(self.wavelength_nm)

    @property
    def rows(self) -> int:
        """Thickness scales times angles: what a launch is tiled over."""
        return self.shape[0] * self.shape[1]

    @property
    def incoherent(self) -> bool:
        """Whether any layer is crossed in intensities."""
        return any(segment.repeat == THICK for segment in self.segments)

    @property
    def periodic(self) -> bool:
        """Whether any layers are a group that repeats."""
        return any(segment.repeat > 1 for segment in self.segments)

    @property
    def build_numbers(self) -> tuple[tuple[str, int], ...]:
        """What the kernels are compiled for: the kinds of segments that there are, and room for media.

        The room is a power of four, so that few programs serve all films.
        """
        room = next(room for n in itertools.count(1) if (room := 4**n) >= max(self.medium_of) + 1)
        return ("INCOHERENT", int(self.incoherent)), ("PERIODIC", int(self.periodic)), ("MEDIA", room)

    @functools.cached_property
    def medium_of(self) -> tuple[int, ...]:
        """Number of the medium of each layer and the substrate: equal rows of `index` are one medium."""
        numbers: dict[bytes, int] = {}
        return tuple(numbers.setdefault(row.tobytes(), len(numbers)) for row in self.index[1:])

    @property
    def layer_evaluations_a_row(self) -> int:
        """Layers crossed for one row, with every variant: what a launch's time goes by."""
        variants, layers = self.thickness_nm.shape[1:]
        return int(variants * (layers + 1) * len(self.wavelength_nm))
