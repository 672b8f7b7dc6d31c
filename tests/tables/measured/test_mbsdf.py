"""MDL's grid: fine enough where it can be, and a certificate that says where it is not."""

import json

import pytest

from measured_files import measured_spec, measured_table
from nacreous.formats.names import FormatName
from nacreous.tables.table import Table


def certificate(table: Table) -> dict[str, float]:
    """Return the figures of a table."""
    figures: dict[str, float] = json.loads(table.provenance["certificate"])
    return figures


@pytest.mark.parametrize("surface", ["ggx", "rough"])
def test_the_certificate_holds_what_a_host_is_promised(surface: str) -> None:
    """Along the lobe and through the film: some per cent at alpha 0.1, one of a broad lobe."""
    found = certificate(measured_table(measured_spec(surface, {"n": 1.5}), FormatName.MBSDF))
    slack = {"ggx": 3.0, "rough": 1.0}[surface]
    assert found["lobe_error_p90"] <= slack * 1e-2
    assert abs(found["lobe_energy_error"]) <= slack * 2e-3
    assert 0 < found["transmission_error_mean"] <= slack * 1e-2


def test_more_bins_are_taken_for_narrower_lobes() -> None:
    """Files grow only where they have to; what metal transmits has no error."""
    broad, narrow = (measured_table(measured_spec(name), FormatName.MBSDF) for name in ("rough", "ggx"))
    assert len(broad.values("theta_i")) < len(narrow.values("theta_i"))
    assert certificate(broad)["transmission_error_mean"] == 0
