"""The albedo of a rough surface: the integral of its BSDF, in the limits where it is known."""

import numpy as np
import pytest

from kernel_surface import (
    CLEAR,
    COMBINATIONS,
    FACETS,
    MASKINGS,
    FacetAlbedo,
    integrated,
    rough_spec,
    solvers_of,
)
from nacreous.errors import SpecError
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.tiles import Tile, TileRunner
from nacreous.optics.colour import colour_system
from nacreous.optics.surface import Surface
from nacreous.tables.albedo.solver import AlbedoSolver, check_albedo, scattered_colour
from nacreous.tables.colour import Colouring
from nacreous.tables.computed import grid_of
from nacreous.tables.tabulate import tabulate_table
from reference import film as reference_film
from reference_facets import FloatArray
from reference_facets import Surface as PlainSurface
from reference_surface import Coating, kulla_conty, monte_carlo_albedo

NM = np.array([400.0, 500.0, 600.0, 700.0])
ONE = np.ones(1)
COSINES = np.linspace(0, 1, 17)
MIRROR = {"n": 0.001, "k": 50.0}
"""Reflects all but a few millionths of the light, at any angle."""
NOTHING = {"material": "vacuum", "thickness_nm": 10}
DISPERSIVE = "titanium-dioxide"
"""Rutile, whose index falls from 2.8 at 450 nm to 2.55 at 700 nm."""


def albedos(
    solver: AlbedoSolver, roughness: float, cos_theta: FloatArray, nm: FloatArray = NM
) -> dict[Side, FloatArray]:
    """E_r and E_t at one roughness and the thickness as it is, (A, L)."""
    place = np.array([roughness])
    geometry = solver.geometry(place, cos_theta, nm)
    sides = solver.spectra(geometry, solver.mirror_mean(place), ONE, nm)
    return {side: values[0, 0] for side, values in sides.items()}


@pytest.mark.parametrize(("distribution", "masking"), COMBINATIONS)
def test_albedo_is_the_integral_of_the_bsdf(distribution: str, masking: str, device: Device) -> None:
    """E = integral of f cos_o d omega_o: sums over facets and over directions agree to 3e-4.

    That over directions is NumPy's; E_r with a diffuse term, E_t below the surface. Some of GGX's
    facets stand upright, so that f_t ends abruptly, and midpoints are off by 1e-3.
    """
    surface = {"distribution": distribution, "masking": masking, "alpha_x": 0.35,
               "specular_weight": 0.8, "diffuse_weight": 0.5, "diffuse_reflectance": 0.2}  # fmt: skip
    albedo, bsdf = solvers_of(device, rough_spec(surface))
    for mu in (0.35, 0.8):
        E = albedos(albedo, 0.35, np.array([mu]))
        for side in albedo.sides:
            abrupt = distribution == "ggx" and side is Side.TRANSMISSION
            got = integrated(bsdf, side, mu, NM)
            np.testing.assert_allclose(got, E[side][0], rtol=0, atol=1e-3 if abrupt else 3e-4)


@pytest.mark.parametrize("alpha", [0.02, 0.3, 1.0])
def test_a_mirrors_facets_lose_nothing_with_kulla_conty(alpha: float, device: Device) -> None:
    """Kulla & Conty 2017: what the first reflection loses leaves after others; R = 1 gives E = 1, with tails.

    As an integral over directions, of the first reflection and the others together, where a lobe is wide.
    """
    surface = {
        "distribution": "ggx",
        "masking": "smith",
        "alpha_x": alpha,
        "multiple_scattering": "kulla-conty",
    }
    albedo, bsdf = solvers_of(device, rough_spec(surface, NOTHING, substrate=MIRROR))
    E = albedos(albedo, alpha, COSINES)[Side.REFLECTION]
    np.testing.assert_allclose(E, 1, rtol=0, atol=2e-4)
    if alpha >= 0.3:
        for mu in (0.35, 0.8):
            np.testing.assert_allclose(integrated(bsdf, Side.REFLECTION, mu, NM), 1, rtol=0, atol=5e-4)


