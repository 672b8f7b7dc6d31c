"""From a spec to a table: what it holds, in which precision, and what is refused."""

import json

import numpy as np
import pytest

from nacreous.errors import BudgetError, NumericalError, SpecError
from nacreous.tables import film
from nacreous.tables.presets import preset, preset_names
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table
from reference import film as reference_film


def _spec(layers: list[dict[str, object]], **table: object) -> Spec:
    stack = {"incident": "vacuum", "substrate": {"n": 1.5}, "layers": layers}
    return Spec.model_validate({"stack": stack, "table": table})


LAYER: dict[str, object] = {"material": {"n": 2.0}, "thickness_nm": 420}


QUANTITIES = {"fresnel": ("R_s", "R_p", "T_s", "T_p"), "albedo": ("E_r", "E_t")}


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_is_a_table(name: str) -> None:
    """Finite, within [0, 1], of the shape that its axes say, with a certificate and an id."""
    spec = preset(name)
    table = tabulate_table(spec)
    for quantity in QUANTITIES[spec.table.quantity]:
        values = table.values(quantity)
        dims = table.variables[quantity].dims
        assert dims[-3:] == ("thickness_scale", "cos_theta", "wavelength_nm")
        assert values.shape == tuple(table.values(axis).size for axis in dims)
        assert values.dtype == np.float32
        assert values.min() >= 0
        assert values.max() <= 1
    colours = [name for name in table.variables if name.endswith("_rgb")]
    assert colours
    assert all(np.isfinite(table.values(name)).all() for name in colours)
    assert table.certificate["nonfinite"] == 0
    assert len(table.id) == 64


def test_spectra_are_the_films() -> None:
    """Every value of a small table, by the independent reference."""
    table = tabulate_table(_spec([LAYER], cos_theta=9, thickness_scale=[0.5, 1.0, 2.0]))
    index = np.array([1.0, 2.0, 1.5], complex)
    for scale, row in zip((0.5, 1.0, 2.0), range(3), strict=True):
        expected = reference_film(
            index, np.array([420.0 * scale]), table.values("wavelength_nm"), table.values("cos_theta")
        )
        for quantity in ("R_s", "R_p", "T_s", "T_p"):
            got = table.values(quantity)[row]
            np.testing.assert_allclose(got, getattr(expected, quantity), rtol=0, atol=5e-6)


def test_only_the_parts_asked_for() -> None:
    """A colour table holds no spectra, and a spectrum no colours."""
    spec = _spec([LAYER])
    assert set(tabulate_table(spec, [Part.COLOUR]).variables) == {"R_rgb", "T_rgb"}
    assert set(tabulate_table(spec, [Part.SPECTRUM]).variables) == {"R_s", "R_p", "T_s", "T_p"}


def test_an_opaque_substrate_has_no_transmitted_colour() -> None:
    """Nothing comes through titanium."""
    assert "T_rgb" not in tabulate_table(preset("anodised-titanium"), [Part.COLOUR]).variables


def test_ellipsometry_on_request() -> None:
    """Psi and Delta join the spectra, in radians."""
    table = tabulate_table(_spec([LAYER], ellipsometry=True), [Part.SPECTRUM])
    assert table.variables["psi"].unit == "rad"
    assert table.values("Delta").shape == table.values("R_s").shape


@pytest.mark.parametrize("field", [{"coherent": False}, {"thickness_sigma_nm": 5.0}])
def test_an_average_has_no_phase(field: dict[str, object]) -> None:
    """Psi and Delta of averaged intensities do not exist, and are refused by name."""
    with pytest.raises(SpecError, match=r"table\.ellipsometry"):
        tabulate_table(_spec([LAYER | field], ellipsometry=True))


def test_infrared_has_spectra_but_no_colour() -> None:
    """Without the visible there are no colours, and asking for them says why."""
    spec = _spec([LAYER], wavelength_nm={"start": 1000, "stop": 2000, "step": 10})
    assert set(tabulate_table(spec).variables) == {"R_s", "R_p", "T_s", "T_p"}
    with pytest.raises(SpecError, match=r"table\.wavelength_nm: .*400 to 700 nm.*1000 to 2000"):
        tabulate_table(spec, [Part.COLOUR])


