"""The distances between glTF's formula and the film, from the reference film and colour-science."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from iridescence_host import three_reflectance
from nacreous.optics.iridescence import Iridescence
from nacreous.optics.refractive_index import refractive_index
from nacreous.optics.stack import Stack
from nacreous.tables.fit.gltf import naive_film
from nacreous.tables.spec import Spec
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb
from validation.gltf_iridescence import FILMS, STATED_DEG, CoatedBase, Compared

FloatArray = NDArray[np.float64]

COSINES = np.cos(np.radians(STATED_DEG))


@pytest.fixture(scope="module")
def compared(measured: Callable[[str], Any]) -> list[Compared]:
    """Compute the comparison."""
    return measured("gltf-iridescence")


def stack_of(each: CoatedBase) -> Stack:
    """Return the film as a stack."""
    return Spec.from_document({"stack": each.stack}).stack


def exact(each: CoatedBase) -> FloatArray:
    """Linear Rec.709 of the film at the stated angles, by the reference and colour-science."""
    stack = stack_of(each)
    media = (stack.incident, stack.layers[0].material, stack.substrate)
    seen_nm = np.clip(WAVELENGTH_NM, 360, 800)  # where every material has data, and nearly all that is seen
    index = np.stack([refractive_index(material, seen_nm) for material in media])
    at = film(index, np.array([each.thickness_nm]), WAVELENGTH_NM, COSINES)
    return linear_rgb((at.R_s + at.R_p) / 2)


def apart(first: FloatArray, second: FloatArray) -> FloatArray:
    """CIEDE2000 of linear Rec.709 by colour-science."""
    import colour

    white = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["D65"]
    matrix = colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_RGB_to_XYZ
    labs = (colour.XYZ_to_Lab(rgb @ matrix.T, white) for rgb in (first, second))
    return np.asarray(colour.delta_E(*labs, method="CIE 2000"))


@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_the_table_is_what_three_js_and_colour_science_say(compared: list[Compared]) -> None:
    """Three.js's own shader on one side, the reference film on the other: CIEDE2000 within 0.3."""
    films: list[Iridescence] = [naive_film(stack_of(each)) for each in FILMS]
    drawn = three_reflectance(films, COSINES)
    for each, shown in zip(compared, drawn, strict=True):
        np.testing.assert_allclose(
            each.apart(each.formula),
            apart(shown, exact(each.film)),
            rtol=0.02,
            atol=0.3,
            err_msg=each.film.label,
        )


@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_the_film_is_exact(compared: list[Compared]) -> None:
    """The colours that the formula is held against are the reference's: CIEDE2000 below 0.2."""
    for each in compared:
        assert apart(each.exact[list(STATED_DEG)], exact(each.film)).max() < 0.2, each.film.label


def test_it_is_right_for_dielectrics_and_wrong_on_titanium(compared: list[Compared]) -> None:
    """What the page says: all dielectrics within 5 at 0 and 45 degrees, titanium off by more than 20."""
    for each in compared:
        near = each.apart(each.formula)[:2]
        if "titanium" in each.film.label:
            assert near.min() > 20
        elif "silicon" not in each.film.label:
            assert near.max() < 5


def test_a_fit_is_better_over_all_angles(compared: list[Compared]) -> None:
    """Fitted parameters bring the worst of the stated angles closer, for every film."""
    for each in compared:
        assert each.apart(each.fitted).max() < each.apart(each.formula).max(), each.film.label
