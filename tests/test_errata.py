"""Each erratum of docs/errata.md: what is printed is off by what it says, what is right agrees with tmm.

The page's numbers are computed here and looked for in its sections, so that they cannot go stale.
"""

import re
from pathlib import Path

import numpy as np
import pytest
import tmm

import reference_paper as paper
from reference_colour import film_colour
from reference_facets import FloatArray, Surface, density, unit
from reference_surface import Coating, monte_carlo_albedo, refracted

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "errata.md").read_text(encoding="utf-8")
SECTIONS = {title: text for title, _, text in (s.partition("\n") for s in PAGE.split("\n## ")[1:])}

FIGURE_3 = (1.0, 2.0, 1.5)
"""A film of 2.0 on glass in air; 420 nm thick in figure 3."""


def exact(
    polarisation: str, index: tuple[complex, ...], thickness_nm: list[float], nm: float, cos_theta: float
) -> tuple[float, float]:
    """R and T of the transfer matrices of Byrnes's tmm."""
    depths = [np.inf, *thickness_nm, np.inf]
    found = tmm.coh_tmm(polarisation, index, depths, np.arccos(cos_theta), nm)
    return float(found["R"]), float(found["T"])


def one_film(
    index: tuple[complex, complex, complex], thickness_nm: float, nm: float, cos_theta: float = 1.0
) -> tuple[paper.SingleFilm, paper.SingleFilm]:
    """Coefficients of one film at one wavelength, (s, p)."""
    return paper.single_film(index, thickness_nm, np.array([nm]), cos_theta)


def assert_told(section: str, *numbers: float, digits: int = 2) -> None:
    """Look for each number, to so many digits behind the point, in a section of the page."""
    text = " ".join(SECTIONS[section].split())
    for number in numbers:
        assert re.search(rf"(?<![\d.]){re.escape(f'{number:.{digits}f}')}(?!\d)", text), (section, number)


def test_equation_2_is_the_sum_of_equation_1() -> None:
    """A geometric series: the beams of eq 1, by Stokes's relations, add up to eq 2 for complex r as well."""
    film = one_film((1.0, 2.0 + 0.05j, 0.6 + 3j), 420, 550, 0.5)[0]
    beam = (1 - film.r_1**2) * film.r_2 * np.exp(1j * film.delta)
    beams = [beam * (-film.r_1 * film.r_2 * np.exp(1j * film.delta)) ** n for n in range(200)]
    np.testing.assert_allclose(film.r_1 + sum(beams), paper.equation_2(film), rtol=1e-14)


def test_equation_3_makes_energy() -> None:
    """A soap film transmits what it does not reflect (tmm); t_1 + t_2 transmits more than comes in."""
    film = one_film((1.0, 1.33, 1.0), 300, 550)[0]
    R, T = exact("s", (1.0, 1.33, 1.0), [300], 550, 1.0)
    printed = float(np.abs(paper.equation_3_printed(film)[0]) ** 2)
    assert np.abs(paper.equation_3(film)[0]) ** 2 == pytest.approx(T, abs=1e-12)
    assert printed > 1
    assert_told("Equation 3", R, T, printed)


def test_equation_4_needs_what_lies_below() -> None:
    """Six ridges of a Morpho reflect as tmm has it if r_(M+1) is that of all that lies below."""
    index, thickness_nm = (1.0, *[1.56 + 0.06j, 1.0] * 5, 1.56 + 0.06j, 1.0), [100.0] * 11
    R, _ = exact("s", index, thickness_nm, 504, 1.0)
    composed = paper.multilayer(index, thickness_nm, np.array([504.0]), 1.0)[0]
    by_the_letter = np.abs(paper.equation_2(one_film((1.0, 1.56 + 0.06j, 1.0), 100, 504)[0])[0]) ** 2
    assert np.abs(paper.equation_4(composed)[0]) ** 2 == pytest.approx(R, abs=1e-12)
    assert_told("Equation 4", R, float(by_the_letter))


