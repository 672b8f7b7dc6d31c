"""The iridescence of three.js, run from its own shader text by OpenGL, in a process below xvfb-run."""

import json
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

CHUNKS = (
    Path(__file__).parent
    / "node"
    / "node_modules"
    / "three"
    / "src"
    / "renderers"
    / "shaders"
    / "ShaderChunk"
)

_EPICS, _SCHLICKS = "exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH )", "pow( 1.0 - dotVH, 5.0 )"
"""Three.js has a Gaussian in the place of Schlick's fifth power, which moves a colour by up to 0.04; both are
in its text, and the specification's is the second."""

_VERTEX = "#version 330\nin vec2 corner;\nvoid main() { gl_Position = vec4(corner, 0.0, 1.0); }\n"
_HEADER = "#version 330\n#define USE_IRIDESCENCE\n"
_MAIN = """
uniform float ior, thickness, cosines[64];
uniform vec3 base;
out vec4 colour;
void main() {
    float cosine = cosines[int(gl_FragCoord.x)];
    colour = vec4(evalIridescence(1.0, ior, cosine, thickness, base), 1.0);
}
"""


def three_reflectance(films: Sequence[Any], cos_theta: FloatArray) -> FloatArray:
    """Return what three.js reflects of films at cosines (A,): (films, A, 3); skips where it cannot run."""
    import pytest

    pytest.importorskip("moderngl", reason="the package moderngl is not installed")
    if not CHUNKS.is_dir():
        pytest.skip("the npm package three is not installed in tests/node")
    if shutil.which("xvfb-run") is None:
        pytest.skip("the Debian package xvfb is not installed")
    asked = [[float(film.ior), float(film.thickness_nm), film.base_f0.tolist()] for film in films]
    command = ["xvfb-run", "--auto-servernum", sys.executable, __file__]
    done = subprocess.run(
        command, input=json.dumps([asked, cos_theta.tolist()]), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return np.array(json.loads(done.stdout))


def _chunk(name: str) -> str:
    """Return the text of one of three.js's chunks, which is between back ticks."""
    return (CHUNKS / f"{name}.glsl.js").read_text(encoding="utf-8").split("`")[1]


def _main() -> None:
    import moderngl

    films, cosines = json.load(sys.stdin)
    context = moderngl.create_context(standalone=True)
    assert _EPICS in _chunk("common")
    common = _chunk("common").replace(_EPICS, _SCHLICKS)
    source = _HEADER + common + _chunk("iridescence_fragment") + _MAIN
    program = context.program(vertex_shader=_VERTEX, fragment_shader=source)
    corners = context.buffer(np.array([-1, -1, 3, -1, -1, 3], np.float32).tobytes())
    triangle = context.vertex_array(program, [(corners, "2f", "corner")])
    target = context.framebuffer([context.texture((len(cosines), 1), 4, dtype="f4")])
    target.use()
    program["cosines"] = cosines + [1.0] * (64 - len(cosines))
    drawn = []
    for ior, thickness_nm, base_f0 in films:
        program["ior"], program["thickness"], program["base"] = ior, thickness_nm, tuple(base_f0)
        triangle.render()
        pixels = np.frombuffer(target.read(components=3, dtype="f4"), np.float32)
        drawn.append(pixels.reshape(-1, 3).tolist())
    print(json.dumps(drawn))


if __name__ == "__main__":
    _main()
