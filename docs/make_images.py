"""Make the pictures of README.md: `make pictures`, or run this file with the package installed.

The spheres are perfect mirrors under an overcast sky and two soft lamps. Each of their pixels is one reading
of the lookup texture that `nacreous tabulate` writes, at the cosine of its own angle; the thickness grows
from the top of a sphere to its bottom, as in a film that drains.
"""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import OpenEXR
from numpy.typing import NDArray
from PIL import Image

IMAGES = Path(__file__).parent / "images"

FloatArray = NDArray[np.float64]

COLUMNS = 5
CELL, RADIUS, OVERSAMPLING = 300, 136, 2
BACKGROUND = np.array([0.0085, 0.0095, 0.0125])


@dataclass(frozen=True)
class Sphere:
    """A preset, the part of its thickness axis that is shown, 0 to 1, and the exposure in stops."""

    preset: str
    thinnest: float
    thickest: float
    stops: float


SPHERES = (
    Sphere("soap-bubble", 0.02, 0.55, 1.3),
    Sphere("oil-on-water", 0.1, 0.9, 2.6),
    Sphere("anodised-titanium", 0.0, 1.0, 0.5),
    Sphere("tempered-steel", 0.0, 0.7, 0.9),
    Sphere("silica-on-silicon", 0.05, 1.0, 0.5),
    Sphere("beetle", 0.1, 0.9, 1.2),
    Sphere("morpho", 0.0, 1.0, 0.8),
    Sphere("nacre", 0.0, 1.0, 1.2),
    Sphere("dichroic", 0.0, 1.0, 0.0),
    Sphere("coated-lens", 0.2, 0.9, 3.2),
)


def main() -> None:
    """Write every picture."""
    IMAGES.mkdir(exist_ok=True)
    with TemporaryDirectory() as folder:
        write_spheres(Path(folder), IMAGES / "spheres.jpg")
        write_preview(Path(folder), "anodised-titanium", IMAGES / "preview.jpg")


def write_spheres(folder: Path, path: Path) -> None:
    """Draw all spheres in rows of `COLUMNS`."""
    rows = -(-len(SPHERES) // COLUMNS)
    canvas = np.empty((rows * CELL, COLUMNS * CELL, 3))
    for at, sphere in enumerate(SPHERES):
        top, left = CELL * (at // COLUMNS), CELL * (at % COLUMNS)
        canvas[top : top + CELL, left : left + CELL] = drawn(sphere, texture(folder, sphere.preset))
    pixels = (255 * encoded(canvas)).round().astype(np.uint8)
    write_jpeg(Image.fromarray(pixels), path)


def texture(folder: Path, preset: str, *options: str) -> FloatArray:
    """Return the lookup texture of a preset, (H, W, 3): thickness downwards, cos_theta to the right."""
    run("tabulate", preset, *options, "--format", "exr", "-o", str(folder))
    with OpenEXR.File(str(folder / f"{stem_of(preset)}.exr")) as file:
        return np.asarray(file.channels()["RGB"].pixels, np.float64)


def stem_of(preset: str) -> str:
    """Return what the files of a preset are called."""
    return preset.replace("/", "-")


def run(*arguments: str) -> None:
    """Run the program `nacreous`."""
    program = Path(sys.executable).with_name("nacreous")
    subprocess.run([program, *arguments], check=True, stdout=subprocess.DEVNULL)  # noqa: S603 - ours


def drawn(sphere: Sphere, lookup: FloatArray) -> FloatArray:
    """Return one cell of the picture, linear, (CELL, CELL, 3)."""
    x, y = places()
    cos_theta = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    share = sphere.thinnest + (sphere.thickest - sphere.thinnest) * (y + 1) / 2
    film = read(lookup, cos_theta, np.clip(share, 0, 1))
    # The view is along z: r = 2 (n.z) n - z is where the mirror looks.
    sky = light(2 * cos_theta * x, -2 * cos_theta * y, 2 * cos_theta**2 - 1)
    shaded = 2.0**sphere.stops * np.maximum(film, 0) * sky[..., None]
    return cut_out(shaded)


def places() -> tuple[FloatArray, FloatArray]:
    """Return where the samples of a cell are, in radii from its middle, (x, y), y downwards."""
    size = CELL * OVERSAMPLING
    y, x = (np.mgrid[:size, :size] + 0.5 - size / 2) / (RADIUS * OVERSAMPLING)
    return x, y


def cut_out(shaded: FloatArray) -> FloatArray:
    """Return one cell of the picture from its samples: what lies outside of the sphere is background."""
    x, y = places()
    picture = np.where((x**2 + y**2 < 1)[..., None], shaded, BACKGROUND)
    return picture.reshape(CELL, OVERSAMPLING, CELL, OVERSAMPLING, 3).mean(axis=(1, 3))


def read(lookup: FloatArray, cos_theta: FloatArray, share: FloatArray) -> FloatArray:
    """Interpolate a texture linearly: cos_theta and the share of the thickness axis, both 0 to 1."""
    height, width = lookup.shape[:2]
    v, u = share * (height - 1), cos_theta * (width - 1)
    row, column = np.minimum(v.astype(int), height - 2), np.minimum(u.astype(int), width - 2)
    down, right = (v - row)[..., None], (u - column)[..., None]
    upper = (1 - right) * lookup[row, column] + right * lookup[row, column + 1]
    lower = (1 - right) * lookup[row + 1, column] + right * lookup[row + 1, column + 1]
    return (1 - down) * upper + down * lower


def light(x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    """Radiance from a direction, y up: a sky that is brighter above, a dark ground, two soft lamps."""
    sky = 0.42 + 0.38 * smooth(-0.35, 0.9, y) - 0.30 * smooth(0.15, 0.95, -y)
    key = 1.5 * lamp(x, y, z, (-0.55, 0.62, 0.56), 0.90)
    fill = 0.55 * lamp(x, y, z, (0.80, 0.15, 0.58), 0.93)
    return sky + key + fill


def lamp(x: FloatArray, y: FloatArray, z: FloatArray, towards: tuple[float, ...], edge: float) -> FloatArray:
    """Return a round lamp with a soft rim, 0 to 1."""
    unit = np.array(towards) / np.linalg.norm(towards)
    return smooth(edge, edge + 0.1, x * unit[0] + y * unit[1] + z * unit[2])


def smooth(first: float, last: float, value: FloatArray) -> FloatArray:
    """Rise smoothly from 0 at `first` to 1 at `last`."""
    t = np.clip((value - first) / (last - first), 0, 1)
    return t * t * (3 - 2 * t)


def encoded(linear: FloatArray) -> FloatArray:
    """Encode linear light as sRGB (IEC 61966-2-1); what is too bright keeps its hue."""
    shown = linear / np.maximum(linear.max(axis=-1, keepdims=True), 1)
    return np.where(shown <= 0.0031308, 12.92 * shown, 1.055 * shown ** (1 / 2.4) - 0.055)


def write_preview(folder: Path, preset: str, path: Path, width: int = 1200) -> None:
    """Write what `nacreous preview` draws, in a size for a page."""
    drawing = folder / "preview.png"
    run("preview", preset, "-o", str(drawing))
    with Image.open(drawing) as picture:
        size = (width, width * picture.height // picture.width)
        small = picture.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    write_jpeg(small, path)


def write_jpeg(picture: Image.Image, path: Path) -> None:
    """Write a JPEG: colours this smooth take ten times the bytes as PNG, and a palette would band them."""
    picture.save(path, quality=90, subsampling=0, optimize=True)


if __name__ == "__main__":
    main()
