"""An albedo's certificate is honest: an independent measurement finds no more, and not much less."""

import numpy as np
import pytest

from kernel_surface import CLEAR, FacetAlbedo, rough_spec
from nacreous.tables.albedo.certificate import AlbedoCertificate
from nacreous.tables.certificate import certificate_fields
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table
from reference_facets import FloatArray, Surface
from reference_surface import Coating

ROUGHNESS, ANGLES = [0.1, 0.3, 0.7], 25
NM = [400.0, 430.0, 460.0, 490.0, 700.0]


@pytest.fixture(scope="module")
def table() -> Table:
    """Return a table of which every cell is measured: 2 over roughness, 24 over angle, 4 over wavelength."""
    surface = {"distribution": "beckmann", "masking": "smith"}
    axes = {"roughness": ROUGHNESS, "cos_theta": ANGLES, "wavelength_nm": NM}
    return tabulate_table(rough_spec(surface, substrate={"n": 1.6, "k": 0.5}, **axes))


def exact(roughness: float, mu: FloatArray, nm: FloatArray) -> FloatArray:
    """E_r by the cubature, with the film of tests/reference.py, (A, L)."""
    index = np.array([1.0, 2.0, 1.6 + 0.5j], complex)[:, None] * np.ones(nm.size)
    albedo = FacetAlbedo(Coating(index, np.array([CLEAR["thickness_nm"]], float), nm))
    return np.array([albedo.at(Surface("beckmann", roughness, roughness, "smith"), float(m)) for m in mu])


def interpolated(table: Table, roughness: float, mu: FloatArray, nm: FloatArray) -> FloatArray:
    """E_r as a reader interpolates it, linearly over every axis, (A, L)."""
    axes = (table.values("roughness"), table.values("cos_theta"), table.values("wavelength_nm"))
    values = table.values("E_r")[:, 0].astype(float)
    for axis, at in zip(axes, (np.array([roughness]), mu, nm), strict=True):
        upper = np.clip(np.searchsorted(axis, at), 1, axis.size - 1)
        t = (at - axis[upper - 1]) / (axis[upper] - axis[upper - 1])
        values = np.moveaxis(values, 0, -1)
        values = (1 - t) * values[..., upper - 1] + t * values[..., upper]
    return np.asarray(values[0])


def middles(axis: list[float] | FloatArray) -> FloatArray:
    """Middles of all cells."""
    values = np.asarray(axis, float)
    return (values[:-1] + values[1:]) / 2


def test_the_largest_error_is_that_of_the_cells_middles(table: Table) -> None:
    """Found again at all 192 middles: the same to 2e-4, by a cubature of another kind."""
    mu, nm = middles(np.linspace(0, 1, ANGLES)), middles(NM)
    errors = [np.abs(interpolated(table, r, mu, nm) - exact(r, mu, nm)) for r in middles(ROUGHNESS)]
    assert table.certificate["held_out_points"] == 192
    assert table.certificate["albedo_error_max"] == pytest.approx(np.max(errors), abs=2e-4)
    assert table.certificate["albedo_error_p99"] == pytest.approx(
        np.quantile(errors, 0.99), abs=2e-4
    )  # E_t, 0 of a metal, is not among them
    assert np.max(errors) > 0.01  # coarse enough that an error of 2e-4 tells


def test_cells_that_were_not_measured_are_no_further_off() -> None:
    """24 of 95 cells over the angle are measured; amid others the error is no larger, but for a tenth."""
    surface = {"distribution": "beckmann", "masking": "smith", "alpha_x": 0.3}
    nm = [400.0, 500.0, 600.0, 700.0]
    spec = rough_spec(surface, substrate={"n": 1.6, "k": 0.5}, cos_theta=96, wavelength_nm=nm)
    table = tabulate_table(spec)
    assert table.certificate["held_out_points"] == 24 * 3
    measured = np.unique(np.linspace(0, 94, 24).round().astype(int))
    others = np.setdiff1d(np.arange(95), measured)[::3]
    mu, at = middles(np.linspace(0, 1, 96))[others], middles(nm)
    wide = rough_spec(
        surface, substrate={"n": 1.6, "k": 0.5}, cos_theta=96, wavelength_nm=nm, roughness=[0.3, 0.31]
    )
    got = interpolated(tabulate_table(wide), 0.3, mu, at)
    error = np.abs(got - exact(0.3, mu, at)).max()
    assert error <= 1.1 * table.certificate["albedo_error_max"] + 1e-4


def test_the_figures_of_a_sound_table(table: Table) -> None:
    """Texels are exact to 3e-4, nothing is missing, and an absorbing substrate keeps some light."""
    stated = table.certificate
    assert set(stated) == set(certificate_fields("albedo"))
    assert 0 < stated["texel_error_max"] <= 3e-4
    assert stated["film_error"] <= 1e-5
    assert stated["nonfinite"] == 0
    assert stated["colour_cells"] == 48
    assert 0 < stated["energy_max"] < 1
    assert 0 < stated["delta_e_p99"] <= stated["delta_e_max"]
    assert stated["out_of_gamut"] == 0
    assert stated["quadrature_error"] <= 2e-4


def test_the_energy_of_a_clear_film() -> None:
    """E_r + E_t of what absorbs nothing is 1 at its largest, facets of 0.05 hardly shadow."""
    stated = tabulate_table(rough_spec({"alpha_x": 0.05}, cos_theta=9)).certificate
    assert stated["energy_max"] == pytest.approx(1, abs=1e-3)


def test_double_precision_is_no_worse_at_the_texels() -> None:
    """Of a smooth surface's albedo the rule, the nodes and either precision take 1e-5 at most."""
    document = rough_spec({"alpha_x": 0.3}, cos_theta=5).model_dump(mode="json")
    for precision in ("single", "double"):
        spec = Spec.model_validate(document | {"accuracy": {"precision": precision}})
        assert tabulate_table(spec).certificate["texel_error_max"] <= 1e-5


def test_an_infrared_table_has_no_colours() -> None:
    """Their figures are empty, the others are not."""
    nm = {"start": 1000, "stop": 2000, "step": 250}
    stated = tabulate_table(rough_spec({"alpha_x": 0.3}, wavelength_nm=nm, cos_theta=3)).certificate
    assert stated["delta_e_max"] is stated["out_of_gamut"] is stated["quadrature_error"] is None
    assert stated["colour_cells"] == 0
    assert stated["albedo_error_max"] > 0
    assert set(stated) == set(AlbedoCertificate.__dataclass_fields__)
