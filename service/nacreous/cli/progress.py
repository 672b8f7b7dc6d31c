"""Progress: a bar on a terminal, nothing in a pipe."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["Observer", "progress"]

Observer = Callable[[float], None]
"""Is called with the fraction done."""


@contextmanager
def progress(label: str) -> Iterator[Observer | None]:
    """Yield what is to be called with the fraction done; None where nobody watches.

    The bar is on stderr, and gone at the end.
    """
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(label, total=1.0)
        yield lambda fraction: bar.update(task, completed=fraction)
