"""Tables of f_r and f_t: what is in them, and what is refused."""

from typing import Any

import numpy as np
import pytest

from kernel_surface import directions_of, rough_spec
from nacreous.errors import BudgetError, NumericalError, SpecError
from nacreous.tables.bsdf import table as module
from nacreous.tables.bsdf.certificate import BsdfCertificate
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table
from reference_facets import FloatArray, Surface
from reference_surface import Coating, f_r, f_t

ANGLES: dict[str, Any] = {"theta_i": [0.2, 0.9], "theta_o": [0.0, 0.5, 1.1], "phi": [0.5, 2.2, 3.0]}
NM = np.array([400.0, 500.0, 600.0, 700.0])
SIDES = {"f_r": (f_r, 1), "f_t": (f_t, -1)}


def bsdf_spec(surface: dict[str, Any], **table: object) -> Spec:
    """Return the spec of 300 nm of n = 2.0 on glass."""
    return rough_spec(surface, quantity="bsdf", **{**ANGLES, **table})


def exact(name: str, surface: Surface, table: Table, phi_i: float) -> FloatArray:
    """All of a table's samples from one azimuth by NumPy, (I, O, P, L)."""
    theta_i, theta_o, phi = (table.values(axis) for axis in ("theta_i", "theta_o", "phi"))
    i = directions_of(np.cos(theta_i), np.array(phi_i))[:, None, None]
    o = directions_of(np.cos(theta_o)[:, None], phi_i + phi)
    function, side = SIDES[name]
    coating = Coating(np.array([1.0, 2.0, 1.5], complex)[:, None] * np.ones(4), np.array([300.0]), NM)
    return function(surface, coating, *np.broadcast_arrays(i, o * [1, 1, side]))


@pytest.mark.parametrize("name", ["f_r", "f_t"])
def test_an_isotropic_table_is_equation_12(name: str) -> None:
    """Every sample, by NumPy; the axes have names, values in radians, and there is no phi_i."""
    table = tabulate_table(bsdf_spec({"distribution": "beckmann"}, roughness=[0.2, 0.5]), {Part.SPECTRUM})
    dims = ("roughness", "theta_i", "theta_o", "phi", "wavelength_nm")
    assert table.variables[name].dims == dims
    assert table.variables[name].unit == "1/sr"
    assert "phi_i" not in table.coords
    assert table.coords["theta_o"].unit == "rad"
    np.testing.assert_allclose(table.values("theta_o"), ANGLES["theta_o"])
    for place, alpha in enumerate((0.2, 0.5)):
        expected = exact(name, Surface("beckmann", alpha, alpha), table, 0.0)
        np.testing.assert_allclose(table.values(name)[place], expected, rtol=2e-4, atol=2e-5)


@pytest.mark.parametrize("name", ["f_r", "f_t"])
def test_an_anisotropic_table_has_the_azimuth_of_the_light(name: str) -> None:
    """phi_i after the roughness; roughness is sqrt(alpha_x alpha_y) and keeps the ratio."""
    phi_i = [-0.4, 0.0, 1.2]
    surface = {"distribution": "ggx", "masking": "smith", "alpha_x": 0.2, "alpha_y": 0.8}
    table = tabulate_table(bsdf_spec(surface, phi_i=phi_i), {Part.SPECTRUM})
    dims = ("roughness", "phi_i", "theta_i", "theta_o", "phi", "wavelength_nm")
    assert table.variables[name].dims == dims
    assert table.values(name).shape == (1, 3, 2, 3, 3, 4)
    np.testing.assert_allclose(table.values("roughness"), [0.4])
    for place, phi in enumerate(phi_i):
        expected = exact(name, Surface("ggx", 0.2, 0.8, "smith"), table, phi)
        np.testing.assert_allclose(table.values(name)[0, place], expected, rtol=2e-4, atol=2e-5)


def test_only_the_parts_asked_for() -> None:
    """Colours have a channel in the place of the wavelength."""
    spec = bsdf_spec({"alpha_x": 0.3})
    table = tabulate_table(spec, {Part.COLOUR})
    assert set(table.variables) == {"f_r_rgb", "f_t_rgb"}
    assert table.variables["f_r_rgb"].dims == ("roughness", "theta_i", "theta_o", "phi", "channel")
    assert table.values("f_r_rgb").shape == (1, 2, 3, 3, 3)
    assert set(tabulate_table(spec, {Part.SPECTRUM}).variables) == {"f_r", "f_t"}
    assert set(tabulate_table(spec).variables) == {"f_r", "f_t", "f_r_rgb", "f_t_rgb"}


