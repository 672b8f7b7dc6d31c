"""The figures that are rendered, in the paper's order; to add one, import its module and name it here."""

from figures import figure_3, figure_4, figure_5, figure_6, figure_7, figure_8, figure_9

_MODULES = (figure_3, figure_4, figure_5, figure_6, figure_7, figure_8, figure_9)
FIGURES = {module.FIGURE.number: module.FIGURE for module in _MODULES}