def test_equation_5_forgets_the_absorption() -> None:
    """Gold transmits what tmm says with exp(i delta / 2) of each passage, and too much without it."""
    index = (1.0, 0.43 + 2.455j, 1.5)
    R, T = exact("s", index, [20], 550, 1.0)
    gold = paper.multilayer(index, [20], np.array([550.0]), 1.0)[0]
    printed = float(1.5 * np.abs(paper.equation_5_printed(gold)[0]) ** 2)
    assert 1.5 * np.abs(paper.equation_5(gold)[0]) ** 2 == pytest.approx(T, abs=1e-12)
    assert printed > 1
    assert_told("Equation 5", R, T, printed)


@pytest.mark.parametrize("cos_theta", [1.0, 0.5])
def test_equation_5_holds_for_clear_layers(cos_theta: float) -> None:
    """Phases of modulus 1 do not change |t|^2: as printed, eq 5 gives tmm's T of three clear layers."""
    index, thickness_nm = (1.0, 2.0, 1.38, 2.3, 1.5), [90.0, 120.0, 60.0]
    clear = paper.multilayer(index, thickness_nm, np.array([550.0]), cos_theta)[0]
    flux = np.sqrt(1.5**2 - (1 - cos_theta**2)) / cos_theta
    printed = flux * np.abs(paper.equation_5_printed(clear)[0]) ** 2
    assert printed == pytest.approx(exact("s", index, thickness_nm, 550, cos_theta)[1], abs=1e-12)


def test_equation_7_is_complex_on_metal() -> None:
    """Squares of complex numbers are no reflectance: below 0 where tmm has a third."""
    index = (1.0, 2.4, 2.54 + 3.43j)
    film = one_film(index, 60, 550)[0]
    R, _ = exact("s", index, [60], 550, 1.0)
    printed = complex(paper.equation_7_printed(film)[0])
    assert paper.equation_7(film)[0] == pytest.approx(R, abs=1e-12)
    assert abs(printed.imag) > 0.1
    assert_told("Equation 7", R, printed.real)


def test_equation_8_breaks_energy() -> None:
    """R + T = 1 without absorption; with the film's angle in the prefactor it is more at 60 degrees."""
    sums = []
    for polarisation, film in zip("sp", one_film(FIGURE_3, 420, 550, 0.5), strict=True):
        R, T = exact(polarisation, FIGURE_3, [420], 550, 0.5)
        assert paper.equation_8(film)[0] == pytest.approx(T, abs=1e-12)
        sums.append(R + float(paper.equation_8_printed(film)[0].real))
    assert min(sums) > 1.05
    assert_told("Equation 8", *sums)


def test_equation_9_names_the_minima() -> None:
    """Born & Wolf, 1.6.4: a film denser than both neighbours reflects most at odd quarter waves."""
    path_nm, orders = 2 * 2.0 * 420, (2, 3)
    bare, quarter = ((1 - 1.5) / (1 + 1.5)) ** 2, ((1.5 - 2.0**2) / (1.5 + 2.0**2)) ** 2
    for nm in paper.equation_9_printed(path_nm, (2, 3, 4)):
        assert exact("s", FIGURE_3, [420], float(nm), 1.0)[0] == pytest.approx(bare, abs=1e-12)
    maxima_nm = paper.equation_9(path_nm, orders)
    for nm in maxima_nm:
        assert exact("s", FIGURE_3, [420], float(nm), 1.0)[0] == pytest.approx(quarter, abs=1e-12)
    assert_told("Equation 9", bare, quarter, digits=3)
    assert_told("Equation 9", *paper.equation_9_printed(path_nm, (2, 3, 4)), *maxima_nm, digits=0)


