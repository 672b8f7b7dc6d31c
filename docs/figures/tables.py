"""Tables of films, computed once for each spec and written once for each format."""

from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np
import xarray
from numpy.typing import NDArray

import nacreous
from nacreous import Spec
from nacreous.formats.registry import format_of
from nacreous.tables.tabulate import tabulate_table

FloatArray = NDArray[np.float64]

MITSUBA_RANGE = "table.wavelength_nm={start=360,stop=830,step=5}"
"""An assignment for `nacreous.preset`: all wavelengths that Mitsuba samples."""


@dataclass(frozen=True)
class Tables:
    """A folder of tables."""

    folder: Path

    def written(self, spec: Spec, suffix: str) -> Path:
        """Return the file of a spec in the format of a suffix, such as ``.spectral.exr`` or ``.bsdf``.

        A transparent film's T lies beside it. What is there already is not computed again, and a measured
        material is sampled where its readers do and nowhere else.
        """
        digest = sha256(spec.model_dump_json().encode()).hexdigest()[:12]
        file = self.folder / f"film-{digest}{suffix}"
        if not file.is_file():
            self.folder.mkdir(parents=True, exist_ok=True)
            nacreous.write(tabulate_table(spec, sampling=format_of(file).sampling), file)
        return file


def table_at_angles(spec: Spec, theta_deg: FloatArray, step_nm: float = 5.0) -> xarray.Dataset:
    """Compute R and T of a spec's smooth film at ascending angles of incidence (A,), in this order."""
    cosines = np.cos(np.radians(theta_deg))[::-1]
    document = spec.model_dump(include={"stack"}, exclude_unset=True)
    document["table"] = {
        "wavelength_nm": {"start": 360.0, "stop": 830.0, "step": step_nm},
        "cos_theta": cosines.tolist(),
    }
    return nacreous.tabulate(document).isel(cos_theta=slice(None, None, -1))


def colours(table: xarray.Dataset) -> FloatArray:
    """Return the linear Rec.709 colours of R under D65 at the table's first thickness, (A, 3)."""
    return np.asarray(table["R_rgb"][0], np.float64)


def spectra(table: xarray.Dataset) -> FloatArray:
    """Return R in unpolarised light at the table's first thickness, (A, L)."""
    return np.asarray((table["R_s"] + table["R_p"])[0] / 2, np.float64)
