"""The editor of the page: layers, materials, the way back, and what is said where something is wrong."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from served import serving
from visited_page import visited

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page, Route

sync_api = pytest.importorskip("playwright.sync_api", reason="the Python package playwright is missing")
expect = sync_api.expect

FIRST_NM = "420"
"""Thickness of the film that the page begins with."""
KEY = "kept-for-this-test-alone"


def thickness(page: "Page", layer: str = "1") -> "Locator":
    """Return the field of a layer's thickness."""
    return page.get_by_role("textbox", name=f"Thickness of layer {layer}", exact=True)


def slider(page: "Page", layer: str = "1") -> "Locator":
    """Return a layer's slider, which always shows what the spec has."""
    return page.get_by_role("slider", name=f"Thickness of layer {layer}, slider")


def layers(page: "Page") -> "Locator":
    """Return the fields of all thicknesses, from the incident medium inwards."""
    return page.get_by_role("textbox", name="Thickness of layer")


def found(page: "Page", name: str) -> "Locator":
    """Return the option of a material in an open list."""
    return page.get_by_role("option").filter(has=page.get_by_text(name, exact=True))


def press(page: "Page", name: str) -> None:
    """Press a button by its whole name."""
    page.get_by_role("button", name=name, exact=True).click()


def test_a_preset_is_opened_and_marked(page: "Page") -> None:
    """Morpho has six pairs of layers of 90 nm (its spec), and is the current one while it is unchanged."""
    preset = page.get_by_role("button", name="Morpho butterfly", exact=True)
    preset.click()
    expect(preset).to_have_attribute("aria-current", "true")
    expect(page.get_by_role("textbox", name="Name of the film")).to_have_value("Morpho butterfly")
    expect(page.get_by_role("textbox", name="Repeat group 1")).to_have_value("6")
    expect(thickness(page, "1.1")).to_have_value("90")
    thickness(page, "1.1").press("ArrowUp")
    expect(preset).not_to_have_attribute("aria-current", "true")
    press(page, "Undo")
    expect(preset).to_have_attribute("aria-current", "true")


def test_keys_step_a_thickness(page: "Page") -> None:
    """An arrow key steps by 1 nm, with Shift by 10, in the field and on the slider alike."""
    thickness(page).press("ArrowUp")
    expect(thickness(page)).to_have_value("421")
    thickness(page).press("Shift+ArrowDown")
    expect(thickness(page)).to_have_value("411")
    slider(page).press("ArrowRight")
    slider(page).press("Shift+ArrowRight")
    expect(thickness(page)).to_have_value("422")


def test_what_is_typed_becomes_the_film_and_is_taken_back(page: "Page") -> None:
    """Typing is one step of the way back, wherever undo is asked for from; redo brings it again."""
    thickness(page).fill("300,5")
    expect(slider(page)).to_have_attribute("aria-valuetext", "300.5 nm")
    thickness(page).press("Enter")
    press(page, "Undo")
    expect(thickness(page)).to_have_value(FIRST_NM)
    page.keyboard.press("Control+Shift+Z")
    expect(thickness(page)).to_have_value("300.5")
    page.keyboard.press("Control+Z")
    expect(thickness(page)).to_have_value(FIRST_NM)
    expect(page.get_by_role("button", name="Undo")).to_be_disabled()


def test_a_drag_of_the_slider_is_taken_back_at_once(page: "Page") -> None:
    """All that one drag passes through is one step of the way back."""
    box = slider(page).bounding_box()
    assert box is not None
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.42 * box["width"], middle)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.7 * box["width"], middle, steps=8)
    page.mouse.up()
    expect(thickness(page)).not_to_have_value(FIRST_NM)
    press(page, "Undo")
    expect(thickness(page)).to_have_value(FIRST_NM)


def test_layers_are_added_moved_and_removed(page: "Page") -> None:
    """A new layer is the innermost; moved up it is the first, and keeps the focus, by keyboard alone."""
    page.get_by_role("button", name="Add a layer").press("Enter")
    expect(layers(page)).to_have_count(2)
    page.get_by_role("button", name="Move layer 2 up").press("Enter")
    expect(thickness(page, "2")).to_have_value(FIRST_NM)
    expect(page.get_by_role("button", name="Move layer 1 down")).to_be_focused()
    page.get_by_role("button", name="Remove layer 1").press("Enter")
    expect(layers(page)).to_have_count(1)
    expect(thickness(page)).to_have_value(FIRST_NM)


