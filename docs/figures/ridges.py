"""The films of figure 8: ridges and gaps, their colours, and which of the paper's words they have."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import nacreous
from figures.hue import lab
from figures.tables import colours, table_at_angles
from nacreous import Spec

FloatArray = NDArray[np.float64]

PRESET = "paper/figure-8"
THICKNESSES_NM = (80.0, 100.0, 120.0, 135.0)
WORDS = ("violet", "blue", "yellow", "red")
"""The paper's, from left to right."""
ANGLES_DEG = np.arange(0.0, 76.0)


@dataclass(frozen=True)
class Structure:
    """What the paper does not state: the number of pairs, and the gap; None is as wide as the ridge."""

    pairs: int = 6
    gap_nm: float | None = None

    def spec(self, ridge_nm: float) -> Spec:
        """Return the preset with a ridge of some thickness."""
        stack = nacreous.preset(PRESET).model_dump(include={"stack"}, exclude_unset=True)["stack"]
        ridge, gap = stack["layers"][0]["layers"]
        layers = [
            ridge | {"thickness_nm": ridge_nm},
            gap | {"thickness_nm": ridge_nm if self.gap_nm is None else self.gap_nm},
        ]
        return Spec.from_document({"stack": stack | {"layers": [{"repeat": self.pairs, "layers": layers}]}})

    def colours(self, ridge_nm: float, theta_deg: FloatArray) -> FloatArray:
        """Return linear colours at two or more ascending angles at the facets, (A, 3)."""
        return colours(table_at_angles(self.spec(ridge_nm), theta_deg))

    def words(self, ridge_nm: float) -> tuple[str, ...]:
        """Return the word for each of `ANGLES_DEG`."""
        return tuple(lab(colour).word for colour in self.colours(ridge_nm, ANGLES_DEG))

    def words_held(self) -> NDArray[np.int64]:
        """Return how many wings have the paper's word, at each of `ANGLES_DEG`."""
        words = [self.words(ridge) for ridge in THICKNESSES_NM]
        return np.sum([np.array(w) == word for w, word in zip(words, WORDS, strict=True)], axis=0)


PAPER = Structure()
"""As the preset assumes."""
OTHERS = (
    *(Structure(pairs=pairs) for pairs in (1, 2, 3, 4, 5, 8, 10, 12)),
    *(Structure(gap_nm=float(gap)) for gap in range(60, 201, 10)),
)
"""Other structures that might have been meant."""
