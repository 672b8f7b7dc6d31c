"""Albedo tables against brute-force Monte Carlo of equation 12 in double precision, at random points."""

from dataclasses import dataclass
from itertools import cycle, islice
from typing import Any

import numpy as np
import pytest
from scipy.stats import binom, t

from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table
from reference_facets import FloatArray, Surface
from reference_surface import REPLICATES, Albedo, Coating, monte_carlo_albedo

POINTS = 200
SIGMA = 1e-3
TRIED, MOST_SAMPLES = 2**13, 2**18
"""Directions of the first try; the scatter falls with the power 2/3 of their number, or faster."""

MASKINGS = ("v-cavity", "smith", "smith-separable")
KINDS = [(d, m) for m in MASKINGS for d in ("ashikhmin-shirley", "ggx", "blinn", "beckmann")]
KINDS.append(("phong", "v-cavity"))
ANISOTROPIC = ("ashikhmin-shirley", "ggx", "beckmann")

FILMS: tuple[tuple[list[complex], list[float]], ...] = (
    ([1.0, 2.0, 1.5], [420.0]),  # the paper's figures 3 to 5
    ([1.0, 2.4, 2.7 + 3.7j], [120.0]),  # an oxide on its metal
    ([1.0, 2.3, 1.38, 2.3, 1.5], [60.0, 100.0, 60.0]),  # a dielectric mirror
    ([1.5, 2.0 + 0.05j, 1.0], [300.0]),  # into a thinner medium: total reflection
    ([1.0, 0.2 + 3.5j, 1.33], [15.0]),  # a metal that lets light through
)
"""Index from the incident medium inwards, thickness in nm."""


@dataclass(frozen=True)
class Case:
    """A table of few samples, each of them a random place of its axis."""

    kind: tuple[str, str]
    film: tuple[list[complex], list[float]]
    ratio: float
    roughness: FloatArray
    cos_theta: FloatArray
    wavelength_nm: FloatArray

    def spec(self) -> Spec:
        """Write the case as a user would."""
        index, thickness_nm = self.film
        layers = [
            {"material": material(n), "thickness_nm": d}
            for n, d in zip(index[1:-1], thickness_nm, strict=True)
        ]
        distribution, masking = self.kind
        return Spec.model_validate(
            {
                "stack": {"incident": material(index[0]), "substrate": material(index[-1]), "layers": layers},
                "surface": {
                    "distribution": distribution,
                    "masking": masking,
                    "alpha_x": 0.3 * self.ratio**0.5,
                    "alpha_y": 0.3 / self.ratio**0.5,
                },
                "table": {
                    "quantity": "albedo",
                    "roughness": self.roughness.tolist(),
                    "cos_theta": self.cos_theta.tolist(),
                    "wavelength_nm": self.wavelength_nm.tolist(),
                },
            }
        )

    def brute_force(self, r: int, a: int, w: int, seed: int) -> Albedo:
        """Evaluate one sample with as many directions as `SIGMA` takes, by what a first try scatters.

        The try's own result is left out: to stop where the scatter happens to be small would make it so.
        """
        stretch = self.ratio**0.5
        surface = Surface(
            self.kind[0], self.roughness[r] * stretch, self.roughness[r] / stretch, self.kind[1]
        )
        index, thickness_nm = self.film
        coating = Coating(np.array(index)[:, None] + 0j, np.array(thickness_nm), self.wavelength_nm[[w]])
        first = monte_carlo_albedo(surface, coating, self.cos_theta[a], TRIED, seed)
        excess = max(first.sigma_r[0], first.sigma_t[0]) / (0.6 * SIGMA)
        samples = min(int(TRIED * max(1, excess**1.5)), MOST_SAMPLES)
        return monte_carlo_albedo(surface, coating, self.cos_theta[a], samples, seed + 1)


def material(n: complex) -> dict[str, Any]:
    """Write a constant index as a spec does."""
    return {"n": n.real, "k": n.imag} if np.imag(n) else {"n": n.real}


def cases(count: int, rng: np.random.Generator) -> list[Case]:
    """Draw tables of every kind in turn, with three samples on each axis."""
    drawn = []
    for kind in islice(cycle(KINDS), count):
        ratio = float(rng.choice([1.0, 3.0])) if kind[0] in ANISOTROPIC else 1.0
        roughness = np.sort(np.exp(rng.uniform(np.log(0.02), np.log(0.55), 3)))
        film = FILMS[rng.integers(len(FILMS))]
        axes = np.sort(rng.uniform(0.05, 1, 3)), np.sort(rng.uniform(380, 780, 3))
        drawn.append(Case(kind, film, ratio, roughness, *axes))
    return drawn


def deviations(case: Case, table: Table, points: int, rng: np.random.Generator) -> FloatArray:
    """Compare E_r and E_t at random samples: (points, 2, 3) of table, brute force, standard error."""
    rows = []
    for r, a, w in rng.integers(0, 3, (points, 3)):
        expected = case.brute_force(r, a, w, seed=int(rng.integers(2**31)))
        got_r, got_t = (float(table.values(name)[r, 0, a, w]) for name in ("E_r", "E_t"))
        rows.append(
            [(got_r, expected.E_r[0], expected.sigma_r[0]), (got_t, expected.E_t[0], expected.sigma_t[0])]
        )
    return np.array(rows)


@pytest.fixture(scope="module")
def compared() -> FloatArray:
    """All points, (200, 2, 3)."""
    rng = np.random.default_rng(20150313)
    return np.concatenate(
        [
            deviations(case, tabulate_table(case.spec(), parts=[Part.SPECTRUM]), 10, rng)
            for case in cases(POINTS // 10, rng)
        ]
    )


def test_brute_force_is_sharp_enough(compared: FloatArray) -> None:
    """A standard error of at most 0.001 at every one of the 200 points."""
    assert compared.shape == (POINTS, 2, 3)
    assert compared[..., 2].max() <= SIGMA


@pytest.mark.parametrize("side", [0, 1], ids=["reflected", "transmitted"])
def test_tables_lie_within_three_standard_errors(compared: FloatArray, side: int) -> None:
    """Right values scatter by Student's t of 31 degrees of freedom, which exceeds 3 once in 190 points.

    So many points beyond 3 are allowed as a binomial law has with a chance of at least 0.1 %; none beyond 5.
    A point that scatters by less than rounding and the quadrature's own error, 2e-4, counts as within.
    """
    got, expected, sigma = np.moveaxis(compared[:, side], -1, 0)
    shines = expected > 0
    assert (got[~shines] == 0).all()
    distance = np.maximum(np.abs(got - expected) - 2e-4, 0)[shines] / np.maximum(sigma[shines], 1e-9)
    chance = 2 * t.sf(3, REPLICATES - 1)
    assert (distance > 3).sum() <= binom.isf(1e-3, shines.sum(), chance)
    assert distance.max() <= 5
