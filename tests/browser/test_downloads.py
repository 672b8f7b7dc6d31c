"""What is taken away from the page is what the service, the command line and another page make of it."""

import hashlib
import json
import re
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from page_links import film_fragment, link_contents
from served import PROGRAM, Served

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page

FILM: dict[str, Any] = {
    "name": "Film for a test",
    "stack": {
        "incident": "air",
        "substrate": {"n": 1.5},
        "layers": [{"material": {"n": 1.9}, "thickness_nm": 333}],
    },
    "table": {"cos_theta": 16},
}
ID = re.compile("[0-9a-f]{64}")


def test_a_downloaded_texture_is_whole(page: "Page", service: Served, tmp_path: Path) -> None:
    """The file's SHA-256 is the one on the page and the service's ETag, and `nacreous verify` accepts it."""
    opened(page, FILM)
    page.get_by_role("button", name="Make the files").click()
    path = tmp_path / "film.exr"
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Download film-for-a-test.exr").click()
    waiting.value.save_as(path)
    found = hashlib.sha256(path.read_bytes()).hexdigest()
    row = page.get_by_role("listitem").filter(has_text="film-for-a-test.exr")
    address = row.get_by_role("link").get_attribute("href")
    assert ID.findall(row.inner_text()) == [found]
    assert httpx.head(f"{service.url}/{address}").headers["ETag"] == f'"{found}"'
    assert waiting.value.suggested_filename == "film-for-a-test.exr"
    subprocess.run([*PROGRAM, "verify", str(path)], check=True)


def test_the_certificate_is_that_of_the_files(page: "Page", service: Served) -> None:
    """Once there are files the figures are their table's, and not the preview's; null ones are left out."""
    from playwright.sync_api import expect

    opened(page, FILM)
    page.get_by_role("button", name="Make the files").click()
    section = page.get_by_role("region", name="How exact it is")
    expect(section).to_contain_text("Of the table in your files")
    section.get_by_text("Figures").click()
    answer = httpx.post(f"{service.url}/v1/tables", json=FILM).raise_for_status().json()
    figures = {name: value for name, value in answer["certificate"].items() if value is not None}
    shown = dict(zip(section.locator("dt").all_inner_texts(), section.locator("dd").all_inner_texts(), strict=True))
    assert {name: float(value) for name, value in shown.items()} == figures
    expect(section.locator(f'[data-table="{answer["id"]}"]')).to_be_visible()


@pytest.mark.parametrize("preset", ["soap-bubble", "morpho-ridges", "dichroic", "paper/figure-6"])
def test_toml_and_commands_make_the_same_table(
    page: "Page", service: Served, tmp_path: Path, preset: str
) -> None:
    """The id of a preset's table is that of its TOML, by the service and by the command line, and of curl's."""
    entry = httpx.get(f"{service.url}/v1/presets/{preset}").raise_for_status().json()
    page.evaluate("fragment => { location.hash = fragment }", f"preset={preset}")
    toml = recipe(page, "Spec as TOML", "TOML", f'name = "{entry["title"]}"')
    (tmp_path / "film.toml").write_text(toml)
    headers = {"Content-Type": "application/toml"}
    posted = httpx.post(f"{service.url}/v1/tables", content=toml.encode(), headers=headers)
    assert posted.raise_for_status().json()["id"] == entry["id"]
    arguments = ["tabulate", "film.toml", "--format", "csv", "--json"]
    made = subprocess.run([*PROGRAM, *arguments], cwd=tmp_path, check=True, capture_output=True)
    assert json.loads(made.stdout.splitlines()[0])["id"] == entry["id"]
    command = recipe(page, "From this service, by curl", "curl command", "curl")
    answered = subprocess.run(["sh", "-c", command], check=True, capture_output=True)
    assert json.loads(answered.stdout)["id"] == entry["id"]
    assert recipe(page, "Command line", "command", "nacreous").split()[2] == preset


