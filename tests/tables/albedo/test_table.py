"""Tables of E_r and E_t: what is in them, and what is refused."""

from typing import Any

import numpy as np
import pytest

from kernel_surface import FacetAlbedo, rough_spec
from nacreous.errors import BudgetError, NumericalError, SpecError
from nacreous.tables.albedo import table as module
from nacreous.tables.albedo.certificate import AlbedoCertificate
from nacreous.tables.albedo.solver import AlbedoSolver
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part
from nacreous.tables.tabulate import tabulate_table
from reference import film as reference_film
from reference_colour import WAVELENGTH_NM, linear_rgb
from reference_facets import FloatArray, Surface
from reference_surface import Coating

NM = np.array([400.0, 500.0, 600.0, 700.0])
SCALES = [0.5, 1.0, 1.25]
MEANS = {"E_r_mean", "E_t_mean"}


def coating(thickness_nm: float, nm: FloatArray) -> Coating:
    """Return n = 2.0 on glass."""
    return Coating(
        np.array([1.0, 2.0, 1.5], complex)[:, None] * np.ones(nm.size), np.array([thickness_nm]), nm
    )


def test_every_sample_is_the_albedo() -> None:
    """E_r over (roughness, thickness_scale, cos_theta, wavelength_nm), by the cubature: 2e-4 at each."""
    table = tabulate_table(
        rough_spec({"distribution": "beckmann"}, roughness=[0.1, 0.5], thickness_scale=SCALES,
                   cos_theta=[0.2, 0.6, 1.0]),
        {Part.SPECTRUM},
    )  # fmt: skip
    assert table.variables["E_r"].dims == ("roughness", "thickness_scale", "cos_theta", "wavelength_nm")
    assert table.variables["E_r"].unit == "1"
    assert table.values("E_r").shape == (2, 3, 3, 4)
    for s, scale in enumerate(SCALES):
        albedo = FacetAlbedo(coating(300 * scale, NM))
        for r, alpha in enumerate((0.1, 0.5)):
            for a, mu in enumerate((0.2, 0.6, 1.0)):
                expected = albedo.at(Surface("beckmann", alpha, alpha), mu)
                np.testing.assert_allclose(table.values("E_r")[r, s, a], expected, rtol=0, atol=2e-4)


def test_means_are_weighted_by_the_cosine() -> None:
    """2 integral of E mu d mu, by Gauss-Legendre over 48 angles of the same table; within 2e-4."""
    nodes, gauss = np.polynomial.legendre.leggauss(48)
    mu = (nodes + 1) / 2
    surface = {"distribution": "ggx", "masking": "smith", "alpha_x": 0.4}
    table = tabulate_table(rough_spec(surface, thickness_scale=SCALES, cos_theta=list(mu)), {Part.SPECTRUM})
    for side in ("E_r", "E_t"):
        mean = table.variables[f"{side}_mean"]
        assert mean.dims == ("roughness", "thickness_scale", "wavelength_nm")
        expected = np.einsum("rsal,a->rsl", table.values(side), mu * gauss)
        np.testing.assert_allclose(mean.values, expected, rtol=0, atol=2e-4)


def test_colours_are_those_of_the_spectra() -> None:
    """E_r_rgb by the cubature at 1 nm and colour-science, to 1e-3, as the film's own."""
    wide = {"start": 360, "stop": 830, "step": 47}
    table = tabulate_table(
        rough_spec({"alpha_x": 0.25}, wavelength_nm=wide, cos_theta=[0.3, 0.9]), {Part.COLOUR}
    )
    assert table.variables["E_r_rgb"].dims == ("roughness", "thickness_scale", "cos_theta", "channel")
    albedo = FacetAlbedo(coating(300.0, WAVELENGTH_NM), nodes=257)
    for place, mu in enumerate((0.3, 0.9)):
        expected = linear_rgb(albedo.at(Surface("ashikhmin-shirley", 0.25, 0.25), mu))
        np.testing.assert_allclose(table.values("E_r_rgb")[0, 0, place], expected, rtol=0, atol=1e-3)


def test_only_the_parts_asked_for() -> None:
    """Spectra come with their means, colours by themselves."""
    spec = rough_spec({"alpha_x": 0.3}, cos_theta=3)
    assert set(tabulate_table(spec, {Part.SPECTRUM}).variables) == {"E_r", "E_t"} | MEANS
    assert set(tabulate_table(spec, {Part.COLOUR}).variables) == {"E_r_rgb", "E_t_rgb"}
    assert set(tabulate_table(spec).variables) == {"E_r", "E_t", "E_r_rgb", "E_t_rgb"} | MEANS


@pytest.mark.parametrize(
    ("surface", "substrate"),
    [({"alpha_x": 0.3}, {"n": 1.5, "k": 0.1}), ({"alpha_x": 0.3, "distribution": "phong"}, {"n": 1.5})],
)
def test_nothing_goes_through(surface: dict[str, Any], substrate: dict[str, float]) -> None:
    """An opaque substrate, and a lobe of Phong's, which is one of reflection: E_t is 0, and has no colour."""
    table = tabulate_table(rough_spec(surface, substrate=substrate, cos_theta=3))
    assert set(table.variables) == {"E_r", "E_t", "E_r_rgb"} | MEANS
    assert (table.values("E_t") == 0).all()
    assert (table.values("E_t_mean") == 0).all()
    assert table.values("E_r").min() > 0


