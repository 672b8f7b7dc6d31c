"""Our Mueller matrices in Mitsuba 3's own, unmodified `measured_polarized`.

Bare silver is held against Mitsuba's `roughconductor`, which knows of polarisation by itself: the sign of
every element and its handedness are Mitsuba's. Both are in Stokes frames that Mitsuba turns, so that another
frame of ours would show, too.
"""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from measured_files import FloatArray, measured_file, measured_spec, random_diffuse, random_incoming
from mitsuba_surface import Bsdf, conductor, mueller_values, variant_fault
from nacreous.formats.names import FormatName
from nacreous.opencl.device import Device
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.spec import Spec

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


@pytest.fixture(scope="module")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> Callable[[ModuleType, Spec], Bsdf]:
    """Return what loads the file of a spec, written once."""
    folder = tmp_path_factory.mktemp("mueller")
    files: dict[str, Path] = {}

    def load(mitsuba: ModuleType, spec: Spec) -> Bsdf:
        key = spec.model_dump_json()
        if key not in files:
            files[key] = measured_file(spec, FormatName.MUELLER, folder).rename(
                folder / f"{len(files)}.pbsdf"
            )
        return mitsuba.load_dict({"type": "measured_polarized", "filename": str(files[key])})

    return load


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
def test_silver_is_mitsubas_own_conductor(
    alpha: float, mitsuba: ModuleType, loaded: Callable[[ModuleType, Spec], Bsdf]
) -> None:
    """All 16 elements at each pair: half within 0.3 % of M00, nine of ten in 2 %, the light within 0.1 %."""
    index = refractive_index(NamedMaterial(name=SILVER), WAVELENGTH_NM)
    i, o = directions()
    nm = WAVELENGTH_NM[:4]
    got = mueller_values(loaded(mitsuba, silver(alpha)), i, o, nm)
    expected = mueller_values(conductor(alpha, alpha, index, WAVELENGTH_NM), i, o, nm)
    m00 = expected[:, 0, 0]
    error = np.abs(got - expected).max(axis=(1, 2)) / m00
    assert np.median(error) <= 3e-3
    assert np.quantile(error, 0.9) <= 2e-2
    assert abs(got[:, 0, 0].sum() / m00.sum() - 1) <= 1e-3
    # Not by being small: every element that is not 0 by symmetry matters here.
    assert (np.abs(expected[:, 1:, 1:]) / m00[:, None, None]).max(axis=(0, 3)).min() > 0.3


def test_the_handedness_is_that_of_light(
    mitsuba: ModuleType, loaded: Callable[[ModuleType, Spec], Bsdf]
) -> None:
    """Off silver circular light stays circular, and turns the other way round: M33 is about -M00."""
    i = random_incoming(50, 4)
    nm = WAVELENGTH_NM[:4]
    # Not quite in the mirror direction, in which the reader has no azimuth of the half vector.
    o = i * [-1, -1, 1] + [1e-3, 0, 0]
    got = mueller_values(loaded(mitsuba, silver(0.2)), i, o / np.linalg.norm(o, axis=1, keepdims=True), nm)
    steep = i[:, 2] > 0.8
    assert (got[steep, 3, 3] < -0.9 * got[steep, 0, 0]).all()


def test_a_film_has_the_light_of_its_bsdf(
    mitsuba: ModuleType, loaded: Callable[[ModuleType, Spec], Bsdf], device: Device
) -> None:
    """M00 of an interference film is unpolarised f cos_o: within 1e-3 of all the light, mostly in 0.3 %."""
    fields = measured_spec("ggx").model_dump(mode="json")
    fields["table"]["wavelength_nm"] = WAVELENGTH_NM.tolist()
    spec = Spec.from_document(fields)
    i, o = directions()
    nm = WAVELENGTH_NM[:4]
    got = mueller_values(loaded(mitsuba, spec), i, o, nm)[:, 0, 0]
    expected = bsdf_solver(device, spec).reflection(0, i, o, nm) * o[:, 2:]
    assert abs(got.sum() / expected.sum() - 1) <= 1e-3
    seen = expected > 1e-3 * expected.max()
    assert np.median(np.abs(got[seen] / expected[seen] - 1)) <= 3e-3


def test_light_up_to_the_horizon_is_seen(
    mitsuba: ModuleType, loaded: Callable[[ModuleType, Spec], Bsdf], device: Device
) -> None:
    """Cells that the horizon cuts are not black: nine of ten within 7 % of f, all within 15 %."""
    random = np.random.default_rng(5)
    turn, cosine = random.uniform(-np.pi, np.pi, 100), random.uniform(0.01, 0.06, 100)
    sine = np.sqrt(1 - cosine**2)
    i, o = random_incoming(100, 6), np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine], axis=-1)
    nm = WAVELENGTH_NM[:4]
    got = mueller_values(loaded(mitsuba, silver(0.4)), i, o, nm)[:, 0, 0]
    expected = bsdf_solver(device, silver(0.4)).reflection(0, i, o, nm) * o[:, 2:]
    assert (got > 0).all()
    error = np.abs(got / expected - 1)
    assert np.quantile(error, 0.9) <= 0.07
    assert error.max() <= 0.15
