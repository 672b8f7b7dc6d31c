"""The tutorials, followed literally in an empty folder, print what they show."""

import shutil
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest

import nacreous
from figures.hue import lab
from mitsuba_surface import variant_fault
from nacreous.tables.presets import preset
from served import serving
from shown_output import fault
from tutorial_pages import PAGES, SERVICE, blocks_of, follow

NEEDED = {"curl": "the package curl is not installed", "tmm": "tmm is not installed"}
VARIANT = "llvm_ad_spectral"


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Run the service, and return where it is."""
    with serving(tmp_path_factory.mktemp("service")) as served:
        served.await_ready()
        yield served.url


def missing(page: Path) -> str:
    """Say what a page needs and this machine lacks; empty where nothing."""
    text = "\n".join(block.text for block in blocks_of(page))
    if "curl" in text and not shutil.which("curl"):
        return NEEDED["curl"]
    if "import tmm" in text and not find_spec("tmm"):
        return NEEDED["tmm"]
    return variant_fault(VARIANT) if VARIANT in text else ""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_tutorial_works_as_it_is_written(
    page: Path, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """Every block runs in order in one folder, and prints what the page shows below it."""
    if lack := missing(page):
        pytest.skip(lack)
    for block in blocks_of(page):
        url = request.getfixturevalue("service") if SERVICE in block.text else SERVICE
        printed = follow(block, tmp_path, url)
        if block.shown is not None:
            assert not (wrong := fault(block.shown, printed)), f"{block.text}\n{wrong}"


def test_there_is_a_tutorial_for_each_kind_of_user() -> None:
    """Artists, researchers, pipelines and optics, each with output that is shown."""
    assert {page.stem for page in PAGES} >= {"artist", "researcher", "pipeline", "optics"}
    for page in PAGES:
        assert any(block.shown for block in blocks_of(page)), page


def test_the_artists_blue_is_blue() -> None:
    """50 nm has a blue hue in the sense of Munsell, head on and at 60 degrees, and 45 nm has none."""
    overrides = ["table.thickness_scale=[0.45, 0.5]", "table.cos_theta=[0.5, 1.0]"]
    colours = nacreous.tabulate(preset("anodised-titanium", overrides)).R_rgb
    hues = [lab(film.sel(cos_theta=mu).values) for film in colours for mu in (1, 0.5)]
    assert [colour.word for colour in hues] == ["violet", "purple", "blue", "blue"]
    text = next(page for page in PAGES if page.stem == "artist").read_text(encoding="utf-8")
    assert [f"{colour.hue_deg:.0f}°" for colour in hues if f"{colour.hue_deg:.0f}°" not in text] == []


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("a 1.50 b", "a  1.501 b", True),
        ("a 1.50 b", "a 1.52 b", False),
        ("12 files", "12 files", True),
        ("12 files", "13 files", False),
        ("first\n…\nlast", "first\nsecond\nthird\nlast", True),
        ("first\nlast", "first\nsecond\nlast", False),
        ("first", "first\nsecond", False),
        ("id 3775…, good", "id 3775b5e9, good", True),
        ("error 4.4e-04", "error 4.45e-04", True),
        ("error 4.4e-04", "error 6.4e-04", False),
        ("-0.5", "0.5", False),
        ("2.0.1", "2.0.2", False),
    ],
)
def test_output_is_compared_loosely_and_not_too_loosely(shown: str, printed: str, same: bool) -> None:  # noqa: FBT001 - a column of the table above
    """Dots stand for what differs from run to run; a number that is shown has to be right."""
    assert (not fault(shown, printed)) is same
