"""What the tests against renderers may ask for."""

import pytest

from mitsuba_surface import VARIANTS, variant_fault


@pytest.fixture(params=VARIANTS)
def mitsuba_variant(request: pytest.FixtureRequest) -> str:
    """Choose each of Mitsuba's variants in turn; skip, with the reason, what does not run here."""
    variant: str = request.param
    if fault := variant_fault(variant):
        pytest.skip(fault)
    import mitsuba

    mitsuba.set_variant(variant)
    return variant
