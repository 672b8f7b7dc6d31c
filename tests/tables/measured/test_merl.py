"""The bins of the MERL database: which of them light reaches, and what a certificate says of their width."""

import json

import numpy as np

from measured_files import measured_spec, measured_table
from nacreous.formats.names import FormatName
from nacreous.tables.measured.merl import BINS, reached
from reference_merl import directions_at


def test_reached_bins_are_those_with_a_direction() -> None:
    """Corners of 3,000 bins: where any pair of directions is above the surface, the bin is reached."""
    random = np.random.default_rng(1)
    bins = np.stack([random.integers(0, n, 3000) for n in BINS], axis=-1)
    found = reached()[tuple(bins.T)]
    for at, expected in zip(bins, found, strict=True):
        corners = at + np.stack(np.meshgrid(*[[1e-4, 1 - 1e-4]] * 3), axis=-1).reshape(-1, 3)
        angles = corners / BINS * [1, np.pi / 2, np.pi]
        pairs = [directions_at(h**2 * np.pi / 2, d, phi, 0.0) for h, d, phi in angles]
        any_above = any(min(i[2], o[2]) > 0 for i, o in pairs)
        assert any_above <= expected
        assert any_above or not expected or max(min(i[2], o[2]) for i, o in pairs) > -1e-3


def test_the_certificate_knows_how_wide_the_bins_are() -> None:
    """A bin's value stands for all of it: narrow lobes lose most, and no light in all."""
    figures = [
        json.loads(measured_table(measured_spec(name), FormatName.MERL).provenance["certificate"])
        for name in ("narrow", "ggx", "rough")
    ]
    medians = [certificate["lobe_error_median"] for certificate in figures]
    assert sorted(medians, reverse=True) == medians
    assert 0.03 < medians[0] < 0.12
    assert medians[-1] < 0.03
    assert all(abs(certificate["lobe_energy_error"]) < 5e-3 for certificate in figures)
