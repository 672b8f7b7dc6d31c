"""The gallery shows every preset, with its citation and its pictures."""

from pathlib import Path

import pytest

from nacreous.tables.presets import preset, preset_names

DOCS = Path(__file__).parents[1] / "docs"
PAGE = (DOCS / "gallery.md").read_text(encoding="utf-8")
LARGEST_BYTES = 250_000


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_is_in_the_gallery(name: str) -> None:
    """What a preset is called, what it is, and where its numbers come from are as the preset says."""
    entry = next((part for part in PAGE.split("\n### ") if f"`{name}`: " in part), "")
    spec = preset(name)
    assert entry.startswith(f"{spec.name}\n")
    assert f"`{name}`: {spec.description}" in entry
    assert f"*Source:* {spec.source}" in entry
    assert f"nacreous preview {name} " in entry


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_has_its_pictures(name: str) -> None:
    """A sphere and a preview, whole JPEG files that a page can carry."""
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")
    for ending, least_width in (("", 200), ("-preview", 800)):
        file = DOCS / "images" / "gallery" / f"{name.replace('/', '-')}{ending}.jpg"
        assert f"]({file.relative_to(DOCS).as_posix()})" in PAGE
        assert file.stat().st_size <= LARGEST_BYTES
        with image.open(file) as picture:
            picture.load()
            assert picture.width >= least_width


def test_the_page_is_what_the_program_writes(monkeypatch: pytest.MonkeyPatch) -> None:
    """docs/make_gallery.py would write the page as it is: no preset has changed since."""
    pytest.importorskip("OpenEXR", reason="OpenEXR is not installed")
    monkeypatch.syspath_prepend(DOCS)
    import make_gallery

    assert make_gallery.renewed(PAGE) == PAGE
