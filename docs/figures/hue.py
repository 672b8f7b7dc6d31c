"""Words for colours, by their hue angle h_ab in CIELAB.

The bounds are where the Munsell hues 10RP, 10R, 10YR, 10Y, 10G, 10BG, 7.5PB, 2.5P and 10P lie at value 5 and
chroma 8, in CIELAB under D65, to the degree (renotation of Newhall, Nickerson and Judd 1943). Munsell's RP
is called magenta, YR orange, GY and G green, BG cyan, B and most of PB blue.
"""

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

HUES = (
    (11.0, "red"),
    (44.0, "orange"),
    (76.0, "yellow"),
    (101.0, "green"),
    (175.0, "cyan"),
    (207.0, "blue"),
    (288.0, "violet"),
    (308.0, "purple"),
    (334.0, "magenta"),
)
"""From which h_ab, in degrees, a word holds; magenta goes over 360 to 11."""
LEAST_CHROMA = 4.0
"""C*_ab below which a colour is called grey."""


REC709_TO_XYZ = np.array(
    [[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]]
)
"""Of linear Rec.709 with white at D65 (ITU-R BT.709; x, y of the primaries as there)."""


@dataclass(frozen=True)
class Lab:
    """A colour in CIELAB under D65, a perfect white being L* = 100."""

    lightness: float
    a: float
    b: float

    @property
    def chroma(self) -> float:
        """Return C*_ab."""
        return float(np.hypot(self.a, self.b))

    @property
    def hue_deg(self) -> float:
        """Return h_ab, 0 to 360 degrees."""
        return float(np.degrees(np.arctan2(self.b, self.a)) % 360)

    @property
    def word(self) -> str:
        """Return what the colour is called."""
        if self.chroma < LEAST_CHROMA:
            return "grey"
        at = bisect_right([bound for bound, _ in HUES], self.hue_deg)
        return HUES[at - 1][1]  # below the first bound: the last word

    def __str__(self) -> str:
        """Return the word with the angle that it follows from."""
        return f"{self.word} (h {self.hue_deg:.0f}°, C* {self.chroma:.0f})"


def nearest_word(hue_deg: float, words: tuple[str, ...]) -> str:
    """Return which of some words has the middle of its range nearest to a hue."""
    bounds = [bound for bound, _ in HUES]
    ends = [*bounds[1:], bounds[0] + 360]
    middles = {word: (first + end) / 2 for (first, word), end in zip(HUES, ends, strict=True)}
    return min(words, key=lambda word: abs((hue_deg - middles[word] + 180) % 360 - 180))


def lab(linear_rgb: ArrayLike) -> Lab:
    """Return the CIELAB colour of linear Rec.709 (3,), white being 1 (CIE 15, 8.2.1)."""
    xyz = REC709_TO_XYZ @ np.asarray(linear_rgb, np.float64) / REC709_TO_XYZ.sum(axis=1)
    x, y, z = (_cube_root(each) for each in xyz)
    return Lab(116 * y - 16, 500 * (x - y), 200 * (y - z))


def _cube_root(share: float) -> float:
    """Return the cube root, with CIELAB's straight line near 0."""
    return float(np.cbrt(share)) if share > (6 / 29) ** 3 else share * (29 / 6) ** 2 / 3 + 4 / 29