def test_equation_10_is_fresnels() -> None:
    """Named parallel, r vanishes at Brewster's angle, tan theta = n; each r and t of one name keep energy."""
    n, cos_1 = 1.5, 1 / np.sqrt(1 + 1.5**2)
    cos_2 = np.sqrt(1 - (1 - cos_1**2) / n**2)
    r_p, t_p = paper.equation_10_parallel(1, n, cos_1, cos_2)
    r_s, t_s = paper.equation_10_perpendicular(1, n, cos_1, cos_2)
    flux = n * cos_2 / cos_1
    assert abs(r_p) == pytest.approx(0, abs=1e-15)
    assert [r_s**2 + flux * t_s**2, r_p**2 + flux * t_p**2] == pytest.approx([1, 1], abs=1e-14)
    assert abs(r_p**2 + flux * t_s**2 - 1) > 0.1


def test_both_polarisations_turn_their_phase_in_total_reflection() -> None:
    """Born & Wolf, 1.5.4, eq 60: tan(phase / 2) = -sqrt(sin^2 - n^2) / cos, for p over n^2 as well."""
    n, cos, sin = 1 / 1.5, 0.5, np.sqrt(0.75)
    evanescent = np.sqrt(complex(1 - (sin / n) ** 2))
    phases = []
    for of, divisor in ((paper.equation_10_perpendicular, 1), (paper.equation_10_parallel, n**2)):
        r = complex(of(1.5, 1.0, cos, evanescent)[0])
        expected = -2 * np.arctan(np.sqrt(sin**2 - n**2) / cos / divisor)
        assert [abs(r), np.angle(r)] == pytest.approx([1, expected], abs=1e-12)
        phases.append(np.degrees(expected))
    assert_told("Section 3.2: polarisation", *phases, digits=0)


def test_polarisations_are_averaged_last() -> None:
    """(R_s + R_p) / 2 of tmm; eq 7 of averaged boundaries is off, averaged amplitudes reflect nothing."""
    nm = np.arange(380.0, 781.0)
    for degrees in (60, 75):
        s, p = paper.single_film(FIGURE_3, 420, nm, np.cos(np.radians(degrees)))
        right = (paper.equation_7(s) + paper.equation_7(p)) / 2
        r_1, r_2 = (np.sqrt((abs(a) ** 2 + abs(b) ** 2) / 2) for a, b in ((s.r_1, p.r_1), (s.r_2, p.r_2)))
        averaged = paper.equation_7_printed(s._replace(r_1=-r_1, r_2=r_2)).real
        worst = int(np.argmax(np.abs(averaged - right)))
        tmm_R = [exact(of, FIGURE_3, [420], nm[worst], np.cos(np.radians(degrees)))[0] for of in "sp"]
        assert right[worst] == pytest.approx(np.mean(tmm_R), abs=1e-12)
        assert_told("Section 3.2: polarisation", abs(averaged - right)[worst], right[worst], digits=3)
    s, p = paper.single_film(FIGURE_3, 420, nm, 1.0)
    np.testing.assert_allclose(paper.equation_2(s) + paper.equation_2(p), 0, atol=1e-15)


def share_by_equation_12(surface: Surface, coating: Coating, mu: float, samples: int) -> float:
    """Integrate eq 12 with F = T (eq 8) and the bisector as half vector over the lower hemisphere."""
    cos, turn = (np.stack(np.meshgrid(*[(np.arange(samples) + 0.5) / samples] * 2)).reshape(2, -1)) * [
        [1],
        [2 * np.pi],
    ]
    sin = np.sqrt(1 - cos**2)
    o = np.stack([sin * np.cos(turn), sin * np.sin(turn), -cos], axis=-1)
    i = np.array([np.sqrt(1 - mu**2), 0, mu])
    h = unit(i + o)
    h *= np.sign(h[:, 2:])  # a facet faces upwards
    masking = np.minimum(1, 2 * h[:, 2] * np.minimum(mu, cos) / np.abs((o * h).sum(axis=-1)))
    T = coating.intensities(np.abs(h @ i))[1][:, 0]
    return float(2 * np.pi * np.mean(density(surface, i, h) * masking * T / (4 * mu)))


