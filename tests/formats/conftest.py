"""Small tables that the kernels have really computed, for every test of the formats."""

from collections.abc import Callable

import pytest

from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table

Tabulated = Callable[..., Table]

WAVELENGTH_NM = {"start": 380, "stop": 780, "step": 20}


@pytest.fixture(scope="session")
def tabulated() -> Tabulated:
    """Return what computes a table of a 420 nm film, n 2.0, on glass (Wu & Zheng 2015, figure 3)."""

    def compute(*, substrate: object = None, colour: dict[str, str] | None = None, **axes: object) -> Table:
        film = {"material": {"n": 2.0}, "thickness_nm": 420}
        glass = {"n": 1.5}
        spec = {
            "name": 'A film with "quotes", an ångström and 60 % of a # sign',
            "stack": {"incident": "air", "substrate": substrate or glass, "layers": [film]},
            "table": {"wavelength_nm": WAVELENGTH_NM, "cos_theta": 9} | axes,
            "colour": colour or {},
        }
        return tabulate_table(Spec.from_document(spec))

    return compute


@pytest.fixture(scope="session")
def table(tabulated: Tabulated) -> Table:
    """Return a table of five thicknesses, nine angles, and psi and Delta."""
    return tabulated(thickness_scale={"start": 0.5, "stop": 1.5, "count": 5}, ellipsometry=True)


@pytest.fixture(scope="session")
def one_thickness(tabulated: Tabulated) -> Table:
    """Return a table without a thickness axis."""
    return tabulated()


@pytest.fixture(scope="session")
def opaque(tabulated: Tabulated) -> Table:
    """Return a table of the film on silver, which has no colour of T."""
    return tabulated(substrate="main/Ag/Johnson")


@pytest.fixture(scope="session")
def infrared(tabulated: Tabulated) -> Table:
    """Return a table whose wavelengths span no colour, on both sides of 1,000 nm."""
    return tabulated(wavelength_nm={"start": 900, "stop": 1100, "step": 50})
