"""Make the pictures of the clients' pages, each by the renderer or the browser that its client is tested in.

`make pictures`, or run this file with PYTHONPATH=tests; names of pictures, such as ``unity``, make those
alone. A picture whose programs are missing stays as it is, and the reason is said.
"""

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import OpenImageIO
import pytest
from numpy.typing import NDArray
from PIL import Image

from blender_process import blender_jobs, packed_add_on, run_blender
from hlsl_host import ENGINES, Sphere, draw_sphere, hlsl_page
from lut_contract import LookupTexture
from make_images import BACKGROUND, encoded, run
from materialx_host import Picture, draw
from mitsuba_surface import variant_fault
from web_page import chromium, open_page

ROOT = Path(__file__).parents[1]
CLIENTS, IMAGES = ROOT / "clients", ROOT / "docs" / "images" / "clients"

FloatArray = NDArray[np.float64]

PIXELS, OVERSAMPLING, MARGIN = 152, 2, 4
"""Of one sphere's side, how many more each way are drawn for it, and how many are left around it."""


@dataclass(frozen=True)
class Film:
    """A preset, its thickness at the top and bottom of a sphere, the exposure in stops, and the roughness."""

    preset: str
    thickness_scale: tuple[float, float]
    stops: float
    roughness: float = 0.0


HLSL_FILMS = {
    "unreal": (
        Film("soap-bubble", (0.05, 1.1), 1.6),
        Film("anodised-titanium", (0.1, 2.0), 0.4),
        Film("beetle", (0.96, 1.14), 1.2),
    ),
    "unity": (
        Film("oil-on-water", (0.2, 1.6), 2.4),
        Film("tempered-steel", (0.1, 1.9), 1.0),
        Film("morpho", (0.8, 1.3), 0.5),
    ),
}
OSL_FILMS = (
    Film("silica-on-silicon", (0.3, 2.0), 0.3),
    Film("anodised-titanium", (0.2, 1.8), 0.3, roughness=0.35),
    Film("beetle", (0.96, 1.12), 1.0, roughness=0.45),
)
MATERIALX_FILMS = (
    Film("silica-on-silicon", (1.0, 1.0), 0.0),
    Film("anodised-titanium", (0.4, 0.4), 0.0),
    Film("soap-bubble", (0.5, 0.5), 1.4),
)
THREE_PRESETS = ("anodised-titanium", "morpho", "nacre", "oil-on-water", "beetle", "soap-bubble")
BLENDER_PRESETS = ("soap-bubble", "anodised-titanium", "beetle")
COATED_GLASS = """
[stack]
incident = "air"
substrate = { n = 1.5 }
layers = [{ material = { n = 2.3 }, thickness_nm = 420 }]
[table]
thickness_scale = { start = 0.3, stop = 0.8, count = 51 }
"""
"""A bright film on glass; that of a coated lens is too faint to see here."""


def main(names: list[str]) -> None:
    """Write the pictures of these names, or every one."""
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name in names or PICTURES:
        with TemporaryDirectory() as folder:
            try:
                picture = PICTURES[name](Path(folder))
            except pytest.skip.Exception as missing:
                print(f"{name}.png stays: {missing}", file=sys.stderr)
            else:
                picture.save(IMAGES / f"{name}.png", optimize=True)


def texture(folder: Path, preset: str) -> Path:
    """Return the file of a preset's lookup texture; that of T lies beside it."""
    run("tabulate", preset, "--format", "exr", "-o", str(folder))
    return folder / f"{preset}.exr"


# ---- spheres of our own, in a row --------------------------------------------------------------------------


def unreal(folder: Path) -> Image.Image:
    """Draw by the HLSL of Unreal Engine."""
    return hlsl_spheres("unreal", folder)


def unity(folder: Path) -> Image.Image:
    """Draw by the HLSL of Unity."""
    return hlsl_spheres("unity", folder)


def hlsl_spheres(engine: str, folder: Path) -> Image.Image:
    """Draw mirrors under a bright sky and a lamp."""
    spheres = []
    with hlsl_page() as page:
        for film in HLSL_FILMS[engine]:
            table = LookupTexture.read(texture(folder, film.preset))
            sphere = Sphere(PIXELS * OVERSAMPLING, film.thickness_scale, light=(0.3, 0.5, 1.6))
            spheres.append(draw_sphere(page, ENGINES[engine], table, sphere, folder, texels="RGBA32F"))
    return row_of(spheres, HLSL_FILMS[engine])


def osl(folder: Path) -> Image.Image:
    """Render by both shaders of clients/osl in Cycles."""
    job = {
        "job": "render_draining_sphere",
        "closure": str(CLIENTS / "osl" / "nacreous_film_surface.osl"),
        "surroundings": "studio",
        "pixels": PIXELS * OVERSAMPLING,
        "samples": 64,
    }
    pictures = [folder / f"{film.preset}.picture.exr" for film in OSL_FILMS]
    jobs = [
        job
        | {"path": str(texture(folder, film.preset)), "thickness_scale": film.thickness_scale}
        | {"roughness": film.roughness, "picture": str(picture)}
        for film, picture in zip(OSL_FILMS, pictures, strict=True)
    ]
    blender_jobs([{"job": "install", "archive": str(packed_add_on(folder))}, *jobs], folder)
    return row_of([pixels_of(picture) for picture in pictures], OSL_FILMS)


