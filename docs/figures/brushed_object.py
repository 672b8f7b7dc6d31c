"""One brushed object in a grid of roughnesses and thicknesses: what figures 6 and 7 have in common."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from PIL import Image

from figures import studio
from figures.brushed import FEW_BOUNCES, Brushed, colour_lines, lobe_lines
from figures.figure import Quality
from figures.meshes.mesh import Mesh, write_ply
from figures.pictures import exposed, labelled, side_by_side, stacked
from figures.studio import Camera, Scene, SoftBox
from figures.tables import Tables


@dataclass(frozen=True)
class BrushedObject:
    """An object under soft boxes, a panel for each surface.

    Parameters
    ----------
    name : str
        Of its mesh.
    mesh : callable
    rows : tuple of tuple of Brushed
        Surfaces as the panels show them.
    camera : Camera
    lights : tuple of SoftBox
    stops : float
        Exposure of the panels.
    """

    name: str
    mesh: Callable[[], Mesh]
    rows: tuple[tuple[Brushed, ...], ...]
    camera: Camera
    lights: tuple[SoftBox, ...]
    stops: float

    def picture(self, tables: Tables, quality: Quality) -> Image.Image:
        """Render every panel."""
        return stacked(
            [side_by_side([self._panel(tables, each, quality) for each in row]) for row in self.rows]
        )

    def _panel(self, tables: Tables, surface: Brushed, quality: Quality) -> Image.Image:
        linear = studio.rendered(self.scene(tables, surface, quality.height), quality.samples)
        return labelled(exposed(linear, self.stops), surface.label)

    def scene(self, tables: Tables, surface: Brushed, height: int) -> Scene:
        """Return one panel's scene."""
        bsdf = studio.measured(tables.written(surface.spec, ".bsdf"))
        shape = {"type": "ply", "filename": str(self._mesh_file(tables.folder)), "bsdf": bsdf}
        objects = {self.name: shape, "floor": studio.plain(0.06)} | FEW_BOUNCES
        return studio.scene(studio.room(self.lights), self.camera, height, objects)

    def _mesh_file(self, folder: Path) -> Path:
        """Return the mesh as a file, which is written if it is not there."""
        file = folder / f"{self.name}.ply"
        return file if file.is_file() else write_ply(self.mesh(), file)

    def findings(self, tables: Tables) -> Iterator[str]:
        """Return the colours of the films, and how wide the lobes are along both axes."""
        surfaces = tuple(chain.from_iterable(self.rows))
        yield from colour_lines(surfaces)
        yield ""
        yield from lobe_lines(tables, surfaces)