def test_equal_media_have_no_table_of_transmission() -> None:
    """Light passes straight on, in one direction that f_t cannot hold: it is 0. E_t of an albedo is not."""
    table = tabulate_table(bsdf_spec({"alpha_x": 0.3}, substrate="vacuum"))
    assert set(table.variables) == {"f_r", "f_r_rgb", "f_t"}
    assert not table.values("f_t").any()
    albedo = tabulate_table(rough_spec({"alpha_x": 0.3}, substrate="vacuum", cos_theta=3))
    assert albedo.values("E_t").min() >= 0
    assert albedo.values("E_t")[0, 0, -1].min() > 0.5


@pytest.mark.parametrize(
    ("surface", "substrate"),
    [({"alpha_x": 0.3}, {"n": 1.5, "k": 0.1}), ({"alpha_x": 0.3, "distribution": "phong"}, {"n": 1.5})],
)
def test_nothing_goes_through(surface: dict[str, Any], substrate: dict[str, float]) -> None:
    """An opaque substrate, and a lobe of Phong's, which is one of reflection: f_t is 0, and has no colour."""
    table = tabulate_table(bsdf_spec(surface, substrate=substrate))
    assert set(table.variables) == {"f_r", "f_t", "f_r_rgb"}
    assert (table.values("f_t") == 0).all()
    assert table.values("f_t").shape == table.values("f_r").shape
    assert table.values("f_t").dtype == table.values("f_r").dtype == np.float32


def test_double_precision_is_stored() -> None:
    """Asked for, all of it is: also the zeros."""
    document = bsdf_spec({"alpha_x": 0.3}, substrate={"n": 1.5, "k": 0.1}).model_dump(mode="json")
    table = tabulate_table(Spec.model_validate(document | {"accuracy": {"precision": "double"}}))
    assert {variable.values.dtype for variable in table.variables.values()} == {np.dtype(np.float64)}


def test_the_paper_exceeds_no_light() -> None:
    """c_a + c_b too large: one message with the albedo and what to do."""
    surface = {"alpha_x": 0.3, "specular_weight": 1.0, "diffuse_weight": 1.0, "diffuse_reflectance": 0.9}
    with pytest.raises(SpecError, match=r"surface: expected .*albedo.* at most 1, got an albedo of 1\.\d{3}"):
        tabulate_table(bsdf_spec(surface))


def test_a_table_over_the_budget_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before its directions are laid out: the message has its sizes."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "16M")
    angles = {"theta_i": 64, "theta_o": 64, "phi": 64}
    with pytest.raises(BudgetError, match="a bsdf table of 1 x 1 x 64 x 64 x 64"):
        tabulate_table(bsdf_spec({"alpha_x": 0.3}, **angles))


@pytest.mark.parametrize("fault", [np.nan, -1.0, np.inf])
def test_a_poisoned_result_is_refused(fault: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """One value that no sound device gives, and there is no table."""
    known = BsdfSolver.spectra

    def poisoned(self: BsdfSolver, *args: object) -> FloatArray:
        f = known(self, *args)  # type: ignore[arg-type]
        f[-1, -1] = fault
        return f

    spec = bsdf_spec({"alpha_x": 0.3})
    certificate = BsdfCertificate(**tabulate_table(spec).certificate)
    monkeypatch.setattr(module, "certify", lambda *_: certificate)
    monkeypatch.setattr(BsdfSolver, "spectra", poisoned)
    with pytest.raises(NumericalError, match="f_r has values"):
        tabulate_table(spec, {Part.SPECTRUM})


def test_progress_rises_to_one() -> None:
    """Over all parts together, and never back."""
    told: list[float] = []
    tabulate_table(bsdf_spec({"alpha_x": 0.3}), observer=told.append)
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1)


def test_the_same_spec_gives_the_same_bytes() -> None:
    """Three times, certificate and all."""
    spec = bsdf_spec({"distribution": "ggx", "masking": "smith", "alpha_x": 0.3,
                      "multiple_scattering": "kulla-conty"})  # fmt: skip
    first, *others = (tabulate_table(spec) for _ in range(3))
    for again in others:
        assert again.provenance == first.provenance
        for name, variable in first.variables.items():
            assert again.values(name).tobytes() == variable.values.tobytes()


@pytest.mark.parametrize("n", [1.1, 1.3, 1.5, 1.7])
def test_a_free_film_whose_fringes_touch_0_is_a_table(n: float) -> None:
    """R of a clear film between equal media is 0 at half waves, where a cubic would fall below it."""
    film = {"material": {"n": n}, "thickness_nm": 300}
    spec = rough_spec({"distribution": "ggx", "alpha_x": 0.3}, film, substrate="vacuum", quantity="bsdf")
    table = tabulate_table(spec, {Part.SPECTRUM})
    assert table.values("f_r").min() >= 0
    assert table.values("f_r").max() > 1
    assert not table.values("f_t").any()
