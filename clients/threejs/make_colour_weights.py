"""Print src/colour-weights.json: what a wavelength adds to linear Rec.709 under D65, from colour-science.

The sum over wavelengths is that of CIE 15, "Calculation of tristimulus values", at 5 nm, normalised so that a
reflectance of 1 is white, and adapted from the illuminant's white to the space's (Bradford).
"""

import json
import sys

import colour
import numpy as np

FIRST_NM, LAST_NM, STEP_NM = 360, 830, 5
"""The range of the CIE 1931 colour-matching functions, and the finer of the two steps in CIE 15."""


def colour_weights() -> dict[str, object]:
    """Weights at every step: ``first_nm``, ``step_nm`` and one list a channel."""
    weights = _rgb_from_xyz() @ _xyz_weights()  # (3, L)
    channels = {name: [round(w, 9) for w in row.tolist()] for name, row in zip("rgb", weights, strict=True)}
    return {"first_nm": FIRST_NM, "step_nm": STEP_NM, **channels}


def _xyz_weights() -> np.ndarray:
    """XYZ of the light of one step, (3, L); all of them make the illuminant's white, Y = 1."""
    shape = colour.SpectralShape(FIRST_NM, LAST_NM, STEP_NM)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape)
    power = colour.SDS_ILLUMINANTS["D65"].copy().align(shape)
    weights = observer.values.T * power.values
    return weights / weights[1].sum()


def _rgb_from_xyz() -> np.ndarray:
    space = colour.RGB_COLOURSPACES["ITU-R BT.709"]
    source_white, white = _xyz_weights().sum(axis=1), colour.xy_to_XYZ(space.whitepoint)
    adaptation = colour.adaptation.matrix_chromatic_adaptation_VonKries(source_white, white, "Bradford")
    return space.matrix_XYZ_to_RGB @ adaptation


if __name__ == "__main__":
    json.dump(colour_weights(), sys.stdout)
    sys.stdout.write("\n")
