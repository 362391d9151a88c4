# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes of meshes by name: on every domain, of every type, UV maps and colours among them."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from svo_engine.blender.extract.attributes import seen
from tests.blender.build import extracted, plane


def only_mesh():
    mesh, = extracted().meshes
    return mesh


def attribute(data, name, kind, domain, values, prop="value"):
    made = data.attributes.new(name, kind, domain)
    made.data.foreach_set(prop, np.ravel(values))
    return made


def cube():
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object.data


@pytest.mark.parametrize("domain", ["POINT", "FACE", "CORNER"])
def test_values_lie_where_they_did(empty, domain):
    """Each element has its own place as a vector, which must be that of what the triangles show."""
    data = cube()
    faces = np.array([p.center[:] for p in data.polygons])
    points = np.array([v.co[:] for v in data.vertices])
    corners = points[[loop.vertex_index for loop in data.loops]]
    attribute(data, "place", "FLOAT_VECTOR", domain, {"POINT": points, "FACE": faces, "CORNER": corners}[domain],
              "vector")
    mesh = only_mesh()
    found = mesh.attribute("place")
    assert (found.domain, found.values.dtype) == (domain, np.float32)
    at = mesh.positions[mesh.triangles]
    if domain == "POINT":
        np.testing.assert_array_equal(found.values, mesh.positions)
    elif domain == "CORNER":
        np.testing.assert_array_equal(found.values.reshape(-1, 3, 3), at)
    else:
        normals = np.cross(at[:, 1] - at[:, 0], at[:, 2] - at[:, 0])
        np.testing.assert_allclose(found.values, normals / np.linalg.norm(normals, axis=1, keepdims=True), atol=1e-6)


@pytest.mark.parametrize(("dtype", "is_own"), [("f4", True), ("f8", False), ("i4", False)])
def test_blenders_own_memory_is_seen_only_where_it_holds_what_is_asked_for(empty, dtype, is_own):
    values = np.arange(8, dtype="f4") + 1
    data = attribute(cube(), "own", "FLOAT", "POINT", values).data
    found = seen(data, "value", (8, 1), dtype)
    np.testing.assert_array_equal(found.ravel(), values)
    assert (found.ctypes.data == data[0].as_pointer()) == is_own


@pytest.mark.parametrize(("kind", "prop", "values"), [
    ("FLOAT", "value", [[0.5], [1.5], [2.5], [3.5]]), ("INT", "value", [[-1], [2], [3], [70000]]),
    ("INT8", "value", [[-1], [2], [3], [100]]), ("BOOLEAN", "value", [[True], [False], [True], [False]]),
    ("FLOAT2", "vector", [[0.5, 1]] * 4), ("FLOAT_VECTOR", "vector", [[0.5, 1, 2]] * 4),
    ("INT32_2D", "value", [[5, -6]] * 4), ("QUATERNION", "value", [[0, 0, 1, 0]] * 4),
    ("FLOAT_COLOR", "color", [[0.5, 2, -1, 0.25]] * 4)])
def test_types(empty, kind, prop, values):
    attribute(plane().data, "own", kind, "POINT", values, prop)
    np.testing.assert_array_equal(only_mesh().attribute("own").values, np.array(values, "f4"))


def test_byte_colors_are_linear(empty):
    data = plane().data
    made = data.color_attributes.new("Col", "BYTE_COLOR", "CORNER")
    made.data.foreach_set("color_srgb", [0.5, 0.25, 1, 0.5] * 4)
    found = only_mesh().attribute("Col")
    encoded = np.rint(np.array([0.5, 0.25, 1]) * 255) / 255
    np.testing.assert_allclose(found.values[:, :3], np.tile(((encoded + 0.055) / 1.055) ** 2.4, (6, 1)), atol=1e-5)
    np.testing.assert_allclose(found.values[:, 3], 128 / 255, atol=1e-5)


def test_all_uv_maps_and_colors_and_which_are_meant(empty):
    data = plane().data
    data.uv_layers.new(name="Second").active_render = True
    data.uv_layers[1].uv.foreach_set("vector", np.arange(8, dtype="f4"))
    for name in ("First", "Other"):
        data.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    data.attributes.default_color_name = "Other"
    mesh = only_mesh()
    assert {a.name for a in mesh.attributes} == {"UVMap", "Second", "First", "Other"}
    assert (mesh.uv_map, mesh.color) == ("Second", "Other")
    np.testing.assert_array_equal(mesh.corner_uvs.reshape(-1, 2), mesh.attribute("Second").values)
    assert np.unique(mesh.corner_uvs).tolist() == list(range(8))


def test_what_is_blenders_own_is_left_out(empty):
    data = cube()
    data.uv_layers.remove(data.uv_layers[0])
    data.polygons[0].material_index = 1
    data.polygons[0].use_smooth = True
    data.edges[0].use_edge_sharp = True
    data.normals_split_custom_set([(0, 0, 1)] * 24)
    attribute(data, "along", "FLOAT", "EDGE", np.zeros(12))
    mesh = only_mesh()
    assert mesh.attributes == ()
    assert (mesh.uv_map, mesh.color) == ("", "")


def test_no_more_than_sixteen_and_the_active_ones_among_them(empty):
    data = plane().data
    data.uv_layers.remove(data.uv_layers[0])
    for i in range(20):
        attribute(data, f"own {i}", "FLOAT", "POINT", np.zeros(4))
    data.uv_layers.new(name="Last")
    scene = extracted()
    assert len(scene.meshes[0].attributes) == 16
    assert scene.meshes[0].uv_map == "Last"
    assert scene.warnings == ("Mesh 'Plane': only 16 of its 21 attributes are read",)


def test_values_that_are_not_finite(empty):
    attribute(plane().data, "heat", "FLOAT", "POINT", [1, np.nan, np.inf, 2])
    scene = extracted()
    assert sorted(scene.meshes[0].attribute("heat").values.ravel().tolist()) == [0, 0, 1, 2]
    assert scene.warnings == ("Mesh 'Plane': 2 vertices have values of 'heat' that are not finite; zero is used",)


def test_attributes_of_dropped_triangles_and_vertices(empty):
    data = bpy.data.meshes.new("Bust")
    data.from_pydata([(9, 9, 9), (0, 0, 0), (1, 0, 0), (0, 1, 0), (2, 0, 0)], [], [(1, 2, 4), (1, 2, 3)])
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Bust", data))
    attribute(data, "point", "FLOAT", "POINT", [0, 1, 2, 3, 4])
    attribute(data, "face", "INT", "FACE", [5, 6])
    attribute(data, "corner", "INT", "CORNER", np.arange(6))
    mesh = only_mesh()
    assert mesh.attribute("point").values.ravel().tolist() == [1, 2, 3]
    assert mesh.attribute("face").values.tolist() == [[6]]
    assert mesh.attribute("corner").values.ravel().tolist() == [3, 4, 5]


def test_generated_coordinates_go_from_0_to_1(empty):
    bpy.ops.mesh.primitive_cube_add(size=3)
    data = bpy.context.object.data
    data.transform(Matrix.Translation((5, 0, -1)))
    mesh = only_mesh()
    generated = (mesh.positions - mesh.generated_low) / mesh.generated_size
    np.testing.assert_allclose((generated.min(0), generated.max(0)), ((0, 0, 0), (1, 1, 1)), atol=1e-6)
