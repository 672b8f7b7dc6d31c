"""The byte budget."""

import numpy as np
import pytest

from nacreous.errors import BudgetError, SpecError
from nacreous.opencl.budget import byte_budget, require
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import FilmProblem, Segment
from nacreous.opencl.precision import Precision


@pytest.mark.parametrize(
    ("text", "size"),
    [("", 2 * 2**30), ("1000", 1000), ("500M", 500 * 2**20), ("4 GiB", 2**32), ("1kb", 1024)],
)
def test_sizes_are_read_with_their_units(text: str, size: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Plain bytes, or powers of 1024 by their letters."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", text)
    assert byte_budget() == size


@pytest.mark.parametrize("text", ["much", "-1", "0", "1.5G", "M"])
def test_what_is_no_size_is_refused(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message has the variable and the value."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", text)
    with pytest.raises(SpecError, match="NACREOUS_BYTE_BUDGET: expected a size"):
        byte_budget()


def test_the_budget_is_a_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    """As much as the budget passes, a byte more does not."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1M")
    require("a table", 2**20)
    with pytest.raises(BudgetError, match=r"a table needs 1\.0 MiB and the limit is 1\.0 MiB"):
        require("a table", 2**20 + 1)


def test_nothing_is_allocated_for_a_table_over_the_budget(device: Device) -> None:
    """A table of 4 TiB, which no machine here could hold, is refused at once and not attempted."""
    problem = FilmProblem(
        wavelength_nm=np.linspace(400, 700, 65_536),
        index=np.ones((3, 65_536), complex),
        segments=(Segment(0, 1, 1),),
        thickness_nm=np.ones((65, 1, 1)),
        weights=np.ones(1),
        cos_theta=np.linspace(0, 1, 65_536),
    )
    with pytest.raises(BudgetError) as refused:
        film_intensities(device, problem, Precision.SINGLE)
    assert refused.value.needed_bytes == 65 * 65_536 * 65_536 * 4 * 4
