"""The lookup texture as OpenImageIO reads it: the library behind Blender, Houdini, Arnold and Cycles."""

import json
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO
import pytest

from analytic_tables import ALBEDO_AXES, BSDF_AXES, analytic_albedo, known
from nacreous.errors import FileFormatError
from nacreous.formats import exr
from nacreous.formats.registry import write
from nacreous.tables.spec import LABELS, Spec
from nacreous.tables.table import Table
from reference_colour import film_colour


def opened(path: Path) -> tuple[Any, np.ndarray]:
    """Return the only part's specification and its pixels."""
    image = OpenImageIO.ImageInput.open(str(path))
    assert image is not None, OpenImageIO.geterror()
    assert not image.seek_subimage(1, 0)  # one part, as Blender wants it
    image.seek_subimage(0, 0)
    spec, pixels = image.spec(), image.read_image("unknown")
    image.close()
    return spec, pixels


def test_is_one_part_of_three_float_channels_compressed_by_zip(table: Table, tmp_path: Path) -> None:
    """The rules that every renderer can load: RGB, float32, ZIP, scan lines."""
    exr.write(table, tmp_path / "film.exr")
    spec, _ = opened(tmp_path / "film.exr")
    assert spec.channelnames == ("R", "G", "B") or list(spec.channelnames) == ["R", "G", "B"]
    assert str(spec.format) == "float"
    assert spec.getattribute("compression") == "zip"
    assert spec.tile_width == 0


def test_says_nothing_of_primaries(table: Table, tmp_path: Path) -> None:
    """Mitsuba converts pixels of a file with chromaticities even where it is told that they are raw."""
    exr.write(table, tmp_path / "film.exr")
    spec, _ = opened(tmp_path / "film.exr")
    assert spec.getattribute("chromaticities") is None


@pytest.mark.parametrize(("suffix", "name"), [(".exr", "R_rgb"), (".transmission.exr", "T_rgb")])
def test_keeps_every_value_in_place(table: Table, tmp_path: Path, suffix: str, name: str) -> None:
    """Columns are cos_theta from the left, rows thickness_scale from the top; nothing is rounded."""
    exr.write(table, tmp_path / "film.exr")
    _, pixels = opened(tmp_path / f"film{suffix}")
    np.testing.assert_array_equal(pixels, table.values(name))


def test_the_film_of_figure_3_has_the_colour_of_an_independent_integral(table: Table, tmp_path: Path) -> None:
    """Third row, last texel: scale 1, normal incidence.

    The integral is colour-science's over the film of equation 1 (Wu & Zheng 2015), from 360 to 830 nm; the
    table's is from 380 to 780 nm, beyond which 0.1 % of the light lies.
    """
    exr.write(table, tmp_path / "film.exr")
    _, pixels = opened(tmp_path / "film.exr")
    expected = film_colour(np.array([1.000277, 2.0, 1.5]), np.array([420.0]), 1.0)
    np.testing.assert_allclose(pixels[2, -1], expected, atol=1e-3)


def test_keeps_its_provenance(table: Table, tmp_path: Path) -> None:
    """A reader finds the id, the version, the certificate and the complete spec, and can ask for it again."""
    exr.write(table, tmp_path / "film.exr")
    spec, _ = opened(tmp_path / "film.exr")
    assert spec.getattribute("nacreous:id") == table.id
    assert spec.getattribute("nacreous:version") == table.provenance["version"]
    assert json.loads(spec.getattribute("nacreous:certificate")) == table.certificate
    unlabelled = table.spec.model_copy(update=dict.fromkeys(LABELS, ""))
    assert Spec.model_validate_json(spec.getattribute("nacreous:spec")) == unlabelled
    assert spec.getattribute("nacreous:colour.space") == "Rec.709"


def test_describes_even_axes_by_their_ends(table: Table, tmp_path: Path) -> None:
    """The texel of value v is (v - first) / (last - first) (count - 1), as the contract of clients says."""
    exr.write(table, tmp_path / "film.exr")
    spec, _ = opened(tmp_path / "film.exr")
    assert json.loads(spec.getattribute("nacreous:axis.x")) == {
        "name": "cos_theta", "unit": "1", "range": [0.0, 1.0], "count": 9, "mapping": "linear"
    }  # fmt: skip
    assert json.loads(spec.getattribute("nacreous:axis.y")) == {
        "name": "thickness_scale", "unit": "1", "range": [0.5, 1.5], "count": 5, "mapping": "linear"
    }  # fmt: skip


