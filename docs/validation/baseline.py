"""How many names of a chart hold by chance, and how many with wrong thicknesses.

A count within a tolerance says little alone: where colours follow each other closely, many names are near
many thicknesses. Two counts stand beside it: with the names dealt out to the chart's thicknesses in any
order, and with all thicknesses wrong by one factor.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from validation.named_chart import NamedChart

WRONG_BY = (0.9, 1.1)
"""What the thicknesses are multiplied by."""


def shuffled(chart: "NamedChart", tolerance_nm: float) -> float:
    """Return how many names hold in the mean over all orders of them.

    In all orders a name is at each thickness equally often, so that no order has to be drawn.
    """
    look = chart.look
    holds = np.array([colour.holds(look) for colour in chart.colours], int)
    places_nm = np.array([colour.thickness_nm for colour in chart.colours])
    near = (np.abs(chart.thickness_nm - places_nm[:, None]) <= tolerance_nm).astype(int)
    return float((near @ holds.T > 0).sum() / len(chart.colours))


def stretched(chart: "NamedChart", factor: float) -> int:
    """Return how many names hold where all thicknesses of the chart are multiplied by a factor."""
    colours = tuple(replace(each, thickness_nm=each.thickness_nm * factor) for each in chart.colours)
    return int(replace(chart, colours=colours).kept.sum())


def baseline(chart: "NamedChart", tolerance_nm: float) -> str:
    """Say both."""
    less, more = (stretched(chart, factor) for factor in WRONG_BY)
    return (
        f"By chance, which is the mean over all orders of the names, {shuffled(chart, tolerance_nm):.1f} of "
        f"{len(chart.colours)} would hold within ±{tolerance_nm:.0f} nm. With the names in their order, "
        f"{less} hold if every thickness of the chart is multiplied by {WRONG_BY[0]}, and {more} if by "
        f"{WRONG_BY[1]}."
    )
