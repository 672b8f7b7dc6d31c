"""Nodes of Mueller matrices: what the reader needs of them, and that they are where f bends."""

import numpy as np
import pytest

from measured_files import measured_spec
from nacreous.opencl.device import Device
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.measured.mueller_nodes import Nodes, placing
from nacreous.tables.measured.surface import Spectra
from nacreous.tables.spec import Spec

WAVELENGTH_NM = np.array([400.0, 480.0, 560.0, 640.0, 720.0])


def nodes_of(spec: Spec, device: Device) -> Nodes:
    """Return the nodes of a surface on the largest grid."""
    return placing(bsdf_solver(device, spec), Spectra(WAVELENGTH_NM)).nodes(37, 12_500)


@pytest.mark.parametrize("surface", ["narrow", "ggx", "rough"])
def test_readers_find_every_angle(surface: str, device: Device) -> None:
    """Ascending as single precision has them, from end to end; about as many as asked for."""
    nodes = nodes_of(measured_spec(surface), device)
    for angle in (nodes.phi_d, nodes.theta_d, nodes.theta_h):
        assert (angle == angle.astype(np.float32)).all()
        assert (np.diff(angle.astype(np.float32)) > 0).all()
    np.testing.assert_allclose(nodes.phi_d[[0, 18, 36]], [-np.pi, 0, np.pi], atol=1e-6)
    for angle in (nodes.theta_d, nodes.theta_h):
        np.testing.assert_allclose(angle[[0, -1]], [0, np.pi / 2], atol=1e-6)
    assert nodes.count == pytest.approx(37 * 12_500, rel=0.02)


def test_azimuths_repeat_their_quarter(device: Device) -> None:
    """An isotropic f is even in phi_d and of period pi: |sin| and |cos| tell where in the quarter."""
    nodes = nodes_of(measured_spec("ggx"), device)
    folded = np.arctan2(np.abs(np.sin(nodes.phi_d)), np.abs(np.cos(nodes.phi_d)))
    np.testing.assert_allclose(nodes.quarter[nodes.folded], folded, atol=1e-6)


def test_nodes_follow_the_lobe(device: Device) -> None:
    """Half of theta_h is within a few alpha, of a narrow lobe as of a broad one."""
    narrow, broad = (nodes_of(measured_spec(surface), device).theta_h for surface in ("narrow", "rough"))
    assert np.median(narrow) < 8 * 0.02
    assert np.median(broad) < 2 * 0.4
    assert np.median(broad) > 3 * np.median(narrow)


def test_fringes_are_given_nodes(device: Device) -> None:
    """A film of 3 micrometres has fringes over theta_d: more nodes there, fewer along the lobe."""
    fields = measured_spec("ggx").model_dump(mode="json")
    fields["stack"]["layers"][0]["thickness_nm"] = 3000
    thick, thin = nodes_of(Spec.from_document(fields), device), nodes_of(measured_spec("ggx"), device)
    assert thick.theta_d.size > 1.2 * thin.theta_d.size
