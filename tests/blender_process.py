"""Blender, in a process of its own: what every test with it needs.

Blender's Python module wants Python 3.11 and an older NumPy than Nacreous, so it has an environment of its
own: ``.venv-blender``, which `make test` makes, or the interpreter that ``NACREOUS_BLENDER_PYTHON`` names.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from lut_contract import FloatArray

ROOT = Path(__file__).parent.parent
TIMEOUT_SECONDS = 300


def blender_python() -> Path:
    """Return an interpreter that has the module ``bpy``, or skip."""
    path = Path(os.environ.get("NACREOUS_BLENDER_PYTHON", ROOT / ".venv-blender" / "bin" / "python"))
    if not path.is_file():
        pytest.skip("Blender is missing: install the package bpy 4.5 into .venv-blender (Python 3.11)")
    return path


def blender_jobs(jobs: list[dict[str, Any]], folder: Path) -> list[Any]:
    """Let Blender do jobs of blender_jobs.py one after another, and return their answers."""
    asked, answers = folder / "jobs.json", folder / "answers.json"
    asked.write_text(json.dumps(jobs))
    run_blender(Path(__file__).with_name("blender_jobs.py"), folder, asked, answers)
    return json.loads(answers.read_text())


def run_blender(script: Path, folder: Path, *arguments: str | Path) -> str:
    """Run a script that imports ``bpy`` and return what it printed."""
    done = subprocess.run(
        [blender_python(), script, *arguments],
        env=os.environ | {"BLENDER_USER_RESOURCES": str(folder / "blender"), "PYTHONPATH": ""},
        capture_output=True,
        text=True,
        timeout=TIMEOUT_SECONDS,
    )
    assert done.returncode == 0, done.stderr[-4000:] or done.stdout[-4000:]
    return done.stdout


def linear_pixels(path: Path) -> FloatArray:
    """Return the colours of a picture, (H, W, 3), rows from the top."""
    import OpenImageIO

    image = OpenImageIO.ImageInput.open(str(path))
    spec = image.spec()
    pixels = np.asarray(image.read_image(OpenImageIO.FLOAT), np.float64)
    image.close()
    return pixels.reshape(spec.height, spec.width, -1)[..., :3]


def packed_add_on(folder: Path) -> Path:
    """Pack the add-on as an artist gets it."""
    script = ROOT / "clients" / "blender" / "pack.py"
    done = subprocess.run(
        [sys.executable, script, folder], capture_output=True, text=True, check=True, timeout=TIMEOUT_SECONDS
    )
    return Path(done.stdout.strip())


def sphere_cosines(pixels: int) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Return the cosine at each pixel of a sphere that fills the picture, and where it is well inside.

    The outermost pixels are left out: there a mesh of flat faces is no sphere.
    """
    centre = (np.arange(pixels) + 0.5) / pixels * 2 - 1
    radius2 = centre[:, None] ** 2 + centre**2
    return np.sqrt(np.clip(1 - radius2, 0, 1)), radius2 < 0.98**2