def test_layers_are_grouped_and_ungrouped(page: "Page") -> None:
    """A group takes the layer beneath it in, repeats both, and leaves both in the stack when it is undone."""
    page.get_by_text("More of layer 1").click()
    press(page, "Make a group")
    expect(page.get_by_role("textbox", name="Repeat group 1")).to_have_value("2")
    press(page, "Add a layer")
    page.get_by_text("More of layer 2").click()
    press(page, "Add to the group above")
    expect(thickness(page, "1.2")).to_be_visible()
    page.get_by_role("button", name="Move layer 1.2 up").click()
    expect(thickness(page, "1.2")).to_have_value(FIRST_NM)
    press(page, "Ungroup")
    expect(thickness(page, "2")).to_have_value(FIRST_NM)


def test_a_material_is_found_and_chosen_by_keyboard(page: "Page") -> None:
    """The combobox of ARIA 1.2: typing opens the list, arrow keys go through it, Enter chooses."""
    page.get_by_role("button", name="Substrate: choose from the library").press("Enter")
    field = page.get_by_role("combobox", name="Substrate")
    expect(field).to_be_focused()
    page.keyboard.type("ag johnson")
    expect(field).to_have_attribute("aria-expanded", "true")
    option = found(page, "main/Ag/Johnson")
    expect(option).to_be_visible()
    for _ in range(page.get_by_role("option").count()):
        if option.get_attribute("aria-selected") == "true":
            break
        field.press("ArrowDown")
    expect(field).to_have_attribute("aria-activedescendant", str(option.get_attribute("id")))
    field.press("Enter")
    expect(field).to_have_value("main/Ag/Johnson")
    expect(field).to_have_attribute("aria-expanded", "false")


def test_enter_takes_the_material_that_is_typed(page: "Page") -> None:
    """A whole name is that material, also where others that hold the word are listed before it."""
    field = page.get_by_role("combobox", name="Incident medium")
    field.fill("water")
    expect(found(page, "conchiolin")).to_be_visible()
    field.press("Enter")
    expect(field).to_have_value("water")


def test_a_material_that_is_not_there_is_not_chosen(page: "Page") -> None:
    """A name that no material has stays as it was typed, with a message; Escape brings the old one back."""
    field = page.get_by_role("combobox", name="Incident medium")
    field.fill("unobtainium")
    expect(page.get_by_text('No material holds "unobtainium".')).to_be_visible()
    field.press("Enter")
    expect(field).to_have_value("unobtainium")
    expect(field).to_have_accessible_description(
        "Expected a material of the library, got 'unobtainium'; choose one of the list."
    )
    field.press("Escape")
    expect(field).to_have_value("air")
    expect(field).not_to_have_attribute("aria-invalid", "true")


def test_nonsense_is_kept_and_explained(page: "Page") -> None:
    """A text that is no number changes nothing but its field, which says what was expected and what came."""
    thickness(page).fill("abc")
    thickness(page).press("Tab")
    expect(thickness(page)).to_have_value("abc")
    expect(thickness(page)).to_have_attribute("aria-invalid", "true")
    expect(thickness(page)).to_have_accessible_description(
        "Expected a thickness in nanometres, 0 or 1e-6 to 1e8, got 'abc'."
    )
    expect(slider(page)).to_have_value(FIRST_NM)
    expect(page.get_by_role("button", name="Undo")).to_be_disabled()
    thickness(page).fill("400")
    expect(thickness(page)).not_to_have_attribute("aria-invalid", "true")
    expect(slider(page)).to_have_value("400")


def test_a_refusal_stands_at_its_field_until_it_is_mended(page: "Page") -> None:
    """1e9 nm is more than the service takes (its spec): what it says is the description of the field."""
    thickness(page).fill("1e9")
    expect(thickness(page)).to_have_attribute("aria-invalid", "true")
    expect(thickness(page)).to_have_accessible_description(
        "Expected 0, or a thickness from 1e-06 to 1e+08 nm, got 1e+09."
    )
    thickness(page).fill("500")
    expect(thickness(page)).not_to_have_attribute("aria-invalid", "true")