def test_kulla_conty_is_the_references(device: Device) -> None:
    """(1 - E_i)(1 - E_o) / (pi (1 - E)) F^2 E / (1 - F (1 - E)), integrated over o."""
    surface = {"distribution": "beckmann", "masking": "smith", "alpha_x": 0.8}
    spec = rough_spec(surface, NOTHING, substrate={"n": 0.2, "k": 3.0})
    once, _ = solvers_of(device, spec)
    many, _ = solvers_of(device, rough_spec(surface | {"multiple_scattering": "kulla-conty"}, NOTHING,
                                            substrate={"n": 0.2, "k": 3.0}))  # fmt: skip
    mu = (np.arange(400) + 0.5) / 400
    lost = 1 - once.geometry(np.array([0.8]), mu, np.zeros(0)).mirror[0]
    E_mean = 1 - 2 * mu @ lost / 400
    R = reference_film([1.0, 0.2 + 3j], [], NM, mu)
    F_mean = (mu @ (R.R_s + R.R_p) / 400)[0]
    added = albedos(many, 0.8, mu[:1])[Side.REFLECTION] - albedos(once, 0.8, mu[:1])[Side.REFLECTION]
    expected = 2 * np.pi / 400 * mu @ kulla_conty(1 - lost[0], 1 - lost, E_mean, F_mean)
    np.testing.assert_allclose(added[0], expected, rtol=2e-3)


@pytest.mark.parametrize(("F", "E"), [(0.3, 0.9), (1.0, 0.5), (0.9, 0.1)])
def test_later_reflections_add_up(F: float, E: float) -> None:  # noqa: N803 - Hill's symbols
    """Hill 2018: the k-th reflection leaves F^(k + 1) (1 - E)^k E of what was lost, over 1 - E; k from 1."""
    series = sum(F ** (k + 1) * (1 - E) ** (k - 1) * E for k in range(1, 3000))
    assert scattered_colour(np.array([[F]]), np.array([E])).item() == pytest.approx(series, rel=1e-9)


@pytest.mark.parametrize("distribution", [*FACETS, "phong"])
def test_without_roughness_it_is_the_film(distribution: str, device: Device) -> None:
    """As alpha falls to 0.001 E_r tends to the film's R of tests/reference.py: 1e-3 from 0.002 on."""
    solver, _ = solvers_of(device, rough_spec({"distribution": distribution, "alpha_x": 0.1}))
    mu = np.array([0.3, 0.6, 1.0])
    at = reference_film([1.0, 2.0, 1.5], [300.0], NM, mu)
    R, T = (at.R_s + at.R_p) / 2, (at.T_s + at.T_p) / 2
    off = [np.abs(albedos(solver, a, mu)[Side.REFLECTION] - R).max() for a in (0.1, 0.03, 0.01, 0.002, 0.001)]
    assert off == sorted(off, reverse=True)
    assert off[3] <= 1e-3
    assert off[4] <= 1e-4
    if distribution != "phong":
        np.testing.assert_allclose(albedos(solver, 0.001, mu)[Side.TRANSMISSION], T, rtol=0, atol=1e-3)


@pytest.mark.parametrize(("distribution", "masking"), COMBINATIONS)
def test_a_clear_film_makes_no_light(distribution: str, masking: str, device: Device) -> None:
    """Nothing absorbs: E_r + E_t <= 1 + 1e-3, alpha from 0.02 to 1, at any angle, and from above hardly less.

    What is missing is what facets would reflect or refract again.
    """
    solver, _ = solvers_of(
        device, rough_spec({"distribution": distribution, "masking": masking, "alpha_x": 0.3})
    )
    for alpha in (0.02, 0.1, 0.4, 1.0):
        E = albedos(solver, alpha, COSINES)
        total = E[Side.REFLECTION] + E[Side.TRANSMISSION]
        assert total.max() <= 1 + 1e-3
        assert total.min() >= 0
        if alpha == 0.02 and distribution != "phong":
            assert total[-1].min() >= 0.999


