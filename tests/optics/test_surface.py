"""Rough surfaces: one roughness in two spellings, what no surface can be, and how it is told."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from nacreous.optics.surface import MAX_EXPONENT, Surface, alpha_of, alphas_at, exponent_of

alphas = st.floats(1e-3, 1.0)
KULLA_CONTY = {"distribution": "phong", "multiple_scattering": "kulla-conty", "alpha_x": 0.1}
SMITH = {"distribution": "phong", "masking": "smith", "alpha_x": 0.1}


def test_the_default_is_the_paper() -> None:
    """F. Wu and C. Zheng 2015, equations 11 to 13: no diffuse term, and light is scattered once."""
    surface = Surface()
    assert (surface.distribution, surface.masking) == ("ashikhmin-shirley", "v-cavity")
    assert (surface.specular_weight, surface.diffuse_weight, surface.multiple_scattering) == (1, 0, "none")
    assert (surface.alphas, surface.roughness, surface.ratio, surface.anisotropic) == (None, None, 1, False)


@pytest.mark.parametrize(
    ("alpha", "exponent"), [(1.0, 0.0), (0.5, 6.0), (0.1, 198.0), (1e-3, MAX_EXPONENT), (1e-3, 1_999_998)]
)
def test_an_exponent_has_a_roughness(alpha: float, exponent: float) -> None:
    """Walter et al. 2007, section 5.2: exponent = 2 / alpha² - 2."""
    assert exponent_of(alpha) == pytest.approx(exponent, abs=1e-12)
    assert alpha_of(exponent) == pytest.approx(alpha, rel=1e-12)
    assert Surface(exponent_x=exponent).alphas == pytest.approx((alpha, alpha), rel=1e-12)


@given(alphas)
def test_alpha_and_exponent_are_inverse(alpha: float) -> None:
    """Either way there and back is where one was."""
    assert alpha_of(exponent_of(alpha)) == pytest.approx(alpha, rel=1e-9)
    assert exponent_of(alpha_of(1 / alpha)) == pytest.approx(1 / alpha, rel=1e-9)


@pytest.mark.parametrize("kind", ["alpha", "exponent"])
@given(x=alphas)
def test_y_is_x_where_it_is_left_out(kind: str, x: float) -> None:
    """Such a surface is isotropic, and its place on a roughness axis is its alpha, to the last bit."""
    surface = Surface.model_validate({f"{kind}_x": x})
    assert surface == Surface.model_validate({f"{kind}_x": x, f"{kind}_y": None})
    assert surface.alphas == (surface.roughness, surface.roughness)
    assert not surface.anisotropic


@given(x=alphas, y=alphas, roughness=st.lists(alphas, min_size=1, max_size=5))
def test_a_roughness_axis_keeps_the_ratio(x: float, y: float, roughness: list[float]) -> None:
    """alpha_x / alpha_y is the surface's own at every roughness, sqrt(alpha_x alpha_y) is the roughness."""
    found = alphas_at(Surface(alpha_x=x, alpha_y=y), np.array(roughness))
    assert found.shape == (len(roughness), 2)
    np.testing.assert_allclose(found[:, 0] / found[:, 1], x / y, rtol=1e-12)
    np.testing.assert_allclose(np.sqrt(found.prod(axis=1)), roughness, rtol=1e-12)


@given(x=alphas, y=alphas)
def test_a_surface_lies_on_its_own_axis(x: float, y: float) -> None:
    """At its own roughness it is itself."""
    surface = Surface(alpha_x=x, alpha_y=y)
    assert surface.roughness is not None
    np.testing.assert_allclose(alphas_at(surface, np.array([surface.roughness])), [[x, y]], rtol=1e-12)


def test_without_a_ratio_both_are_the_roughness() -> None:
    """A surface that states no roughness is isotropic."""
    np.testing.assert_array_equal(alphas_at(Surface(), np.array([0.1, 0.3])), [[0.1, 0.1], [0.3, 0.3]])


