"""Thermal oxide on silicon against the colour chart that every cleanroom has on its wall.

W. A. Pliskin and E. E. Conrad, Nondestructive determination of thickness and refractive index of transparent
films, IBM J. Res. Dev. 8, 43-51 (1964), table 2: seen perpendicularly, under fluorescent daylight. One name
is taken for each colour of the first two orders.
"""

from functools import partial

from validation import named_chart
from validation.comparison import Comparison
from validation.named_chart import ChartColour

CHART = (
    ChartColour(100, "dark violet"),
    ChartColour(120, "royal blue"),
    ChartColour(150, "light blue"),
    ChartColour(170, "metallic"),
    ChartColour(200, "light gold"),
    ChartColour(250, "orange"),
    ChartColour(270, "red-violet"),
    ChartColour(310, "blue"),
    ChartColour(340, "light green"),
    ChartColour(390, "yellow"),
    ChartColour(420, "pink"),
    ChartColour(480, "blue-violet"),
    ChartColour(520, "green"),
    ChartColour(600, "pink"),
)

PICTURE_TITLE = "SiO₂ on silicon, D65, normal incidence"

COMPARISON = Comparison(
    name="silica-on-silicon",
    title="Oxide on silicon",
    against="the colour chart of Pliskin and Conrad 1964",
    measure=partial(named_chart.measure, PICTURE_TITLE, "silica-on-silicon", CHART, 700),
    headline=named_chart.headline,
    numbers=named_chart.numbers,
    draw=named_chart.draw,
)
