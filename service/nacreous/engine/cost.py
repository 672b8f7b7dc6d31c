"""What a work costs, estimated before anything is begun, from what would have to be evaluated.

The counts follow the code that computes a table; the seconds of each are measured (two cores with AVX-512,
PoCL 7, other processes running) and lie within a factor of about three of what was measured for presets in
all formats. What only the computation itself can find out, such as how fine a grid `delta_e` needs or how
many nodes a resonance takes, is estimated high. Loading materials and building kernels are not counted.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from nacreous.engine.work import Work
from nacreous.formats.names import FormatName
from nacreous.formats.registry import parts_of
from nacreous.opencl.precision import Precision
from nacreous.optics.stack import SampledStack, sample_stack
from nacreous.optics.surface import alphas_at
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.computed import asked_precision
from nacreous.tables.film import Grid, film_problem, optical_thickness_nm, phase_precision
from nacreous.tables.sampling import Sampling
from nacreous.tables.solver import TRANSMITTING_K
from nacreous.tables.spec import Spec, bsdf_angles, roughness_values, surface_of
from nacreous.tables.table import Part
from nacreous.tables.thickness_spread import one_thickness

__all__ = ["estimated_seconds"]

_START_S = 0.03
"""Reading the spec, the device, and a small file."""
_FILM_S, _DOUBLE = 8e-9, 2.0
"""A film of one layer at one angle and wavelength, and how much longer double precision takes."""
_LAYER = 0.25
"""What each further layer adds, as a part of the first."""
_FACET_S = 5e-9
"""One facet of the albedo's integral, for one side."""
_PRODUCT_S = 6e-10
"""One product of the albedo's weights and the film at its nodes."""
_PAIR_S, _PAIR_WAVELENGTH_S = 2e-7, 1e-8
"""A pair of directions, and one wavelength of it."""
_NODE_WAVELENGTH_S = 2e-7
"""A node of the facets' film at a wavelength: its settling and its certificate included."""

_CERTIFIED_CELLS = 8192
"""Up to about 20,000 cells are all compared, of more 4,096: let it be between, and never less for more."""
_POINTS_A_CELL = 5
"""Four corners and a middle."""
_TRIALS = 10
"""Grids that a refinement looks at."""
_REFINED_DELTA_E = 3.3
"""Below this a table with two axes needs more texels than it has, as 1 / delta_e (measured)."""

_SETTLED_AT = 2 * 8 * 48
"""Points at which the nodes of a thickness spread are settled, with twice as many each time."""
_FACETS, _INCIDENCE, _MEAN_ANGLES = 4096, 16, 24
_CERTIFIED_ALBEDOS, _DOUBLED_RULE = 12 * 48, 4
"""Roughnesses and angles of the albedo's certificate, and its finer rule."""
_FEWEST_NODES, _RESONANT_NODES = 257, 2049
_PERIODS_A_DOUBLING = 8.0
"""Optical thickness in wavelengths beyond which the film takes twice the nodes."""
_LEAST_CONTRAST = 0.1
"""Index beyond the incident medium's that keeps a film from total reflection at grazing angles."""
_MIRROR = 1.5
"""Relative contrast of a periodic group times its repeats from which its bands have sharp edges."""
_SAME_INDEX = 1e-3
"""Difference of the indices of both media below which light passes straight on."""

_RGL_BYTES, _RGL_PAIRS, _RGL_S = {False: 20e6, True: 40e6}, 500_000, 0.5
_MBSDF_BINS, _BINS_A_LOBE = (48, 72, 100), 30
_MERL_S, _MUELLER_S = 0.8, 0.3

