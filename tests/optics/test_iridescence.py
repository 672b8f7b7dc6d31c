"""The thin film of glTF: its limits, how far it is from the film, and that it is what three.js draws."""

import numpy as np
import pytest
from numpy.typing import NDArray

from iridescence_host import three_reflectance
from nacreous.optics.colour import colour_system, lab
from nacreous.optics.delta_e import delta_e_2000
from nacreous.optics.iridescence import Iridescence, iridescent_reflectance
from nacreous.optics.material import Material
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.spec import Spec
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb

FloatArray = NDArray[np.float64]

ANGLES = np.cos(np.radians([0.0, 45.0, 70.0]))
ONE = np.ones(WAVELENGTH_NM.size, complex)


def parameters(ior: float, thickness_nm: float, base_f0: object, factor: float = 1.0) -> Iridescence:
    """Return the parameters of one film."""
    f0 = np.broadcast_to(np.asarray(base_f0, np.float64), 3)
    return Iridescence(np.array(ior), np.array(thickness_nm), f0, np.array(factor))


def index_of(material: object) -> NDArray[np.complex128]:
    """Return n + ik of a spec's material at the reference's wavelengths."""
    layer = {"material": {"n": 1.5}, "thickness_nm": 1.0}
    spec = Spec.from_document({"stack": {"incident": "air", "substrate": material, "layers": [layer]}})
    substrate: Material = spec.stack.substrate
    return refractive_index(substrate, WAVELENGTH_NM)


def differences(model: FloatArray, exact: FloatArray) -> FloatArray:
    """CIEDE2000 of linear Rec.709 colours."""
    screen = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
    first, second = (lab(screen.to_xyz(colour), screen.white) for colour in (model, exact))
    return delta_e_2000(first, second)


def test_without_a_film_it_is_schlicks_curve() -> None:
    """Factor 0 leaves F0 + (1 - F0)(1 - cos)^5 (Schlick 1994, equation 15)."""
    bare = iridescent_reflectance(parameters(1.8, 300.0, [0.2, 0.5, 0.9], factor=0.0), ANGLES)
    expected = np.array([0.2, 0.5, 0.9]) + np.array([0.8, 0.5, 0.1]) * (1 - ANGLES[:, None]) ** 5
    np.testing.assert_allclose(bare, expected, rtol=1e-12)


@pytest.mark.parametrize("f0", [0.04, 0.3, 0.8])
def test_a_film_of_no_thickness_is_nearly_its_base(f0: float) -> None:
    """The film's index goes to that of the air; what is left is the rounding of the cut series."""
    shown = iridescent_reflectance(parameters(2.0, 0.0, f0), np.ones(1))
    np.testing.assert_allclose(shown, np.full((1, 3), f0), rtol=0, atol=0.02)


def test_an_echo_is_brightest_where_it_is_in_phase() -> None:
    """A quarter wave of n = sqrt(n_base) on a base of index 2.25 takes the reflection of green away."""
    f0 = ((2.25 - 1) / (2.25 + 1)) ** 2
    quarter, half = (550 / 1.5 * share for share in (0.25, 0.5))
    dark, bright = (iridescent_reflectance(parameters(1.5, d, f0), np.ones(1))[0] for d in (quarter, half))
    assert dark[1] < 0.01
    assert bright[1] == pytest.approx(f0, abs=0.02)


def test_a_batch_is_its_films_one_by_one() -> None:
    """Leading axes are those of the batch."""
    many = Iridescence(np.array([1.3, 2.0]), np.array([300.0, 420.0]), np.full((2, 3), 0.1), np.ones(2))
    batch = iridescent_reflectance(many, ANGLES)
    for at, (ior, thickness) in enumerate([(1.3, 300.0), (2.0, 420.0)]):
        np.testing.assert_array_equal(
            batch[at], iridescent_reflectance(parameters(ior, thickness, 0.1), ANGLES)
        )


def test_it_is_never_negative() -> None:
    """The extension cuts components that are outside of the gamut."""
    thickness = np.linspace(0, 1000, 200)
    films = Iridescence(np.full(200, 1.8), thickness, np.full((200, 3), 0.3), np.ones(200))
    assert iridescent_reflectance(films, np.linspace(0, 1, 50)).min() >= 0


@pytest.mark.parametrize(
    ("layer", "thickness_nm", "base", "ior", "expected"),
    [
        ({"n": 1.33}, 300.0, "air", 1.33, (1.1, 2.9, 14.6)),
        ({"n": 2.0}, 420.0, {"n": 1.5}, 2.0, (3.2, 2.0, 7.0)),
        ("main/SiO2/Malitson", 300.0, "main/Si/Green-2008", 1.46, (4.0, 0.7, 15.4)),
        ({"n": 2.4}, 60.0, "main/Ti/Johnson", 2.4, (34.8, 33.5, 42.4)),
    ],
)
def test_how_far_it_is_from_the_film(
    layer: object, thickness_nm: float, base: object, ior: float, expected: tuple[float, ...]
) -> None:
    """CIEDE2000 at 0, 45 and 70 degrees, measured with another program, on the base's F0 in air.

    Right for thin dielectrics near normal incidence; on titanium the lost phase of the metal shows.
    """
    under = index_of(base)
    exact = film(np.stack([ONE, index_of(layer), under]), np.array([thickness_nm]), WAVELENGTH_NM, ANGLES)
    f0 = linear_rgb(np.abs((1 - under) / (1 + under)) ** 2)
    model = iridescent_reflectance(parameters(ior, thickness_nm, f0), ANGLES)
    apart = differences(model, linear_rgb((exact.R_s + exact.R_p) / 2))
    np.testing.assert_allclose(apart, expected, rtol=0.05, atol=0.15)


def test_it_is_what_three_js_draws() -> None:
    """Three.js's own shader, run by OpenGL in single precision, with Schlick's curve as it is specified."""
    rng = np.random.default_rng(7)
    films = [
        parameters(rng.uniform(1.05, 2.6), rng.uniform(50, 900), rng.uniform(0.0, 0.9, 3)) for _ in range(40)
    ]
    cos_theta = np.linspace(0.2, 1, 17)
    drawn = three_reflectance(films, cos_theta)
    ours = np.stack([iridescent_reflectance(each, cos_theta) for each in films])
    np.testing.assert_allclose(drawn, ours, rtol=0, atol=1e-4)
