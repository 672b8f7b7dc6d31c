"""Our measured files in Mitsuba 3's own, unmodified `measured`, against f_r itself."""

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from measured_files import (
    SUBSTRATES,
    SURFACES,
    WAVELENGTH_NM,
    FloatArray,
    directions,
    measured_file,
    measured_spec,
    random_diffuse,
    random_incoming,
)
from mitsuba_surface import VARIANTS, sampled, spectral_values, variant_fault
from nacreous.formats.names import FormatName
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.tables.albedo.solver import albedo_solver
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.computed import colouring_of, grid_of
from nacreous.tables.facet_film import on_facets
from nacreous.tables.measured.surface import Colours
from reference_tensor_file import MeasuredMaterial

MEDIAN, P90, MEAN = 3e-3, 1.5e-2, 2e-3
"""Relative errors that a renderer may make of an isotropic file; twice that of an anisotropic one."""
ISOTROPIC = tuple(surface for surface in SURFACES if "alpha_y" not in SURFACES[surface])
LARGEST_BYTES = 20 * 10**6
BLOCKS, PAIRS = 10, 500
"""Pairs of directions at four random wavelengths, several times over: 20,000 values."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return where the files of this module lie."""
    return tmp_path_factory.mktemp("measured")


def use(variant: str) -> ModuleType:
    """Return Mitsuba in a variant, or skip with the reason why it does not run."""
    if fault := variant_fault(variant):
        pytest.skip(fault)
    import mitsuba

    mitsuba.set_variant(variant)
    return mitsuba


def written(surface: str, name: FormatName, folder: Path, substrate: str = "titanium") -> Path:
    """Return the file of a surface, written once."""
    path = folder / f"{surface}-{substrate}-{name}"
    path.mkdir(exist_ok=True)
    spec = measured_spec(surface, SUBSTRATES[substrate])
    return next(path.iterdir(), None) or measured_file(spec, name, path)


def slack(surface: str) -> float:
    """Return what an error of this surface's file may be multiplied by."""
    return 2.0 if "alpha_y" in SURFACES[surface] else 1.0


@pytest.mark.parametrize("substrate", SUBSTRATES)
@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("variant", VARIANTS)
def test_mitsuba_reads_spectra_along_the_lobe(
    surface: str, substrate: str, variant: str, folder: Path, device: Device
) -> None:
    """At 20,000 directions that it samples itself and random wavelengths: median, nine of ten, mean."""
    mitsuba = use(variant)
    path = written(surface, FormatName.RGL, folder, substrate)
    assert path.stat().st_size <= slack(surface) * LARGEST_BYTES
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(path)})
    solver = bsdf_solver(device, measured_spec(surface, SUBSTRATES[substrate]))
    got, expected = [], []
    for block in range(BLOCKS):
        nm = np.sort(np.random.default_rng(block).uniform(*WAVELENGTH_NM, 4))
        i = random_incoming(PAIRS, block)
        o, _ = sampled(bsdf, i, nm, block)
        above = o[:, 2] > 1e-3
        got.append(spectral_values(bsdf, i[above], o[above], nm))
        expected.append(solver.reflection(0, i[above], o[above], nm) * o[above, 2:])
    check_errors(np.concatenate(got), np.concatenate(expected), slack(surface))


@pytest.mark.parametrize("surface", ["ggx", "anisotropic"])
def test_two_readers_agree(surface: str, folder: Path) -> None:
    """Mitsuba and the plain reader of tests/reference_tensor_file.py, within 1e-4 of what either finds."""
    mitsuba = use("llvm_ad_spectral")
    path = written(surface, FormatName.RGL, folder)
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(path)})
    material = MeasuredMaterial.read(path)
    i, nm = random_incoming(40, 5), np.array([431.0, 512.5, 600.0, 700.0])
    o, _ = sampled(bsdf, i, nm, 6)
    expected = [[material.f_cos(*pair, at) for at in nm] for pair in zip(i, o, strict=True)]
    np.testing.assert_allclose(
        spectral_values(bsdf, i, o, nm), expected, rtol=1e-4, atol=1e-5 * np.max(expected)
    )


def check_errors(got: FloatArray, expected: FloatArray, slack: float) -> None:
    """Require what relative errors are, where anything is seen, and what they add up to.

    In their mean a faint direction counts as much as a bright one; in the light as a whole it does not.
    """
    seen = expected > 1e-6 * expected.max()
    error = got[seen] / expected[seen] - 1
    assert np.median(np.abs(error)) <= slack * MEDIAN
    assert np.quantile(np.abs(error), 0.9) <= slack * P90
    assert abs(error.mean()) <= slack * MEAN
    assert abs(got.sum() / expected.sum() - 1) <= slack * MEAN


