# SPDX-License-Identifier: GPL-3.0-or-later
"""F12 with everything real, from the depsgraph to the file, on whatever OpenGL there is."""

from __future__ import annotations

import bpy
import numpy as np
import OpenEXR
import pytest

from svo_engine.blender import session


@pytest.fixture
def scene(empty, extension, tmp_path):
    """A rough floor of reflectance 0.8 under a lamp, seen from above."""
    bpy.ops.mesh.primitive_plane_add(size=2)
    material = bpy.data.materials.new("Floor")
    if material.node_tree is None:
        material.use_nodes = True
    inputs = material.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value, inputs["Roughness"].default_value = (0.8, 0.8, 0.8, 1), 1
    inputs["Specular IOR Level"].default_value = 0
    bpy.context.object.data.materials.append(material)
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    lamp.data.energy, lamp.data.shadow_soft_size, lamp.location = 100, 0, (0, 0, 2)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0, 0, 5)
    for thing in (lamp, camera):
        empty.collection.objects.link(thing)
    empty.camera = camera
    render = empty.render
    render.engine = extension.engine.SVORenderEngine.bl_idname
    render.resolution_x, render.resolution_y, render.resolution_percentage = 24, 16, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.image_settings.color_mode = "RGBA"
    render.filepath = str(tmp_path / "picture.exr")
    empty.svo.samples, empty.svo.resolution = 2, "32"
    return empty


def combined(scene):
    bpy.ops.render.render(write_still=True)
    with OpenEXR.File(scene.render.filepath) as file:
        return file.channels()["RGBA"].pixels[::-1]


def test_same_scene_gives_the_same_bits(scene):
    first = combined(scene)
    session.current.forget()
    np.testing.assert_array_equal(combined(scene), first)


def test_floor_has_the_light_of_its_lamp(scene):
    # L = rho E / pi and E = P / (4 pi h^2) below the lamp; the four pixels around that point lie 0.1 m from it, where
    # E is cos^4 = 0.994 of that
    expected = 0.8 * 100 / (4 * np.pi * 2**2) / np.pi
    assert combined(scene)[7:9, 11:13, :3].mean() == pytest.approx(expected, rel=0.02)


def test_transparent_film_has_no_sky_and_black_film_does(scene):
    corner = combined(scene)[0, 0]
    scene.render.film_transparent = True
    transparent = combined(scene)
    assert corner[3] == 1
    assert transparent[0, 0].tolist() == [0, 0, 0, 0]
    assert transparent[8, 12, 3] == 1


def test_stats_name_the_device_and_the_stages(scene):
    combined(scene)
    assert session.last_stats["n_samples"] == 2
    assert session.last_stats["device"]
    assert session.last_stats["counts"]["triangles"] == 2
    times = session.last_stats["times_ms"]
    assert {"extract", "upload", "hand over"} <= set(times)
    assert all(ms >= 0 for ms in times.values())


def test_unregistering_frees_the_device_and_the_next_render_makes_a_new_one(scene, extension):
    first = combined(scene)
    extension.unregister()
    extension.register()
    scene = bpy.context.scene
    scene.svo.samples, scene.svo.resolution = 2, "32"
    np.testing.assert_array_equal(combined(scene), first)
