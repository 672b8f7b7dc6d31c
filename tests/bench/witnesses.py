"""The other programs that compute thin films, each behind the same function: a stack in, four tables out."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench import complex_recursion, real_recursion
from bench.stack import BenchStack
from bench.timing import Solver
from reference import Intensities

Tables = tuple[Any, Any, Any, Any]
"""R_s, R_p, T_s, T_p as arrays of NumPy or JAX."""

BLOCK_ROWS = 32
"""Angles a block: 32 x 400 complex64 values are 100 kB, a few of which fit a core's second-level cache."""


@dataclass(frozen=True)
class Witness:
    """A program, how to get hold of it, and how much of the work it is given.

    One angle in `angle_step` and one wavelength in `wavelength_step`: all of them, but for a scalar program,
    whose cost per sample is the same for any number of samples.
    """

    name: str
    make: Callable[[], Solver]
    angle_step: int = 1
    wavelength_step: int = 1
    runs: int = 7


def witnesses() -> tuple[Witness, ...]:
    """List all programs, the slowest first."""
    return (
        Witness("tmm (scalar Python)", make_tmm, angle_step=64, wavelength_step=8),
        Witness("tmm_fast (PyTorch)", make_tmm_fast, runs=3),
        Witness("tmm_faster (C++)", make_tmm_faster, runs=5),
        Witness("NumPy, the kernels' recursion, complex64", make_numpy),
        Witness("JAX jit, the kernels' recursion, complex64", make_jax_complex),
        Witness("JAX jit, the same in real arithmetic", make_jax_real),
    )


def make_tmm() -> Solver:
    """Byrnes's tmm: one call for each sample and polarisation."""
    import tmm

    def solve(stack: BenchStack) -> Intensities:
        d_nm = [np.inf, *stack.thickness_nm, np.inf]
        tables = np.empty((4, len(stack.cos_theta), len(stack.wavelength_nm)))
        for a, mu in enumerate(stack.cos_theta):
            for w, wavelength_nm in enumerate(stack.wavelength_nm):
                s, p = (tmm.coh_tmm(x, stack.index[:, w], d_nm, np.arccos(mu), wavelength_nm) for x in "sp")
                tables[:, a, w] = s["R"], p["R"], s["T"], p["T"]
        return Intensities(*tables)

    return solve


def make_tmm_fast() -> Solver:
    """PyTorch behind tmm_fast: vectorised, complex128."""
    import tmm_fast

    def solve(stack: BenchStack) -> Intensities:
        d = np.array([[np.inf, *stack.thickness_nm, np.inf]])
        index, theta = stack.index[None], np.arccos(stack.cos_theta)
        s, p = (tmm_fast.coh_tmm(x, index, d, theta, stack.wavelength_nm) for x in "sp")
        return Intensities(s["R"][0], p["R"][0], s["T"][0], p["T"][0])

    return solve


def make_tmm_faster() -> Solver:
    """C++ with OpenMP behind tmm_faster, complex128."""
    import tmm_faster

    def solve(stack: BenchStack) -> Intensities:
        index = np.ascontiguousarray(stack.index.T)  # it reads the buffer and takes no notice of strides
        d_nm, degrees = [0, *stack.thickness_nm, 0], np.degrees(np.arccos(stack.cos_theta))
        got = tmm_faster.calc_coherent(index, d_nm, degrees, stack.wavelength_nm)
        return Intensities(*(np.transpose(got[name]) for name in Intensities._fields))

    return solve


def make_numpy() -> Solver:
    """NumPy in complex64."""

    def solve(stack: BenchStack) -> Intensities:
        index, d_nm, wavelength_nm = _single_precision(stack)
        return _in_blocks(lambda mu: complex_recursion.film(np, index, d_nm, wavelength_nm, mu), stack)

    return solve


def make_jax_complex() -> Solver:
    """JAX: the whole recursion in one compiled program of complex64."""
    import jax

    film = jax.jit(partial(complex_recursion.film, jax.numpy))

    def solve(stack: BenchStack) -> Intensities:
        inputs = _single_precision(stack)
        return _in_blocks(lambda mu: film(*inputs, mu), stack)

    return solve


def make_jax_real() -> Solver:
    """JAX: the whole recursion in one compiled program of float32 that knows which layers are clear."""
    import jax

    film = jax.jit(partial(real_recursion.film, jax.numpy), static_argnums=1)

    def solve(stack: BenchStack) -> Intensities:
        index, d_nm, wavelength_nm = _single_precision(stack)
        clear = tuple(bool(c) for c in (index[1:-1].imag == 0).all(axis=1))
        n_and_k = index.real.copy(), index.imag.copy()
        return _in_blocks(lambda mu: film(n_and_k, clear, d_nm, wavelength_nm, mu), stack)

    return solve


def _in_blocks(film: Callable[[NDArray[np.float32]], Tables], stack: BenchStack) -> Intensities:
    """Run `film` on blocks of angles that fit the caches, one thread a core.

    For NumPy and JAX alike this was the fastest of what was tried: whole tables with XLA's own threads,
    lax.map over blocks, and a program sharded over two devices were slower.
    """
    mu = stack.cos_theta.astype(np.float32)[:, None]
    blocks = np.split(mu, range(BLOCK_ROWS, len(mu), BLOCK_ROWS))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        parts = pool.map(lambda block: [np.asarray(table) for table in film(block)], blocks)
        return Intensities(*(np.concatenate(table) for table in zip(*parts, strict=True)))


def _single_precision(
    stack: BenchStack,
) -> tuple[NDArray[np.complex64], tuple[float, ...], NDArray[np.float32]]:
    """Index (M+2, L), thicknesses and wavelengths (L,) as complex64 and float32."""
    return (
        stack.index.astype(np.complex64),
        tuple(stack.thickness_nm.astype(np.float32)),
        stack.wavelength_nm.astype(np.float32),
    )
