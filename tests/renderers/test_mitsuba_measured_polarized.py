"""Our Mueller matrices in Mitsuba 3's own, unmodified `measured_polarized`.

Bare silver is held against Mitsuba's `roughconductor`, which knows of polarisation by itself: the sign of
every element and its handedness are Mitsuba's. Both are in Stokes frames that Mitsuba turns, so that another
frame of ours would show, too.
"""

import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from measured_files import (
    SURFACES,
    FloatArray,
    check_exact_where_light_goes,
    measured_file,
    measured_spec,
    random_diffuse,
    random_incoming,
    random_reflected,
)
from mitsuba_surface import Bsdf, conductor, mueller_values, variant_fault
from nacreous.formats.names import FormatName
from nacreous.opencl.device import Device
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.measured.half_difference import HalfDifference
from nacreous.tables.spec import Spec
from reference_tensor_file import tensor_fields

VARIANTS = ("scalar_spectral_polarized", "llvm_ad_spectral_polarized")
WAVELENGTH_NM = np.array([400.0, 480.0, 560.0, 640.0, 720.0])
SILVER = "main/Ag/Johnson"
PAIRS = 400


@pytest.fixture(params=VARIANTS)
def mitsuba(request: pytest.FixtureRequest) -> ModuleType:
    """Return Mitsuba in each of its polarised variants; skip, with the reason, what does not run here."""
    if fault := variant_fault(request.param):
        pytest.skip(fault)
    import mitsuba

    mitsuba.set_variant(request.param)
    return mitsuba


def silver(alpha: float) -> Spec:
    """Return silver under a layer of no thickness, lit from vacuum, with the masking that Mitsuba has."""
    nothing = {"material": {"n": 1.5}, "thickness_nm": 0.0}
    return Spec.model_validate(
        {
            "stack": {"incident": "vacuum", "substrate": SILVER, "layers": [nothing]},
            "surface": {"distribution": "ggx", "masking": "smith-separable", "alpha_x": alpha},
            "table": {"quantity": "bsdf", "wavelength_nm": WAVELENGTH_NM.tolist()},
        }
    )


class Loaded:
    """Files in a folder, each written once, as Mitsuba loads them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.files: dict[str, Path] = {}

    def __call__(self, mitsuba: ModuleType, spec: Spec) -> Bsdf:
        """Return the material of a spec in the variant that is set."""
        return mitsuba.load_dict({"type": "measured_polarized", "filename": str(self.path_of(spec))})

    def path_of(self, spec: Spec) -> Path:
        """Return the file of a spec."""
        key = spec.model_dump_json()
        if key not in self.files:
            written = measured_file(spec, FormatName.MUELLER, self.folder)
            self.files[key] = written.rename(self.folder / f"{len(self.files)}.pbsdf")
        return self.files[key]


@pytest.fixture(scope="module")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Loaded]:
    """Return what loads the file of a spec, and remove the files: they are large."""
    folder = tmp_path_factory.mktemp("mueller")
    yield Loaded(folder)
    shutil.rmtree(folder)


def directions() -> tuple[FloatArray, FloatArray]:
    """Return pairs of directions, half about the mirror direction and half anywhere."""
    i = random_incoming(2 * PAIRS, 1)
    tilt = 0.15 * np.random.default_rng(2).normal(size=(PAIRS, 2))
    m = np.concatenate([tilt, np.ones((PAIRS, 1))], axis=1)
    m /= np.linalg.norm(m, axis=1, keepdims=True)
    o = np.concatenate(
        [2 * np.sum(i[:PAIRS] * m, 1, keepdims=True) * m - i[:PAIRS], random_diffuse(PAIRS, 3)]
    )
    above = o[:, 2] > 0.02
    return i[above], o[above]


@pytest.mark.parametrize("alpha", [0.05, 0.2, 0.4])
def test_silver_is_mitsubas_own_conductor(alpha: float, mitsuba: ModuleType, loaded: Loaded) -> None:
    """All 16 elements at each pair: half within 0.1 % of M00, nine of ten in 0.5 %, the light in 0.05 %."""
    index = refractive_index(NamedMaterial(name=SILVER), WAVELENGTH_NM)
    i, o = directions()
    nm = WAVELENGTH_NM[:4]
    got = mueller_values(loaded(mitsuba, silver(alpha)), i, o, nm)
    expected = mueller_values(conductor(alpha, alpha, index, WAVELENGTH_NM), i, o, nm)
    m00 = expected[:, 0, 0]
    error = np.abs(got - expected).max(axis=(1, 2)) / m00
    assert np.median(error) <= 1e-3
    assert np.quantile(error, 0.9) <= 5e-3
    assert abs(got[:, 0, 0].sum() / m00.sum() - 1) <= 5e-4
    # Not by being small: every element that is not 0 by symmetry matters here.
    assert (np.abs(expected[:, 1:, 1:]) / m00[:, None, None]).max(axis=(0, 3)).min() > 0.3


def test_the_handedness_is_that_of_light(mitsuba: ModuleType, loaded: Loaded) -> None:
    """Off silver circular light stays circular, and turns the other way round: M33 is about -M00."""
    i = random_incoming(50, 4)
    nm = WAVELENGTH_NM[:4]
    # Not quite in the mirror direction, in which the reader has no azimuth of the half vector.
    o = i * [-1, -1, 1] + [1e-3, 0, 0]
    got = mueller_values(loaded(mitsuba, silver(0.2)), i, o / np.linalg.norm(o, axis=1, keepdims=True), nm)
    steep = i[:, 2] > 0.8
    assert (got[steep, 3, 3] < -0.9 * got[steep, 0, 0]).all()


def lit_film(surface: str) -> Spec:
    """Return the film of 420 nm on titanium with a surface, at the wavelengths of the file."""
    fields = measured_spec(surface).model_dump(mode="json")
    fields["table"]["wavelength_nm"] = WAVELENGTH_NM.tolist()
    return Spec.from_document(fields)


@dataclass(frozen=True, eq=False)
class Read:
    """M00 over f cos_o less 1, as Mitsuba reads it, and the light there, (P, 4)."""

    nodes: FloatArray
    lobe: FloatArray
    lobe_light: FloatArray
    wide: FloatArray
    wide_light: FloatArray


@pytest.fixture(params=["ggx", "rough", "diffuse"])
def read(
    request: pytest.FixtureRequest,
    mitsuba: ModuleType,
    loaded: Loaded,
    reads: dict[tuple[str, str], Read],
    device: Device,
) -> Read:
    """Return what Mitsuba makes of a film's file, in one call: its vectorised variants compile each."""
    key = (mitsuba.variant(), request.param)
    if key not in reads:
        reads[key] = read_of(request.param, mitsuba, loaded, device)
    return reads[key]


