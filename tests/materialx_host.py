"""MaterialX as a host of its documents: they are validated, made shaders of, and drawn off screen in GLSL.

`python materialx_host.py JOBS.json`, below `xvfb-run`, draws every job of a list. It is a process of its own,
because OpenGL needs a display. `draw` starts it. The wheel of MaterialX has no reader of EXRs, so OpenImageIO
gives it the pixels.
"""

import json
import os
import shutil
import subprocess
import sys
from ctypes.util import find_library
from dataclasses import asdict, dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

FAR = 1e5
"""Distance of the eye in radii: all pixels see the surface from one direction."""

_NO_ANISOTROPY = "-GL_EXT_texture_filter_anisotropic -GL_ARB_texture_filter_anisotropic"
"""MaterialX asks for it, and Mesa's software renderer then blurs a texture over several texels, even where
all pixels read one place: by 0.1 at texel centres, measured."""


@dataclass(frozen=True)
class Picture:
    """A picture to draw.

    Parameters
    ----------
    document : str
    element : str
        Path of a material, or of the output of a node graph, whose colour is then seen as it is.
    inputs : dict
        Values by the path of an input.
    cos_theta : float or None
        A sheet whose normal everywhere has this cosine to the view; without one a sphere of radius 1.
    size : int
        Pixels of either side.
    """

    document: str
    element: str
    inputs: dict[str, float] = field(default_factory=dict)
    cos_theta: float | None = None
    size: int = 8


def draw(pictures: list[Picture], folder: Path) -> list[FloatArray]:
    """Return linear pictures, (size, size, 3), the first row at the top; skips a test without a display."""
    import pytest

    pytest.importorskip("MaterialX", reason="the package MaterialX is not installed")
    if shutil.which("xvfb-run") is None:
        pytest.skip("the Debian package xvfb is not installed")
    if find_library("GL") is None:
        pytest.skip("the Debian packages libgl1 and libgl1-mesa-dri are not installed")
    jobs = folder / "jobs.json"
    jobs.write_text(json.dumps([asdict(picture) for picture in pictures]))
    command = ["xvfb-run", "--auto-servernum", sys.executable, __file__, str(jobs)]
    environment = {**os.environ, "MESA_EXTENSION_OVERRIDE": _NO_ANISOTROPY}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stderr
    return list(np.load(jobs.with_suffix(".npz")).values())


# ---- documents and shaders, without a display --------------------------------------------------------------


def standard_library() -> Any:  # noqa: ANN401 - MaterialX has no types
    """Return the document of all nodes that MaterialX defines."""
    import MaterialX as mx  # noqa: N813 - the name that all its examples have

    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    return library


def opened(path: Path, library: Any) -> Any:  # noqa: ANN401 - as above
    """Return a document, read as a host reads it."""
    import MaterialX as mx  # noqa: N813 - as above

    document = mx.createDocument()
    mx.readFromXmlFile(document, str(path))
    document.setDataLibrary(library)
    return document


def shader_source(generator: Any, library: Any, element: Any) -> str:  # noqa: ANN401 - as above
    """Return the pixel stage of the shader that a generator makes of an element."""
    return shader(generator, library, element).getSourceCode("pixel")


def shader(generator: Any, library: Any, element: Any) -> Any:  # noqa: ANN401 - as above
    """Return the shader that a generator makes of an element."""
    import MaterialX as mx  # noqa: N813 - as above
    from MaterialX import PyMaterialXGenShader

    generator.registerTypeDefs(library)
    context = PyMaterialXGenShader.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    context.getOptions().fileTextureVerticalFlip = True  # its own viewer's: files begin with the top row
    return generator.generate("film", element, context)


# ---- drawing, below xvfb-run -------------------------------------------------------------------------------


def _main(jobs: Path) -> None:
    library = standard_library()
    pictures = [Picture(**job) for job in json.loads(jobs.read_text())]
    drawn = {str(at): _drawn(picture, library, jobs.parent) for at, picture in enumerate(pictures)}
    np.savez(jobs.with_suffix(".npz"), **drawn)