@pytest.mark.parametrize("masking", MASKINGS)
def test_brute_force_agrees(masking: str, device: Device) -> None:
    """Equation 12 and Walter's eq 21 by Monte Carlo, an anisotropic surface lit all around.

    Student's t of 31 exceeds 4.5 once in ten thousand.
    """
    alphas = (0.25, 0.6)
    surface = {"distribution": "ggx", "masking": masking, "alpha_x": alphas[0], "alpha_y": alphas[1]}
    solver, _ = solvers_of(device, rough_spec(surface))
    coating = Coating(np.array([1.0, 2.0, 1.5], complex)[:, None] * np.ones(2), np.array([300.0]), NM[:2])
    for seed, mu in enumerate((0.25, 0.85)):
        got = albedos(solver, np.sqrt(alphas[0] * alphas[1]), np.array([mu]), NM[:2])
        expected = monte_carlo_albedo(PlainSurface("ggx", *alphas, masking), coating, mu, 4096, seed)
        assert (np.abs(got[Side.REFLECTION][0] - expected.E_r) <= 4.5 * expected.sigma_r + 3e-4).all()
        assert (np.abs(got[Side.TRANSMISSION][0] - expected.E_t) <= 4.5 * expected.sigma_t + 3e-4).all()


@pytest.mark.parametrize("alpha", [0.05, 0.5])
def test_a_film_with_fringes_over_the_facets(alpha: float, device: Device) -> None:
    """4 um thick: E_r of a cubature with the film of tests/reference.py at each facet, to 3e-4."""
    solver, _ = solvers_of(device, rough_spec({"alpha_x": alpha}, CLEAR | {"thickness_nm": 4000}))
    index = np.array([1.0, 2.0, 1.5], complex)[:, None] * np.ones(4)
    cubature = FacetAlbedo(Coating(index, np.array([4000.0]), NM), nodes=4097)
    for mu in (0.3, 0.9):
        got = albedos(solver, alpha, np.array([mu]))[Side.REFLECTION][0]
        expected = cubature.at(PlainSurface("ashikhmin-shirley", alpha, alpha), mu)
        np.testing.assert_allclose(got, expected, rtol=0, atol=3e-4)


def test_dispersion_is_interpolated(device: Device) -> None:
    """E_t with geometry at three ratios of indices is that of each wavelength by itself, to 1e-4."""
    nm = np.linspace(450, 700, 13)
    spec = rough_spec({"distribution": "ggx", "alpha_x": 0.4}, substrate=DISPERSIVE, wavelength_nm=list(nm))
    solver, _ = solvers_of(device, spec)
    together = solver.geometry(np.array([0.4]), COSINES, nm)
    assert together.ratios.size == 3
    all_at_once = albedos(solver, 0.4, COSINES, nm)[Side.TRANSMISSION]
    for place in range(nm.size):
        one = nm[[place]]
        assert solver.geometry(np.array([0.4]), COSINES, one).ratios.size == 1
        alone = albedos(solver, 0.4, COSINES, one)[Side.TRANSMISSION]
        np.testing.assert_allclose(all_at_once[:, [place]], alone, rtol=0, atol=1e-4)


def test_equal_media_transmit_straight_on(device: Device) -> None:
    """A substrate of the incident medium: without a film E_t is Smith's G1, Heitz 2014, eq 14."""
    surface = {"distribution": "ggx", "masking": "smith-separable", "alpha_x": 0.5}
    solver, bsdf = solvers_of(device, rough_spec(surface, NOTHING, substrate="vacuum"))
    E = albedos(solver, 0.5, COSINES[1:])
    mu = COSINES[1:, None]
    lit = 2 * mu / (mu + np.sqrt(mu**2 + 0.25 * (1 - mu**2)))  # Walter et al. 2007, eq 34
    np.testing.assert_allclose(E[Side.TRANSMISSION], lit * np.ones(4), rtol=0, atol=3e-4)
    np.testing.assert_allclose(E[Side.REFLECTION], 0, atol=1e-6)
    assert bsdf.sides(NM) == (Side.REFLECTION,)


