"""A refined grid keeps its promise at points that it has never seen."""

from typing import NamedTuple

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.optics.colour import ColourSystem, colour_system, lab
from nacreous.optics.delta_e import delta_e_2000
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb

INDEX, THICKNESS_NM = [1.0, 2.0, 1.5], 400.0
SCALES, ANGLES = 20, 100


def refined(delta_e: float, **axes: object) -> Table:
    """Tabulate the film of Wu & Zheng 2015, figure 5, from 400 to 600 nm, to a colour difference."""
    layer = {"material": {"n": INDEX[1]}, "thickness_nm": THICKNESS_NM}
    spec = {
        "stack": {"incident": "vacuum", "substrate": {"n": INDEX[2]}, "layers": [layer]},
        "table": {"cos_theta": 9, "thickness_scale": {"start": 1.0, "stop": 1.5, "count": 3},
                  "wavelength_nm": {"start": 360, "stop": 780, "step": 20}} | axes,
        "accuracy": {"delta_e": delta_e},
    }  # fmt: skip
    return tabulate_table(Spec.from_document(spec), {Part.COLOUR})


def interpolated(table: Table, scale: float, mu: np.ndarray) -> np.ndarray:
    """Interpolate the table bilinearly, as its reader does: (A, 3)."""
    scales, colour = table.values("thickness_scale"), table.values("R_rgb").astype(float)
    upper = int(np.clip(np.searchsorted(scales, scale), 1, scales.size - 1))
    t = (scale - scales[upper - 1]) / (scales[upper] - scales[upper - 1])
    row = (1 - t) * colour[upper - 1] + t * colour[upper]
    return np.stack([np.interp(mu, table.values("cos_theta"), channel) for channel in row.T], axis=-1)


def lab_of(rgb: np.ndarray, system: ColourSystem) -> np.ndarray:
    """L*a*b* of linear Rec.709."""
    return lab(system.to_xyz(rgb), system.white)


class Witness(NamedTuple):
    """Random points short of grazing, and the exact colours there, by the reference and colour-science."""

    scales: np.ndarray  # (S,)
    cosines: np.ndarray  # (S, A)
    rgb: np.ndarray  # (S, A, 3)


@pytest.fixture(scope="module")
def witness() -> Witness:
    """Return 2,000 points: 20 thicknesses, and 100 angles for each."""
    rng = np.random.default_rng(20)
    scales, cosines = rng.uniform(1.0, 1.5, SCALES), rng.uniform(0.01, 1, (SCALES, ANGLES))
    films = [
        film(INDEX, [THICKNESS_NM * scale], WAVELENGTH_NM, mu)
        for scale, mu in zip(scales, cosines, strict=True)
    ]
    return Witness(scales, cosines, linear_rgb(np.stack([(at.R_s + at.R_p) / 2 for at in films])))


@pytest.mark.parametrize("delta_e", [1.0, 0.5])
def test_the_promise_holds_at_2000_random_points(delta_e: float, witness: Witness) -> None:
    """CIEDE2000 of what a reader interpolates; a tenth on top, as the certificate measures amid cells."""
    table = refined(delta_e)
    system = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
    pairs = zip(witness.scales, witness.cosines, strict=True)
    seen = np.stack([interpolated(table, scale, mu) for scale, mu in pairs])
    differences = delta_e_2000(lab_of(seen, system), lab_of(witness.rgb, system))
    assert differences.size == 2000
    assert differences.max() <= 1.1 * delta_e
    assert differences.max() >= 0.4 * delta_e  # or the table is larger than it need be


def test_a_tighter_promise_is_a_larger_table() -> None:
    """Linear interpolation errs as the square of the step: a quarter of the error, over twice the texels."""
    sizes = [refined(delta_e).values("R_rgb").size for delta_e in (2.0, 0.5)]
    assert sizes[1] > 2 * sizes[0]


def test_axes_that_nearly_hold_are_refined() -> None:
    """A grid that keeps 1.0 does not keep 0.7."""
    enough = refined(1.0)
    scales = {"start": 1.0, "stop": 1.5, "count": enough.values("thickness_scale").size}
    finer = refined(0.7, cos_theta=enough.values("cos_theta").size, thickness_scale=scales)
    assert finer.values("R_rgb").size > enough.values("R_rgb").size
    assert finer.certificate["delta_e_max"] <= 0.7


def test_axes_that_hold_are_left_alone() -> None:
    """The spec's own axes are lower bounds: kept, to the last value, where they are fine enough."""
    table = refined(10.0, cos_theta=301, thickness_scale={"start": 1.0, "stop": 1.02, "count": 11})
    np.testing.assert_array_equal(table.values("cos_theta"), np.linspace(0, 1, 301))
    np.testing.assert_array_equal(table.values("thickness_scale"), np.linspace(1.0, 1.02, 11))


def test_a_table_without_a_colour_cannot_be_refined() -> None:
    """The promise is about a colour: wavelengths that span none are an error of the field."""
    with pytest.raises(SpecError):
        refined(1.0, wavelength_nm={"start": 900, "stop": 1100, "step": 20})
