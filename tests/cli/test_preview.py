"""``nacreous preview`` draws a picture of what the tables say."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

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