def test_lists_the_values_of_uneven_axes(tabulated: Callable[..., Table], tmp_path: Path) -> None:
    """An axis given as a list keeps its own values: texels are samples at them."""
    exr.write(tabulated(thickness_scale=[0.8, 1.0, 1.2, 1.35]), tmp_path / "film.exr")
    spec, _ = opened(tmp_path / "film.exr")
    axis = json.loads(spec.getattribute("nacreous:axis.y"))
    assert axis["mapping"] == "explicit"
    assert axis["values"] == [0.8, 1.0, 1.2, 1.35]


def test_repeats_the_row_of_a_single_thickness(one_thickness: Table, tmp_path: Path) -> None:
    """Renderers disagree on where V = 0 is; with two equal rows all of them read the same."""
    exr.write(one_thickness, tmp_path / "film.exr")
    spec, pixels = opened(tmp_path / "film.exr")
    np.testing.assert_array_equal(pixels, np.repeat(one_thickness.values("R_rgb"), 2, axis=0))
    assert json.loads(spec.getattribute("nacreous:axis.y"))["range"] == [1.0, 1.0]
    assert json.loads(spec.getattribute("nacreous:axis.y"))["count"] == 2


def test_an_opaque_substrate_has_no_transmission(opaque: Table, tmp_path: Path) -> None:
    """No light comes through silver, so there is nothing to write."""
    assert exr.write(opaque, tmp_path / "film.exr") == (tmp_path / "film.exr",)
    assert [path.name for path in tmp_path.iterdir()] == ["film.exr"]


def test_names_the_channels_of_xyz_so(tabulated: Callable[..., Table], tmp_path: Path) -> None:
    """A viewer would show channels R, G, B as RGB, which XYZ is not."""
    table = tabulated(colour={"space": "XYZ"})
    exr.write(table, tmp_path / "film.exr")
    spec, pixels = opened(tmp_path / "film.exr")
    assert list(spec.channelnames) == ["X", "Y", "Z"]
    np.testing.assert_array_equal(pixels[:1], table.values("R_rgb"))


def test_refuses_a_table_without_colours(infrared: Table, tmp_path: Path) -> None:
    """Nobody sees the infrared; the message names what is missing."""
    with pytest.raises(FileFormatError, match="R_rgb"):
        exr.write(infrared, tmp_path / "film.exr")
    assert list(tmp_path.iterdir()) == []


# ---- rough surfaces ----------------------------------------------------------------------------------------

ONE_TILE = '{"axes": [], "size": 0}'


def texel(spec: OpenImageIO.ImageSpec, sample: dict[str, float]) -> tuple[int, int]:
    """Return row and column of a sample as clients/README.md tells a shader to find them."""
    row, column = (_texel_along(spec, side, sample) for side in "yx")
    return row, column


def _texel_along(spec: OpenImageIO.ImageSpec, side: str, sample: dict[str, float]) -> int:
    tiles = json.loads(spec.getattribute(f"nacreous:tiles.{side}") or ONE_TILE)
    tile = 0
    for axis in tiles["axes"]:
        tile = tile * len(axis["values"]) + axis["values"].index(sample[axis["name"]])
    axis = json.loads(spec.getattribute(f"nacreous:axis.{side}"))
    return tile * tiles["size"] + _texel_inside(axis, sample[axis["name"]])


def _texel_inside(axis: dict[str, Any], value: float) -> int:
    if axis["mapping"] == "explicit":
        return axis["values"].index(value)
    first, last = axis["range"]
    return round((value - first) / ((last - first) or 1) * (axis["count"] - 1))


@pytest.mark.parametrize(("suffix", "name"), [(".exr", "E_r"), (".transmission.exr", "E_t")])
def test_an_albedo_is_over_angle_and_roughness(albedo: Table, tmp_path: Path, suffix: str, name: str) -> None:
    """Every sample is where the attributes say: a tile for each thickness, the first at the top."""
    exr.write(albedo, tmp_path / "film.exr")
    spec, pixels = opened(tmp_path / f"film{suffix}")
    assert pixels.shape == (3 * 4, 5, 3)
    assert spec.getattribute("nacreous:quantity") == name
    for values in product(*ALBEDO_AXES.values()):
        sample = dict(zip(ALBEDO_AXES, values, strict=True))
        expected = [known(f"{name}_rgb", **sample, channel=channel) for channel in range(3)]
        np.testing.assert_allclose(pixels[texel(spec, sample)], expected, rtol=1e-6)