@pytest.mark.parametrize("space", ["Rec.709", "XYZ"])
def test_a_colour_is_the_weighted_spectrum(space: str, device: Device) -> None:
    """Linear: the colour of E is E weighted, of both sides, all terms of the surface among them."""
    surface = {"distribution": "ggx", "masking": "smith", "alpha_x": 0.6, "specular_weight": 0.7,
               "diffuse_weight": 0.5, "diffuse_reflectance": 0.3,
               "multiple_scattering": "kulla-conty"}  # fmt: skip
    nm = np.linspace(400, 700, 61)
    solver, _ = solvers_of(device, rough_spec(surface, substrate=DISPERSIVE, wavelength_nm=list(nm)))
    system = colour_system("D65", "CIE 1931 2 Degree Standard Observer", space)
    colouring = Colouring(system, nm, system.weights(nm), 0.0)
    place = np.array([0.6])
    geometry, mean = solver.geometry(place, COSINES, nm), solver.mirror_mean(place)
    spectra = solver.spectra(geometry, mean, ONE, nm)
    for side in Side:
        colour = solver.colours(geometry, mean, ONE, colouring, side)
        np.testing.assert_allclose(colour, spectra[side] @ colouring.weights.T, rtol=0, atol=5e-6)


@pytest.mark.parametrize("quantity", ["albedo", "bsdf"])
def test_wavelengths_cost_no_geometry(quantity: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten times the wavelengths: as many rows of facets, or as few, whatever the kernel is launched for.

    Model.md's factorisation: D and G depend on the geometry alone.
    """
    rows: list[int] = []
    known = TileRunner.run

    def counted(self: TileRunner, tile: Tile, arguments: tuple[object, ...], work: tuple[int, ...]) -> None:
        if self.kernel.function_name == "albedo_weights":
            rows.append(tile.rows)
        known(self, tile, arguments, work)

    monkeypatch.setattr(TileRunner, "run", counted)
    counts = []
    for step in (30.0, 3.0):
        rows.clear()
        angles = {"theta_i": 3, "theta_o": 3, "phi": 3} if quantity == "bsdf" else {"cos_theta": 9}
        nm = {"start": 400, "stop": 700, "step": step}
        tabulate_table(rough_spec({"alpha_x": 0.3}, quantity=quantity, wavelength_nm=nm, **angles))
        counts.append(sum(rows))
    assert counts[0] == counts[1] > 0


def test_more_light_than_there_is_is_refused(device: Device) -> None:
    """The message has the albedo: R of silver-like facets and 0.4 of diffuse light are 1.4."""
    surface = {"alpha_x": 0.1, "diffuse_weight": 0.8, "diffuse_reflectance": 0.5}
    spec = rough_spec(surface, NOTHING, substrate=MIRROR)
    solver, _ = solvers_of(device, spec)
    with pytest.raises(
        SpecError, match=r"albedo of 1\.400 at cos_theta .* and roughness 0\.1.*diffuse_weight"
    ):
        check_albedo(solver, np.array([0.1]), grid_of(spec))


def test_the_largest_albedo_is_told(device: Device) -> None:
    """A tenth of diffuse light and a tenth of a mirror's are a fifth, at any angle that shadows nothing."""
    surface = {"alpha_x": 0.05, "specular_weight": 0.1, "diffuse_weight": 1.0, "diffuse_reflectance": 0.1}
    spec = rough_spec(surface, NOTHING, substrate=MIRROR)
    solver, _ = solvers_of(device, spec)
    assert check_albedo(solver, np.array([0.05]), grid_of(spec)) == pytest.approx(0.2, abs=1e-5)


def test_an_exact_solver_takes_more_of_everything(device: Device) -> None:
    """Double precision, twice the nodes less one, twice the facets each way: its albedo is close by."""
    solver, _ = solvers_of(device, rough_spec({"alpha_x": 0.4, "masking": "smith"}))
    exact = solver.exact()
    assert exact.rule == solver.rule.doubled()
    assert exact.film.nodes == 2 * solver.film.nodes - 1
    got, expected = albedos(solver, 0.4, COSINES), albedos(exact, 0.4, COSINES)
    for side in Side:
        np.testing.assert_allclose(got[side], expected[side], rtol=0, atol=2e-4)


def test_alphas_keep_their_ratio(device: Device) -> None:
    """Roughness is sqrt(alpha_x alpha_y): with the ratio 4, facets at 0.2 are 0.4 and 0.1."""
    solver, _ = solvers_of(device, rough_spec({"alpha_x": 0.8, "alpha_y": 0.2}))
    assert isinstance(solver.surface, Surface)
    np.testing.assert_allclose(solver.microsurface(np.array([0.2])).alphas, [[0.4, 0.1]])
