"""A thin film computed slowly and plainly: the reference that the kernels are tested against.

Every boundary and every layer is a scatterer with the reflection and transmission coefficients of its two
sides. Two scatterers in a row make one: the beams that bounce between them form the geometric series of Wu &
Zheng 2015, equation 1 (Born & Wolf, section 7.6). Over amplitudes the sum gives a coherent film, over
intensities a thick incoherent layer (Byrnes, arXiv 1603.02720, section 6). This shares no step with the
kernels, which carry the field pair (E, H) outwards from the substrate.

Airy sums cancel close to a critical angle, so they are carried out in NumPy's extended precision (18 digits
on x86-64) and rounded to double at the end.

Time factor exp(-i w t), index n + ik with k >= 0, media 0 ... M+1 from the incident medium inwards. Inner
arrays are (2, A, L): s and p, then the cosines of incidence, then the wavelengths.
"""

import itertools
from collections.abc import Iterator, Sequence
from functools import reduce
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

ComplexArray: TypeAlias = NDArray[np.complexfloating]
Groups: TypeAlias = Sequence[tuple[int, int, int]]
"""Periodic groups as (first, stop, repeat) over layer positions 0 ... M-1."""


class Film(NamedTuple):
    """Amplitudes and intensities of a coherent film, each (A, L).

    Amplitudes are ratios of electric fields with the signs of equation 10: at normal incidence r_p = -r_s.
    """

    r_s: ComplexArray
    r_p: ComplexArray
    t_s: ComplexArray
    t_p: ComplexArray
    R_s: NDArray[np.float64]
    R_p: NDArray[np.float64]
    T_s: NDArray[np.float64]
    T_p: NDArray[np.float64]

    @property
    def psi(self) -> NDArray[np.float64]:
        """Ellipsometric psi in radians: tan psi = abs(r_p / r_s)."""
        return np.arctan2(np.abs(self.r_p), np.abs(self.r_s))

    @property
    def Delta(self) -> NDArray[np.float64]:  # noqa: N802 - the symbol of ellipsometry
        """Ellipsometric Delta in radians, (-pi, pi]: the phase of -r_p / r_s, 0 for glass at mu = 1."""
        return np.angle(-self.r_p / self.r_s)


class Intensities(NamedTuple):
    """Reflected and transmitted share of the incident flux, each (A, L)."""

    R_s: NDArray[np.float64]
    R_p: NDArray[np.float64]
    T_s: NDArray[np.float64]
    T_p: NDArray[np.float64]


class Scatterer(NamedTuple):
    """Coefficients of a boundary, a layer or a whole film, seen from its front and from its back.

    Amplitudes in a coherent film, intensities across an incoherent layer.
    """

    r: NDArray[np.inexact]
    t: NDArray[np.inexact]
    r_back: NDArray[np.inexact]
    t_back: NDArray[np.inexact]


class Media(NamedTuple):
    """What a wave of given wavelength and incidence sees in each medium."""

    n: ComplexArray  # (M+2, 1, L)
    cos_theta: ComplexArray  # (M+2, A, L)
    phase: ComplexArray  # (M+2, A, L), of one passage: half the delta of equation 6; 0 in the outer media


def film(
    index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta: ArrayLike,
    *,
    groups: Groups = (),
) -> Film:
    """Amplitudes and intensities of a coherent film for s and p.

    Parameters
    ----------
    index
        Complex (M+2,) or (M+2, L): incident medium, layers, substrate. A periodic group is listed once.
    thickness_nm
        (M,), one for each layer.
    wavelength_nm
        Scalar or (L,), in vacuum.
    cos_theta
        Scalar or (A,), cosine of the angle of incidence in the incident medium.
    groups
        Periodic groups; layers outside of them occur once.

    Returns
    -------
    Film
        Arrays of shape (A, L). At cos_theta = 0 the limit R = 1, T = 0.
    """
    media = _media(index, thickness_nm, wavelength_nm, cos_theta)
    whole = _coherent(media, 0, len(media.n) - 1, groups)
    R, T = np.abs(whole.r) ** 2, _transmitted_flux(whole.t, media, 0, -1)
    amplitudes = [a.astype(np.complex128) for a in (*whole.r, *whole.t)]
    return Film(*amplitudes, *(i.astype(np.float64) for i in (*R, *T)))