@pytest.fixture(scope="module")
def reads() -> dict[tuple[str, str], Read]:
    """Return where they are kept."""
    return {}


def read_of(surface: str, mitsuba: ModuleType, loaded: Loaded, device: Device) -> Read:
    """Compare M00 of a film with the bsdf in double precision."""
    spec, nm = lit_film(surface), WAVELENGTH_NM[1:]
    i, turned = random_incoming(10 * PAIRS, 8), random_incoming(2 * PAIRS, 10)
    o, weight = random_reflected(i, SURFACES[surface]["alpha_x"], 9)
    lit = weight > 0
    sets = [
        node_directions(loaded.path_of(spec)),
        (i[lit], o[lit]),
        (turned, random_diffuse(2 * PAIRS, 11)),
    ]
    incoming, outgoing = (np.concatenate(side) for side in zip(*sets, strict=True))
    got = mueller_values(loaded(mitsuba, spec), incoming, outgoing, nm)[:, 0, 0]
    f_cos = bsdf_solver(device, spec).exact().reflection(0, incoming, outgoing, nm) * outgoing[:, 2:]
    ends = np.cumsum([len(pair[0]) for pair in sets])[:2]
    nodes, lobe, wide = np.split(got / f_cos - 1, ends)
    _, lobe_light, wide_light = np.split(f_cos, ends)
    return Read(nodes, lobe, lobe_light * weight[lit, None], wide, wide_light)


def node_directions(path: Path) -> tuple[FloatArray, FloatArray]:
    """Return pairs of directions at random nodes of a file, to 80 degrees.

    Both angles are beyond where an arc cosine in single precision tells one from 0.
    """
    fields, random = tensor_fields(path), np.random.default_rng(7)
    phi_d, theta_d, theta_h = (fields[name][0].astype(np.float64) for name in ("phi_d", "theta_d", "theta_h"))
    count = 4 * PAIRS
    at = HalfDifference(
        random.choice(theta_h[theta_h > 0.01], count),
        random.choice(theta_d[theta_d > 0.01], count),
        random.choice(phi_d, count),
    )
    pairs = at.pairs()
    above = np.minimum(pairs.incoming[:, 2], pairs.outgoing[:, 2]) > np.cos(np.radians(80))
    return pairs.outgoing[above], pairs.incoming[above]


def test_m00_of_a_film_is_f_at_the_nodes(read: Read) -> None:
    """At random nodes of the file M00 is unpolarised f cos_o: none is off by more than 1e-3."""
    assert np.abs(read.nodes).max() <= 1e-3
    assert len(read.nodes) > PAIRS


def test_m00_of_a_film_is_f_where_light_goes(read: Read) -> None:
    """Along the lobe, from up to 75 degrees: half of the light within 0.5e-3, nine tenths and all in 1e-3."""
    check_exact_where_light_goes(read.lobe, read.lobe_light)


def test_m00_of_a_film_is_f_all_over(read: Read) -> None:
    """Off the lobe, too, from up to 75 degrees: the light within 1e-3, and half of all directions."""
    assert abs((read.wide * read.wide_light).sum() / read.wide_light.sum()) <= 1e-3
    assert np.median(np.abs(read.wide)) <= 1e-3


def test_light_up_to_the_horizon_is_seen(mitsuba: ModuleType, loaded: Loaded, device: Device) -> None:
    """Cells that the horizon cuts are not black: nine of ten within 5 % of f, all within 10 %."""
    random = np.random.default_rng(5)
    turn, cosine = random.uniform(-np.pi, np.pi, 100), random.uniform(0.01, 0.06, 100)
    sine = np.sqrt(1 - cosine**2)
    i, o = random_incoming(100, 6), np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine], axis=-1)
    nm = WAVELENGTH_NM[:4]
    got = mueller_values(loaded(mitsuba, silver(0.4)), i, o, nm)[:, 0, 0]
    expected = bsdf_solver(device, silver(0.4)).reflection(0, i, o, nm) * o[:, 2:]
    assert (got > 0).all()
    error = np.abs(got / expected - 1)
    assert np.quantile(error, 0.9) <= 0.05
    assert error.max() <= 0.1