def materialx(folder: Path) -> Image.Image:
    """Draw by MaterialX's own GLSL, in white surroundings."""
    for film in MATERIALX_FILMS:
        run("tabulate", film.preset, "--format", "materialx", "-o", str(folder))
    asked = [
        Picture(
            str(folder / f"{film.preset}.mtlx"),
            # the whole material of a film that absorbs nothing would be white all over
            "film/reflection" if (folder / f"{film.preset}.transmission.exr").exists() else "film_material",
            {"film/thickness_scale": film.thickness_scale[0]},
            size=PIXELS * OVERSAMPLING,
        )
        for film in MATERIALX_FILMS
    ]
    return row_of([on_disc(picture) for picture in draw(asked, folder)], MATERIALX_FILMS)


def on_disc(picture: FloatArray) -> FloatArray:
    """Add the alpha of a sphere that fills the picture."""
    centre = (np.arange(len(picture)) + 0.5) / len(picture) * 2 - 1
    inside = np.hypot(centre[:, None], centre) < 1
    return np.where(inside[..., None], np.dstack([picture, np.ones(inside.shape)]), 0)


def row_of(pictures: list[FloatArray], films: tuple[Film, ...]) -> Image.Image:
    """Expose linear pictures, (H, W, 4), premultiplied, and join them before a dark background."""
    rows = []
    for picture, film in zip(pictures, films, strict=True):
        small = picture.reshape(PIXELS, OVERSAMPLING, PIXELS, OVERSAMPLING, 4).mean(axis=(1, 3))
        small = np.pad(small, ((MARGIN, MARGIN), (MARGIN, MARGIN), (0, 0)))
        rows.append(2.0**film.stops * np.maximum(small[..., :3], 0) + (1 - small[..., 3:]) * BACKGROUND)
    return Image.fromarray((255 * encoded(np.concatenate(rows, axis=1))).round().astype(np.uint8))


def pixels_of(path: Path) -> FloatArray:
    """Return the colours and the alpha of a picture, (H, W, 4), rows from the top."""
    return np.asarray(OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT), np.float64)[..., :4]


# ---- the clients' own examples -----------------------------------------------------------------------------


def blender(folder: Path) -> Image.Image:
    """Render clients/blender/example.py."""
    for preset in BLENDER_PRESETS:
        texture(folder, preset)
    path = folder / "films.png"
    look = ("--width", str(OVERSAMPLING * 400), "--samples", "24")
    run_blender(CLIENTS / "blender" / "example.py", folder, "--tables", folder, "--output", path, *look)
    return smaller(path)


def mitsuba(folder: Path) -> Image.Image:
    """Render clients/mitsuba/scene.py."""
    if fault := variant_fault("llvm_ad_rgb"):
        pytest.skip(fault)
    (folder / "coated-glass.toml").write_text(COATED_GLASS)
    films = [texture(folder, preset) for preset in ("soap-bubble", "anodised-titanium")]
    run("tabulate", str(folder / "coated-glass.toml"), "-o", str(folder))
    tables = [*films, folder / "coated-glass.exr"]
    path = folder / "spheres.png"
    look = ["--alpha", "0", "0.15", "0", "--thickness-scale", "0.3", "0.8"]
    size = ["--height", str(OVERSAMPLING * 160), "--samples", "192"]
    finished(sys.executable, CLIENTS / "mitsuba" / "scene.py", *tables, *look, *size, "-o", path)
    return smaller(path)


def threejs(folder: Path) -> Image.Image:
    """Take a picture of the page of clients/threejs/example."""
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("npm is missing: install the package npm, or Node.js 20")
    package, path = folder / "package", folder / "view.png"
    shutil.copytree(
        CLIENTS / "threejs", package, ignore=shutil.ignore_patterns("node_modules", "dist", "public")
    )
    for preset in THREE_PRESETS:
        texture(package / "example" / "public" / "tables", preset)
    for command in (("ci", "--no-audit", "--no-fund"), ("run", "build:example")):
        finished(npm, "--prefix", package, *command)
    site = package / "example" / "dist"
    with chromium() as browser, open_page(browser, site, "index.html", OVERSAMPLING * 560) as opened:
        opened.page.wait_for_selector("body[data-state=drawn]")
        opened.page.add_style_tag(content="form { display: none }")
        opened.page.screenshot(path=path)
    return smaller(path)


def smaller(path: Path) -> Image.Image:
    """Return a picture that was drawn `OVERSAMPLING` times as large as it is wanted."""
    return Image.open(path).convert("RGB").reduce(OVERSAMPLING)


def finished(*command: str | Path) -> None:
    """Run a program to its end."""
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)  # noqa: S603 - programs of this project


PICTURES: dict[str, Callable[[Path], Image.Image]] = {
    "materialx": materialx,
    "mitsuba": mitsuba,
    "osl": osl,
    "threejs": threejs,
    "unity": unity,
    "unreal": unreal,
    "blender": blender,  # the last: it takes minutes
}


if __name__ == "__main__":
    main(sys.argv[1:])