def incoherent_film(
    index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta: ArrayLike,
    *,
    coherent: Sequence[bool],
    groups: Groups = (),
) -> Intensities:
    """Intensities of a film some of whose layers are so thick that phases average out.

    `coherent` is (M,); the other parameters are those of `film`. Amplitudes add between two incoherent
    layers, intensities across one (Byrnes 2016, section 6). A thick layer in which the wave is evanescent
    passes nothing on.
    """
    media = _media(index, thickness_nm, wavelength_nm, cos_theta)
    thick = [j for j, adds_amplitudes in enumerate(coherent, start=1) if not adds_amplitudes]
    edges = [0, *thick, len(media.n) - 1]
    steps = []
    for front, back in itertools.pairwise(edges):
        amplitudes = _coherent(media, front, back, groups)
        steps += [_intensities(amplitudes, media, front, back), _attenuation(media, back)]
    whole = reduce(_compose, steps)
    return Intensities(*(i.astype(np.float64) for i in (*whole.r, *whole.t)))


def spread_film(
    index: ArrayLike,
    thickness_nm: ArrayLike,
    thickness_sigma_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta: ArrayLike,
    *,
    coherent: Sequence[bool] | None = None,
    groups: Groups = (),
) -> Intensities:
    """Intensities averaged over independent, normally distributed layer thicknesses.

    A trapezoid sum over +-7 standard deviations, in steps of at most sigma/4 and a sixteenth of the shortest
    fringe: far beyond convergence, because trapezoid sums over a normal distribution converge exponentially.
    The distribution is cut at thickness 0. A layer of a periodic group has the same thickness in all periods.
    """
    mean, sigma = np.atleast_1d(thickness_nm), np.atleast_1d(thickness_sigma_nm)
    fringe_nm = float(np.min(wavelength_nm) / (2 * np.abs(index).max()))
    nodes = [_normal_nodes(m, s, fringe_nm / 16) for m, s in zip(mean, sigma, strict=True)]
    keep = [True] * len(mean) if coherent is None else coherent
    terms = []
    for choice in itertools.product(*nodes):
        d_nm, weights = zip(*choice, strict=True)
        at = incoherent_film(index, d_nm, wavelength_nm, cos_theta, coherent=keep, groups=groups)
        terms.append(np.prod(weights) * np.stack(at))
    return Intensities(*np.sum(terms, axis=0))


def _normal_nodes(mean_nm: float, sigma_nm: float, step_nm: float) -> list[tuple[float, float]]:
    """Thicknesses and weights that average over a normal distribution; one node where sigma is 0."""
    if sigma_nm == 0:
        return [(mean_nm, 1.0)]
    count = int(np.ceil(14 * sigma_nm / min(sigma_nm / 4, step_nm))) + 1
    z = np.linspace(-7, 7, count)
    z = z[mean_nm + sigma_nm * z >= 0]
    weight = np.exp(-(z**2) / 2)
    return list(zip(mean_nm + sigma_nm * z, weight / weight.sum(), strict=True))


def _media(
    index: ArrayLike, thickness_nm: ArrayLike, wavelength_nm: ArrayLike, cos_theta: ArrayLike
) -> Media:
    """Index, refracted cosine (Snell's law) and phase in every medium."""
    wavelength = np.atleast_1d(np.asarray(wavelength_nm, np.longdouble))  # (L,)
    mu = np.atleast_1d(np.asarray(cos_theta, np.longdouble))[:, None]  # (A, 1)
    n = np.asarray(index, np.clongdouble)
    n = (n[:, None, None] if n.ndim == 1 else n[:, None, :]) + np.zeros_like(wavelength)  # (M+2, 1, L)
    beta = n[0] * np.sqrt((1 - mu) * (1 + mu))  # (A, L)
    kz = np.sqrt((n - beta) * (n + beta))  # (M+2, A, L); k >= 0 makes Im kz >= 0: waves decay inwards
    # A layer exactly at its critical angle: R and T are even in its kz, so this step away costs about 1e-13.
    kz[1:-1] = np.where(kz[1:-1] == 0, np.longdouble(1e-7), kz[1:-1])
    kz[0] = n[0] * mu  # exact: zero at grazing incidence, where equation 10 then gives r = -1 and t = 0
    d = np.concatenate([[0], np.atleast_1d(np.asarray(thickness_nm, np.longdouble)), [0]])[:, None, None]
    two_pi = 8 * np.arctan(np.longdouble(1))  # the double is wrong by 1e-16 of a phase that can be 1e5
    return Media(n, kz / n, two_pi * d * kz / wavelength)


def _coherent(media: Media, front: int, back: int, groups: Groups) -> Scatterer:
    """Everything between medium `front` and medium `back`, the two boundaries included."""
    steps, previous = [], front
    for members, repeat in _blocks(front + 1, back, groups):
        steps.append(_crossing(media, (previous, *members)))
        steps.append(_repeated(_crossing(media, (members[-1], *members)), repeat - 1))
        previous = members[-1]
    return reduce(_compose, [*steps, _boundary(media, previous, back)])