@pytest.mark.parametrize("exponent", [1000.0, 10.0])
def test_equation_12_transmits_next_to_nothing(exponent: float) -> None:
    """Walter et al. 2007, eq 21, transmits nine tenths; the Jacobian of eq 12 is a reflection's."""
    alpha = np.sqrt(2 / (exponent + 2))
    surface = Surface("ashikhmin-shirley", alpha, alpha)
    coating = Coating(np.array(FIGURE_3, complex)[:, None], np.array([420.0]), np.array([550.0]))
    mu = np.cos(np.radians(45))
    right = monte_carlo_albedo(surface, coating, mu, 16384, 20150311)
    assert right.E_r[0] + right.E_t[0] <= 1.001
    printed = share_by_equation_12(surface, coating, mu, 200)
    assert printed < 0.03
    assert_told("Equation 12", printed, float(right.E_t[0]))


def in_plane(degrees: float) -> FloatArray:
    """Return a direction in the plane of x and z, so many degrees from the normal."""
    return np.array([np.sin(np.radians(degrees)), 0, np.cos(np.radians(degrees))])


def test_equation_13_is_not_reciprocal_in_refraction() -> None:
    """Reciprocity (Helmholtz): masking is the same for light that runs the other way."""
    i, h = in_plane(85), in_plane(5)
    o = refracted(i, h, 1.0, 1.5)
    assert paper.equation_13(i, o, h) == paper.equation_13(o, i, h)
    there, back = paper.equation_13_printed(i, o, h), paper.equation_13_printed(o, i, h)
    assert back - there > 0.5
    assert_told("Equation 13", there, back, paper.equation_13(i, o, h))


def test_equation_13_is_right_in_reflection() -> None:
    """The half vector has one angle to both directions, so either may stand in the denominators."""
    i, o = in_plane(80), unit(np.array([-0.9, 0.3, 0.5]))
    h = unit(i + o)
    assert paper.equation_13_printed(i, o, h) == pytest.approx(paper.equation_13(i, o, h), abs=1e-14)


def test_figure_4_is_not_redder() -> None:
    """CIELAB hues under D65 by colour-science: 420 nm is purple and 450 nm green at normal incidence."""
    import colour

    space = colour.RGB_COLOURSPACES["ITU-R BT.709"]
    index = np.repeat(np.array(FIGURE_3, complex)[:, None], 471, axis=1)
    hues = []
    for thickness_nm in (420.0, 450.0):
        rgb = film_colour(index, np.array([thickness_nm]), 1.0)
        _, a, b = colour.XYZ_to_Lab(space.matrix_RGB_to_XYZ @ rgb, space.whitepoint)
        hues.append(float(np.degrees(np.arctan2(b, a)) % 360))
    assert 290 < hues[0] < 330
    assert 130 < hues[1] < 180
    assert_told("Words about the figures", *hues, digits=0)
    assert_told("Words about the figures", *paper.equation_9(2 * 2.0 * 450, (2, 3)), digits=0)


def test_the_overview_has_the_numbers_of_the_sections() -> None:
    """Each row links a section, and what it says of the effect is in there."""
    rows = re.findall(r"\| \[[^\]]+\]\(#([\w-]+)\) \|[^|]+\|([^|]+)\|", PAGE)
    anchors = {re.sub(r"[^\w -]", "", title).lower().replace(" ", "-"): title for title in SECTIONS}
    assert {anchor for anchor, _ in rows} == set(anchors)
    for anchor, effect in rows:
        for number in re.findall(r"-?\d+\.\d+|\d+°", effect):
            assert number in SECTIONS[anchors[anchor]], (anchor, number)


def test_every_erratum_names_its_tests() -> None:
    """A test that the page names is in this file, or in the file that it links."""
    texts = (Path(__file__), ROOT / "tests" / "kernels" / "test_paper.py")
    defined = "\n".join(file.read_text(encoding="utf-8") for file in texts)
    named = re.findall(r"`(test_\w+)`", PAGE)
    assert len(named) >= len(SECTIONS) - 1
    assert [name for name in named if f"def {name}(" not in defined] == []
