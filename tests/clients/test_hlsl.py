"""The HLSL of Unreal Engine and Unity, translated by glslang and SPIRV-Cross and run in a browser's WebGL."""

import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import nacreous
from lut_contract import CONTRACT_SPEC, POINTS, LookupTexture, write_contract_table
from web_page import WebPage, chromium, open_page

CLIENTS = Path(__file__).parents[2] / "clients"


@dataclass(frozen=True)
class Engine:
    """How an engine calls its function and stores a picture: `rows` is the step along the file's rows."""

    file: Path
    call: str
    rows: int


ENGINES = {
    # A Custom node's body returns the function's value. Direct3D: the first row in memory is at v = 0.
    "unreal": Engine(CLIENTS / "unreal" / "NacreousFilm.ush", "colour = NacreousReflectance({});", 1),
    # Shader Graph calls NAME_float with the outputs behind the inputs. Unity stores the bottom row first.
    "unity": Engine(CLIENTS / "unity" / "NacreousFilm.hlsl", "NacreousReflectance_float({}, colour);", -1),
}

NODE = """
#include "{include}"
Texture2D Table : register(t0);
SamplerState TableSampler : register(s0);
Texture2D Points : register(t1);
cbuffer Axes : register(b0) {{ float4 CosThetaAxis; float4 ThicknessScaleAxis; }};
float4 main(float4 position : SV_Position) : SV_Target
{{
    float2 place = Points.Load(int3(int(position.x), 0, 0)).xy;
    float3 colour;
    {call}
    return float4(colour, 1.0);
}}
"""
ARGUMENTS = "Table, TableSampler, place.x, place.y, CosThetaAxis.xyz, ThicknessScaleAxis.xyz"


@pytest.fixture(scope="module")
def page() -> Iterator[WebPage]:
    """Open the page that runs fragment shaders."""
    with chromium() as browser, open_page(browser, Path(__file__).parent, "hlsl_page/index.html") as opened:
        yield opened


def translate(engine: Engine, folder: Path) -> str:
    """GLSL ES 3.00 of a pixel shader that calls the engine's function."""
    for program, package in (("glslangValidator", "glslang-tools"), ("spirv-cross", "spirv-cross")):
        if shutil.which(program) is None:
            pytest.skip(f"{program} is missing: install the package {package}")
    source, binary, glsl = (folder / f"node.{suffix}" for suffix in ("hlsl", "spv", "glsl"))
    source.write_text(NODE.format(include=engine.file.name, call=engine.call.format(ARGUMENTS)))
    hlsl = ["-D", "-V", "-S", "frag", "-e", "main"]
    _run("glslangValidator", *hlsl, f"-I{engine.file.parent}", source, "-o", binary)
    _run("spirv-cross", binary, "--version", "300", "--es", "--output", glsl)
    return glsl.read_text()


def _run(*command: object) -> None:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def run(
    page: WebPage, engine: Engine, fragment: str, texture: LookupTexture, points: np.ndarray
) -> np.ndarray:
    """Colours of the function at points (P, 2), (P, 3), the texture stored as the engine stores it."""
    axes = [(*axis["range"], axis["count"], 0) for axis in (texture.axis_x, texture.axis_y)]
    argument = {
        "fragment": fragment,
        "rows": texture.texels[:: engine.rows].tolist(),
        "points": points.tolist(),
        "constants": [float(value) for axis in axes for value in axis],
    }
    return np.array(page.call("run", argument))


@pytest.mark.parametrize("name", ENGINES)
@pytest.mark.parametrize("suffix", [".exr", ".transmission.exr"])
def test_reads_the_contract_table(page: WebPage, name: str, suffix: str, tmp_path: Path) -> None:
    """The function agrees with the lookup of clients/README.md at its points, and beyond the axes."""
    engine = ENGINES[name]
    texture = LookupTexture.read(write_contract_table(tmp_path).with_suffix(suffix))
    points = np.vstack([POINTS, [(-0.5, 0.2), (1.5, 2.0)]])
    got = run(page, engine, translate(engine, tmp_path), texture, points)
    np.testing.assert_allclose(got, texture.at(points[:, 0], points[:, 1]), rtol=0, atol=1e-4)


@pytest.mark.parametrize("name", ENGINES)
def test_one_thickness_has_no_upper_and_lower_row(page: WebPage, name: str, tmp_path: Path) -> None:
    """A table of one thickness has two equal rows: any thickness_scale reads the same."""
    engine = ENGINES[name]
    spec = CONTRACT_SPEC | {"table": CONTRACT_SPEC["table"] | {"thickness_scale": 1}}
    texture = LookupTexture.read(nacreous.write(nacreous.tabulate(spec), tmp_path / "single.exr")[0])
    points = np.array([(0.3, 0.0), (0.3, 1.0), (0.3, 2.0)])
    got = run(page, engine, translate(engine, tmp_path), texture, points)
    expected = texture.at(np.full(3, 0.3), np.ones(3))
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-4)


def test_both_engines_share_their_lines() -> None:
    """What is not the engine's own is the same text in both files, and there is some."""
    start, end = "// ---- the same in every engine", "// ---- U"
    shared = [engine.file.read_text().split(start)[1].split(end)[0] for engine in ENGINES.values()]
    assert shared[0] == shared[1]
    assert "NacreousPlace" in shared[0]