def test_a_large_phase_is_computed_in_double_precision() -> None:
    """50 um of glass turns the phase by 1,300 rad: single precision would lose 1e-4, the table does not."""
    thick = {"material": {"n": 1.5}, "thickness_nm": 50_000}
    stack = {"incident": "vacuum", "substrate": {"n": 2.0}, "layers": [thick]}
    table = tabulate_table(Spec.model_validate({"stack": stack}), [Part.SPECTRUM])
    assert table.provenance["precision"] == "double"
    expected = reference_film(
        np.array([1.0, 1.5, 2.0], complex),
        np.array([50_000.0]),
        table.values("wavelength_nm"),
        table.values("cos_theta"),
    )
    np.testing.assert_allclose(table.values("R_s")[0], expected.R_s, rtol=0, atol=2e-7)


def test_double_glazing_at_every_angle() -> None:
    """Two panes with air between, grazing incidence among the angles: nothing comes in there, all is finite.

    Head on, four surfaces of glass that add in intensities pass 1 / (1 + 4 r / (1 - r) ) of the light (Stokes
    1862) where nothing is absorbed.
    """
    pane = {"material": {"n": 1.5}, "thickness_nm": 1e6, "coherent": False}
    gap = {"material": "vacuum", "thickness_nm": 1e6, "coherent": False}
    stack = {"incident": "vacuum", "substrate": "vacuum", "layers": [pane, gap, pane]}
    table = tabulate_table(Spec.model_validate({"stack": stack}))
    r = 0.04
    np.testing.assert_allclose(table.values("T_s")[0, -1], 1 / (1 + 4 * r / (1 - r)), atol=1e-6)
    assert (table.values("R_s")[0, 0] == 1).all()
    assert (table.values("R_p")[0, 0] == 1).all()
    assert (table.values("T_p")[0, 0] == 0).all()


def test_double_precision_on_request() -> None:
    """Asked for, numbers are stored in double precision and are exact to 1e-12."""
    spec = Spec.model_validate(_spec([LAYER]).model_dump() | {"accuracy": {"precision": "double"}})
    table = tabulate_table(spec, [Part.SPECTRUM])
    expected = reference_film(
        np.array([1.0, 2.0, 1.5], complex),
        np.array([420.0]),
        table.values("wavelength_nm"),
        table.values("cos_theta"),
    )
    np.testing.assert_allclose(table.values("T_p")[0], expected.T_p, rtol=0, atol=1e-12)


def test_the_same_spec_gives_the_same_bytes() -> None:
    """Twenty times."""
    spec = preset("paper/figure-8")
    first = tabulate_table(spec)
    for _ in range(20):
        again = tabulate_table(spec)
        assert again.provenance == first.provenance
        for name, variable in first.variables.items():
            assert again.values(name).tobytes() == variable.values.tobytes()


def test_progress_rises_to_one() -> None:
    """Over all parts together, and never back."""
    told: list[float] = []
    tabulate_table(preset("soap-bubble"), observer=told.append)
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1)


def test_an_observer_can_cancel() -> None:
    """What it raises ends the work."""

    class CancelledError(Exception):
        pass

    def cancel(_: float) -> None:
        raise CancelledError

    with pytest.raises(CancelledError):
        tabulate_table(preset("paper/figure-3"), observer=cancel)


@pytest.mark.parametrize("part", Part)
def test_a_table_over_the_budget_is_refused(part: Part, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message has the size and the limit."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1M")
    spec = _spec([LAYER], cos_theta=4096, thickness_scale={"start": 0.5, "stop": 1.5, "count": 64})
    with pytest.raises(BudgetError, match=r"needs [\d,.]+ MiB and the limit is 1\.0 MiB"):
        tabulate_table(spec, [part])


def test_a_poisoned_result_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """One NaN among the computed values, which no sound device gives, and there is no table."""
    known = film.film_intensities

    def poisoned(*args: object, **options: object) -> dict[str, np.ndarray]:
        computed = known(*args, **options)  # type: ignore[arg-type]
        computed["T_p"][-1, -1, -1] = np.nan
        return computed

    monkeypatch.setattr(film, "film_intensities", poisoned)
    with pytest.raises(NumericalError, match=r"T_p .* 1 values that are not finite"):
        tabulate_table(preset("paper/figure-3"))


def test_a_dataset_and_back() -> None:
    """Values, units and provenance survive xarray."""
    table = tabulate_table(preset("paper/figure-3"))
    dataset = table.to_xarray()
    assert dataset.R_s.attrs["units"] == "1"
    assert dataset.wavelength_nm.attrs["units"] == "nm"
    back = Table.from_xarray(dataset)
    assert back.provenance == table.provenance
    assert json.loads(back.provenance["certificate"]) == table.certificate
    np.testing.assert_array_equal(back.values("R_rgb"), table.values("R_rgb"))