def test_a_smooth_surface_is_the_film() -> None:
    """Alpha 0.001: E_r and E_t are R and T of tests/reference.py short of grazing, to 1e-3."""
    mu = np.array([0.2, 0.5, 1.0])
    table = tabulate_table(rough_spec({"alpha_x": 0.001}, cos_theta=list(mu)), {Part.SPECTRUM})
    at = reference_film([1.0, 2.0, 1.5], [300.0], NM, mu)
    for name, expected in (("E_r", (at.R_s + at.R_p) / 2), ("E_t", (at.T_s + at.T_p) / 2)):
        np.testing.assert_allclose(table.values(name)[0, 0], expected, rtol=0, atol=1e-3)


@pytest.mark.parametrize("quantity", ["single", "double"])
def test_numbers_are_stored_as_asked_for(quantity: str) -> None:
    """All of them, within [0, 1] but for colours."""
    document = rough_spec({"alpha_x": 0.3}, cos_theta=5).model_dump(mode="json")
    table = tabulate_table(Spec.model_validate(document | {"accuracy": {"precision": quantity}}))
    dtype = np.dtype(np.float32 if quantity == "single" else np.float64)
    assert {variable.values.dtype for variable in table.variables.values()} == {dtype}
    for name in ("E_r", "E_t", *MEANS):
        assert table.values(name).min() >= 0
        assert table.values(name).max() <= 1


def test_diffuse_light_is_added() -> None:
    """specular_weight E + diffuse_weight diffuse_reflectance: equation 12 is a sum."""
    weights = {"specular_weight": 0.6, "diffuse_weight": 0.4, "diffuse_reflectance": 0.5}
    bare, mixed = (tabulate_table(rough_spec({"alpha_x": 0.3} | more, cos_theta=5)) for more in ({}, weights))
    np.testing.assert_allclose(mixed.values("E_r"), 0.6 * bare.values("E_r") + 0.2, rtol=0, atol=1e-6)
    np.testing.assert_allclose(
        mixed.values("E_r_mean"), 0.6 * bare.values("E_r_mean") + 0.2, rtol=0, atol=1e-6
    )
    np.testing.assert_allclose(mixed.values("E_t"), 0.6 * bare.values("E_t"), rtol=0, atol=1e-6)
    white = 0.6 * bare.values("E_r_rgb") + 0.2
    np.testing.assert_allclose(
        mixed.values("E_r_rgb"), white, rtol=0, atol=1e-3
    )  # 400 to 700 nm: nearly white


def test_more_light_than_there_is_is_refused() -> None:
    """c_a + c_b too large: one message with the albedo and what to do."""
    surface = {"alpha_x": 0.3, "diffuse_weight": 1.0, "diffuse_reflectance": 0.95}
    with pytest.raises(SpecError, match=r"at most 1, got an albedo of 1\.\d{3} at cos_theta .*; reduce"):
        tabulate_table(rough_spec(surface, cos_theta=3))


def test_a_table_over_the_budget_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The message has its sizes."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1M")
    spec = rough_spec({}, roughness={"start": 0.1, "stop": 0.9, "count": 64}, cos_theta=1024)
    with pytest.raises(BudgetError, match="an albedo table of 64 x 1 x 1024"):
        tabulate_table(spec)


@pytest.mark.parametrize("fault", [np.nan, -0.1, 1.1])
def test_a_poisoned_result_is_refused(fault: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """One value that no sound device gives, and there is no table: it is not clamped away."""
    spec = rough_spec({"alpha_x": 0.3}, cos_theta=3)
    certificate = AlbedoCertificate(**tabulate_table(spec).certificate)
    known = AlbedoSolver.spectra

    def poisoned(self: AlbedoSolver, *args: object) -> dict[Any, FloatArray]:
        sides = known(self, *args)  # type: ignore[arg-type]
        next(iter(sides.values()))[0, 0, 0, 0] = fault
        return sides

    monkeypatch.setattr(module, "certify", lambda *_: certificate)
    monkeypatch.setattr(module, "check_albedo", lambda *_: 1.0)
    monkeypatch.setattr(AlbedoSolver, "spectra", poisoned)
    with pytest.raises(NumericalError, match=r"E_r lies in .* must lie in \[0, 1\]"):
        tabulate_table(spec, {Part.SPECTRUM})


def test_progress_rises_to_one() -> None:
    """Over all parts together, and never back."""
    told: list[float] = []
    tabulate_table(rough_spec({"alpha_x": 0.3}, cos_theta=9), observer=told.append)
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1)


def test_an_observer_can_cancel() -> None:
    """What it raises ends the work."""

    class CancelledError(Exception):
        pass

    def cancel(_: float) -> None:
        raise CancelledError

    with pytest.raises(CancelledError):
        tabulate_table(rough_spec({"alpha_x": 0.3}, cos_theta=9), observer=cancel)


def test_the_same_spec_gives_the_same_bytes() -> None:
    """Three times, certificate and all."""
    surface = {"distribution": "ggx", "masking": "smith", "multiple_scattering": "kulla-conty"}
    spec = rough_spec(surface, roughness=[0.1, 0.6], cos_theta=9)
    first, *others = (tabulate_table(spec) for _ in range(3))
    for again in others:
        assert again.provenance == first.provenance
        for name, variable in first.variables.items():
            assert again.values(name).tobytes() == variable.values.tobytes()
