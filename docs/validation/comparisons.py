"""All comparisons, in the order of the page."""

from typing import Any

from validation import (
    anodised_titanium,
    film_solver,
    gltf_iridescence,
    microfacets,
    morpho_wings,
    newton_series,
    silica_on_silicon,
)
from validation.comparison import Comparison


def comparisons() -> tuple[Comparison[Any], ...]:
    """Return every comparison."""
    return (
        silica_on_silicon.COMPARISON,
        anodised_titanium.COMPARISON,
        newton_series.COMPARISON,
        morpho_wings.COMPARISON,
        gltf_iridescence.COMPARISON,
        film_solver.COMPARISON,
        microfacets.COMPARISON,
    )
