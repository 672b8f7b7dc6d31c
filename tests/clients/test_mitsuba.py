"""The BSDF plugin for Mitsuba: what it reads from a table, and what it refuses."""

from pathlib import Path

import numpy as np
import pytest

from lut_contract import CONTRACT_SPEC, POINTS, LookupTexture
from mitsuba_plugin import (
    VARIANTS,
    WAVELENGTHS_NM,
    FloatArray,
    array,
    context,
    direction,
    film,
    interaction,
    table_file,
    use_variant,
)
from nacreous.optics.library import library_material

GRAZING = 1e-6
"""Mitsuba's dielectrics leave out the cosine 0 itself, and so does the plugin."""
UNEVEN_SPEC = {
    **CONTRACT_SPEC,
    "table": {
        **CONTRACT_SPEC["table"],
        "wavelength_nm": [390, 430, 500, 600, 780],
        "cos_theta": [0.0, 0.1, 0.3, 0.65, 1.0],
        "thickness_scale": [0.5, 0.6, 1.1, 1.5],
    },
}
"""The contract's film, sampled at places of unequal distance."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the tables."""
    return tmp_path_factory.mktemp("mitsuba")


def expected(file: Path, cos_theta: float, thickness_scale: float) -> FloatArray:
    """Look a texel up in NumPy: a colour, or a spectrum at `WAVELENGTHS_NM`."""
    texture = LookupTexture.read(file)
    values = texture.at(np.array([cos_theta]), np.array([thickness_scale]))[0]
    if ".spectral." not in file.name:
        return values
    return np.interp(WAVELENGTHS_NM, wavelengths_nm(file), values[3:])


def wavelengths_nm(file: Path) -> FloatArray:
    """Return those of a spectral texture, in the order of its channels, after the preview's three."""
    import OpenImageIO

    names = OpenImageIO.ImageInput.open(str(file)).spec().channelnames[3:]
    return np.array([float(name.removeprefix("T.").removesuffix("nm").replace(",", ".")) for name in names])


def companion(file: Path) -> Path:
    """Return the file of T."""
    stem, dot, rest = file.name.partition(".")
    return file.with_name(f"{stem}.transmission{dot}{rest}")


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize(("name", "spec"), [("film", CONTRACT_SPEC), ("uneven", UNEVEN_SPEC)])
def test_a_smooth_film_is_the_table(name: str, spec: dict[str, object], variant: str, folder: Path) -> None:
    """R and T at the contract's points are its lookup in NumPy, with linear or explicit axes."""
    use_variant(variant)
    file = table_file(folder, variant, spec, name)
    for cos_theta, scale in np.maximum(POINTS, GRAZING):
        bsdf = film(file, thickness_scale=float(scale))
        for component, texture in enumerate((file, companion(file))):
            ctx = context("Importance", component)
            weight = bsdf.sample(ctx, interaction(direction(cos_theta)), 0.5, [0.5, 0.5])[1]
            np.testing.assert_allclose(
                array(weight).ravel(), expected(texture, cos_theta, scale), rtol=0, atol=2e-5
            )


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral"])
def test_a_texture_chooses_the_row(variant: str, folder: Path) -> None:
    """At (u, v) of a surface a bitmap's texel is the thickness scale: here two texels side by side."""
    use_variant(variant)
    import mitsuba as mi

    file = table_file(folder, variant, CONTRACT_SPEC)
    scales = mi.Bitmap(np.array([[[0.61], [1.37]]], np.float32))
    texture = {"type": "bitmap", "bitmap": scales, "raw": True, "filter_type": "nearest"}
    si = interaction(np.array([direction(0.7)] * 2))
    si.uv = mi.Point2f([0.25, 0.75], [0.5, 0.5])
    ctx = context("Importance", 0)
    weight = film(file, thickness_scale=texture).sample(ctx, si, 0.5, [0.5, 0.5])[1]
    np.testing.assert_allclose(
        array(weight), [expected(file, 0.7, 0.61), expected(file, 0.7, 1.37)], rtol=0, atol=2e-5
    )


@pytest.mark.parametrize("variant", VARIANTS)
def test_tints_multiply_the_lobes(variant: str, folder: Path) -> None:
    """The weight of a lobe is proportional to its tint."""
    use_variant(variant)
    file = table_file(folder, variant, CONTRACT_SPEC)
    tinted = film(file, specular_reflectance=0.25, specular_transmittance=0.5)
    for component, tint in ((0, 0.25), (1, 0.5)):
        arguments = context("Radiance", component), interaction(direction(0.6)), 0.5, [0.5, 0.5]
        plain = array(film(file).sample(*arguments)[1])
        np.testing.assert_allclose(array(tinted.sample(*arguments)[1]), tint * plain, rtol=1e-5)


def test_the_thickness_is_differentiable(folder: Path) -> None:
    """The derivative of a colour by the thickness scale is the slope between two rows of the table."""
    use_variant("llvm_ad_rgb")
    import drjit as dr
    import mitsuba as mi

    file = table_file(folder, "llvm_ad_rgb", CONTRACT_SPEC)
    bsdf = film(file, thickness_scale=1.07)
    parameters = mi.traverse(bsdf)
    scale = parameters["thickness_scale.value"]
    dr.enable_grad(scale)
    parameters.update()
    weight = bsdf.sample(context("Importance", 0), interaction(direction(0.8)), 0.5, [0.5, 0.5])[1]
    dr.forward(scale)
    slope = (expected(file, 0.8, 1.12) - expected(file, 0.8, 1.01)) / 0.11
    np.testing.assert_allclose(array(dr.grad(weight)).ravel(), slope, rtol=1e-3)


