"""``nacreous preview`` draws a picture of what the tables say."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from nacreous.cli.preview_lobe import draw_lobes
from nacreous.cli.preview_surface import surface_line
from nacreous.cli.preview_tables import preview_tables
from nacreous.tables.presets import load

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.mark.parametrize("name", ["paper/figure-3", "anodised-titanium", "beetle"])
def test_draws_a_picture(run: Run, tmp_path: Path, name: str) -> None:
    """A film without a thickness axis, an opaque one, and one with a periodic group."""
    done = run("preview", name, "-o", "pictures/film.png")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "pictures/film.png\n"
    assert [path.name for path in (tmp_path / "pictures").iterdir()] == ["film.png"]
    with Image.open(tmp_path / "pictures" / "film.png") as picture:
        pixels = np.asarray(picture.convert("RGB"))
    assert pixels.shape[1] == 1920
    assert (pixels[0] == 255).all()  # dark on white
    colours = pixels.astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    assert len(np.unique(colours)) > 5000  # a swatch of many colours


def test_shows_the_film_of_figure_4_green(run: Run, tmp_path: Path) -> None:
    """450 nm of n = 2.0 on glass are green at normal incidence (Wu & Zheng 2015, figure 4)."""
    run("preview", "paper/figure-4", "-o", "film.png")
    with Image.open(tmp_path / "film.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    height, width, _ = pixels.shape
    # The swatch's left edge at half its height is scale 1 at 0 degrees; the dashed line is a few pixels wide.
    row, column = int(height * (1 - (0.125 + 0.83) / 2)) - 6, int(width * 0.07) + 6
    red, green, blue = pixels[row, column]
    assert green > red + 40
    assert green > blue + 40


# ---- rough surfaces ----------------------------------------------------------------------------------------

SMOOTH_HEIGHT = 1216
"""Pixels of a picture without a surface."""


def pixels_of(path: Path) -> np.ndarray:
    """Return the picture as signed integers, (H, W, 3)."""
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB")).astype(int)


@pytest.mark.parametrize(
    ("name", "setting"),
    [
        ("paper/figure-7", "table.roughness=[0.1]"),  # anisotropic and opaque
        ("paper/figure-9", "surface.exponent_x=1000"),
        ("paper/figure-3", 'surface.distribution="ggx"'),  # whose roughness nobody says
        ("paper/figure-3", "surface.alpha_x=0.15"),
    ],
)
def test_a_rough_surface_adds_a_row_to_the_picture(run: Run, tmp_path: Path, name: str, setting: str) -> None:
    """The film's picture is where it was, at the top; lobes and a strip are below it."""
    done = run("preview", name, "--set", setting, "-o", "film.png")
    assert (done.returncode, done.stderr) == (0, "")
    pixels = pixels_of(tmp_path / "film.png")
    assert pixels.shape[1] == 1920
    row = pixels[SMOOTH_HEIGHT:]
    assert row.shape[0] > 400
    lobes, strip = row[:, : int(0.7 * 1920)], row[:, int(0.77 * 1920) : int(0.97 * 1920)]
    assert (np.ptp(lobes, axis=-1) > 20).any()  # a lobe in colour
    assert len(np.unique(strip.reshape(-1, 3), axis=0)) > 500


def test_lobes_point_where_mirror_and_refraction_send_the_light() -> None:
    """At 0, 30 and 60 degrees: as far to the right of the normal, and, by Snell's law, asin(sin / 1.5)."""
    from matplotlib.figure import Figure

    spec = load("paper/figure-3", ["surface.alpha_x=0.001"])  # as narrow as can be
    rough = preview_tables(spec).rough
    assert rough is not None
    panels = list(Figure().subplots(1, 3))
    draw_lobes(panels, rough)
    for axes, angle in zip(panels, np.deg2rad([0.0, 30.0, 60.0]), strict=True):
        reflected, transmitted = (line.get_xydata() for line in axes.lines if len(line.get_xydata()) > 200)
        for outline, towards in ((reflected, angle), (transmitted, np.pi - np.arcsin(np.sin(angle) / 1.5))):
            x, y = outline[np.argmax(np.hypot(*outline.T))]
            assert np.arctan2(x, y) == pytest.approx(towards, abs=np.deg2rad(0.1))


def test_the_line_below_says_what_the_surface_is() -> None:
    """Distribution, roughness along x and y with their exponents (2 / alpha^2 - 2), and masking."""
    settings = ["surface.alpha_x=0.1", "surface.alpha_y=0.2"]
    rough = preview_tables(load("paper/figure-3", settings)).rough
    assert rough is not None
    assert surface_line(rough) == (
        "ashikhmin-shirley, alpha 0.1 x 0.2 (exponent 198 x 48), v-cavity masking, in the plane of x"
    )


def test_a_film_without_a_surface_has_the_picture_it_had(run: Run, tmp_path: Path) -> None:
    """Nothing is said of roughness where the spec says nothing."""
    run("preview", "paper/figure-3", "-o", "film.png")
    assert pixels_of(tmp_path / "film.png").shape == (SMOOTH_HEIGHT, 1920, 3)


@pytest.mark.parametrize("output", ["film.toml/film.png", "n" * 300 + ".png"])
def test_a_picture_that_cannot_be_written_is_one_message(run: Run, tmp_path: Path, output: str) -> None:
    """And leaves nothing."""
    (tmp_path / "film.toml").touch()
    done = run("preview", "coated-lens", "-o", output)
    assert done.returncode in (1, 2)
    assert done.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["film.toml"]


def test_a_name_in_any_script_is_drawn_in_silence(run: Run, tmp_path: Path) -> None:
    """Letters that the font lacks, a home that is not there: no concern of who wants a picture."""
    environment = {**os.environ, "HOME": "/nonexistent", "MPLCONFIGDIR": "/nonexistent/matplotlib"}
    done = run("preview", "coated-lens", "--set", 'name="薄膜"', "-o", "film.png", env=environment)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "film.png").exists()


@pytest.mark.parametrize("name", ["film.jpg", "film", "film.png.exr"])
def test_a_picture_that_is_no_png_is_refused(run: Run, tmp_path: Path, name: str) -> None:
    """A PNG under another name would be taken for what it is not."""
    done = run("preview", "coated-lens", "-o", name)
    assert done.returncode == 2
    assert "--output: expected a file name that ends in .png" in done.stderr
    assert list(tmp_path.iterdir()) == []
