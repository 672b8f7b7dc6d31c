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
    measure : callable
        Computes everything that is shown.
    numbers : callable
        Says it in Markdown.
    draw : callable
        Draws it.
    palette : int, optional
        Colours that its file has; without it, all, as strips of smooth colours need.
    """

    name: str
    measure: Callable[[], Measured]
    numbers: Callable[[Measured], str]
    draw: Callable[[Measured], "Figure"]
    palette: int | None = None