def test_without_a_file_of_t_a_film_is_opaque(folder: Path) -> None:
    """One lobe and one side, as Mitsuba's conductors have; `twosided` shows the same from behind."""
    use_variant("llvm_ad_rgb")
    import mitsuba as mi

    (folder / "opaque").mkdir()
    file = table_file(folder / "opaque", "llvm_ad_rgb", CONTRACT_SPEC)
    companion(file).unlink()
    bsdf = film(file, int_ior=1.5)  # as in the scene that had the file of T
    assert bsdf.component_count() == 1
    above, below = interaction(direction(0.7)), interaction(direction(-0.7))
    front, back = (array(bsdf.sample(context(), si, 0.5, [0.5, 0.5])[1]) for si in (above, below))
    assert (front > 0).all()
    assert (back == 0).all()
    nested = mi.load_dict({"type": "twosided", "film": {"type": "nacreous", "filename": str(file)}})
    np.testing.assert_array_equal(array(nested.sample(context(), below, 0.5, [0.5, 0.5])[1]), front)


# ---- what it refuses ---------------------------------------------------------------------------------------


def refusal(file: Path, **parameters: object) -> str:
    """Return why the plugin does not load."""
    with pytest.raises(RuntimeError) as refused:
        film(file, **parameters)
    return str(refused.value)


def test_colours_are_refused_in_a_spectral_variant(folder: Path) -> None:
    """A colour stands for no spectrum; the message names the format to write instead."""
    use_variant("scalar_spectral")
    assert "--format spectral-exr" in refusal(table_file(folder, "scalar_rgb", CONTRACT_SPEC))


def test_spectra_are_refused_in_an_rgb_variant(folder: Path) -> None:
    """The message names the format to write instead."""
    use_variant("scalar_rgb")
    assert "--format exr" in refusal(table_file(folder, "scalar_spectral", CONTRACT_SPEC))


def test_colours_of_another_space_are_refused(folder: Path) -> None:
    """Mitsuba's RGB is Rec.709."""
    use_variant("scalar_rgb")
    spec = {**CONTRACT_SPEC, "colour": {"space": "ACEScg"}}
    assert "colour.space = Rec.709" in refusal(table_file(folder, "scalar_rgb", spec, "aces"))


def test_an_albedo_is_refused(folder: Path) -> None:
    """E_r of a rough surface looks like R, but is not what one facet reflects."""
    use_variant("scalar_rgb")
    table = {**CONTRACT_SPEC["table"], "quantity": "albedo", "cos_theta": 3, "roughness": [0.1, 0.2]}
    spec = {**CONTRACT_SPEC, "table": table | {"thickness_scale": 1.0}, "surface": {"distribution": "ggx"}}
    assert "table.quantity = fresnel" in refusal(table_file(folder, "scalar_rgb", spec, "albedo"))


def test_an_unknown_index_is_asked_for(folder: Path) -> None:
    """A dispersive substrate refracts at the index that the user gives, and at none before."""
    use_variant("scalar_rgb")
    spec = {**CONTRACT_SPEC, "stack": {**CONTRACT_SPEC["stack"], "substrate": "bk7"}}
    file = table_file(folder, "scalar_rgb", spec, "on-bk7")
    assert "int_ior" in refusal(file)
    assert film(file, int_ior=1.52).component_count() == 2


def test_rough_equal_media_are_refused(folder: Path) -> None:
    """Facets between equal indices bend nothing: f_t has no density, only a direction."""
    use_variant("scalar_rgb")
    file = table_file(folder, "scalar_rgb", CONTRACT_SPEC)
    assert "equal" in refusal(file, int_ior=1.3, ext_ior=1.3, alpha=0.1)
    assert film(file, int_ior=1.3, ext_ior=1.3).component_count() == 2


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"alpha": 0.1, "distribution": "phong"}, "ggx or beckmann"),
        ({"alpha_u": 0.1}, "alpha_v"),
        ({"alpha": 0.1, "alpha_u": 0.1, "alpha_v": 0.1}, "unreferenced"),
        ({"int_ior": -1.5}, "above 0"),
    ],
)
def test_parameters_without_meaning_are_refused(
    parameters: dict[str, object], message: str, folder: Path
) -> None:
    """The message says what was expected."""
    use_variant("scalar_rgb")
    assert message in refusal(table_file(folder, "scalar_rgb", CONTRACT_SPEC), **parameters)


def test_polarised_variants_are_refused() -> None:
    """A table of R has no Mueller matrix; the message names the format that has."""
    use_variant("scalar_rgb")
    import mitsuba as mi
    import nacreous_bsdf

    mi.set_variant("scalar_spectral_polarized")
    with pytest.raises(ValueError, match=r"\.pbsdf"):
        nacreous_bsdf.register()


def test_the_plugin_knows_the_library_s_constants() -> None:
    """Vacuum and air have the index that Nacreous's library has for them."""
    use_variant("scalar_rgb")
    import nacreous_bsdf

    known = nacreous_bsdf.CONSTANT_INDEX
    assert {name: library_material(name).model.n for name in known} == known