def test_the_address_is_a_link_to_what_is_seen(page: "Page", browser: "Browser", service: Served) -> None:
    """The film and the view that an address holds are on any page that it is opened in."""
    from playwright.sync_api import expect

    opened(page, FILM, thetaDegrees=25, shape="wing", light="sunset")
    strip = page.get_by_role("region", name="Colour over angle and thickness").get_by_role("slider")
    strip.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowDown")
    page.get_by_role("button", name="Use this thickness").click()
    toml = recipe(page, "Spec as TOML", "TOML", "thickness_nm = 329.67")
    page.wait_for_function(f"location.href !== {page.url!r}")
    link = recipe(page, "Link to this film", "link", "#film=")
    expect(page).to_have_url(link)
    contents = link_contents(link)
    assert contents["view"] == {"shape": "wing", "light": "sunset", "thetaDegrees": 26}
    assert contents["spec"]["stack"]["layers"] == [{"material": {"n": 1.9}, "thickness_nm": 329.67}]
    other = browser.new_page()
    other.goto(link)
    assert recipe(other, "Spec as TOML", "TOML", "329.67") == toml
    angle = other.get_by_role("region", name="Spectrum").get_by_role("slider")
    expect(angle).to_have_value("26")
    other.close()


@pytest.mark.parametrize(
    ("fragment", "words"),
    [
        (film_fragment(FILM)[:60], "the link is damaged"),
        (film_fragment({"stack": {"incident": "air"}}), "the link holds no film"),
        (film_fragment(FILM | {"description": "x" * 5_000_000}), "more than a film"),
    ],
)
def test_a_link_that_is_broken_says_so(page: "Page", fragment: str, words: str) -> None:
    """The film on the page stays, and a sentence says what is wrong with the link."""
    from playwright.sync_api import expect

    before = recipe(page, "Spec as TOML", "TOML", "[stack]")
    page.evaluate("fragment => { location.hash = fragment }", fragment)
    expect(page.get_by_role("alert").filter(has_text=words)).to_be_visible()
    assert page.get_by_role("region", name="TOML", exact=True).inner_text() == before


def test_a_refusal_is_told_in_the_panel(browser: "Browser", service: Served) -> None:
    """What the service refuses names its field, what was expected, and what came: RFC 9457."""
    from playwright.sync_api import expect

    page = browser.new_page()
    wrong = FILM | {"table": {"cos_theta": [0.5, 0.4]}}
    page.goto(f"{service.url}/#{film_fragment(wrong)}")
    recipe(page, "Spec as TOML", "TOML", "cos_theta = [0.5, 0.4]")
    page.get_by_role("button", name="Make the files").click()
    problem = httpx.post(f"{service.url}/v1/tables", json=wrong).json()
    alert = page.get_by_role("region", name="Take it away").get_by_role("alert")
    for part in ("field", "expected", "got"):
        expect(alert).to_contain_text(problem[part])
    page.close()


def test_a_format_that_wants_another_table_gets_it(page: "Page", service: Served) -> None:
    """pbrt reads a bsdf: one press makes the film one, and its file is then there."""
    from playwright.sync_api import expect

    opened(page, FILM)
    page.get_by_role("button", name="Make the files").click()
    page.get_by_role("radio", name="pbrt-v4").check()
    page.get_by_role("button", name="Tabulate a rough surface").click()
    expect(page.get_by_role("button", name="Download film-for-a-test.bsdf")).to_be_visible()
    expect(page.get_by_role("region", name="snippet for pbrt-v4")).to_have_text(
        'Material "measured" "string filename" "film-for-a-test.bsdf"'
    )


def opened(page: "Page", spec: dict[str, Any], /, **view: str | float) -> None:
    """Open a film by a link, and wait until it is on the page."""
    page.evaluate("fragment => { location.hash = fragment }", film_fragment(spec, **view))
    recipe(page, "Spec as TOML", "TOML", spec["name"])


def recipe(page: "Page", summary: str, name: str, words: str) -> str:
    """Unfold a text of the panel, and return it once it holds some words."""
    from playwright.sync_api import expect

    text: Locator = page.get_by_role("region", name=name, exact=True)
    folded = page.locator("details").filter(has=page.get_by_text(summary, exact=True))
    if folded.get_attribute("open") is None:
        folded.locator("summary").click()
    expect(text).to_contain_text(words)
    return text.locator("code").text_content() or ""
