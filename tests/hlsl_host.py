"""Unreal Engine's and Unity's way of calling their HLSL, run in a browser: pictures come back as numbers.

glslang compiles a pixel shader that calls a client's function, SPIRV-Cross translates it, and WebGL 2 runs it
on texels that lie in memory, and are filtered, as the engine has them.
"""

import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lut_contract import FloatArray, LookupTexture
from web_page import WebPage, chromium, open_page

TESTS = Path(__file__).parent
CLIENTS = TESTS.parent / "clients"
PAGE = TESTS / "clients" / "hlsl_page"


@dataclass(frozen=True)
class Engine:
    """How an engine calls its function and stores a picture: `rows` is the step along the file's rows."""

    file: Path
    call: str
    rows: int


ENGINES = {
    # A Custom node's body returns the function's value. Direct3D: the first row in memory is at v = 0.
    "unreal": Engine(CLIENTS / "unreal" / "NacreousFilm.ush", "Colour = NacreousReflectance({});", 1),
    # Shader Graph calls NAME_float with the outputs behind the inputs. Unity stores the bottom row first.
    "unity": Engine(CLIENTS / "unity" / "NacreousFilm.hlsl", "NacreousReflectance_float({}, Colour);", -1),
}

NODE = """
#include "{include}"
Texture2D Table : register(t0);
SamplerState TableSampler : register(s0);
float3 FilmColour(float CosTheta, float ThicknessScale, float3 CosThetaAxis, float3 ThicknessScaleAxis)
{{
    float3 Colour;
    {call}
    return Colour;
}}
"""
ARGUMENTS = "Table, TableSampler, CosTheta, ThicknessScale, CosThetaAxis, ThicknessScaleAxis"


@dataclass(frozen=True)
class Sphere:
    """What sphere.hlsl draws.

    Parameters
    ----------
    pixels : int
        Of either side of the picture.
    thickness_scale : tuple of float
        At the top and at the bottom; it changes evenly with the height.
    light : tuple of float
        Radiance from everywhere, more of it from above, more from a lamp.
    """

    pixels: int
    thickness_scale: tuple[float, float]
    light: tuple[float, float, float] = (1.0, 0.0, 0.0)

    eye_distance = 4.0
    """From the centre, in radii."""
    half_width = 1.08
    """Of the picture at the centre, in radii; the rim is seen at 1.033."""


@contextmanager
def hlsl_page() -> Iterator[WebPage]:
    """Open the page that runs fragment shaders; skips a test without a browser."""
    with chromium() as browser, open_page(browser, PAGE, "index.html") as opened:
        yield opened


def read_points(
    page: WebPage, engine: Engine, texture: LookupTexture, points: FloatArray, folder: Path
) -> FloatArray:
    """Return the function's colours at points (P, 2), (P, 3)."""
    shader = translate(engine, "points.hlsl", folder)
    size = {"width": len(points), "height": 1}
    argument = {"fragment": shader, "places": points.tolist(), "constants": _axes(texture), **size}
    return _run_on(page, engine, texture, "RGBA32F", argument)[0, :, :3]


def draw_sphere(
    page: WebPage, engine: Engine, texture: LookupTexture, sphere: Sphere, folder: Path, *, texels: str
) -> FloatArray:
    """Return a linear picture, (pixels, pixels, 4), top row first; alpha tells where the sphere is.

    `texels` is the format of the table in memory: RGBA32F or RGBA16F.
    """
    camera = (sphere.pixels, sphere.eye_distance, sphere.half_width, 0)
    constants = [*_axes(texture), *camera, *sphere.thickness_scale, 0, 0, *sphere.light, 0]
    size = {"width": sphere.pixels, "height": sphere.pixels}
    argument = {"fragment": translate(engine, "sphere.hlsl", folder), "constants": constants, **size}
    return _run_on(page, engine, texture, texels, argument)


def translate(engine: Engine, shader: str, folder: Path) -> str:
    """Return GLSL ES 3.00 of a pixel shader of the page's folder, whose film is the engine's."""
    import pytest

    for program, package in (("glslangValidator", "glslang-tools"), ("spirv-cross", "spirv-cross")):
        if shutil.which(program) is None:
            pytest.skip(f"{program} is missing: install the package {package}")
    binary, glsl = (folder / f"shader.{suffix}" for suffix in ("spv", "glsl"))
    node = NODE.format(include=engine.file.name, call=engine.call.format(ARGUMENTS))
    (folder / "film.hlsli").write_text(node)
    hlsl = ["-D", "-V", "-S", "frag", "-e", "main", f"-I{folder}", f"-I{engine.file.parent}"]
    _run("glslangValidator", *hlsl, PAGE / shader, "-o", binary)
    _run("spirv-cross", binary, "--version", "300", "--es", "--output", glsl)
    return glsl.read_text()


def _run(*command: object) -> None:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def _axes(texture: LookupTexture) -> list[float]:
    axes = [(*axis["range"], axis["count"], 0) for axis in (texture.axis_x, texture.axis_y)]
    return [float(value) for axis in axes for value in axis]


def _run_on(
    page: WebPage, engine: Engine, texture: LookupTexture, texels: str, argument: dict[str, object]
) -> FloatArray:
    """Return what a shader draws of a texture that is stored as the engine stores it, (H, W, 4)."""
    stored = {"rows": texture.texels[:: engine.rows].tolist(), "format": texels}
    return np.array(page.call("run", argument | stored)).reshape(argument["height"], argument["width"], 4)