@pytest.mark.parametrize(
    ("given_", "field", "expected", "got"),
    [
        ({"alpha_x": 0}, "alpha_x", "a roughness from 0.001 to 1", "0"),
        ({"alpha_x": -0.1}, "alpha_x", "a roughness from 0.001 to 1", "-0.1"),
        ({"alpha_x": 0.1, "alpha_y": 1.5}, "alpha_y", "a roughness from 0.001 to 1", "1.5"),
        ({"exponent_x": -1}, "exponent_x", "an exponent from 0 to 1999998", "-1"),
        ({"exponent_x": 9, "exponent_y": 2e6}, "exponent_y", "an exponent from 0 to 1999998", "2e+06"),
        (
            {"alpha_x": 0.1, "exponent_x": 198},
            "exponent_x",
            "either alpha or exponent",
            "alpha_x and exponent_x",
        ),
        (
            {"alpha_x": 0.1, "exponent_y": 9},
            "exponent_y",
            "either alpha or exponent",
            "alpha_x and exponent_y",
        ),
        ({"alpha_y": 0.1}, "alpha_x", "alpha_x beside alpha_y", "nothing"),
        ({"exponent_y": 10}, "exponent_x", "exponent_x beside exponent_y", "nothing"),
        (
            {"distribution": "blinn", "alpha_x": 0.1, "alpha_y": 0.2},
            "alpha_y",
            "the same as alpha_x, 0.1, for blinn",
            "0.2",
        ),
        (
            {"distribution": "phong", "exponent_x": 9, "exponent_y": 10},
            "exponent_y",
            "the same as exponent_x, 9, for phong",
            "10",
        ),
        (SMITH, "masking", '"v-cavity" for a phong lobe', '"smith"'),
        (KULLA_CONTY, "multiple_scattering", '"none" for a phong lobe', '"kulla-conty"'),
        ({"specular_weight": -1}, "specular_weight", "a weight from 0 to 1000", "-1"),
        ({"diffuse_weight": -0.5}, "diffuse_weight", "a weight from 0 to 1000", "-0.5"),
        ({"diffuse_weight": 1001}, "diffuse_weight", "a weight from 0 to 1000", "1001"),
        ({"diffuse_reflectance": 1.1}, "diffuse_reflectance", "a share of the light from 0 to 1", "1.1"),
        ({"diffuse_reflectance": -0.1}, "diffuse_reflectance", "a share of the light from 0 to 1", "-0.1"),
    ],
    ids=str,
)
def test_what_is_no_surface_is_refused(given_: dict[str, Any], field: str, expected: str, got: str) -> None:
    """One message, with the field, what was expected, what came, and what to do."""
    with pytest.raises(ValidationError) as caught:
        Surface.model_validate(given_)
    (error,) = caught.value.errors()
    context = error["ctx"]
    assert ".".join(filter(None, (*error["loc"], context["field"]))) == field
    assert (context["expected"], context["got"]) == (expected, got)
    assert context["remedy"]


@pytest.mark.parametrize("distribution", ["blinn", "phong"])
@pytest.mark.parametrize("same", [{}, {"alpha_x": 0.1}, {"exponent_x": 7, "exponent_y": 7}])
def test_one_roughness_is_isotropic_however_it_is_written(distribution: str, same: dict[str, float]) -> None:
    """Blinn 1977 and Sun 2006 know one exponent: it may be written twice."""
    assert not Surface.model_validate({"distribution": distribution, **same}).anisotropic


@pytest.mark.parametrize("wrong", [True, "0.1", float("nan"), float("inf"), [0.1]])
def test_a_roughness_is_a_finite_number(wrong: object) -> None:
    """Nothing is converted."""
    with pytest.raises(ValidationError, match="alpha_x"):
        Surface.model_validate({"alpha_x": wrong})


def test_the_schema_states_the_bounds() -> None:
    """An editor that knows the schema warns before the program does."""
    alpha = Surface.model_json_schema()["properties"]["alpha_x"]["anyOf"][0]
    assert (alpha["type"], alpha["minimum"], alpha["maximum"]) == ("number", 1e-3, 1)
