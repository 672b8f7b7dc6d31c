"""The picture as Pillow reads it."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from analytic_tables import known
from nacreous.formats import png
from nacreous.formats.srgb import encoded, out_of_gamut
from nacreous.tables.rec709 import rec709
from nacreous.tables.table import Table


def picture(path: Path) -> tuple[np.ndarray, dict[str, str]]:
    """Return the pixels and the text chunks."""
    with Image.open(path) as image:
        assert image.mode == "RGB"
        return np.asarray(image), dict(image.text)


def test_has_the_size_and_the_provenance_of_the_lookup_texture(table: Table, tmp_path: Path) -> None:
    """X is cos_theta, y thickness_scale; the text chunks say what it is, in any script."""
    assert [path.name for path in png.write(table, tmp_path / "film.png")] == [
        "film.png",
        "film.transmission.png",
    ]
    pixels, texts = picture(tmp_path / "film.png")
    assert pixels.shape == (5, 9, 3)
    assert texts["nacreous:id"] == table.id
    assert texts["nacreous:spec"] == table.provenance["spec"]
    assert 0 <= float(texts["nacreous:gamut.outside"]) <= 1


def test_grazing_light_is_white(table: Table, tmp_path: Path) -> None:
    """At cos_theta = 0 every film reflects everything, and white is 255 in sRGB (IEC 61966-2-1)."""
    png.write(table, tmp_path / "film.png")
    pixels, _ = picture(tmp_path / "film.png")
    assert (pixels[:, 0] == 255).all()


def test_srgb_has_the_values_of_the_standard() -> None:
    """IEC 61966-2-1:1999: the linear part below 0.0031308, and 18 % grey at 118."""
    linear = np.array([0.0, 0.0031308, 0.18, 0.5, 1.0])
    np.testing.assert_array_equal(
        encoded(linear), np.rint(255 * np.array([0, 0.0404482, 0.4613561, 0.7353569, 1]))
    )


def test_colours_out_of_the_gamut_are_clipped_and_counted() -> None:
    """Clipping keeps the bytes in range; one of the two colours is outside."""
    colours = np.array([[0.2, -0.1, 1.3], [0.2, 0.1, 0.3]])
    assert encoded(colours)[0].tolist() == [124, 0, 255]
    assert out_of_gamut(colours) == 0.5


def test_other_spaces_show_the_same_colours(tabulated: Callable[..., Table]) -> None:
    """A space is a way to write a colour down: the film looks the same in all of them."""
    expected = tabulated().values("R_rgb")
    for space in ("ACEScg", "Rec.2020", "XYZ"):
        table = tabulated(colour={"space": space})
        np.testing.assert_allclose(rec709(table.values("R_rgb"), table.spec.colour), expected, atol=1e-3)


def test_a_rough_surface_has_the_atlas_of_the_exr(albedo: Table, bsdf: Table, tmp_path: Path) -> None:
    """The first tile's last texel: 1 / (2.9 + 0.5 + 0.8 x 0.31 + 0.17), in sRGB (IEC 61966-2-1)."""
    png.write(albedo, tmp_path / "albedo.png")
    pixels, texts = picture(tmp_path / "albedo.transmission.png")
    assert pixels.shape == (3 * 4, 5, 3)
    assert texts["nacreous:quantity"] == "E_t"
    linear = known("E_t_rgb", roughness=0.5, thickness_scale=0.8, cos_theta=1, channel=0)
    assert pixels[3, 4, 0] == round(255 * (1.055 * linear ** (1 / 2.4) - 0.055))
    png.write(bsdf, tmp_path / "bsdf.png")
    pixels, texts = picture(tmp_path / "bsdf.png")
    assert pixels.shape == (2 * 3 * 3, 5 * 4, 3)
    assert {"nacreous:tiles.x", "nacreous:tiles.y"} <= texts.keys()


def test_an_all_but_smooth_surface_looks_like_its_film(
    computed_albedo: Table, one_thickness: Table, tmp_path: Path
) -> None:
    """Head on, at scale 1: roughness 0.02 is the first row of the second tile; two steps of 8 bits apart."""
    png.write(computed_albedo, tmp_path / "rough.png")
    png.write(one_thickness, tmp_path / "smooth.png")
    rough, smooth = (picture(tmp_path / f"{name}.png")[0].astype(int) for name in ("rough", "smooth"))
    assert np.abs(rough[2, -1] - smooth[0, -1]).max() <= 2
