"""How a film is laid out for the kernels."""

import numpy as np
import pytest

from kernel_film import kernel_film, one_run, plain_problem
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_buffers import film_buffers
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.precision import Precision
from reference import film


@pytest.mark.parametrize(
    ("wavelengths", "lanes", "stride"), [(1, 16, 16), (16, 16, 16), (17, 8, 24), (5, 1, 5)]
)
def test_wavelengths_fill_whole_lanes(wavelengths: int, lanes: int, stride: int, device: Device) -> None:
    """A stride is the next multiple of the lanes: rows stay aligned."""
    problem = plain_problem([1, 2, 1.5], [100], np.linspace(400, 700, wavelengths), 1)
    assert film_buffers(device, problem, Precision.SINGLE, lanes).stride == stride


def test_a_film_is_built_for_the_segments_it_has() -> None:
    """INCOHERENT where a layer is thick, PERIODIC where a group repeats, room for four media."""
    n, d_nm = [1, 2, 1.4, 1.5], [100, 100]
    plain = plain_problem(n, d_nm, 550, 1)
    thick = plain_problem(n, d_nm, 550, 1, coherent=[True, False])
    periodic = plain_problem(n, d_nm, 550, 1, groups=[(0, 2, 3)])
    assert dict(plain.build_numbers) == {"INCOHERENT": 0, "PERIODIC": 0, "MEDIA": 4}
    assert dict(thick.build_numbers) == {"INCOHERENT": 1, "PERIODIC": 0, "MEDIA": 4}
    assert dict(periodic.build_numbers) == {"INCOHERENT": 0, "PERIODIC": 1, "MEDIA": 4}


def test_a_medium_is_counted_once() -> None:
    """Twenty pairs of two materials on one of them are two media; the incident medium is none of them."""
    problem = plain_problem([1, *[2, 1.4] * 20, 2], [100] * 40, [500, 600], 1)
    assert problem.medium_of == (0, 1) * 20 + (0,)
    assert dict(problem.build_numbers)["MEDIA"] == 4


@pytest.mark.parametrize(("layers", "room"), [(3, 4), (4, 16), (15, 16), (16, 64)])
def test_there_is_room_for_every_medium(layers: int, room: int) -> None:
    """A power of four, so that few programs serve all films: layers of different media, and the substrate."""
    n = 1.3 + 0.01 * np.arange(layers + 1)
    problem = plain_problem([1, *n], [50] * layers, [500, 600], [0.4, 1])
    assert dict(problem.build_numbers)["MEDIA"] == room
    got, at = (
        kernel_film([1, *n], [50] * layers, [500, 600], [0.4, 1]),
        film([1, *n], [50] * layers, [500, 600], [0.4, 1]),
    )
    np.testing.assert_allclose(got.R_p, at.R_p, rtol=0, atol=1e-12)


def test_scales_angles_and_wavelengths_are_in_their_places(device: Device) -> None:
    """An (S, A, L) table is its single values side by side, dispersive indices included."""
    index = np.array([[1, 1.1, 1.2], [2 + 1j, 2.2, 2.3], [1.5, 1.6, 1.7 + 0.1j]])
    wavelength_nm, mu, d_nm = np.array([450, 550, 650]), np.array([0.2, 0.9]), np.array([80, 120, 200, 310])
    problem = one_run(plain_problem(index, [1], wavelength_nm, mu))
    problem = FilmProblem(
        problem.wavelength_nm, problem.index, problem.segments, d_nm.reshape(4, 1, 1), np.ones(1), mu
    )
    table = film_intensities(device, problem, Precision.DOUBLE)
    assert table["R_s"].shape == (4, 2, 3)
    for place in np.ndindex(4, 2, 3):
        s, a, w = place
        at = film(index[:, w], [d_nm[s]], wavelength_nm[w], mu[a])
        assert [values[place] for values in table.values()] == pytest.approx(
            [v.item() for v in (at.R_s, at.R_p, at.T_s, at.T_p)], abs=1e-12
        )


def test_variants_are_averaged_by_their_weights(device: Device) -> None:
    """The mean over a thickness distribution is linear: weights 1/4 and 3/4 of two films."""
    thin, thick = (kernel_film([1, 2, 1.5], [d], [500, 600], [0.3, 1]) for d in (200, 300))
    problem = one_run(plain_problem([1, 2, 1.5], [1], [500, 600], [0.3, 1]))
    mixed = FilmProblem(
        problem.wavelength_nm, problem.index, problem.segments,
        np.array([200.0, 300.0]).reshape(1, 2, 1), np.array([0.25, 0.75]), problem.cos_theta,
    )  # fmt: skip
    got = film_intensities(device, mixed, Precision.DOUBLE)
    for name, values in got.items():
        expected = 0.25 * getattr(thin, name) + 0.75 * getattr(thick, name)
        np.testing.assert_allclose(values[0], expected, rtol=0, atol=1e-14)
