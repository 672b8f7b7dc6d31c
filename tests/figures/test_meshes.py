"""The meshes of figures 6 to 9, examined by trimesh."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import trimesh

from figures.meshes.kangaroo import kangaroo
from figures.meshes.mesh import Mesh, write_ply
from figures.meshes.pigment import wing_pigment
from figures.meshes.teapot import teapot
from figures.meshes.wing import EXTENT, WINGS, Side, body, wing


@cache
def coarse_kangaroo() -> Mesh:
    """Return the kangaroo in large cubes."""
    return kangaroo(cell=0.035)


SOLIDS: dict[str, Callable[[], Mesh]] = {
    "teapot": lambda: teapot(0.25),
    "kangaroo": coarse_kangaroo,
    "body of the butterfly": body,
}
CARDS: dict[str, tuple[str, Side]] = {
    f"{side} {name} wing": (name, side) for name in WINGS for side in ("right", "left")
}


@pytest.fixture(scope="module", params=SOLIDS)
def solid(request: pytest.FixtureRequest) -> Mesh:
    """Each closed mesh, coarse."""
    return SOLIDS[request.param]()


@pytest.fixture(scope="module", params=CARDS)
def card(request: pytest.FixtureRequest) -> Mesh:
    """Each wing."""
    return wing(*CARDS[request.param], outwards=12)


def test_solids_are_closed(solid: Mesh) -> None:
    """Each edge parts two triangles that run along it in opposite directions; the volume is positive."""
    welded = trimesh.Trimesh(solid.positions, solid.faces, process=False)
    welded.merge_vertices(merge_tex=True, merge_norm=True)
    welded.update_faces(welded.nondegenerate_faces())
    assert welded.is_watertight
    assert welded.is_winding_consistent
    assert welded.volume > 0


def test_normals_of_solids_point_outwards(solid: Mesh) -> None:
    """A vertex's normal is of length 1 and on the outer side of its triangles."""
    examine_vertices(solid)
    flat = trimesh.Trimesh(solid.positions, solid.faces, process=False)
    facing = np.einsum("fi,fci->fc", flat.face_normals, solid.normals[solid.faces])
    assert np.average(facing.min(axis=1) > 0, weights=flat.area_faces) > 0.99


def test_wings_face_upwards(card: Mesh) -> None:
    """A wing's normals and the winding of its triangles agree on its upper side."""
    examine_vertices(card)
    flat = trimesh.Trimesh(card.positions, card.faces, process=False)
    assert (card.normals[:, 2] > 0.7).all()
    assert np.average(flat.face_normals[:, 2] > 0, weights=flat.area_faces) > 0.999


def examine_vertices(mesh: Mesh) -> None:
    """Assert that everything is finite and normals are of length 1."""
    assert all(np.isfinite(values).all() for values in (mesh.positions, mesh.normals, mesh.uvs))
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, rtol=0, atol=1e-9)


def dp_du(mesh: Mesh) -> np.ndarray:
    """Return the direction of dp/du in each triangle (F, 3), of dp = dp/du du + dp/dv dv."""
    edges = mesh.positions[mesh.faces[:, 1:]] - mesh.positions[mesh.faces[:, :1]]  # (F, 2, 3)
    (du1, dv1), (du2, dv2) = np.moveaxis(mesh.uvs[mesh.faces[:, 1:]] - mesh.uvs[mesh.faces[:, :1]], 0, 2)
    along = (dv2[:, None] * edges[:, 0] - dv1[:, None] * edges[:, 1]) * np.sign(du1 * dv2 - du2 * dv1)[
        :, None
    ]
    return along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)


@pytest.mark.parametrize("name", ["body and lid of the teapot", "kangaroo"])
def test_u_runs_around_the_vertical_axis(name: str) -> None:
    """Brushed anisotropy has a direction: the derivative of the position by u is horizontal."""
    mesh = coarse_kangaroo() if name == "kangaroo" else teapot(0.25)
    direction = dp_du(mesh)
    if name != "kangaroo":  # spout and handle have rings of their own
        direction = direction[np.hypot(*mesh.positions[mesh.faces].mean(axis=1)[:, :2].T) < 0.6]
        assert len(direction) > 1000
    assert np.percentile(abs(direction[:, 2]), 99) < 0.02


def test_the_kangaroo_is_symmetric() -> None:
    """Its left side mirrors its right: the centre of its surface lies in the plane y = 0."""
    mesh = coarse_kangaroo()
    flat = trimesh.Trimesh(mesh.positions, mesh.faces, process=False)
    assert abs(flat.centroid[1]) < 1e-3
    np.testing.assert_allclose(flat.bounds[0, 1], -flat.bounds[1, 1], rtol=0, atol=0.01)


def test_left_wings_mirror_the_right_ones() -> None:
    """A point on the right and its image on the left have opposite x and the same u and v."""
    for name in WINGS:
        right, left = (wing(name, side, 12) for side in ("right", "left"))
        image, uvs = (
            values.reshape(240, 12, -1)[::-1].reshape(240 * 12, -1) for values in (left.positions, left.uvs)
        )
        np.testing.assert_allclose(image, right.positions * [-1, 1, 1], rtol=0, atol=1e-12)
        np.testing.assert_array_equal(uvs, right.uvs)
        np.testing.assert_allclose(right.uvs[:, 0] * EXTENT, right.positions[:, 0], rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", WINGS)
def test_pigment_darkens_veins_and_margin_and_leaves_most_of_a_wing_free(name: str) -> None:
    """Along the outline away from the body a wing is dark; most of its area is film."""
    dark = wing_pigment(name, pixels=256)
    mesh = wing(name, "right", 60)
    column, row = (mesh.uvs * [256, 512]).astype(int).clip(0, [255, 511]).T
    there = dark[511 - row, column].reshape(-1, 60)
    assert there[100:150, -1].min() > 0.5
    assert 0.02 < (there[:, 10:45] > 0.5).mean() < 0.3


def test_a_ply_file_holds_the_mesh(tmp_path: Path) -> None:
    """Another reader of the format finds the same triangles, in single precision."""
    mesh = teapot(0.25)
    read = trimesh.load(write_ply(mesh, tmp_path / "teapot.ply"), process=False)
    # the reader drops vertices that no triangle has: corners are compared
    np.testing.assert_allclose(read.triangles, mesh.positions[mesh.faces], rtol=0, atol=1e-6)
