"""The figures that are rendered, in the paper's order; to add one, import its module and name it here."""

from figures import figure_3, figure_4, figure_5

FIGURES = {module.FIGURE.number: module.FIGURE for module in (figure_3, figure_4, figure_5)}
