"""`python -m validation`: draw the pictures and write the numbers, all of them or those that are named."""

import sys

from figures.page import write_block
from validation.comparison import Comparison
from validation.comparisons import comparisons
from validation.drawing import save
from validation.page import IMAGES, OVERVIEW, PAGE, block, with_line


def main() -> None:
    """Renew the comparisons named on the command line."""
    known = {comparison.name: comparison for comparison in comparisons()}
    unknown = [name for name in sys.argv[1:] if name not in known]
    if unknown:
        sys.exit(f"expected names out of {', '.join(known)}; got {', '.join(unknown)}")
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[1:] or known:
        renew(known[name])


def renew(comparison: Comparison[object]) -> None:
    """Measure, draw and write one comparison."""
    sys.stderr.write(f"{comparison.name} ...\n")
    measured = comparison.measure()
    save(comparison.draw(measured), IMAGES / f"{comparison.name}.png", comparison.palette)
    overview = with_line(block(OVERVIEW), comparison.title, comparison.line(measured))
    write_block(PAGE, OVERVIEW, overview.splitlines())
    write_block(PAGE, comparison.name, comparison.numbers(measured).splitlines())


if __name__ == "__main__":
    main()
