"""Presets: complete, cited, computable, and right where a textbook says what they must show."""

from pathlib import Path

import numpy as np
import pytest
import tmm

from nacreous.errors import SpecError
from nacreous.optics.stack import sample_stack
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.presets import load, preset, preset_names
from nacreous.tables.spec import Spec, roughness_values, surface_of

PROMISED = [
    "soap-bubble", "oil-on-water", "anodised-titanium", "tempered-steel", "coated-lens", "dichroic",
    "silica-on-silicon", "beetle", "nacre", "morpho", "morpho-ridges", "paper/figure-3", "paper/figure-4",
    "paper/figure-5", "paper/figure-6", "paper/figure-7", "paper/figure-8", "paper/figure-9",
]  # fmt: skip


def reflectance(name: str, wavelength_nm: np.ndarray, thickness_scale: float = 1.0) -> np.ndarray:
    """R at normal incidence by tmm (Byrnes 2016), with groups written out."""
    sampled = sample_stack(preset(name).stack, wavelength_nm)
    order = list(range(sampled.thickness_nm.size))
    for group in reversed(sampled.groups):
        order[group.first : group.stop] = order[group.first : group.stop] * group.repeat
    thickness_nm = [np.inf, *(sampled.thickness_nm[order] * thickness_scale), np.inf]
    rows = [0, *(position + 1 for position in order), -1]
    spectrum = zip(sampled.index[rows].T, wavelength_nm, strict=True)
    return np.array([tmm.coh_tmm("s", list(n), thickness_nm, 0, nm)["R"] for n, nm in spectrum])


def test_every_promised_preset_is_there() -> None:
    """The list that the documentation promises."""
    assert set(PROMISED) <= set(preset_names())


@pytest.mark.parametrize("name", preset_names())
def test_a_preset_is_complete(name: str) -> None:
    """It has a name, a description and a source, and all of its materials reach all of its wavelengths."""
    spec = preset(name)
    assert min(len(spec.name), len(spec.description), len(spec.source)) > 3
    wavelength_nm = wavelength_values_nm(spec.table.wavelength_nm)
    assert np.isfinite(sample_stack(spec.stack, wavelength_nm).index).all()
    assert 64 <= cos_theta_values(spec.table.cos_theta).size <= 256
    assert thickness_scale_values(spec.table.thickness_scale).size <= 256
    assert Spec.model_validate_json(spec.model_dump_json()) == spec


@pytest.mark.parametrize(
    ("name", "scale", "peak_nm"),
    [
        ("paper/figure-8", 0.8, 403),
        ("paper/figure-8", 1.0, 504),
        ("paper/figure-8", 1.2, 605),
        ("paper/figure-8", 1.35, 681),
        ("dichroic", 1.0, 550),
        ("beetle", 1.0, 530),
        ("morpho", 1.0, 454),
        ("morpho-ridges", 1.0, 400),
        ("paper/figure-9", 1.0, 454),
    ],
)
def test_a_reflector_peaks_where_its_source_says(name: str, scale: float, peak_nm: float) -> None:
    """2 (n d + d) cos for equal ridges and gaps; a quarter wave at 550 nm; Stavenga et al. 2011, 530 nm."""
    wavelength_nm = np.arange(380.0, 750.0, 1.0)
    found = wavelength_nm[reflectance(name, wavelength_nm, scale).argmax()]
    assert found == pytest.approx(peak_nm, abs=12)


@pytest.mark.parametrize(
    ("name", "distribution", "anisotropic"),
    [
        ("paper/figure-5", "blinn", False),
        ("paper/figure-6", "ashikhmin-shirley", True),
        ("paper/figure-7", "ashikhmin-shirley", True),
        ("paper/figure-9", "phong", False),
    ],
)
def test_a_rough_figure_has_the_surface_of_the_paper(
    name: str, distribution: str, *, anisotropic: bool
) -> None:
    """Section 4: Blinn's isotropic exponent, Ashikhmin's anisotropic function, and Sun's Phong beside it."""
    spec = preset(name)
    assert spec.table.quantity == "albedo"
    assert surface_of(spec).distribution == distribution
    assert surface_of(spec).anisotropic == anisotropic
    assert roughness_values(spec).size >= 1
    assert "assumed" in spec.source


