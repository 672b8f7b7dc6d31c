"""What the tests of the comparisons share: each is measured once."""

from collections.abc import Callable
from functools import cache
from typing import Any

import pytest

from mitsuba_surface import VARIANTS, variant_fault
from validation.comparisons import comparisons

Measured = Callable[[str], Any]


@pytest.fixture(scope="session")
def measured() -> Measured:
    """Return what measures a comparison by its name; it skips where Mitsuba is needed and does not run."""
    known = {comparison.name: comparison for comparison in comparisons()}

    @cache
    def of(name: str) -> Any:  # noqa: ANN401 - each comparison has its own
        faults = [variant_fault(variant) for variant in VARIANTS] if name == "microfacets" else [""]
        if all(faults):
            pytest.skip(faults[-1])
        return known[name].measure()

    return of