_WRITING_S: Mapping[FormatName, float] = MappingProxyType(
    {
        FormatName.EXR: 3e-8,
        FormatName.SPECTRAL_EXR: 5e-8,
        FormatName.NPZ: 2e-8,
        FormatName.NETCDF: 1e-7,
        FormatName.CSV: 5e-7,
        FormatName.PNG: 5e-8,
        FormatName.ZARR: 8e-8,
        FormatName.MATERIALX: 3e-8,
    }
)
"""Seconds for each number of a file along the spec's axes."""
_OPENING_S: Mapping[FormatName, float] = MappingProxyType(
    {FormatName.NETCDF: 0.15, FormatName.ZARR: 0.1, FormatName.GLTF: 0.6}
)
"""What a format takes whatever its size: libraries to load, and for glTF the fit."""


@dataclass(frozen=True)
class _Film:
    """What decides the cost of a spec's film.

    Parameters
    ----------
    point_s : float
        Seconds for one thickness scale, angle and wavelength, all nodes of a thickness spread included.
    exact_s : float
        The same in double precision.
    settling_s : float
        What finding these nodes takes.
    scales, angles, wavelengths, quadrature : int
        Samples of the axes, and wavelengths that a colour is integrated over.
    nodes : int
        Cosines that facets take the film from.
    sides : int
        1 for an opaque substrate, else 2.
    refracts : bool
        Whether what is transmitted leaves in another direction.
    """

    point_s: float
    exact_s: float
    settling_s: float
    scales: int
    angles: int
    wavelengths: int
    quadrature: int
    nodes: int
    sides: int
    refracts: bool


def estimated_seconds(work: Work) -> float:
    """Return about how long a work takes: rather too long than too short where that cannot be told.

    Raises
    ------
    SpecError
        A material cannot be used at a wavelength.
    """
    spec, film = work.spec, _film(work.spec)
    parts = parts_of([work.target], spec)
    if work.target.sampling is not Sampling.AXES:
        seconds = _bsdf_settling_s(spec, film) + _MEASURED[work.target.sampling](spec, film)
    else:
        seconds = _QUANTITIES[spec.table.quantity](spec, film, parts)
        seconds += _numbers(spec, film, parts) * _WRITING_S.get(work.format, 0.0)
    return _START_S + film.settling_s + seconds + _OPENING_S.get(work.format, 0.0)


# ---- the film ----------------------------------------------------------------------------------------------


def _film(spec: Spec) -> _Film:
    nm = wavelength_values_nm(spec.table.wavelength_nm)
    scales = thickness_scale_values(spec.table.thickness_scale)
    stack = sample_stack(spec.stack, nm)
    problem = film_problem(
        spec.stack, one_thickness(stack.thickness_nm.size), Grid(scales[-1:], np.ones(1), nm)
    )
    periods = float((optical_thickness_nm(problem) / nm).sum(axis=0).max())
    double = _traps(stack) or phase_precision(problem, asked_precision(spec)) is Precision.DOUBLE
    layers = stack.thickness_nm.size + sum(2 * math.log2(group.repeat) for group in stack.groups)
    exact_s = _FILM_S * _DOUBLE * (1 + _LAYER * (layers - 1))
    spread = _spread_nodes(stack, float(scales[-1]))
    return _Film(
        point_s=exact_s * math.prod(spread) / (1 if double else _DOUBLE),
        exact_s=exact_s * math.prod(spread),
        settling_s=4 * _SETTLED_AT * exact_s * sum(spread),
        scales=scales.size,
        angles=cos_theta_values(spec.table.cos_theta).size,
        wavelengths=nm.size,
        quadrature=_quadrature(nm, periods) * (2 if _traps(stack) else 1),
        nodes=_nodes(stack, periods),
        sides=2 if stack.index[-1].imag.max() < TRANSMITTING_K else 1,
        refracts=bool(np.abs(stack.index[0] - stack.index[-1]).max() > _SAME_INDEX),
    )