def test_an_albedo_of_one_roughness_has_two_equal_rows(tmp_path: Path) -> None:
    """As a film of one thickness has, and for the same reason."""
    table = analytic_albedo(roughness=[0.2], thickness_scale=[0.9, 1.1])
    exr.write(table, tmp_path / "film.exr")
    spec, pixels = opened(tmp_path / "film.exr")
    assert pixels.shape == (4, 5, 3)
    np.testing.assert_array_equal(pixels[::2], pixels[1::2])
    assert json.loads(spec.getattribute("nacreous:axis.y"))["count"] == 2
    assert json.loads(spec.getattribute("nacreous:tiles.y")) == {
        "axes": [{"name": "thickness_scale", "unit": "1", "values": [0.9, 1.1]}], "count": 2, "size": 2
    }  # fmt: skip


@pytest.mark.parametrize(("suffix", "name"), [(".exr", "f_r"), (".transmission.exr", "f_t")])
def test_a_bsdf_is_an_atlas(bsdf: Table, tmp_path: Path, suffix: str, name: str) -> None:
    """Every sample of seven axes is where the attributes say."""
    exr.write(bsdf, tmp_path / "film.exr")
    spec, pixels = opened(tmp_path / f"film{suffix}")
    assert pixels.shape == (2 * 3 * 3, 5 * 4, 3)
    for values in product(*BSDF_AXES.values()):
        sample = dict(zip(BSDF_AXES, values, strict=True))
        expected = [known(f"{name}_rgb", **sample, channel=channel) for channel in range(3)]
        np.testing.assert_allclose(pixels[texel(spec, sample)], expected, rtol=1e-6)


def test_a_bsdf_describes_its_tiles(bsdf: Table, tmp_path: Path) -> None:
    """Names, values and units, how many tiles there are, and how many texels each has."""
    exr.write(bsdf, tmp_path / "film.exr")
    spec, _ = opened(tmp_path / "film.exr")
    assert json.loads(spec.getattribute("nacreous:axis.x")) == {
        "name": "theta_o", "unit": "rad", "range": [0.0, 1.2], "count": 4, "mapping": "linear"
    }  # fmt: skip
    assert json.loads(spec.getattribute("nacreous:tiles.x")) == {
        "axes": [{"name": "phi", "unit": "rad", "values": [-3.0, -1.5, 0.0, 1.5, 3.0]}], "count": 5, "size": 4
    }  # fmt: skip
    down = json.loads(spec.getattribute("nacreous:tiles.y"))
    assert [axis["name"] for axis in down["axes"]] == ["roughness", "phi_i"]
    assert (down["count"], down["size"]) == (6, 3)


def test_linear_filtering_never_reaches_the_next_tile(albedo: Table, tmp_path: Path) -> None:
    """Between the centres of a tile's first and last texel, bilinear weights elsewhere are 0."""
    exr.write(albedo, tmp_path / "film.exr")
    _, pixels = opened(tmp_path / "film.exr")
    texels = OpenImageIO.ImageBuf(pixels)
    for tile, scale in enumerate(ALBEDO_AXES["thickness_scale"]):
        for roughness, row in ((0.1, 0), (0.5, 3)):
            v = tile * 4 + row + 0.5
            found = texels.interppixel(0.5, v)
            expected = known("E_r_rgb", roughness=roughness, thickness_scale=scale, cos_theta=0, channel=0)
            assert found[0] == pytest.approx(expected, rel=1e-6)


def test_an_all_but_smooth_albedo_has_the_colour_of_the_film(computed_albedo: Table, tmp_path: Path) -> None:
    """At alpha 0.02 light meets facets within a few degrees of the surface (Wu & Zheng 2015, figure 3).

    The integral is colour-science's over the film of equation 1, at normal incidence and scale 1.
    """
    exr.write(computed_albedo, tmp_path / "film.exr")
    spec, pixels = opened(tmp_path / "film.exr")
    at = texel(spec, {"roughness": 0.02, "thickness_scale": 1.0, "cos_theta": 1.0})
    expected = film_colour([1.000277, 2.0, 1.5], [420.0], 1.0)
    np.testing.assert_allclose(pixels[at], expected, atol=2e-3)


def test_the_transmission_of_another_film_is_not_removed(
    opaque: Table, one_thickness: Table, tmp_path: Path
) -> None:
    """film.transmission.exr goes with film.exr where it holds T; the R of a film of that name stays."""
    write(opaque, tmp_path / "film.transmission.exr", "exr")
    write(opaque, tmp_path / "film.exr")
    assert (tmp_path / "film.transmission.exr").exists()
    write(one_thickness, tmp_path / "other.exr")
    write(opaque, tmp_path / "other.exr")
    assert not (tmp_path / "other.transmission.exr").exists()
