"""What every figure of the paper is made of."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from PIL import Image

from figures.tables import Tables


@dataclass(frozen=True)
class Quality:
    """How large and how clean pictures are rendered."""

    height: int
    """Of a panel, in pixels; a figure's other measures follow from it."""
    samples: int
    """Paths through each pixel, four wavelengths each."""


@dataclass(frozen=True)
class Figure:
    """A figure of the paper.

    Parameters
    ----------
    number : int
    caption : str
        The paper's own; it goes before the findings.
    quality : Quality
        What `make figures` renders it with.
    render : callable
        Returns the pictures by name, such as ``figure-3``: a rendering, or a chart that belongs to it.
    findings : callable
        Returns lines of Markdown with what was measured on the tables: what agrees, what does not.
    """

    number: int
    caption: str
    quality: Quality
    render: Callable[[Tables, Quality], Mapping[str, Image.Image]]
    findings: Callable[[Tables], Iterable[str]]

    @property
    def name(self) -> str:
        """Return the name of its files, and of its place in the page."""
        return f"figure-{self.number}"
