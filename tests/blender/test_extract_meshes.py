# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles, normals, texture coordinates and material slots of evaluated meshes."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.blender.build import extracted, material, place, plane


def only_mesh():
    mesh, = extracted().meshes
    return mesh


def mesh_of(vertices, faces, name="Mesh"):
    made = bpy.data.meshes.new(name)
    made.from_pydata(vertices, [], faces)
    place(made, name)
    return made


def area(mesh):
    a, b, c = mesh.positions[mesh.triangles.T].astype("f8")
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_faces_of_any_size_become_triangles(empty):
    square = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)]
    hexagon = [(np.cos(a) + 5, np.sin(a), 0) for a in np.arange(6) * np.pi / 3]
    triangle = [(9, 0, 0), (10, 0, 0), (9, 1, 0)]
    mesh_of(square + hexagon + triangle, [range(4), range(4, 10), range(10, 13)])
    mesh = only_mesh()
    assert len(mesh.triangles) == 2 + 4 + 1
    assert area(mesh) == pytest.approx(4 + 1.5 * np.sqrt(3) + 0.5, rel=1e-6)
    np.testing.assert_allclose(mesh.corner_normals, np.broadcast_to((0, 0, 1), (7, 3, 3)), atol=1e-6)


def test_concave_face_does_not_fill_its_notch(empty):
    mesh_of([(0, 0, 0), (4, 0, 0), (4, 4, 0), (3, 1, 0)], [range(4)])
    assert area(only_mesh()) == pytest.approx(4)


