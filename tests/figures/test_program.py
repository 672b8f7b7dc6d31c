"""The program that makes the page of the paper's figures, as `make figures` runs it, with tiny pictures."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from figures.__main__ import parsed
from figures.coated_glass import CAMERA, GLASS_CENTRE, LIGHTS
from figures.hue import lab
from figures.registry import FIGURES
from figures.tables import Tables
from mitsuba_surface import variant_fault
from reference_colour import film_colour

FloatArray = NDArray[np.float64]

ROOT = Path(__file__).parents[2]
HEIGHT, SAMPLES = 90, 64
FILMS = {3: 420.0, 4: 450.0}
"""Thickness in nm of the film in each figure."""
LARGEST_HUE_ERROR_DEG = 15.0
"""What is behind the glass shines through, with the other colours."""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the pictures and the page, as a run of the program leaves it."""
    if fault := variant_fault("llvm_ad_spectral"):
        pytest.skip(fault)
    folder = tmp_path_factory.mktemp("figures")
    shutil.copy(ROOT / "docs" / "paper.md", folder)
    size = ["--height", str(HEIGHT), "--samples", str(SAMPLES)]
    places = ["--out", str(folder), "--page", str(folder / "paper.md")]
    path = os.pathsep.join([str(ROOT / "docs"), str(ROOT / "tests"), os.environ.get("PYTHONPATH", "")])
    subprocess.run(
        [sys.executable, "-m", "figures", *map(str, FILMS), *size, *places],
        check=True,
        env=os.environ | {"PYTHONPATH": path},
    )
    return folder


@pytest.mark.parametrize("number", FILMS)
def test_a_soft_box_is_reflected_in_the_film_s_own_hue(number: int, made: Path) -> None:
    """Where the sphere mirrors a box, the picture has the hue that colour-science has for the Airy sum."""
    normal, cos_theta = mirroring(direction(LIGHTS[0].azimuth_deg, LIGHTS[0].elevation_deg))
    row, column = pixel(np.array(GLASS_CENTRE) + normal)
    picture = decoded(np.asarray(Image.open(made / f"figure-{number}.jpg"), np.float64) / 255)
    got = lab(picture[row - 1 : row + 2, column - 1 : column + 2].mean(axis=(0, 1)))
    exact = lab(film_colour(np.array([1.0, 2.0, 1.5], complex), np.array([FILMS[number]]), cos_theta))
    difference = (got.hue_deg - exact.hue_deg + 180) % 360 - 180
    assert abs(difference) <= LARGEST_HUE_ERROR_DEG, f"{got} instead of {exact}"


def test_findings_are_written_between_their_marks(made: Path) -> None:
    """A run writes its numbers into the page and leaves the prose and the other figures as they are."""
    before, after = (folder / "paper.md" for folder in (ROOT / "docs", made))
    assert outside_marks(before.read_text()) == outside_marks(after.read_text())
    assert "| 450 nm | 400.0, 514.3, 720.0 | 400.0, 514.3, 720.0 |" in after.read_text()


@pytest.mark.parametrize("number", [4, 8])
def test_the_page_says_what_is_measured_now(number: int, tmp_path: Path) -> None:
    """Colours, maxima and words of the page are those that the code finds: docs/paper.md cannot go stale."""
    figure = FIGURES[number]
    page = (ROOT / "docs" / "paper.md").read_text()
    block = page.partition(f"<!-- {figure.name}: begin -->\n")[2].partition(f"<!-- {figure.name}: end -->")[0]
    assert block.partition("\n\n")[2].strip() == "\n".join(figure.findings(Tables(tmp_path))).strip()


def outside_marks(page: str) -> str:
    """Return a page without what the program writes."""
    parts = page.split(": begin -->")
    return "".join([parts[0], *(part.partition(": end -->")[2] for part in parts[1:])])


def direction(azimuth_deg: float, elevation_deg: float) -> FloatArray:
    """Return the unit vector of a direction in the room: 0 degrees is +y, 90 is +x, z is up."""
    azimuth, elevation = np.radians([azimuth_deg, elevation_deg])
    across = np.cos(elevation)
    return np.array([across * np.sin(azimuth), across * np.cos(azimuth), np.sin(elevation)])


def mirroring(light: FloatArray) -> tuple[FloatArray, float]:
    """Return the normal where the sphere mirrors a far light into the camera, and the cosine there."""
    normal = light
    for _ in range(20):  # the point moves with its normal, and with it the way to the camera
        view = unit(np.array(CAMERA.origin) - np.array(GLASS_CENTRE) - normal)
        normal = unit(view + light)
    return normal, float(normal @ light)


def pixel(point: FloatArray) -> tuple[int, int]:
    """Return the row and the column at which the camera sees a point: a pinhole's perspective."""
    origin = np.array(CAMERA.origin)
    ahead = unit(np.array(CAMERA.target) - origin)
    right = unit(np.cross(ahead, [0, 0, 1]))
    place = (point - origin) / ((point - origin) @ ahead) / np.tan(np.radians(CAMERA.fov_deg) / 2)
    row = HEIGHT / 2 * (1 - place @ np.cross(right, ahead))
    return int(row), int(HEIGHT / 2 * (CAMERA.aspect + place @ right))


def unit(vector: FloatArray) -> FloatArray:
    """Return a vector of length 1."""
    return vector / np.linalg.norm(vector)


def decoded(srgb: FloatArray) -> FloatArray:
    """Return linear Rec.709 of sRGB (IEC 61966-2-1)."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def test_without_numbers_every_figure_is_made() -> None:
    """`make figures` names none; argparse's choices once refused that."""
    assert parsed([]).numbers == []
    assert parsed(["3", "9"]).numbers == [3, 9]


def test_a_figure_that_the_paper_renders_not_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """One message, with what there is."""
    with pytest.raises(SystemExit):
        parsed(["2"])
    assert "expected one of 3, 4, 5, 6, 7, 8, 9, got '2'" in capsys.readouterr().err
