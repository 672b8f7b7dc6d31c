"""What is taken away from the page is what the service, the command line and another page make of it."""

import hashlib
import json
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import pytest

from nacreous.tables.spec import Spec, canonical_json
from page_links import film_fragment, link_contents
from served import PROGRAM, Served

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

FILM: dict[str, Any] = {
    "name": "Film for a test",
    "stack": {
        "incident": "air",
        "substrate": {"n": 1.5},
        "layers": [{"material": {"n": 1.9}, "thickness_nm": 333}],
    },
    "table": {"cos_theta": 16},
}
LONG_MS = 60_000
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
    expect(section).to_contain_text("Of the table in your files", timeout=LONG_MS)
    section.get_by_text("Figures").click()
    answer = tabulated(service, json.dumps(FILM), "application/json")
    figures = {name: value for name, value in answer["certificate"].items() if value is not None}
    shown = dict(
        zip(section.locator("dt").all_inner_texts(), section.locator("dd").all_inner_texts(), strict=True)
    )
    assert {name: float(value) for name, value in shown.items()} == figures
    expect(section.locator(f'[data-table="{answer["id"]}"]')).to_be_visible()


@pytest.mark.parametrize("preset", ["morpho-ridges", "dichroic", "paper/figure-6"])
def test_the_toml_of_a_preset_is_the_preset(
    page: "Page", service: Served, tmp_path: Path, preset: str
) -> None:
    """Mixtures, groups, surfaces and lists: the file that is written says what the preset says."""
    entry = opened_preset(page, service, preset)
    path = tmp_path / "film.toml"
    path.write_text(recipe(page, "Spec as TOML", "TOML", f'name = "{entry["title"]}"'))
    assert canonical_json(Spec.from_file(path)) == canonical_json(Spec.from_document(entry["spec"]))


def test_toml_and_commands_make_the_same_table(page: "Page", service: Served, tmp_path: Path) -> None:
    """The table of a film has one id, whoever makes it: the service from TOML, the command line, or curl."""
    entry = opened_preset(page, service, "soap-bubble")
    toml = recipe(page, "Spec as TOML", "TOML", f'name = "{entry["title"]}"')
    assert tabulated(service, toml, "application/toml")["id"] == entry["id"]
    (tmp_path / "film.toml").write_text(toml)
    arguments = ["tabulate", "film.toml", "--format", "csv", "--json"]
    made = subprocess.run([*PROGRAM, *arguments], cwd=tmp_path, check=True, capture_output=True)
    assert json.loads(made.stdout.splitlines()[0])["id"] == entry["id"]
    command = recipe(page, "From this service, by curl", "curl command", "curl")
    answered = subprocess.run(["/bin/sh", "-c", command], check=True, capture_output=True)
    assert json.loads(answered.stdout)["id"] == entry["id"]
    assert recipe(page, "Command line", "command", "nacreous").split()[2] == "soap-bubble"


def test_the_address_is_a_link_to_what_is_seen(page: "Page", open_page: Callable[..., "Page"]) -> None:
    """The film and the view that an address holds are on any page that it is opened in."""
    from playwright.sync_api import expect

    view = {"shape": "wing", "light": "sunset", "thetaDegrees": 25}
    fragment = "&".join(["preset=coated-lens", *(f"{name}={value}" for name, value in view.items())])
    page.evaluate("fragment => { location.hash = fragment }", fragment)
    strip = page.get_by_role("region", name="Colour over angle and thickness").get_by_role("slider")
    expect(strip).to_have_attribute("aria-valuetext", re.compile("25 degrees, 99.7 nm"), timeout=LONG_MS)
    strip.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowDown")
    page.get_by_role("button", name="Use this thickness").click()
    expect(page).to_have_url(re.compile("#film="))  # a preset that has been changed is one no more
    toml = recipe(page, "Spec as TOML", "TOML", "thickness_nm = 98.7")
    contents = link_contents(page.url)
    assert contents["view"] == view | {"thetaDegrees": 26}
    layer = {"material": "magnesium-fluoride", "thickness_nm": 98.7}
    assert contents["spec"]["stack"] == {"incident": "air", "substrate": "bk7", "layers": [layer]}
    assert recipe(page, "Link to this film", "link", "#film=") == page.url
    other = open_page(page.url.rpartition("/")[2])
    assert recipe(other, "Spec as TOML", "TOML", "thickness_nm = 98.7") == toml
    angle = other.get_by_role("region", name="Spectrum").get_by_role("slider")
    expect(angle).to_have_value("26")