def _spread_nodes(stack: SampledStack, scale: float) -> list[int]:
    """Nodes of each layer whose thickness varies, as `nacreous.tables.thickness_spread` doubles them from 9.

    A fringe of w radians a standard deviation is resolved at steps below 2 pi / (w + 4.2), over 10.
    """
    fringe = 4 * np.pi * (np.abs(stack.index[1:-1]) / stack.wavelength_nm).max(axis=1) * scale
    nodes = 1 + 10 * (fringe * stack.thickness_sigma_nm + 4.2) / (2 * np.pi)
    doublings = np.ceil(np.log2(np.clip(nodes / 9, 1, 512)))
    return [9 << int(count) for count in doublings[stack.thickness_sigma_nm > 0]]


def _quadrature(nm: np.ndarray, periods: float) -> int:
    """Wavelengths in steps of 1 nm, or 8 to a fringe."""
    seen = float(np.clip(nm[-1], 400, 830) - np.clip(nm[0], 360, 700))
    return math.ceil(max(seen, 0.0) * max(1.0, 8 * 2 * periods * float(nm[0]) / 400**2)) + 1


def _nodes(stack: SampledStack, periods: float) -> int:
    """Nodes of the facets' film: many where it has resonances or total reflection, or is thick."""
    least = _RESONANT_NODES if _traps(stack) or _mirrors(stack) else _FEWEST_NODES
    thickness = max(1.0, periods / _PERIODS_A_DOUBLING)
    return min(4097, (least - 1) * math.ceil(thickness) + 1)


def _traps(stack: SampledStack) -> bool:
    """Tell whether a medium is hardly denser than the incident one: grazing resonances are sharp."""
    return float(stack.index[1:].real.min()) < float(stack.index[0].real.max()) + _LEAST_CONTRAST


def _mirrors(stack: SampledStack) -> bool:
    """Tell whether a periodic group reflects whole bands, with resonances at their edges."""
    n = stack.index[1:-1].real
    groups = ((n[group.first : group.stop], group.repeat) for group in stack.groups)
    return any(repeat * np.ptp(part, axis=0).max() > _MIRROR * part.mean() for part, repeat in groups)


# ---- quantities along the axes of a spec -------------------------------------------------------------------


def _numbers(spec: Spec, film: _Film, parts: frozenset[Part]) -> int:
    """Numbers in the file."""
    spectrum = 2 * film.wavelengths * (2 if spec.table.quantity == "fresnel" else 1)
    colours = 3 * film.sides
    samples = _pairs(spec) if spec.table.quantity == "bsdf" else film.scales * film.angles
    samples *= roughness_values(spec).size if spec.table.quantity == "albedo" else 1
    return samples * ((Part.SPECTRUM in parts) * spectrum + (Part.COLOUR in parts) * colours)


def _fresnel_s(spec: Spec, film: _Film, parts: frozenset[Part]) -> float:
    texels = film.scales * film.angles
    spectra = texels * film.wavelengths * (2 if spec.table.ellipsometry else 1)
    colours = texels * film.quadrature * film.sides
    points = (Part.SPECTRUM in parts) * spectra + (Part.COLOUR in parts) * colours
    return film.point_s * points + _certificate_s(film) * (1 + _refinement(spec, film))


def _certificate_s(film: _Film) -> float:
    """Cells between the texels, in double precision."""
    cells = min(film.scales * film.angles, _CERTIFIED_CELLS)
    return film.exact_s * _POINTS_A_CELL * cells * film.quadrature


def _refinement(spec: Spec, film: _Film) -> float:
    """How many certificates of the grid as it is go by until `delta_e` is kept."""
    allowed = spec.accuracy.delta_e
    if allowed is None:
        return 0.0
    texels = _REFINED_DELTA_E / allowed if film.scales > 1 else (1 / allowed) ** 0.5
    return _TRIALS * max(1.0, texels)