def _drawn(picture: Picture, library: Any, folder: Path) -> FloatArray:  # noqa: ANN401 - as above
    import MaterialX as mx  # noqa: N813 - as above
    from MaterialX import PyMaterialXGenGlsl, PyMaterialXRender, PyMaterialXRenderGlsl

    renderer = PyMaterialXRenderGlsl.GlslRenderer.create(picture.size, picture.size, PyMaterialXRender.FLOAT)
    renderer.initialize()
    document = opened(Path(picture.document), library)
    for path, value in picture.inputs.items():
        owner, _, name = path.rpartition("/")
        document.getDescendant(owner).setInputValue(name, value)
    loader = _exr_loader(PyMaterialXRender)  # kept here: MaterialX holds it without Python's knowledge
    textures = PyMaterialXRenderGlsl.GLTextureHandler.create(loader)
    textures.setSearchPath(mx.FileSearchPath(str(Path(picture.document).parent)))
    renderer.setImageHandler(textures)
    renderer.setLightHandler(_white_surroundings(PyMaterialXRender, mx))
    geometry = renderer.getGeometryHandler()
    geometry.addLoader(PyMaterialXRender.TinyObjLoader.create())
    geometry.loadGeometry(mx.FilePath(str(_mesh(picture.cos_theta, folder))), False)  # noqa: FBT003 - MaterialX takes it so: V as it is
    _place_eye(renderer.getCamera(), PyMaterialXRender.Camera, mx)
    element = document.getDescendant(picture.element)
    renderer.createProgram(shader(PyMaterialXGenGlsl.GlslShaderGenerator.create(), library, element))
    renderer.render()
    return _pixels(renderer.captureImage(None))


def _place_eye(camera: Any, maker: Any, mx: ModuleType) -> None:  # noqa: ANN401 - as above
    origin, up = mx.Vector3(0.0, 0.0, 0.0), mx.Vector3(0.0, 1.0, 0.0)
    camera.setViewMatrix(maker.createViewMatrix(mx.Vector3(0.0, 0.0, FAR), origin, up))
    camera.setProjectionMatrix(maker.createOrthographicMatrix(-1, 1, -1, 1, 1, 2 * FAR))


def _white_surroundings(render: ModuleType, mx: ModuleType) -> Any:  # noqa: ANN401 - as above
    lights = render.LightHandler.create()
    white = render.createUniformImage(4, 2, 3, render.FLOAT, mx.Color4(1.0, 1.0, 1.0, 1.0))
    lights.setEnvRadianceMap(white)
    lights.setEnvIrradianceMap(white)
    lights.setEnvSampleCount(16)
    return lights


def _exr_loader(render: ModuleType) -> Any:  # noqa: ANN401 - as above
    import MaterialX as mx  # noqa: N813 - as above
    import OpenImageIO

    class ExrLoader(render.ImageLoader):
        def supportedExtensions(self) -> set[str]:  # noqa: N802 - MaterialX's name
            return {"exr"}

        def loadImage(self, path: Any) -> Any:  # noqa: ANN401, N802 - MaterialX's name, and no types
            source = OpenImageIO.ImageInput.open(path.asString())
            spec = source.spec()
            texels = np.asarray(source.read_image(OpenImageIO.FLOAT)).reshape(spec.height, spec.width, -1)
            image = render.Image.create(spec.width, spec.height, 3, render.FLOAT)
            image.createResourceBuffer()
            for y, x in np.ndindex(spec.height, spec.width):
                image.setTexelColor(x, y, mx.Color4(*map(float, texels[y, x, :3]), 1.0))
            return image

    return ExrLoader()


def _pixels(image: Any) -> FloatArray:  # noqa: ANN401 - as above
    rows, columns = range(image.getHeight()), range(image.getWidth())
    colours = [[image.getTexelColor(x, y) for x in columns] for y in rows]
    return np.array([[[colour[at] for at in range(3)] for colour in row] for row in colours])


def _mesh(cos_theta: float | None, folder: Path) -> Path:
    """Write a Wavefront file: a sheet across the view with one normal, or a sphere."""
    if cos_theta is None:
        path = folder / "sphere.obj"
        path.write_text(_sphere())
        return path
    path = folder / f"sheet-{cos_theta:.4f}.obj"
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    lines = [f"v {x} {y} 0\nvt {x} {y}" for x, y in corners]
    normal = f"vn {(1 - cos_theta**2) ** 0.5:.9f} 0 {cos_theta:.9f}"
    path.write_text("\n".join([*lines, normal, "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 3/3/1 4/4/1", ""]))
    return path


def _sphere(parallels: int = 96, meridians: int = 192) -> str:
    polar, azimuth = np.mgrid[0 : np.pi : (parallels + 1) * 1j, 0 : 2 * np.pi : (meridians + 1) * 1j]
    x, y, z = np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)
    points = zip(x.ravel(), y.ravel(), z.ravel(), polar.ravel(), azimuth.ravel(), strict=True)
    lines = [f"v {a} {b} {c}\nvn {a} {b} {c}\nvt {u} {v}" for a, b, c, u, v in points]
    for row, column in np.ndindex(parallels, meridians):
        first = row * (meridians + 1) + column + 1
        below = first + meridians + 1
        for corners in ((first, below, below + 1), (first, below + 1, first + 1)):
            lines += ["f " + " ".join(f"{corner}/{corner}/{corner}" for corner in corners)]
    return "\n".join([*lines, ""])


if __name__ == "__main__":
    _main(Path(sys.argv[1]))
