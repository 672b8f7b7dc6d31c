"""The fit of glTF's film: it finds what the formula can show, and is never worse than the stack's numbers."""

from dataclasses import replace

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.optics.iridescence import Iridescence, iridescent_reflectance
from nacreous.tables.fit.gltf import GltfFit, fit_gltf, naive_film
from nacreous.tables.fit.target import FITTED_DEG, STATED_DEG, FitTarget
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part
from nacreous.tables.tabulate import tabulate_table

AXES = {"wavelength_nm": {"start": 380, "stop": 780, "step": 10}, "cos_theta": 65}
FILMS = {
    "soap": ({"n": 1.33}, 300.0, "air"),
    "n 2 on glass": ({"n": 2.0}, 420.0, {"n": 1.5}),
    "oxide on silicon": ("main/SiO2/Malitson", 300.0, "main/Si/Green-2008"),
    "oxide on titanium": ({"n": 2.4}, 60.0, "main/Ti/Johnson"),
}


def spec_of(layer: object, thickness_nm: float, base: object, **table: object) -> Spec:
    """Return the spec of a single film."""
    layers = [{"material": layer, "thickness_nm": thickness_nm}]
    stack = {"incident": "air", "substrate": base, "layers": layers}
    return Spec.from_document({"stack": stack, "table": AXES | table})


def target_of(spec: Spec) -> FitTarget:
    """Return the film's colours as a table has them."""
    return FitTarget.of_table(tabulate_table(spec, [Part.COLOUR]))


def apart(target: FitTarget, film: Iridescence, angles_deg: tuple[float, ...]) -> np.ndarray:
    """CIEDE2000 of the formula against the target."""
    shown = iridescent_reflectance(film, np.cos(np.radians(angles_deg)))
    return target.comparison(angles_deg).delta_e(shown)


@pytest.mark.parametrize("name", FILMS)
def test_a_fit_is_never_worse_than_the_numbers_of_the_stack(name: str) -> None:
    """In the mean square, weighted with the cosine, of all fitted angles, and of 0, 45 and 70 degrees."""
    spec = spec_of(*FILMS[name])
    target = target_of(spec)
    fit = fit_gltf(target, spec.stack)
    naive = naive_film(spec.stack)
    for angles in (FITTED_DEG, STATED_DEG):
        weights = np.cos(np.radians(angles))
        before, after = (weights @ apart(target, film, angles) ** 2 for film in (naive, fit.film))
        assert after <= before


def test_oxide_on_titanium_is_brought_near() -> None:
    """Other numbers than the stack's stand for the phase that the formula loses: 35 becomes less than 5."""
    spec = spec_of(*FILMS["oxide on titanium"])
    fit = fit_gltf(target_of(spec), spec.stack)
    assert max(fit.delta_e.values()) < 5
    assert abs(float(fit.film.thickness_nm) - 60) > 5


@pytest.mark.parametrize(
    ("ior", "thickness_nm", "base_f0"),
    [(1.4, 350.0, (0.04, 0.04, 0.04)), (2.1, 180.0, (0.3, 0.4, 0.5)), (1.8, 520.0, (0.9, 0.6, 0.4))],
)
def test_it_finds_a_film_that_the_formula_made(
    ior: float, thickness_nm: float, base_f0: tuple[float, ...]
) -> None:
    """A target that can be met is met, whatever stack the search starts from."""
    made = Iridescence(np.array(ior), np.array(thickness_nm), np.array(base_f0), np.array(1.0))
    cos_theta = np.linspace(0, 1, 257)
    target = FitTarget(cos_theta, iridescent_reflectance(made, cos_theta))
    fit = fit_gltf(target, spec_of({"n": 3.0}, 900.0, {"n": 1.5}).stack)
    assert fit.delta_e_max < 1


def test_what_a_fit_states_is_what_its_parameters_give() -> None:
    """The figures are those of the rounded parameters, which a file has."""
    spec = spec_of(*FILMS["n 2 on glass"])
    target = target_of(spec)
    fit: GltfFit = fit_gltf(target, spec.stack)
    np.testing.assert_allclose(apart(target, fit.film, STATED_DEG), list(fit.delta_e.values()), rtol=1e-9)
    fitted = apart(target, fit.film, FITTED_DEG)
    assert fit.delta_e_max == pytest.approx(fitted.max())
    assert fit.delta_e_mean == pytest.approx(fitted.mean())
    assert round(float(fit.film.ior), 4) == pytest.approx(float(fit.film.ior), abs=1e-12)


def test_the_naive_film_is_the_thickest_layer_on_the_bare_substrate() -> None:
    """Of glass under a layer of n 2: the index, its scaled thickness, and F0 = 0.04."""
    naive = naive_film(spec_of({"n": 2.0}, 420.0, {"n": 1.5}).stack, 0.5)
    assert float(naive.ior) == pytest.approx(2.0)
    assert float(naive.thickness_nm) == pytest.approx(210.0)
    np.testing.assert_allclose(naive.base_f0, 0.04, atol=1e-6)


def test_the_thickness_nearest_to_that_of_the_spec_is_fitted() -> None:
    """A table over thicknesses has many films: the one of scale 1, or the nearest to it."""
    table = tabulate_table(spec_of({"n": 2.0}, 420.0, {"n": 1.5}, thickness_scale=[0.25, 0.9, 3.0]))
    target = FitTarget.of_table(table)
    assert target.thickness_scale == pytest.approx(0.9)
    np.testing.assert_allclose(target.colour, table.values("R_rgb")[1], rtol=1e-6)


def test_angles_between_the_samples_are_read_as_a_reader_of_the_table_does() -> None:
    """Linearly in the cosine."""
    colour = np.array([[1.0, 1.0, 1.0], [0.0, 0.2, 0.4]])
    target = FitTarget(np.array([0.0, 1.0]), colour)
    np.testing.assert_allclose(target.at((60.0,)), [[0.5, 0.6, 0.7]], atol=1e-12)


def test_a_table_without_the_angles_is_refused() -> None:
    """The message says which are needed, and what has them."""
    spec = spec_of({"n": 2.0}, 420.0, {"n": 1.5}, cos_theta=[0.4, 1.0])
    with pytest.raises(SpecError, match=r"got 0\.4 to 1; table\.cos_theta = 64"):
        target_of(spec)


def test_a_fit_is_the_same_every_time() -> None:
    """Files of equal tables are equal: nothing in the search is random."""
    spec = spec_of(*FILMS["soap"])
    target = target_of(spec)
    first, second = (fit_gltf(replace(target), spec.stack) for _ in range(2))
    np.testing.assert_array_equal(first.film.base_f0, second.film.base_f0)
    assert (first.film.ior, first.film.thickness_nm) == (second.film.ior, second.film.thickness_nm)