@pytest.mark.parametrize("name", ["paper/figure-5", "paper/figure-6", "paper/figure-7"])
def test_an_opaque_object_is_opaque_and_reflects_as_one_of_index_1_5(name: str) -> None:
    """Light is lost within 10 µm (Born and Wolf, section 14.1: λ / 4πk), and the paper's 1.5 decides R."""
    wavelength_nm = np.arange(350.0, 751.0, 10.0)
    substrate = sample_stack(preset(name).stack, wavelength_nm).index[-1]
    assert (wavelength_nm / (4 * np.pi * substrate.imag)).max() < 10e3
    clear = [tmm.coh_tmm("s", [1, 2, 1.5], [np.inf, 400, np.inf], 0, nm)["R"] for nm in wavelength_nm]
    np.testing.assert_allclose(reflectance(name, wavelength_nm), clear, atol=5e-3)


def test_figure_5_holds_both_of_its_films() -> None:
    """The paper's 400 and 600 nm are samples of the thickness axis."""
    scales = thickness_scale_values(preset("paper/figure-5").table.thickness_scale)
    assert {400.0, 600.0} <= set(400 * scales)


def test_ridges_are_those_of_figure_2() -> None:
    """300 nm wide, one every 675 nm, and of uneven thickness; the air between makes them a weaker mirror."""
    group = preset("morpho-ridges").stack.layers[0]
    ridge = group.layers[0]
    assert ridge.material.fraction == pytest.approx(300 / 675, rel=1e-15)
    assert ridge.thickness_sigma_nm > 0
    wavelength_nm = np.arange(380.0, 750.0, 1.0)
    assert reflectance("morpho-ridges", wavelength_nm).max() < reflectance("morpho", wavelength_nm).max()


def test_figure_3_spans_the_quarter_and_half_wave_limits() -> None:
    """Born and Wolf, section 1.6.4: from the bare glass to ((n0 ns - n1²)/(n0 ns + n1²))² = 0.2066."""
    found = reflectance("paper/figure-3", np.arange(350.0, 750.5, 0.5))
    assert found.min() == pytest.approx(0.04, abs=1e-4)
    assert found.max() == pytest.approx(((1.5 - 4) / (1.5 + 4)) ** 2, abs=1e-4)


def test_a_coated_lens_reflects_least_in_the_green() -> None:
    """Macleod, chapter 4: a quarter wave of magnesium fluoride leaves 1.2 to 1.4 % at its wavelength."""
    wavelength_nm = np.arange(380.0, 750.0, 2.0)
    found = reflectance("coated-lens", wavelength_nm)
    assert wavelength_nm[found.argmin()] == pytest.approx(550, abs=10)
    assert 0.012 < found.min() < 0.014


def test_a_soap_film_is_black_where_it_is_thinnest() -> None:
    """Newton's black film: far below a wavelength both reflections cancel."""
    visible_nm = np.arange(400.0, 701.0, 50.0)
    assert reflectance("soap-bubble", visible_nm, 0.01).max() < 0.005


def test_overrides_reach_a_preset() -> None:
    """As `--set` does on the command line."""
    assert preset("paper/figure-3", ["table.cos_theta=99"]).table.cos_theta == 99


@pytest.mark.parametrize(
    "name", ["paper/figure3", "soap-buble", "nacre.toml", "../optics/library", "", "x" * 9999, "a\0"]
)
def test_an_unknown_preset_is_refused(name: str) -> None:
    """A preset is a name on the list, never a path."""
    with pytest.raises(SpecError, match="preset"):
        preset(name)


def test_a_slip_of_the_keyboard_finds_the_closest() -> None:
    """The remedy is in the message."""
    with pytest.raises(SpecError, match="did you mean soap-bubble"):
        load("soap-buble")


def test_load_takes_a_file_or_a_preset(tmp_path: Path) -> None:
    """A suffix makes it a file; without one a preset comes first, then a file of that name."""
    layer = '{ material = "water", thickness_nm = 1 }'
    text = f'name = "mine"\nstack = {{ incident = "air", substrate = "bk7", layers = [{layer}] }}\n'
    for file in (tmp_path / "film.toml", tmp_path / "film"):
        file.write_text(text, encoding="utf-8")
        assert load(str(file)).name == load(file).name == "mine"
    assert load("morpho") == preset("morpho")
    assert load("morpho", ["name=other"]).name == "other"


@pytest.mark.parametrize("name", ["missing.toml", "missing.json", "a\0.toml"])
def test_a_missing_file_is_told(name: str) -> None:
    """What looks like a file is not looked for among the presets."""
    with pytest.raises(SpecError, match="file"):
        load(name)
