"""A refined albedo keeps its promise at points that it has never seen."""

from functools import cache

import numpy as np
import pytest

from kernel_surface import FacetAlbedo, rough_spec, solvers_of
from nacreous.errors import SpecError
from nacreous.opencl.device import Device
from nacreous.optics.colour import colour_system, lab
from nacreous.optics.delta_e import delta_e_2000
from nacreous.tables.albedo import refine
from nacreous.tables.albedo.certificate import AlbedoCells
from nacreous.tables.computed import colouring_of, grid_of
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table
from reference_colour import WAVELENGTH_NM, linear_rgb
from reference_facets import FloatArray, Surface
from reference_surface import Coating

METAL = {"n": 1.6, "k": 0.9}
WIDE = {"start": 360, "stop": 780, "step": 20}
AXES: dict[str, object] = {"roughness": [0.15, 0.6], "cos_theta": 3, "wavelength_nm": WIDE}


@cache
def refined(delta_e: float) -> Table:
    """Tabulate 300 nm of n = 2.0 on a dull metal, over roughness and angle, to a colour difference."""
    return tabulated(delta_e, **AXES)


def tabulated(delta_e: float, **axes: object) -> Table:
    """Return the colours of other axes."""
    spec = rough_spec({"distribution": "beckmann"}, substrate=METAL, **axes).model_dump(mode="json")
    return tabulate_table(Spec.model_validate(spec | {"accuracy": {"delta_e": delta_e}}), {Part.COLOUR})


@pytest.fixture(scope="module")
def witness() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return roughnesses (10,), cosines (10, 20), and their colours by colour-science (10, 20, 3)."""
    rng = np.random.default_rng(21)
    roughness, cosines = rng.uniform(0.15, 0.6, 10), rng.uniform(0.02, 1, (10, 20))
    index = np.array([1.0, 2.0, 1.6 + 0.9j], complex)[:, None] * np.ones(WAVELENGTH_NM.size)
    albedo = FacetAlbedo(Coating(index, np.array([300.0]), WAVELENGTH_NM), nodes=129)
    spectra = [
        [albedo.at(Surface("beckmann", r, r), float(mu)) for mu in row]
        for r, row in zip(roughness, cosines, strict=True)
    ]
    return roughness, cosines, linear_rgb(np.array(spectra))


def interpolated(table: Table, roughness: float, mu: FloatArray) -> FloatArray:
    """Interpolate the table bilinearly, as its reader does: (A, 3)."""
    axis, colour = table.values("roughness"), table.values("E_r_rgb")[:, 0].astype(float)
    upper = int(np.clip(np.searchsorted(axis, roughness), 1, axis.size - 1))
    t = (roughness - axis[upper - 1]) / (axis[upper] - axis[upper - 1])
    row = (1 - t) * colour[upper - 1] + t * colour[upper]
    return np.stack([np.interp(mu, table.values("cos_theta"), channel) for channel in row.T], axis=-1)


@pytest.mark.parametrize("delta_e", [1.0, 0.5])
def test_the_promise_holds_at_200_random_points(
    delta_e: float, witness: tuple[FloatArray, FloatArray, FloatArray]
) -> None:
    """CIEDE2000 of what a reader interpolates over both axes; a tenth on top, as cells are measured amid."""
    roughness, cosines, rgb = witness
    table = refined(delta_e)
    system = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
    seen = np.array([interpolated(table, r, mu) for r, mu in zip(roughness, cosines, strict=True)])
    labs = (lab(system.to_xyz(colour), system.white) for colour in (seen, rgb))
    differences = delta_e_2000(*labs)
    assert differences.size == 200
    assert table.certificate["delta_e_max"] <= delta_e
    assert differences.max() <= 1.1 * delta_e
    assert differences.max() >= 0.3 * delta_e  # or the table is larger than it need be


def test_a_tighter_promise_is_a_larger_table() -> None:
    """Linear interpolation errs as the square of the step: half the error, 1.4 times the texels an axis."""
    sizes = [refined(delta_e).values("E_r_rgb").size for delta_e in (1.0, 0.5)]
    assert 1.3 * sizes[0] <= sizes[1] <= 4 * sizes[0]


def test_refined_axes_keep_their_ends_and_spacing() -> None:
    """Equidistant stays equidistant; an axis of one value stays one value."""
    table = refined(0.5)
    for axis, ends in (("roughness", (0.15, 0.6)), ("cos_theta", (0.0, 1.0))):
        values = table.values(axis)
        assert values.size > np.size(AXES[axis])
        np.testing.assert_allclose(values, np.linspace(*ends, values.size))
    assert table.values("thickness_scale").size == 1
    assert table.values("wavelength_nm").size == 22


def test_axes_that_hold_are_left_alone() -> None:
    """The spec's own axes are lower bounds."""
    table = tabulated(10.0, **AXES | {"cos_theta": 64})
    assert table.values("cos_theta").size == 64


def test_a_table_is_widened_until_it_holds(device: Device) -> None:
    """One that is too coarse in every axis grows until no cell is worse, and no further."""
    spec = rough_spec({"distribution": "beckmann"}, substrate=METAL, **AXES)
    solver, _ = solvers_of(device, spec)
    grid = grid_of(spec)
    colouring = colouring_of(spec, solver.film.solver, grid)
    assert colouring is not None
    search = refine._Search(solver, colouring, grid, 2.0, 2**16)
    axes = np.array([0.15, 0.6]), np.ones(1), np.linspace(0, 1, 9)
    assert search.worst(axes) > 2
    held = search.holding(axes, [0, 2])
    assert 0.8 < search.worst(held) <= 2
    assert held[1].size == 1


def test_a_difference_that_only_huge_tables_keep_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before such tables are measured: 64 x 8 x 128 is the largest allowed, 128 cells the longest axis."""
    asked: list[int] = []
    known = refine.colour_differences

    def counted(solver: object, cells: AlbedoCells, *rest: object) -> FloatArray:
        axes = (cells.roughness, cells.thickness_scale, cells.cos_theta)
        asked.append(max(axis.lower.size for axis in axes))
        return known(solver, cells, *rest)

    monkeypatch.setattr(refine, "colour_differences", counted)
    axes = {"roughness": {"start": 0.01, "stop": 1.0, "count": 64}, "cos_theta": 64}
    scales = {"thickness_scale": {"start": 0.5, "stop": 2.0, "count": 8}}
    with pytest.raises(SpecError, match=r"accuracy\.delta_e: expected .* 65,536 texels can keep, got 0\.05"):
        tabulated(0.05, **axes, **scales)
    assert 0 < max(asked) <= 128


def test_one_angle_and_one_roughness_need_no_more() -> None:
    """There is nothing to interpolate between."""
    table = tabulated(0.1, **AXES | {"roughness": [0.3], "cos_theta": [0.5, 0.5001]})
    assert table.values("E_r_rgb").shape == (1, 1, 2, 3)


def test_without_a_colour_there_is_no_promise() -> None:
    """Wavelengths that span none are an error of the field."""
    with pytest.raises(SpecError, match=r"accuracy\.delta_e|table\.wavelength_nm"):
        tabulated(1.0, **AXES | {"wavelength_nm": [900.0, 1000.0]})
