# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad geometry: dropped, named, and never a trace of it in what is left."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from svo_engine.errors import SceneError
from svo_engine.scene.meshes import LARGEST_COORDINATE, make_mesh

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5)], "f4")
NOT_FINITE = (np.nan, np.inf, -np.inf, 1e30)


def test_triangle_gets_its_own_normal_and_defaults():
    mesh, warnings = make_mesh("m", CORNERS, [(0, 1, 2)])
    assert warnings == ()
    np.testing.assert_array_equal(mesh.corner_normals, np.broadcast_to(np.float32((0, 0, 1)), (1, 3, 3)))
    assert not mesh.corner_uvs.any()
    assert mesh.material_slots.tolist() == [0]


def test_vertices_that_no_triangle_uses_are_dropped():
    """They would widen the bounds of the scene."""
    mesh, _ = make_mesh("m", CORNERS[[3, 0, 1, 2]], [(1, 2, 3)])
    np.testing.assert_array_equal(mesh.positions[mesh.triangles[0]], CORNERS[:3])
    assert len(mesh.positions) == 3


@pytest.mark.parametrize("value", NOT_FINITE)
def test_corner_that_is_not_finite(value):
    positions = CORNERS.copy()
    positions[3, 1] = value
    mesh, (warning,) = make_mesh("Bust", positions, [(0, 1, 2), (1, 2, 3)], material_slots=[4, 7])
    assert warning == "Mesh 'Bust': 1 triangles dropped: a corner is not a finite number"
    assert mesh.material_slots.tolist() == [4]
    assert np.isfinite(mesh.positions).all()


@pytest.mark.parametrize("triangle", [(0, 0, 1), (1, 1, 1)])
def test_triangle_without_area(triangle):
    mesh, warnings = make_mesh("Bust", CORNERS, [triangle, (0, 1, 2)])
    assert warnings == ()
    np.testing.assert_array_equal(mesh.positions[mesh.triangles], CORNERS[None, :3])


def test_corners_on_a_line_have_no_area():
    positions = np.float32(((1, 1, 1), (2, 2, 2), (7, 7, 7)))
    assert len(make_mesh("m", positions, [(0, 1, 2)])[0].triangles) == 0


@pytest.mark.parametrize("scale", [1e-12, 1e-6, 1e6, 1e12])
def test_size_alone_is_no_fault(scale):
    mesh, warnings = make_mesh("m", CORNERS * np.float32(scale), [(0, 1, 2)])
    assert warnings == ()
    np.testing.assert_allclose(mesh.corner_normals[0, 0], (0, 0, 1), atol=1e-6)


@pytest.mark.parametrize("normal", [(0, 0, 0), (np.nan, 0, 1), (np.inf, 0, 0)])
def test_normal_that_is_none_is_the_triangles(normal):
    given = np.tile(np.float32((1, 0, 0)), (1, 3, 1))
    given[0, 1] = normal
    mesh, _ = make_mesh("m", CORNERS, [(0, 1, 2)], corner_normals=given)
    np.testing.assert_array_equal(mesh.corner_normals[0], [(1, 0, 0), (0, 0, 1), (1, 0, 0)])


def test_unit_normals_stay_as_they_are_and_others_become_unit():
    given = np.float32([[(0.6, 0, 0.8), (0, 3, 4), (1e-3, 0, 0)]])
    mesh, _ = make_mesh("m", CORNERS, [(0, 1, 2)], corner_normals=given)
    np.testing.assert_array_equal(mesh.corner_normals[0, 0], given[0, 0])
    np.testing.assert_allclose(mesh.corner_normals[0, 1:], [(0, 0.6, 0.8), (1, 0, 0)], atol=1e-7)
    assert given[0, 1, 2] == 4


def test_uv_that_is_not_finite_is_zero():
    uvs = np.float32([[(0.25, 0.5), (np.nan, 0.5), (0.25, np.inf)]])
    mesh, (warning,) = make_mesh("Bust", CORNERS, [(0, 1, 2)], corner_uvs=uvs)
    assert warning == "Mesh 'Bust': 1 triangles have values of 'UVMap' that are not finite; zero is used"
    np.testing.assert_array_equal(mesh.corner_uvs[0], [(0.25, 0.5), (0, 0.5), (0.25, 0)])


def test_triangle_of_a_missing_vertex_is_an_error():
    with pytest.raises(SceneError, match="Mesh 'Bust': a triangle names vertex 9 of 4"):
        make_mesh("Bust", CORNERS, [(0, 1, 9)])


def test_no_triangle_at_all():
    mesh, warnings = make_mesh("m", np.zeros((0, 3)), np.zeros((0, 3), "i4"))
    assert len(mesh.triangles) == len(mesh.positions) == 0
    assert warnings == ()


@given(arrays("f4", (6, 3), elements=st.floats(width=32)), arrays("i4", (5, 3), elements=st.integers(0, 5)),
       arrays("f4", (5, 3, 3), elements=st.floats(width=32)), arrays("f4", (5, 3, 2), elements=st.floats(width=32)))
def test_whatever_comes_in_only_good_triangles_come_out(positions, triangles, normals, uvs):
    mesh, warnings = make_mesh("m", positions, triangles, normals, uvs)
    n_not_finite = int((~(np.abs(positions[triangles]) < LARGEST_COORDINATE)).any((1, 2)).sum())
    assert [w for w in warnings if "dropped" in w] == (
        [f"Mesh 'm': {n_not_finite} triangles dropped: a corner is not a finite number"] if n_not_finite else [])
    a, b, c = mesh.positions[mesh.triangles.T].astype("f8")
    assert (np.cross(b - a, c - a) != 0).any(1).all()
    np.testing.assert_allclose(np.linalg.norm(mesh.corner_normals.astype("f8"), axis=2), 1, atol=1e-5)
    assert np.isfinite(mesh.corner_uvs).all()