def _blocks(first: int, stop: int, groups: Groups) -> Iterator[tuple[tuple[int, ...], int]]:
    """Media `first` ... `stop` - 1 in order, as (media of one period, number of periods)."""
    periods = {start + 1: (tuple(range(start + 1, end + 1)), repeat) for start, end, repeat in groups}
    medium = first
    while medium < stop:
        members, repeat = periods.get(medium, ((medium,), 1))
        yield members, repeat
        medium += len(members)


def _crossing(media: Media, path: Sequence[int]) -> Scatterer:
    """From the end of the first medium of `path` to the end of its last: boundary, layer, boundary ..."""
    steps = [
        step for a, b in itertools.pairwise(path) for step in (_boundary(media, a, b), _passage(media, b))
    ]
    return reduce(_compose, steps)


def _boundary(media: Media, a: int, b: int) -> Scatterer:
    """Fresnel's coefficients from medium `a` to medium `b`, equation 10, for s and p: (2, A, L)."""
    (n_a, cos_a), (n_b, cos_b) = ((media.n[j], media.cos_theta[j]) for j in (a, b))
    s, p = n_a * cos_a + n_b * cos_b, n_b * cos_a + n_a * cos_b
    r = np.stack([(n_a * cos_a - n_b * cos_b) / s, (n_b * cos_a - n_a * cos_b) / p])
    t, t_back = (np.stack([2 * n * c / s, 2 * n * c / p]) for n, c in ((n_a, cos_a), (n_b, cos_b)))
    return Scatterer(r, t, -r, t_back)


def _passage(media: Media, j: int) -> Scatterer:
    """Phase and decay of the amplitude on its way through layer `j`: half of equation 6, no reflection."""
    t = np.exp(1j * np.stack([media.phase[j]] * 2))  # (2, A, L); abs(t) <= 1
    return Scatterer(0 * t, t, 0 * t, t)


def _attenuation(media: Media, j: int) -> Scatterer:
    """Decay of the intensity on its way through layer `j`; none in the substrate, which is not passed."""
    t = np.exp(-2 * np.stack([media.phase[j].imag] * 2))  # (2, A, L)
    return Scatterer(0 * t, t, 0 * t, t)


def _compose(front: Scatterer, back: Scatterer) -> Scatterer:
    """Sum of all beams between two scatterers, equation 1: a geometric series."""
    bounces = 1 / (1 - front.r_back * back.r)
    return Scatterer(
        r=front.r + front.t * back.r * front.t_back * bounces,
        t=front.t * back.t * bounces,
        r_back=back.r_back + back.t_back * front.r_back * back.t * bounces,
        t_back=back.t_back * front.t_back * bounces,
    )


def _repeated(period: Scatterer, count: int) -> Scatterer:
    """`count` equal scatterers in a row, by doubling."""
    whole = Scatterer(0 * period.r, 0 * period.t + 1, 0 * period.r, 0 * period.t + 1)
    while count:
        if count % 2:
            whole = _compose(whole, period)
        period, count = _compose(period, period), count // 2
    return whole


def _intensities(amplitudes: Scatterer, media: Media, a: int, b: int) -> Scatterer:
    """Flux coefficients between media `a` and `b` of a part with the given amplitudes."""
    return Scatterer(
        r=np.abs(amplitudes.r) ** 2,
        t=_transmitted_flux(amplitudes.t, media, a, b),
        r_back=np.abs(amplitudes.r_back) ** 2,
        t_back=_transmitted_flux(amplitudes.t_back, media, b, a),
    )


def _transmitted_flux(t: NDArray[np.inexact], media: Media, a: int, b: int) -> NDArray[np.floating]:
    """Flux that an amplitude carries from medium `a` to `b`; 0 where the wave carries none in `a`.

    This is the prefactor of equation 8 with the angle of the last medium (Born & Wolf, section 1.6.3).
    """
    flux_a, flux_b = _flux(media, a), _flux(media, b)
    ratio = np.divide(flux_b, flux_a, out=np.zeros_like(flux_b), where=flux_a > 0)
    flux: NDArray[np.floating] = np.abs(t) ** 2 * ratio
    return flux


def _flux(media: Media, j: int) -> NDArray[np.floating]:
    """Flux of a unit electric field in medium `j`: Re(n cos) for s, Re(n cos*) for p (Byrnes, section 4)."""
    cos = media.cos_theta[j]
    return np.stack([(media.n[j] * cos).real, (media.n[j] * cos.conj()).real])  # (2, A, L)