@pytest.mark.parametrize("substrate", SUBSTRATES)
@pytest.mark.parametrize("surface", ISOTROPIC)
def test_mitsuba_reads_spectra_off_the_lobe(
    surface: str, substrate: str, folder: Path, device: Device
) -> None:
    """Between any two directions a lobe is a thousand times fainter, and as exact: the same errors."""
    mitsuba = use("llvm_ad_spectral")
    path = written(surface, FormatName.RGL, folder, substrate)
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(path)})
    solver = bsdf_solver(device, measured_spec(surface, SUBSTRATES[substrate]))
    got, expected = [], []
    for block in range(BLOCKS):
        nm = np.sort(np.random.default_rng(block).uniform(*WAVELENGTH_NM, 4))
        i, o = random_incoming(PAIRS, block), random_diffuse(PAIRS, BLOCKS + block)
        got.append(spectral_values(bsdf, i, o, nm))
        expected.append(solver.reflection(0, i, o, nm) * o[:, 2:])
    check_errors(np.concatenate(got), np.concatenate(expected), slack(surface))


@pytest.mark.parametrize("surface", ["ggx", "ashikhmin-shirley", "anisotropic"])
def test_mitsuba_reads_colours(surface: str, folder: Path, device: Device) -> None:
    """The RGB file in an RGB variant: the linear colour of f_r, component by component."""
    mitsuba = use("llvm_ad_rgb")
    path = written(surface, FormatName.RGL_RGB, folder)
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(path)})
    spec = measured_spec(surface)
    solver, grid = bsdf_solver(device, spec), grid_of(spec)
    colouring = colouring_of(spec, solver.albedo.film.solver, on_facets(grid))
    i = random_incoming(20_000, 1)
    o, _ = sampled(bsdf, i, None, 2)
    above = o[:, 2] > 1e-3
    i, o = i[above], o[above]
    pairs = Pairs(np.zeros(len(i), np.int32), i, o)
    expected = Colours(colouring).reflected(solver, pairs) * o[:, 2:]
    assert solver.sides(grid.wavelength_nm) == (Side.REFLECTION,)
    check_errors(spectral_values(bsdf, i, o, None), expected, slack(surface))


@pytest.mark.parametrize("surface", ["narrow", "ggx", "rough", "anisotropic"])
def test_a_furnace_gives_back_the_albedo(surface: str, folder: Path, device: Device) -> None:
    """The mean weight of Mitsuba's samples is E_r within 0.5 %, at 500 nm and four angles."""
    mitsuba = use("llvm_ad_spectral")
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(written(surface, FormatName.RGL, folder))})
    spec = measured_spec(surface)
    solver = bsdf_solver(device, spec)
    nm = np.array([500.0])
    for theta in (0.0, 0.5, 0.9, 1.2):
        phi = np.linspace(-np.pi, np.pi, 2**16)  # an anisotropic albedo is a mean over azimuth
        i = directions(np.full(phi.size, theta), phi)
        _, weights = sampled(bsdf, i, np.repeat(nm, 4), 3)
        albedo = albedo_solver(device, spec)
        geometry = albedo.geometry(solver.roughness, np.cos([theta]), nm)
        mirror = albedo.mirror_mean(solver.roughness)
        exact = albedo.spectra(geometry, mirror, np.ones(1), nm)[Side.REFLECTION].item()
        assert abs(weights[:, 0].mean() / exact - 1) <= 5e-3 * slack(surface)


@pytest.mark.parametrize("surface", ["ggx", "diffuse", "anisotropic"])
@pytest.mark.parametrize("theta", [0.2, 0.9])
def test_mitsuba_samples_what_it_evaluates(surface: str, theta: float, folder: Path) -> None:
    """Mitsuba's own chi-square test: samples of our file follow the density that it states for them."""
    mitsuba = use("llvm_ad_rgb")
    from mitsuba.chi2 import BSDFAdapter, ChiSquareTest, SphericalDomain

    path = written(surface, FormatName.RGL_RGB, folder)
    xml = f'<string name="filename" value="{path}"/>'
    wi = directions(np.array([theta]), np.array([0.4]))[0]
    sample, density = BSDFAdapter("measured", xml, wi=mitsuba.ScalarVector3f(*wi))
    test = ChiSquareTest(
        domain=SphericalDomain(), sample_func=sample, pdf_func=density, sample_dim=3, res=101, ires=16
    )
    assert test.run(), test.messages
