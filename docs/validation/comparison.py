"""What a comparison consists of."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Measured = TypeVar("Measured")


@dataclass(frozen=True)
class Comparison(Generic[Measured]):
    """One comparison of the page.

    Parameters
    ----------
    name : str
        That of its picture, and of its place in the page.
    title, against : str
        The heading in the page, and whose numbers Nacreous is compared with.
    measure : callable
        Computes everything that is shown.
    headline : callable
        Says it in a few words.
    numbers : callable
        Says it in Markdown.
    draw : callable
        Draws it.
    palette : int, optional
        Colours that its file has; without it, all, as strips of smooth colours need.
    """

    name: str
    title: str
    against: str
    measure: Callable[[], Measured]
    headline: Callable[[Measured], str]
    numbers: Callable[[Measured], str]
    draw: Callable[[Measured], "Figure"]
    palette: int | None = None

    def line(self, measured: Measured) -> str:
        """Return the line of the table at the top of the page."""
        return f"| {self.title} | {self.against} | {self.headline(measured)} |"