def _albedo_s(spec: Spec, film: _Film, parts: frozenset[Part]) -> float:
    roughness, n = roughness_values(spec).size, (Part.SPECTRUM in parts) * film.wavelengths
    looks = 1 + (film.sides - 1) * (3 if film.refracts else 1)  # dispersion takes three ratios of indices
    channels = n + 3 * (Part.COLOUR in parts)
    angles = film.angles + (_MEAN_ANGLES if n else 0)
    geometry = roughness * angles + _DOUBLED_RULE * _CERTIFIED_ALBEDOS
    product = roughness * film.scales * angles * film.nodes * channels * looks
    at_nodes = film.scales * film.nodes * (n + (Part.COLOUR in parts) * looks * film.quadrature)
    seconds = geometry * looks * _facets(spec) * _FACET_S + product * _PRODUCT_S + at_nodes * film.point_s
    allowed = spec.accuracy.delta_e
    refined = 1 if allowed is None else 8 + 8 / allowed**0.5
    return (seconds + film.nodes * film.quadrature * _NODE_WAVELENGTH_S) * refined


def _facets(spec: Spec) -> int:
    return _FACETS * (_INCIDENCE if surface_of(spec).anisotropic else 1)


def _bsdf_s(spec: Spec, film: _Film, parts: frozenset[Part]) -> float:
    n = (2 if film.refracts else 1) * (Part.SPECTRUM in parts) * film.wavelengths
    colours = (Part.COLOUR in parts) * _colour_wavelengths(film)
    return _bsdf_settling_s(spec, film) + _pairs(spec) * (_PAIR_S + (n + colours) * _PAIR_WAVELENGTH_S)


def _colour_wavelengths(film: _Film) -> int:
    """Return the wavelengths of a pair's colours: light that is refracted goes elsewhere at each."""
    return 3 + (film.quadrature if film.refracts and film.sides > 1 else 0)


def _pairs(spec: Spec) -> int:
    angles = bsdf_angles(spec)
    axes = (angles.theta_i, angles.theta_o, angles.phi, angles.phi_i, roughness_values(spec))
    return math.prod(axis.size for axis in axes)


def _bsdf_settling_s(spec: Spec, film: _Film) -> float:
    """Return what the film at the nodes takes, its colours, and the albedo that is looked at."""
    looked_at = 17 * _DOUBLED_RULE * _facets(spec) * 2 * film.sides
    return film.nodes * film.quadrature * (_NODE_WAVELENGTH_S + film.point_s) + looked_at * _FACET_S


# ---- where readers fix the samples -------------------------------------------------------------------------


def _rgl_s(spec: Spec, channels: int) -> float:
    """All grids of the ladder that a file has room for; the last has half of all pairs."""
    pairs = min(_RGL_PAIRS, 2 * _RGL_BYTES[surface_of(spec).anisotropic] / (4 * (channels + 1)))
    return _RGL_S + pairs * (_PAIR_S + channels * _PAIR_WAVELENGTH_S)


def _mbsdf_s(spec: Spec, film: _Film) -> float:
    """All numbers of bins that are fine enough for the lobe."""
    alpha = float(alphas_at(surface_of(spec), roughness_values(spec)).min())
    tried = [bins for bins in _MBSDF_BINS if 4 * bins * alpha >= _BINS_A_LOBE] or [_MBSDF_BINS[-1]]
    pairs = sum(2 * bins**3 for bins in tried)
    return pairs * (_PAIR_S + _colour_wavelengths(film) * _PAIR_WAVELENGTH_S)


_QUANTITIES: Mapping[str, Callable[[Spec, _Film, frozenset[Part]], float]] = MappingProxyType(
    {"fresnel": _fresnel_s, "albedo": _albedo_s, "bsdf": _bsdf_s}
)
_MEASURED: Mapping[Sampling, Callable[[Spec, _Film], float]] = MappingProxyType(
    {
        Sampling.RGL_SPECTRA: lambda spec, film: _rgl_s(spec, film.wavelengths),
        Sampling.RGL_COLOURS: lambda spec, _: _rgl_s(spec, 3),
        Sampling.MBSDF: _mbsdf_s,
        Sampling.MERL: lambda *_: _MERL_S,
        Sampling.MUELLER: lambda *_: _MUELLER_S,
    }
)