@pytest.mark.parametrize(
    ("fragment", "words"),
    [
        (film_fragment(FILM)[:60], "the link is damaged"),
        (film_fragment({"stack": {"incident": "air"}}), "the link holds no film"),
        (film_fragment(FILM | {"description": "x" * 5_000_000}), "more than a film"),
        (film_fragment(FILM | {"name": {"first": "x"}}), "the link holds no film"),
        (
            film_fragment({"stack": FILM["stack"] | {"substrate": {"constructor": 1}}}),
            "the link holds no film",
        ),
        (film_fragment(FILM | {"table": {"thickness_scale": {"start": "a"}}}), "the link holds no film"),
        ("preset=..%2F..%2Fhealthz", "the link names no preset"),
    ],
)
def test_a_link_that_is_broken_says_so(page: "Page", fragment: str, words: str) -> None:
    """The film on the page stays, and a sentence says what is wrong with the link."""
    from playwright.sync_api import expect

    before = recipe(page, "Spec as TOML", "TOML", "[stack]")
    page.evaluate("fragment => { location.hash = fragment }", fragment)
    expect(page.get_by_role("alert").filter(has_text=words)).to_be_visible()
    assert page.get_by_role("region", name="TOML", exact=True).inner_text() == before


def test_a_refusal_is_told_in_the_panel(open_page: Callable[..., "Page"], service: Served) -> None:
    """What the service refuses names its field, what was expected, and what came: RFC 9457."""
    from playwright.sync_api import expect

    wrong = FILM | {"table": {"cos_theta": [0.5, 0.4]}}
    page = open_page(f"#{film_fragment(wrong)}")
    recipe(page, "Spec as TOML", "TOML", "cos_theta = [0.5, 0.4]")
    page.get_by_role("button", name="Make the files").click()
    problem = tabulated(service, json.dumps(wrong), "application/json")
    alert = page.get_by_role("region", name="Take it away").get_by_role("alert")
    expect(alert.locator("dd")).to_have_text([problem[part] for part in ("field", "expected", "got")])


def test_a_table_that_takes_long_is_made_by_a_job(page: "Page") -> None:
    """Half a million texels are a job, 202; the panel follows it until the files are there."""
    from playwright.sync_api import expect

    scales = {"start": 0.5, "stop": 1.5, "count": 1000}
    opened(page, FILM | {"table": {"cos_theta": 512, "thickness_scale": scales}})
    with page.expect_response("**/v1/jobs/*/events") as followed:
        page.get_by_role("button", name="Make the files").click()
    assert followed.value.ok
    file = page.get_by_role("button", name="Download film-for-a-test.exr")
    expect(file).to_be_visible(timeout=LONG_MS)


def test_a_format_that_wants_another_table_gets_it(page: "Page") -> None:
    """A bsdf is what pbrt reads: one press makes the film one, and its file is then there."""
    from playwright.sync_api import expect

    opened(page, FILM)
    page.get_by_role("button", name="Make the files").click()
    page.get_by_role("radio", name="pbrt-v4").check()
    page.get_by_role("button", name="Tabulate a rough surface").click()
    expect(page.get_by_role("button", name="Download film-for-a-test.bsdf")).to_be_visible(timeout=LONG_MS)
    expect(page.get_by_role("region", name="snippet for pbrt-v4")).to_have_text(
        'Material "measured" "string filename" "film-for-a-test.bsdf"'
    )


def opened(page: "Page", spec: dict[str, Any], /, **view: str | float) -> None:
    """Open a film by a link, and wait until it is on the page."""
    page.evaluate("fragment => { location.hash = fragment }", film_fragment(spec, **view))
    recipe(page, "Spec as TOML", "TOML", spec["name"])


def tabulated(service: Served, spec: str, media_type: str) -> Any:  # noqa: ANN401 - any JSON
    """Return what the service answers to a spec."""
    headers = {"Content-Type": media_type}
    return httpx.post(f"{service.url}/v1/tables", content=spec.encode(), headers=headers, timeout=60).json()


def opened_preset(page: "Page", service: Served, name: str) -> Any:  # noqa: ANN401 - any JSON
    """Open a preset by its link, and return what the service knows of it."""
    page.evaluate("fragment => { location.hash = fragment }", f"preset={name}")
    return httpx.get(f"{service.url}/v1/presets/{name}").raise_for_status().json()


def recipe(page: "Page", summary: str, name: str, words: str) -> str:
    """Unfold a text of the panel, and return it once it holds some words."""
    from playwright.sync_api import expect

    text: Locator = page.get_by_role("region", name=name, exact=True)
    folded = page.locator("details").filter(has=page.get_by_text(summary, exact=True))
    if folded.get_attribute("open") is None:
        folded.locator("summary").click()
    expect(text).to_contain_text(words, timeout=LONG_MS)
    return text.locator("code").text_content() or ""
