"""From linear renderings to pictures: exposure, sRGB, labels, panels side by side."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib.font_manager import FontProperties, findfont
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

FloatArray = NDArray[np.float64]

PAPER = (255, 255, 255)
INK = (40, 44, 52)
LARGEST_BYTES = 250_000
BEST_QUALITY, LEAST_QUALITY = 92, 60


def exposed(linear: FloatArray, stops: float = 0.0) -> Image.Image:
    """Return a picture of linear Rec.709 (H, W, 3) that is `stops` brighter; what is above white is white."""
    return Image.fromarray((255 * encoded(2.0**stops * linear)).round().astype(np.uint8))


def fitting_stops(linear: FloatArray) -> float:
    """Return the exposure at which no colour is clipped but those of one pixel in a thousand.

    A channel that is cut off at white turns a colour's hue.
    """
    return -float(np.log2(np.quantile(linear.max(axis=-1), 0.999)))


def encoded(linear: FloatArray) -> FloatArray:
    """Return sRGB of linear Rec.709 (IEC 61966-2-1), clipped to 0 to 1."""
    share = np.clip(linear, 0.0, 1.0)
    return np.where(share <= 0.0031308, 12.92 * share, 1.055 * share ** (1 / 2.4) - 0.055)


def labelled(panel: Image.Image, text: str) -> Image.Image:
    """Return a panel with a line of text under it."""
    size = max(9, round(panel.height / 32))
    font = ImageFont.truetype(findfont(FontProperties(family="DejaVu Sans")), size)
    picture = Image.new("RGB", (panel.width, panel.height + 2 * size), PAPER)
    picture.paste(panel)
    place = (panel.width / 2, panel.height + size)
    ImageDraw.Draw(picture).text(place, text, fill=INK, font=font, anchor="mm")
    return picture


def side_by_side(panels: Sequence[Image.Image], gap: int = 8) -> Image.Image:
    """Return panels in a row."""
    width = sum(panel.width for panel in panels) + gap * (len(panels) - 1)
    picture = Image.new("RGB", (width, max(panel.height for panel in panels)), PAPER)
    left = 0
    for panel in panels:
        picture.paste(panel, (left, 0))
        left += panel.width + gap
    return picture


def stacked(rows: Sequence[Image.Image], gap: int = 8) -> Image.Image:
    """Return pictures under each other, to the left."""
    height = sum(row.height for row in rows) + gap * (len(rows) - 1)
    picture = Image.new("RGB", (max(row.width for row in rows), height), PAPER)
    top = 0
    for row in rows:
        picture.paste(row, (0, top))
        top += row.height + gap
    return picture


def write_jpeg(picture: Image.Image, path: Path) -> None:
    """Write a JPEG of at most `LARGEST_BYTES`, as good as that allows."""
    for quality in range(BEST_QUALITY, LEAST_QUALITY - 1, -4):
        file = BytesIO()
        picture.save(file, "JPEG", quality=quality, subsampling=0, optimize=True)
        if file.tell() <= LARGEST_BYTES:
            break
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(file.getvalue())
