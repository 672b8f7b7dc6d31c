"""The atlas, from its numbers alone; tests/formats/test_exr.py reads one as a renderer would."""

import numpy as np
import pytest

from nacreous.formats.atlas import LAYOUTS, Atlas, Axis, atlas_of
from nacreous.tables.spec import TableSpec


def axis(name: str, *samples: float) -> Axis:
    """Return an axis without a unit."""
    return Axis(name, "1", np.array(samples))


def test_every_quantity_has_a_layout() -> None:
    """What a spec can ask for can be laid out."""
    quantities = TableSpec.model_json_schema()["properties"]["quantity"]["enum"]
    assert sorted(LAYOUTS) == sorted(quantities)


def test_one_tile_is_the_array_itself() -> None:
    """Rows are y and columns x, both from their first value."""
    atlas = Atlas(x=axis("x", 0, 1, 2), y=axis("y", 0, 1))
    values = np.arange(6.0).reshape(2, 3, 1)
    np.testing.assert_array_equal(atlas.picture(values, ("y", "x", "c"))[..., 0], [[0, 1, 2], [3, 4, 5]])
    np.testing.assert_array_equal(
        atlas.picture(values.swapaxes(0, 1), ("x", "y", "c"))[..., 0], [[0, 1, 2], [3, 4, 5]]
    )
    assert set(atlas.described()) == {"axis.x", "axis.y"}


def test_tiles_lie_side_by_side_and_one_below_the_other() -> None:
    """Written out by hand: two tiles across, two down, each of two by two, the digits p q y x."""
    atlas = Atlas(axis("x", 0, 1), axis("y", 0, 1), across=(axis("p", 0, 1),), down=(axis("q", 0, 1),))
    digits = [np.arange(2).reshape(-1, *[1] * zeros) for zeros in (4, 3, 2, 1)]
    values = sum(digit * 10**place for digit, place in zip(digits, (3, 2, 1, 0), strict=True))
    picture = atlas.picture(values, ("p", "q", "y", "x", "c"))[..., 0]
    assert picture.astype(int).tolist() == [
        [0, 1, 1000, 1001],
        [10, 11, 1010, 1011],
        [100, 101, 1100, 1101],
        [110, 111, 1110, 1111],
    ]


def test_the_last_of_several_axes_changes_fastest() -> None:
    """Tiles down are numbered as the digits of a number are."""
    atlas = Atlas(axis("x", 0, 1), axis("y", 0, 1), down=(axis("a", 0, 1), axis("b", 0, 1, 2)))
    values = np.arange(6.0).reshape(2, 3, 1, 1, 1) * np.ones((1, 1, 2, 2, 1))
    assert atlas.picture(values, ("a", "b", "y", "x", "c"))[::2, 0, 0].tolist() == [0, 1, 2, 3, 4, 5]
    assert atlas.described()["tiles.y"]["count"] == 6
    assert atlas.described()["tiles.y"]["size"] == 2


@pytest.mark.parametrize("single", ["x", "y"])
def test_one_sample_has_two_equal_texels(single: str) -> None:
    """A picture of one row has no V, and renderers disagree on where it begins."""
    axes = {"x": axis("x", 0, 1, 2), "y": axis("y", 0, 1, 2)} | {single: axis(single, 7)}
    atlas = Atlas(axes["x"], axes["y"], down=(axis("q", 0, 1),))
    shape = [len(axes[name].samples) for name in "yx"]
    picture = atlas.picture(np.random.default_rng(1).random((2, *shape, 3)), ("q", "y", "x", "c"))
    assert picture.shape == ((6, 2, 3) if single == "x" else (4, 3, 3))
    halves = (picture[:, 0], picture[:, 1]) if single == "x" else (picture[::2], picture[1::2])
    np.testing.assert_array_equal(*halves)
    assert axes[single].described()["range"] == [7.0, 7.0]
    assert axes[single].described()["count"] == 2


@pytest.mark.parametrize(
    "samples", [(-np.pi, 0.0, np.pi), (-0.7, -0.6, -0.5, -0.4, -0.3, -0.2, -0.1, 0.0), (0.0, 0.5, 1.0)]
)
def test_even_axes_are_linear_whichever_end_is_zero(samples: tuple[float, ...]) -> None:
    """A shader then needs the ends alone."""
    described = axis("phi", *samples).described()
    assert described["mapping"] == "linear"
    assert "values" not in described


def test_an_isotropic_table_has_no_tiles_of_azimuth() -> None:
    """The layout leaves out what the table does not have."""
    names = ("roughness", "theta_i", "theta_o", "phi")
    atlas = atlas_of("bsdf", {name: axis(name, 0.1, 0.2) for name in names})
    assert [each.name for each in atlas.down] == ["roughness"]
