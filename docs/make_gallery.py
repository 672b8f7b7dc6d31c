"""Make the gallery of presets: `make pictures`, or run this file with PYTHONPATH=docs.

Writes a sphere and a preview for each preset into docs/images/gallery, and docs/gallery.md between its
markers. Names of presets as arguments make the pictures of those alone.

The spheres of films are those of make_images.py: mirrors under a sky and two lamps, one reading of the lookup
texture a pixel. Those of rough surfaces are lit by a white sky of the same brightness all around, in which a
surface sends as much light to the eye as it would reflect of light that comes from there: one reading of the
albedo a pixel, the film growing thicker from top to bottom as well.
"""

import sys
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

from make_images import (
    SPHERES,
    FloatArray,
    Sphere,
    cut_out,
    drawn,
    encoded,
    places,
    read,
    stem_of,
    texture,
    write_jpeg,
    write_preview,
)
from nacreous.tables.axes import thickness_scale_values
from nacreous.tables.presets import preset, preset_names
from nacreous.tables.spec import roughness_values

PAGE = Path(__file__).parent / "gallery.md"
FOLDER = Path(__file__).parent / "images" / "gallery"
BEGIN, END = "<!-- gallery: begin -->", "<!-- gallery: end -->"
PREVIEW_WIDTH = 1000
PAPER = "paper/"

POSES = {sphere.preset: sphere for sphere in SPHERES} | {
    "morpho-ridges": Sphere("morpho-ridges", 0.2, 1.0, 1.6),
    "paper/figure-3": Sphere("paper/figure-3", 0.0, 1.0, 1.8),
    "paper/figure-4": Sphere("paper/figure-4", 0.0, 1.0, 1.8),
    "paper/figure-8": Sphere("paper/figure-8", 0.0, 1.0, 0.8),
}
"""How the spheres of films are shown: thickness at the top and at the bottom, and exposure."""
BRIGHTEST, ROUGHNESS, ROWS = 0.7, 0.1, 64
"""Of rough spheres: the brightest channel head on, the roughness where a preset has several, thicknesses."""


def main(chosen: Iterable[str] = ()) -> None:
    """Draw the presets that are named, or all, and write the page."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as folder:
        for name in chosen or preset_names():
            draw(name, Path(folder))
    PAGE.write_text(renewed(PAGE.read_text(encoding="utf-8")), encoding="utf-8")


def draw(name: str, folder: Path) -> None:
    """Write the two pictures of a preset."""
    stem = stem_of(name)
    pixels = (255 * encoded(portrait(name, folder))).round().astype(np.uint8)
    write_jpeg(Image.fromarray(pixels), FOLDER / f"{stem}.jpg")
    write_preview(folder, name, FOLDER / f"{stem}-preview.jpg", PREVIEW_WIDTH)


def portrait(name: str, folder: Path) -> FloatArray:
    """Return the sphere of a preset, linear, (CELL, CELL, 3)."""
    if preset(name).surface is not None:
        return evenly_lit(rough_texture(folder, name))
    return drawn(POSES[name], texture(folder, name))


def rough_texture(folder: Path, name: str) -> FloatArray:
    """Return the albedo at the surface's own roughness, from the preset's thinnest film to its thickest."""
    spec = preset(name)
    scales = thickness_scale_values(spec.table.thickness_scale)
    axis = f"{{start = {scales[0]}, stop = {scales[-1]}, count = {ROWS}}}" if scales.size > 1 else "1"
    roughness = roughness_values(spec)[0] if spec.table.roughness is None else ROUGHNESS
    options = (f"table.thickness_scale={axis}", f"table.roughness=[{roughness}]")
    atlas = texture(folder, name, *(word for option in options for word in ("--set", option)))
    return atlas.reshape(-1, 2, *atlas.shape[1:])[:, 0] if scales.size > 1 else atlas


def evenly_lit(albedo: FloatArray) -> FloatArray:
    """Return a rough sphere in a white furnace: its albedo towards the eye, thicker towards the bottom."""
    x, y = places()
    cos_theta = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    seen = read(albedo, cos_theta, np.clip((y + 1) / 2, 0, 1))
    return cut_out(BRIGHTEST / albedo[:, -1].max() * np.maximum(seen, 0))


def renewed(page: str) -> str:
    """Return the page with all presets between its markers."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    films = [name for name in preset_names() if not name.startswith(PAPER)]
    figures = [name for name in preset_names() if name.startswith(PAPER)]
    parts = ("## Films", *map(entry, films), "## Figures of the paper", *map(entry, figures))
    return "\n\n".join((before + BEGIN, *parts, END + after))


def entry(name: str) -> str:
    """Return what the page says of a preset."""
    spec, stem = preset(name), stem_of(name)
    shown = "colours, spectra and chromaticities" + (", lobes and albedo" if spec.surface else "")
    return "\n\n".join(
        (
            f"### {spec.name}",
            f"![{spec.name}, a sphere](images/gallery/{stem}.jpg)",
            f"`{name}`: {spec.description}",
            f"![{spec.name}: {shown}](images/gallery/{stem}-preview.jpg)",
            f"`nacreous tabulate {name} --format exr` · `nacreous preview {name} -o {stem}.png`",
            f"*Source:* {spec.source}",
        )
    )


if __name__ == "__main__":
    main(sys.argv[1:])
