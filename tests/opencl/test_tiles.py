"""Launches in tiles: every row once, whatever the tiles' sizes, and the observer's say in it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nacreous.opencl import tiles
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import FilmProblem, Segment
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import empty_table, empty_tables, row_tiles


@given(rows=st.integers(1, 5000), evaluations=st.integers(1, 10**9), size=st.integers(1, 10**8))
def test_tiles_cover_every_row_once(rows: int, evaluations: int, size: int) -> None:
    """In order, without gap or overlap, and none is larger than its buffers may be."""
    told: list[float] = []
    covered = 0
    for tile in row_tiles(rows, evaluations, size, told.append):
        assert tile.origin == covered
        assert tile.rows * size <= max(size, 32 * 2**20)
        covered += tile.rows
    assert covered == rows
    assert told == sorted(told)
    assert told[-1] == 1


@given(rows=st.integers(1, 50), columns=st.integers(1, 50), precision=st.sampled_from(Precision))
def test_a_table_is_aligned_to_the_widest_lane(rows: int, columns: int, precision: Precision) -> None:
    """Sixteen lanes of double precision are 128 bytes, which a vector's load and store may rely on."""
    table = empty_table(rows, columns, precision.dtype)
    assert (table.shape, table.dtype) == ((rows, columns), np.dtype(precision.dtype))
    assert table.ctypes.data % 128 == 0
    assert table.flags.c_contiguous


def _problem() -> FilmProblem:
    return FilmProblem(
        wavelength_nm=np.linspace(400, 700, 37),
        index=np.array([1.0, 2.1 + 0.01j, 1.5])[:, None] * np.ones(37),
        segments=(Segment(0, 1, 1),),
        thickness_nm=np.linspace(100, 900, 7).reshape(7, 1, 1),
        weights=np.ones(1),
        cos_theta=np.linspace(0, 1, 11),
    )


@pytest.mark.parametrize("lanes", [1, 4])
@pytest.mark.parametrize("first", [1, 5_000, 10**9])
def test_results_do_not_depend_on_the_tiles(
    first: int, lanes: int, device: Device, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A row at a time, a few, or all at once: the same bytes, in place (1 lane) or with padding left."""
    whole = film_intensities(device, _problem(), Precision.SINGLE, lanes=lanes)
    monkeypatch.setattr(tiles, "_FIRST_TILE_EVALUATIONS", first)
    monkeypatch.setattr(tiles, "_MOST_GROWTH", 1)
    tiled = film_intensities(device, _problem(), Precision.SINGLE, lanes=lanes)
    for name, values in whole.items():
        assert values.tobytes() == tiled[name].tobytes()


def test_tables_of_one_piece_do_not_overlap() -> None:
    """Each keeps what is written to it, and begins where a lane may where its rows are whole lanes."""
    tables = empty_tables(3, 5, 16, np.float32)
    for mark, table in enumerate(tables):
        assert table.shape == (5, 16)
        assert table.ctypes.data % 64 == 0
        table[:] = mark
    assert [set(table.ravel()) for table in tables] == [{0}, {1}, {2}]
    assert all(table.base is not None for table in tables)


def test_what_an_observer_raises_ends_the_work(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """After the first tile, and the device works on."""
    monkeypatch.setattr(tiles, "_FIRST_TILE_EVALUATIONS", 1)
    told: list[float] = []

    def stop(fraction: float) -> None:
        told.append(fraction)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        film_intensities(device, _problem(), Precision.SINGLE, observer=stop)
    assert told == [1 / 77]
    assert np.isfinite(film_intensities(device, _problem(), Precision.SINGLE)["R_s"]).all()
