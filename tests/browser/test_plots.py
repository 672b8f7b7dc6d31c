"""Plots: the page's numbers against the film in double precision, the lookup texture and colour-science."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
from numpy.typing import NDArray

from lut_contract import LookupTexture
from page_links import film_fragment
from reference import film
from served import Served

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

INDEX, THICKNESS_NM = (1.0, 2.0, 1.5), 420.0
FILM: dict[str, Any] = {
    "stack": {
        "incident": {"n": INDEX[0]},
        "substrate": {"n": INDEX[2]},
        "layers": [{"material": {"n": INDEX[1]}, "thickness_nm": THICKNESS_NM}],
    },
    "table": {"wavelength_nm": {"start": 380, "stop": 750, "step": 10}},
}
ALPHA = 0.15
ROUGH = FILM | {"surface": {"distribution": "ggx", "alpha_x": ALPHA, "masking": "v-cavity"}}
PERCENT_DIGIT = 0.01
COLOURS_OF_CANVAS = """plot => {
    const canvas = plot.querySelector("canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Set();
    for (let at = 0; at < data.length; at += 4) colours.add(data.slice(at, at + 3).join());
    return [...colours].map(text => text.split(",").map(Number));
}"""
LONG_MS = 60_000
FINE = "128x65"
"""Texels of the texture that is drawn once the film rests."""


def test_the_spectrum_is_that_of_the_film_in_double_precision(page: "Page") -> None:
    """R and T of s and p at 40 degrees, as the page's table has them: tests/reference.py."""
    section = opened(page, FILM, "Spectrum", thetaDegrees=40)
    rows = numbers(section, "R and T in % at 40°")
    exact = film(INDEX, [THICKNESS_NM], rows[:, 0], np.cos(np.radians(40)))
    means = [(exact.R_s + exact.R_p) / 2, (exact.T_s + exact.T_p) / 2]
    expected = np.concatenate([means[0], exact.R_s, exact.R_p, means[1], exact.T_s, exact.T_p])
    np.testing.assert_allclose(rows[:, 1:].T, 100 * expected, atol=PERCENT_DIGIT)
    assert rows.shape == (38, 7)


def test_a_spectrum_is_said_in_words(page: "Page") -> None:
    """A reader who does not see the plot hears its range and where it is largest."""
    from playwright.sync_api import expect

    section = opened(page, FILM, "Spectrum", thetaDegrees=10)
    rows = numbers(section, "R and T in % at 10°")
    largest = int(rows[rows[:, 1].argmax(), 0])
    words = f"Reflectance at 10°: .* to {rows[:, 1].max():.1f} %, largest at {largest} nm"
    expect(section.get_by_role("img", name=re.compile(words))).to_be_visible(timeout=LONG_MS)


def test_the_strip_has_the_colours_of_the_lookup_texture(
    page: "Page", service: Served, tmp_path: Path
) -> None:
    """Each pixel is the texture at its angle and thickness, encoded as IEC 61966-2-1 says and clipped."""
    opened(page, FILM, "Colour over angle and thickness")
    pixels, table = strip_pixels(page)
    texture = lookup_texture(service, table, tmp_path)
    height, width, _ = pixels.shape
    cos_theta = np.cos(np.radians(90 * (np.arange(width) + 0.5) / width))
    scale = 1.5 - (np.arange(height) + 0.5) / height
    places = np.meshgrid(cos_theta, scale)
    linear = texture.at(*(place.ravel() for place in places)).reshape(height, width, 3)
    assert np.abs(pixels - encoded(linear)).max() <= 0.56


def test_the_arrows_move_angle_and_thickness(page: "Page") -> None:
    """The strip is a slider of both; a thickness that has been chosen becomes that of the film."""
    from playwright.sync_api import expect

    section = opened(page, FILM, "Colour over angle and thickness", thetaDegrees=20)
    strip = section.get_by_role("slider")
    expect(strip).to_have_attribute("aria-valuenow", "20")
    strip.focus()
    for key in ("ArrowRight", "ArrowRight", "ArrowUp"):
        page.keyboard.press(key)
    expect(strip).to_have_attribute(
        "aria-valuetext", re.compile(r"22 degrees, 424.2 nm: colour #[0-9a-f]{6}")
    )
    expect(region(page, "Spectrum").get_by_role("slider")).to_have_value("22")
    section.get_by_role("button", name="Use this thickness").click()
    page.get_by_text("Spec as TOML").click()
    expect(page.get_by_role("region", name="TOML", exact=True)).to_contain_text("thickness_nm = 424.2")


def test_the_diagram_is_that_of_cie_1931(page: "Page") -> None:
    """The spectral locus and the corners of sRGB: colour-science's tables of both."""
    import colour

    section = opened(page, FILM, "Chromaticity")
    locus = points(section.locator("polygon.locus"))
    wavelengths = np.arange(390, 705, 5)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    expected = colour.XYZ_to_xy(observer[wavelengths.astype(float)])
    np.testing.assert_allclose(locus, expected, atol=1e-3)
    corners = points(section.locator("polygon.gamut"))
    np.testing.assert_allclose(corners, colour.RGB_COLOURSPACES["sRGB"].primaries, atol=1e-4)


def test_the_path_is_the_chromaticity_of_the_texture(page: "Page", service: Served, tmp_path: Path) -> None:
    """Places on the path over the angle are the texture's colours in x and y, by colour-science."""
    import colour

    section = opened(page, FILM, "Chromaticity")
    path = points(section.locator("polyline.path:not(.thin)"))
    texture = lookup_texture(service, strip_pixels(page)[1], tmp_path)
    theta = np.array([0, 35, 70, 85])
    linear = texture.at(np.cos(np.radians(theta)), np.ones(theta.size))
    expected = colour.XYZ_to_xy(colour.RGB_to_XYZ(linear, colour.RGB_COLOURSPACES["sRGB"]))
    np.testing.assert_allclose(path[theta], expected, atol=1e-4)


def test_the_lobe_has_its_height_in_the_mirror_direction(page: "Page") -> None:
    """There facets lie flat: f_r = R / (4 pi alpha² cos²), with GGX's D and without masking (v-cavities)."""
    section = opened(page, ROUGH, "Scattering lobe", thetaDegrees=30)
    rows = numbers(section, "f_r in the plane of incidence")
    mirror = rows[np.isclose(rows[:, 0], 30), 1]
    expected = luminous_reflectance(30) / (4 * np.pi * ALPHA**2 * np.cos(np.radians(30)) ** 2)
    np.testing.assert_allclose(mirror, expected, rtol=0.01)
    assert abs(rows[rows[:, 1].argmax(), 0] - 30) <= 2


def test_a_smooth_surface_has_a_ray(page: "Page") -> None:
    """Without roughness there is no lobe to compute: all light leaves in the mirror direction."""
    from playwright.sync_api import expect

    section = opened(page, FILM, "Scattering lobe", thetaDegrees=55)
    expect(section.get_by_role("img", name=re.compile("all reflected light leaves at 55°"))).to_be_visible(
        timeout=LONG_MS
    )


def test_curves_are_drawn_anew_for_the_dark(page: "Page") -> None:
    """A canvas knows no style sheet: once the theme changes its curve has the new token's colour."""
    from playwright.sync_api import expect

    plot = opened(page, FILM, "Spectrum").get_by_role("img")
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        ink, curve = (token(page, name) for name in ("--ink", "--plot-r"))
        expect(plot).to_have_attribute("data-ink", ink)
        assert [int(part) for part in re.findall(r"\d+", curve)] in plot.evaluate(COLOURS_OF_CANVAS)


def test_plots_fit_a_phone(page: "Page") -> None:
    """No plot is wider than a screen of 320 pixels: WCAG 2.2, success criterion 1.4.10."""
    opened(page, FILM, "Chromaticity")
    page.set_viewport_size({"width": 320, "height": 640})
    for plot in page.locator("section.plot").all():
        box = plot.bounding_box()
        assert box is not None
        assert box["x"] >= 0
        assert box["x"] + plot.evaluate("section => section.scrollWidth") <= 320


def opened(page: "Page", spec: dict[str, Any], name: str, /, **view: float) -> "Locator":
    """Open a film by its link, wait until its colours are fine, and return a section."""
    from playwright.sync_api import expect

    strip = page.locator(".strip canvas")
    before = strip.get_attribute("data-table")
    page.evaluate("fragment => { location.hash = fragment }", film_fragment(spec, **view))
    expect(strip).not_to_have_attribute("data-table", before or "", timeout=LONG_MS)
    expect(strip).to_have_attribute("data-size", FINE, timeout=LONG_MS)
    section = region(page, name)
    section.scroll_into_view_if_needed()
    return section


def region(page: "Page", name: str) -> "Locator":
    """Return the section of a plot."""
    return page.get_by_role("region", name=name, exact=True)


def numbers(section: "Locator", caption: str) -> NDArray[np.float64]:
    """Return the rows of a plot's table, without their units and what is no number."""
    from playwright.sync_api import expect

    section.get_by_text("Numbers", exact=True).click(timeout=LONG_MS)
    expect(section.locator("caption")).to_have_text(caption, timeout=LONG_MS)
    rows = section.locator("tbody tr").all_inner_texts()
    return np.array([[float(cell.rstrip("°")) for cell in numeric(row)] for row in rows])


def numeric(row: str) -> list[str]:
    """Return the cells of a row that are numbers."""
    return re.findall(r"(?<![#\w.])-?\d+\.?\d*(?:e[-+]\d+)?°?(?!\w)", row)


def strip_pixels(page: "Page") -> tuple[NDArray[np.float64], str]:
    """Return the strip as it is drawn, (H, W, 3), and the id of its table."""
    width, height, data, table = page.evaluate(
        """() => {
            const canvas = document.querySelector(".strip canvas");
            const { width, height } = canvas;
            const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
            return [width, height, Array.from(data), canvas.dataset.table];
        }"""
    )
    return np.array(data, np.float64).reshape(height, width, 4)[..., :3], table


def lookup_texture(service: Served, table: str, folder: Path) -> LookupTexture:
    """Return the texture of a table, as OpenImageIO reads the service's file."""
    path = folder / "strip.exr"
    path.write_bytes(httpx.get(f"{service.url}/v1/tables/{table}.exr").raise_for_status().content)
    return LookupTexture.read(path)


def token(page: "Page", name: str) -> str:
    """Return the colour of a token of the page's style, as an element has it in the theme of now."""
    style = """name => {
        const element = document.body.appendChild(document.createElement("i"));
        element.style.color = `var(${name})`;
        const { color } = getComputedStyle(element);
        element.remove();
        return color;
    }"""
    return str(page.evaluate(style, name))


def encoded(linear: NDArray[np.float64]) -> NDArray[np.float64]:
    """Linear colours as sRGB from 0 to 255, clipped: IEC 61966-2-1."""
    shown = np.clip(linear, 0, 1)
    return 255 * np.where(shown <= 0.0031308, 12.92 * shown, 1.055 * shown ** (1 / 2.4) - 0.055)


def points(line: "Locator") -> NDArray[np.float64]:
    """Return the corners of an SVG line in x and y, which counts upwards."""
    text = line.get_attribute("points") or ""
    return np.array([[float(number) for number in pair.split(",")] for pair in text.split()]) * (1, -1)


def luminous_reflectance(theta_degrees: float) -> float:
    """Return R of the film, weighed with the observer's y under D65."""
    import colour

    wavelengths = np.arange(390.0, 711.0, 1.0)
    exact = film(INDEX, [THICKNESS_NM], wavelengths, np.cos(np.radians(theta_degrees)))
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"][wavelengths][:, 1]
    weight = observer * colour.SDS_ILLUMINANTS["D65"][wavelengths]
    return float(((exact.R_s + exact.R_p)[0] / 2 * weight).sum() / weight.sum())
