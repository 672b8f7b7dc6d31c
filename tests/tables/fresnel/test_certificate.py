"""A certificate is honest: what it states is what an independent measurement finds."""

import numpy as np
import pytest

from nacreous.optics.colour import lab
from nacreous.optics.delta_e import delta_e_2000
from nacreous.tables.presets import preset
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb

WHITE = np.array([0.3127 / 0.3290, 1.0, (1 - 0.3127 - 0.3290) / 0.3290])
RGB_TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
"""Rec.709 as IEC 61966-2-1 prints it."""
INDEX = np.array([1.0, 2.0, 1.5], complex)


def _spec(**sections: object) -> Spec:
    layer = {"material": {"n": 2.0}, "thickness_nm": 420}
    stack = {"incident": "vacuum", "substrate": {"n": 1.5}, "layers": [layer]}
    return Spec.model_validate({"stack": stack} | sections)


def _largest_intensity_error(table: Table) -> float:
    """Interpolate a one-thickness table at random points; the largest error, by the reference."""
    rng = np.random.default_rng(5)
    mu, nm = table.values("cos_theta"), table.values("wavelength_nm")
    worst = 0.0
    for _ in range(300):
        a, w = rng.integers(mu.size - 1), rng.integers(nm.size - 1)
        s, t = rng.uniform(0.3, 0.7, 2)
        point = (1 - s) * mu[a] + s * mu[a + 1], (1 - t) * nm[w] + t * nm[w + 1]
        exact = film(INDEX, np.array([420.0]), np.array([point[1]]), np.array([point[0]]))
        for name in ("R_s", "R_p", "T_s", "T_p"):
            cell = table.values(name)[0, a : a + 2, w : w + 2].astype(float)
            between = np.array([1 - s, s]) @ cell @ np.array([1 - t, t])
            worst = max(worst, abs(between - getattr(exact, name).item()))
    return worst


@pytest.mark.parametrize(("angles", "step_nm"), [(33, 10.0), (128, 2.0)])
def test_stated_errors_are_the_measured_ones(angles: int, step_nm: float) -> None:
    """300 random points: none is off by more than stated, and the worst is not far below it."""
    wavelengths = {"start": 350, "stop": 750, "step": step_nm}
    table = tabulate_table(_spec(table={"cos_theta": angles, "wavelength_nm": wavelengths}))
    worst = _largest_intensity_error(table)
    assert worst <= 1.05 * table.certificate["intensity_error_max"]
    assert table.certificate["intensity_error_max"] <= 2.5 * worst


def _colour_differences(table: Table, points: int) -> np.ndarray:
    """CIEDE2000 of interpolated and exact R at random points short of grazing, by colour-science."""
    rng = np.random.default_rng(11)
    mu, scales = table.values("cos_theta"), table.values("thickness_scale")
    differences = []
    for _ in range(points):
        point, scale = rng.uniform(0.025, 1), rng.uniform(scales[0], scales[-1])
        rows = [_interpolated_row(table, row, point) for row in range(scales.size)]
        between = np.array([np.interp(scale, scales, channel) for channel in np.transpose(rows)])
        exact = film(INDEX, np.array([420.0 * scale]), WAVELENGTH_NM, np.array([point]))
        rgb = linear_rgb((exact.R_s[0] + exact.R_p[0]) / 2)
        differences.append(delta_e_2000(_lab(between), _lab(rgb)).item())
    assert mu.size > 1
    return np.array(differences)


def _interpolated_row(table: Table, row: int, mu: float) -> np.ndarray:
    colour = table.values("R_rgb")[row].astype(float)
    return np.array([np.interp(mu, table.values("cos_theta"), colour[:, c]) for c in range(3)])


def _lab(rgb: np.ndarray) -> np.ndarray:
    return lab(rgb @ RGB_TO_XYZ.T, WHITE)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("delta_e", [2.0, 0.5])
def test_a_demanded_difference_is_kept(delta_e: float) -> None:
    """400 random points of a table over angle and thickness, measured by colour-science, keep to it."""
    axes = {"cos_theta": 5, "thickness_scale": {"start": 0.5, "stop": 1.0, "count": 3}}
    table = tabulate_table(_spec(table=axes, accuracy={"delta_e": delta_e}))
    assert table.certificate["delta_e_max"] <= delta_e
    assert _colour_differences(table, 400).max() <= 1.1 * delta_e


def test_a_tighter_demand_is_a_larger_table() -> None:
    """The grid grows with the demand, and is no larger than the demand needs by a factor of two."""
    axes = {"cos_theta": 5, "thickness_scale": {"start": 0.5, "stop": 1.0, "count": 3}}
    tables = [tabulate_table(_spec(table=axes, accuracy={"delta_e": d})) for d in (4.0, 1.0, 0.25)]
    sizes = [table.values("R_rgb").size for table in tables]
    assert sizes[0] < sizes[1] < sizes[2]
    assert all(t.certificate["delta_e_max"] >= d / 2 for t, d in zip(tables, (4.0, 1.0, 0.25), strict=True))


def test_the_specs_own_axes_are_lower_bounds() -> None:
    """A grid that holds already is left as it is."""
    spec = _spec(table={"cos_theta": 512}, accuracy={"delta_e": 5.0})
    assert tabulate_table(spec).values("cos_theta").size == 512


def test_a_refined_axis_keeps_its_ends_and_spacing() -> None:
    """Equidistant stays equidistant, from the same first to the same last value."""
    spec = _spec(table={"cos_theta": {"start": 0.2, "stop": 0.9, "count": 4}}, accuracy={"delta_e": 0.3})
    mu = tabulate_table(spec).values("cos_theta")
    assert mu.size > 4
    assert (mu[0], mu[-1]) == (0.2, 0.9)
    np.testing.assert_allclose(np.diff(mu), 0.7 / (mu.size - 1), rtol=1e-9)


def test_energy_and_gamut_are_stated() -> None:
    """A lossless film keeps all light; titanium keeps some; a bubble's colours leave the gamut."""
    assert tabulate_table(_spec()).certificate["energy_max"] == pytest.approx(1, abs=2e-5)
    ag = {
        "incident": "vacuum",
        "substrate": {"n": 2.7, "k": 3.5},
        "layers": _spec().stack.model_dump()["layers"],
    }
    lossy = tabulate_table(Spec.model_validate({"stack": ag, "table": {"cos_theta": [0.5, 1.0]}}))
    assert lossy.certificate["energy_max"] <= 1
    assert 0.01 < tabulate_table(preset("soap-bubble")).certificate["out_of_gamut"] < 0.5


def test_rounding_is_stated() -> None:
    """Single precision rounds to a few 1e-7 here, double precision not at all."""
    assert 1e-8 < tabulate_table(_spec()).certificate["rounding_error_max"] < 5e-6
    double = tabulate_table(_spec(accuracy={"precision": "double"}))
    assert double.certificate["rounding_error_max"] == 0