def test_a_material_is_held_beyond_its_data(page: "Page") -> None:
    """Bodurov's titanium dioxide is known from 405 nm (its page), the film wants 350 nm: a click mends it."""
    press(page, "Material of layer 1: choose from the library")
    field = page.get_by_role("combobox", name="Material of layer 1")
    field.fill("TiO2/Bodurov")
    found(page, "main/TiO2/Bodurov").click()
    expect(field).to_have_attribute("aria-invalid", "true")
    press(page, "Hold beyond its data")
    expect(field).not_to_have_attribute("aria-invalid", "true")
    expect(field).to_have_value("main/TiO2/Bodurov")


def test_a_rough_surface_has_one_roughness_or_two(page: "Page") -> None:
    """A brushed surface is given along x and y; the distribution of Blinn is the same all round."""
    page.get_by_role("radio", name="Rough").check(force=True)
    page.get_by_role("checkbox", name="Brushed").check()
    expect(page.get_by_role("textbox", name="Roughness along y")).to_be_visible()
    page.get_by_role("combobox", name="How the facets lie").select_option("blinn")
    expect(page.get_by_role("textbox", name="Roughness along y")).to_have_count(0)
    expect(page.get_by_role("textbox", name="Roughness", exact=True)).to_be_visible()


def test_the_theme_is_kept(page: "Page") -> None:
    """What was chosen holds against the system, also at the next visit."""
    page.get_by_role("combobox", name="Light or dark").select_option("dark")
    page.reload()
    expect(page.locator("html")).to_have_attribute("data-theme", "dark")


def test_a_phone_scrolls_down_alone(open_page: Callable[..., "Page"]) -> None:
    """On 390 pixels nothing is wider than the screen, with the longest of the presets."""
    page = open_page(viewport={"width": 390, "height": 844}, has_touch=True)
    page.get_by_role("button", name="Dichroic mirror").click()
    expect(page.get_by_role("textbox", name="Name of the film")).to_have_value("Dichroic mirror")
    assert page.evaluate("document.documentElement.scrollWidth") == 390


def test_a_key_is_asked_for(browser: "Browser", tmp_path: Path) -> None:
    """A service with keys asks for one; a wrong one is said to be, with a right one all goes on."""
    with serving(tmp_path / "store", api_keys=KEY) as served:
        served.await_ready()
        with visited(browser, f"{served.url}/") as page:
            dialogue = page.get_by_role("dialog", name="This service asks for a key")
            field = dialogue.get_by_label("Key", exact=True)
            field.fill("no key of it")
            field.press("Enter")
            expect(field).to_have_accessible_description("The service does not know this key.")
            field.fill("\N{CYRILLIC SMALL LETTER KA}" * 16)  # no header holds it
            field.press("Enter")
            expect(dialogue).to_be_visible()
            field.fill(KEY)
            field.press("Enter")
            expect(dialogue).to_be_hidden()
            expect(page.get_by_role("button", name="Soap bubble")).to_be_visible(timeout=20_000)


def test_a_late_refusal_of_another_key_is_no_refusal_of_this_one(browser: "Browser", tmp_path: Path) -> None:
    """An answer to a request with the key before arrives after the right one is given: that one is kept."""
    with serving(tmp_path / "store", api_keys=KEY) as served:
        served.await_ready()
        with visited(browser, f"{served.url}/") as page:
            dialogue = page.get_by_role("dialog", name="This service asks for a key")
            field = dialogue.get_by_label("Key", exact=True)
            held: list[Route] = []
            page.route("**/v1/presets", lambda route: held.append(route), times=1)
            field.fill("no key of it")
            field.press("Enter")
            expect(field).to_have_accessible_description("The service does not know this key.")
            field.fill(KEY)
            field.press("Enter")
            expect(dialogue).to_be_hidden()
            held[0].continue_()
            expect(page.get_by_role("button", name="Soap bubble")).to_be_visible()
            expect(dialogue).to_be_hidden()


def test_a_keyboard_can_pass_over_the_presets(page: "Page") -> None:
    """WCAG 2.2, 2.4.1: the first stop leads past what every visit begins with."""
    page.keyboard.press("Tab")
    skip = page.get_by_role("button", name="Skip to the film")
    expect(skip).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="Film", exact=True)).to_be_focused()