def test_triangles_are_read_the_same_with_and_without_a_larger_face(empty):
    """Meshes of triangles alone take a shorter way."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
    alone = only_mesh()
    data = bpy.context.object.data
    vertices = [v.co[:] for v in data.vertices] + [(9, 0, 0), (10, 0, 0), (10, 1, 0), (9, 1, 0)]
    faces = [p.vertices[:] for p in data.polygons]
    bpy.data.objects.remove(bpy.context.object)
    mesh_of(vertices, [*faces, [len(vertices) - i for i in (4, 3, 2, 1)]])
    mixed = only_mesh()
    n = len(alone.triangles)
    np.testing.assert_array_equal(mixed.positions[mixed.triangles[:n]], alone.positions[alone.triangles])


def test_smooth_and_flat_normals(empty):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    data = bpy.context.object.data
    flat = only_mesh()
    a, b, c = flat.positions[flat.triangles.T].astype("f8")
    own = np.cross(b - a, c - a)
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    np.testing.assert_allclose(flat.corner_normals, np.repeat(own[:, None], 3, 1), atol=1e-3)
    assert flat.flat.all() and len(flat.flat) == len(flat.triangles)
    for polygon in data.polygons:
        polygon.use_smooth = True
    data.update()
    smooth = only_mesh()
    assert not smooth.flat.any()
    # On the unit sphere a vertex is its own normal; the mean of its faces' normals is off by less than a ring's angle
    np.testing.assert_allclose(smooth.corner_normals, smooth.positions[smooth.triangles], atol=0.02)


def test_custom_normals(empty):
    data = plane().data
    data.normals_split_custom_set([(0.6, 0, 0.8)] * 4)
    # Blender keeps custom normals as two 16-bit angles
    np.testing.assert_allclose(only_mesh().corner_normals, np.broadcast_to((0.6, 0, 0.8), (2, 3, 3)), atol=1e-4)


def test_uvs_of_the_map_that_is_active_for_rendering(empty):
    data = plane().data
    other = data.uv_layers.new(name="Other")
    other.uv.foreach_set("vector", np.arange(8, dtype="f4"))
    np.testing.assert_allclose(only_mesh().corner_uvs, only_mesh().positions[only_mesh().triangles][..., :2] / 2 + 0.5)
    other.active_render = True
    assert set(only_mesh().corner_uvs.ravel()) == set(range(8))


def test_uvs_without_a_map_are_zero(empty):
    data = plane().data
    data.uv_layers.remove(data.uv_layers[0])
    assert not only_mesh().corner_uvs.any()


def test_material_slot_of_each_face(empty):
    bpy.ops.mesh.primitive_cube_add()
    data = bpy.context.object.data
    for polygon in data.polygons:
        polygon.material_index = polygon.index % 3
    mesh = only_mesh()
    heights = mesh.positions[mesh.triangles].mean(1)
    for polygon in data.polygons:
        on_face = np.abs(heights @ np.array(polygon.normal) - 1) < 1e-5
        assert set(mesh.material_slots[on_face]) == {polygon.index % 3}


def test_shape_keys_and_modifiers(empty):
    owner = plane()
    owner.shape_key_add(name="Basis")
    key = owner.shape_key_add(name="Up")
    for point in key.data:
        point.co.z = 1
    key.value = 1
    owner.modifiers.new("Array", "ARRAY").count = 3
    mesh = only_mesh()
    assert len(mesh.triangles) == 6
    np.testing.assert_allclose(mesh.positions[:, 2], 1)


def test_deformation_is_that_of_the_frame(empty):
    owner = plane()
    modifier = owner.modifiers.new("Displace", "DISPLACE")
    for frame, strength in ((1, 0), (11, 10)):
        modifier.strength = strength
        modifier.keyframe_insert("strength", frame=frame)
    empty.frame_set(11)
    np.testing.assert_allclose(only_mesh().positions[:, 2], 5)  # without a texture: half the strength


def test_mesh_that_is_being_edited(empty):
    plane()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    mesh = only_mesh()
    assert len(mesh.triangles) == 8
    assert area(mesh) == pytest.approx(4)
    np.testing.assert_allclose(mesh.corner_uvs, mesh.positions[mesh.triangles][..., :2] / 2 + 0.5, atol=1e-6)


@pytest.mark.parametrize("kind", ["text", "curve", "surface", "metaball"])
def test_everything_that_evaluates_to_a_mesh(empty, kind):
    shade = material().show(material().new("Emission"))
    if kind == "text":
        bpy.ops.object.text_add()
    elif kind == "curve":
        bpy.ops.curve.primitive_bezier_circle_add()
        bpy.context.object.data.bevel_depth = 0.1
    elif kind == "surface":
        bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    else:
        bpy.ops.object.metaball_add()
        bpy.ops.object.metaball_add(location=(1, 0, 0))  # melts into the first one
        bpy.context.view_layer.objects.active = bpy.data.objects["Mball"]
    bpy.context.object.data.materials.append(shade)
    scene = extracted()
    assert len(scene.meshes) == len(scene.instances) == 1
    assert scene.n_triangles > 10
    assert [m.name for m in scene.materials] == [shade.name]
    assert scene.warnings == ()


def test_curve_without_a_surface_is_nothing(empty):
    bpy.ops.curve.primitive_bezier_curve_add()
    assert extracted().meshes == ()


def test_mesh_without_faces_is_nothing(empty):
    mesh_of([(0, 0, 0), (1, 0, 0)], [])
    scene = extracted()
    assert scene.meshes == ()
    assert len(scene.instances) == 0
    assert scene.warnings == ()


def test_bad_geometry_is_named(empty):
    mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (np.nan, 0, 0)], [(0, 1, 2), (1, 2, 3)], "Bust")
    scene = extracted()
    assert scene.warnings == ("Mesh 'Bust': 1 triangles dropped: a corner is not a finite number",)
    assert len(scene.meshes[0].triangles) == 1


@pytest.mark.parametrize("kind", ["VOLUME", "CURVES", "POINTCLOUD"])
def test_geometry_that_is_not_supported_is_named(empty, kind):
    if kind == "VOLUME":
        made = bpy.data.volumes.new("Smoke")
    elif kind == "CURVES":
        made = bpy.data.hair_curves.new("Smoke")
    else:
        made = bpy.data.pointclouds.new("Smoke")
    place(made, "Smoke")
    warning, = extracted().warnings
    assert warning.startswith("Object 'Smoke' is ")
    assert warning.endswith("which is not supported; it is left out")


def test_adaptive_subdivision_is_told(empty):
    made = plane()
    modifier = made.modifiers.new("Subdivision", "SUBSURF")
    if hasattr(modifier, "use_adaptive_subdivision"):
        modifier.use_adaptive_subdivision = True
    else:
        made.cycles.use_adaptive_subdivision = True
    sentence, = extracted().warnings
    assert sentence == "Object 'Plane': adaptive subdivision is not supported; the modifier's own levels are used"
