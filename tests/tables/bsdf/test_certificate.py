"""A BSDF's certificate is honest: an independent measurement finds the same."""

from itertools import product

import numpy as np
import pytest

from kernel_surface import directions_of, rough_spec
from nacreous.tables.certificate import certificate_fields
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table
from reference_facets import FloatArray, Surface
from reference_surface import Coating, f_r, f_t

NM = [400.0, 440.0, 480.0, 700.0]
ANGLES = {"theta_i": [0.1, 0.5, 0.9], "theta_o": [0.0, 0.3, 0.6, 0.9, 1.2], "phi": [1.5, 2.0, 2.5, 3.1]}
AXES = ("theta_i", "theta_o", "phi", "wavelength_nm")
ALPHA = 0.45


@pytest.fixture(scope="module")
def table() -> Table:
    """Return a table of which every cell is measured: 2 x 4 x 3 over angles, 3 over wavelength, two sides."""
    return tabulate_table(
        rough_spec({"distribution": "ggx", "alpha_x": ALPHA}, quantity="bsdf", wavelength_nm=NM, **ANGLES)
    )


def exact(name: str, theta_i: float, theta_o: float, phi: float, nm: FloatArray) -> FloatArray:
    """f_r or f_t by NumPy, (L,)."""
    index = np.array([1.0, 2.0, 1.5], complex)[:, None] * np.ones(nm.size)
    coating = Coating(index, np.array([300.0]), nm)
    i, o = (directions_of(np.cos([t]), np.array([p])) for t, p in ((theta_i, 0.0), (theta_o, phi)))
    function, side = (f_r, 1) if name == "f_r" else (f_t, -1)
    return np.asarray(function(Surface("ggx", ALPHA, ALPHA), coating, i, o * [1, 1, side])[0])


def amid(values: FloatArray) -> FloatArray:
    """Mean of the 16 corners of every cell over the last four axes: linear interpolation in its middle."""
    for axis in range(-4, 0):
        values = np.moveaxis(values, axis, -1)
        values = np.moveaxis((values[..., 1:] + values[..., :-1]) / 2, -1, axis)
    return values


@pytest.fixture(scope="module")
def found(table: Table) -> tuple[FloatArray, FloatArray]:
    """Return the errors of f cos_o amid all cells, and f cos_o there, found by NumPy: both sides, flat."""
    theta_i, theta_o, phi, nm = (np.convolve(table.values(axis), [0.5, 0.5], "valid") for axis in AXES)
    errors, sizes = [], []
    for name in ("f_r", "f_t"):
        between = amid(table.values(name)[0].astype(float))
        for place in product(range(2), range(4), range(3)):
            angles = theta_i[place[0]], theta_o[place[1]], phi[place[2]]
            truth = exact(name, *angles, nm)
            cos_o = np.cos(angles[1])
            errors.append(np.abs(between[place] - truth) * cos_o)
            sizes.append(truth * cos_o)
    return np.ravel(errors), np.ravel(sizes)


def test_errors_are_those_of_the_cells_middles(table: Table, found: tuple[FloatArray, FloatArray]) -> None:
    """Found again at all 144 middles, the largest and the 99th percentile; the largest value, a sample's."""
    errors, sizes = found
    stated = table.certificate
    assert stated["held_out_points"] == errors.size == 144
    cos_o = np.cos(table.values("theta_o"))[:, None, None]
    largest = max(float((table.values(name) * cos_o).max()) for name in ("f_r", "f_t"))
    assert largest > sizes.max()
    assert stated["bsdf_max"] == pytest.approx(largest, rel=1e-3)
    assert stated["bsdf_error_max"] == pytest.approx(errors.max(), abs=1e-4 + 1e-3 * errors.max())
    assert stated["bsdf_error_p99"] == pytest.approx(
        np.quantile(errors, 0.99), abs=1e-4 + 1e-3 * errors.max()
    )
    assert errors.max() > 0.01 * sizes.max()  # coarse enough to tell


def test_samples_are_as_exact_as_stated(table: Table) -> None:
    """Every sample of the table by NumPy: off by twice the stated share of it at most."""
    stated = table.certificate
    assert 0 < stated["sample_error_max"] <= 1e-3
    nm = np.array(NM)
    for name, (a, theta_i), (b, theta_o), (c, phi) in product(
        ("f_r", "f_t"), *(list(enumerate(ANGLES[axis]))[::2] for axis in AXES[:3])
    ):
        truth = exact(name, theta_i, theta_o, phi, nm)
        error = np.abs(table.values(name)[0, a, b, c] - truth)
        seen = truth * np.cos(theta_o) > 1e-3 * stated["bsdf_max"]
        assert (error[seen] <= 2 * stated["sample_error_max"] * truth[seen] + 2e-5).all()


def test_the_figures_of_a_sound_table(table: Table) -> None:
    """Reciprocity to 1e-5, no more light than there is, colours compared, nothing missing."""
    stated = table.certificate
    assert set(stated) == set(certificate_fields("bsdf"))
    assert stated["reciprocity_error_max"] <= 1e-5
    assert 0.9 < stated["energy_max"] <= 1 + 1e-3
    assert stated["nonfinite"] == 0
    assert stated["film_error"] <= 1e-5
    assert 0 < stated["delta_e_p99"] <= stated["delta_e_max"]
    assert 0 <= stated["out_of_gamut"] < 1
    assert stated["quadrature_error"] <= 2e-4


def test_a_lobe_narrower_than_the_grid_is_told() -> None:
    """Alpha 0.02 on steps of a tenth of a radian: the error is a large part of the lobe."""
    angles = {"theta_i": [0.3, 0.5], "theta_o": [0.3, 0.4, 0.5], "phi": [2.9, 3.1]}
    spec = rough_spec({"alpha_x": 0.02}, quantity="bsdf", wavelength_nm=NM, **angles)
    stated = tabulate_table(spec).certificate
    assert stated["bsdf_error_max"] > 0.1 * stated["bsdf_max"]


def test_a_finer_grid_has_smaller_errors() -> None:
    """Half the steps in every angle: a quarter of the error of what is smooth, at least half of it here."""

    def error(count: int) -> float:
        angles = {"theta_i": count, "theta_o": count, "phi": count}
        spec = rough_spec({"alpha_x": 0.6}, quantity="bsdf", wavelength_nm=[400.0, 401.0, 700.0], **angles)
        return float(tabulate_table(spec).certificate["bsdf_error_p99"])

    assert error(17) <= 0.6 * error(9)
