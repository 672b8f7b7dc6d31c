"""Small tables for every test of the formats: computed ones, and such that are known at every sample."""

from collections.abc import Callable
from functools import cache

import pytest

from analytic_tables import analytic_albedo, analytic_bsdf
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table
from nacreous.tables.tabulate import tabulate_table

Tabulated = Callable[..., Table]
Held = Callable[[str], Table]

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


@pytest.fixture(scope="session")
def albedo() -> Table:
    """Return a table of albedos over roughness, thickness and angle, known at every sample."""
    return analytic_albedo()


@pytest.fixture(scope="session")
def bsdf() -> Table:
    """Return a table of an anisotropic surface's BSDF over all its axes, known at every sample."""
    return analytic_bsdf()


@pytest.fixture(scope="session")
def computed_albedo(tabulated: Tabulated) -> Table:
    """Return the albedos of the film on an all but smooth, and on a rough surface."""
    return tabulated(quantity="albedo", roughness=[0.02, 0.4], thickness_scale=[0.9, 1.0])


@pytest.fixture(scope="session")
def computed_bsdf(tabulated: Tabulated) -> Table:
    """Return a BSDF of the film over the same angles of incoming and outgoing light."""
    angles = [0.0, 0.4, 0.8, 1.2]
    return tabulated(quantity="bsdf", roughness=[0.3], theta_i=angles, theta_o=angles, phi=5)


@pytest.fixture(scope="session")
def rough_opaque(tabulated: Tabulated) -> Table:
    """Return a BSDF of the film on silver, whose spec every format with readers of its own takes."""
    angles = [0.0, 0.8]
    return tabulated(
        substrate="main/Ag/Johnson",
        quantity="bsdf",
        roughness=[0.4],
        theta_i=angles,
        theta_o=angles,
        phi=[0.0, 3.0],
    )


@pytest.fixture(scope="session")
def held(table: Table, rough_opaque: Table) -> Held:
    """Return what gives a table for a format: of a smooth film, or of a rough one as its readers want it."""

    @cache
    def sampled(sampling: Sampling) -> Table:
        return tabulate_table(rough_opaque.spec, sampling=sampling)

    def held_by(name: str) -> Table:
        sampling = FORMATS[FormatName(name)].sampling
        return table if sampling is Sampling.AXES else sampled(sampling)

    return held_by
