"""Anodic oxide on titanium against the colours that jewellers and metallurgists name by its thickness.

M. V. Diamanti, B. Del Curto and M. Pedeferri, Interference colors of thin oxide layers on titanium, Color
Res. Appl. 33, 221-228 (2008), and jewellers' charts; thicknesses rounded.
"""

from functools import partial

from validation import named_chart
from validation.comparison import Comparison
from validation.named_chart import ChartColour

CHART = (
    ChartColour(20, "gold"),
    ChartColour(40, "purple"),
    ChartColour(50, "blue"),
    ChartColour(80, "silver"),
    ChartColour(120, "yellow"),
    ChartColour(140, "pink"),
    ChartColour(160, "violet"),
    ChartColour(180, "cyan"),
)

PICTURE_TITLE = "TiO₂ on titanium, D65, normal incidence"

COMPARISON = Comparison(
    name="anodised-titanium",
    title="Anodised titanium",
    against="Diamanti et al. 2008, jewellers' charts",
    measure=partial(named_chart.measure, PICTURE_TITLE, "anodised-titanium", CHART, 200),
    headline=named_chart.headline,
    numbers=named_chart.numbers,
    draw=named_chart.draw,
)
