# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a lamp is read, and what is told; how bright it is, `test_radiometry.py` holds against Cycles."""

from __future__ import annotations

from math import pi, radians

import bpy
import numpy as np
import pytest

from tests.blender.build import Nodes, extracted, lamp, one_color, place


def only_light():
    light, = extracted().lights
    return light


@pytest.mark.parametrize("kind", ["POINT", "SUN", "SPOT", "AREA"])
def test_place_is_a_rotation_and_a_translation(empty, kind):
    parent = place(None, "Parent", at=(1, 2, 3), turn=(0.3, 0.2, 0.1), scale=(2, 2, 2))
    owner = lamp(kind, at=(1, 0, 0), turn=(0.5, 0, 0))
    owner.parent = parent
    matrix = only_light().world_from_light
    np.testing.assert_allclose(matrix[:3, 3], owner.matrix_world.translation, rtol=1e-6)
    np.testing.assert_allclose(matrix[:3, :3], owner.matrix_world.to_quaternion().to_matrix(), atol=1e-6)


@pytest.mark.parametrize("scale", [(1, 2, 3), (-1, 1, 1), (1, -1, 1), (1, 1, -1), (-1, -1, -1)])
def test_scale_leaves_a_rotation_that_looks_where_the_lamp_does(empty, scale):
    owner = lamp("AREA", turn=(0.4, 0.5, 0.6), scale=scale)
    matrix = only_light().world_from_light
    rotation = matrix[:3, :3]
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-6)
    assert np.linalg.det(rotation) == pytest.approx(1)
    front = -np.array(owner.matrix_world.col[2][:3])
    np.testing.assert_allclose(-rotation[:, 2], front / np.linalg.norm(front), atol=1e-6)


def test_fields_of_a_spot(empty):
    lamp("SPOT", spot_size=radians(50), spot_blend=0.25, shadow_soft_size=0.3, use_shadow=False)
    light = only_light()
    assert (light.spot_angle, light.spot_blend, light.radius) == pytest.approx((radians(50), 0.25, 0.3))
    assert not light.casts_shadow


def test_default_lamp_casts_shadows_over_its_full_angle(empty):
    lamp("AREA")
    light = only_light()
    assert light.casts_shadow
    assert light.spread == pi


@pytest.mark.parametrize(("shape", "is_ellipse", "size"), [
    ("SQUARE", False, (2, 2)), ("RECTANGLE", False, (2, 3)), ("DISK", True, (2, 2)), ("ELLIPSE", True, (2, 3))])
def test_shape_of_an_area(empty, shape, is_ellipse, size):
    lamp("AREA", shape=shape, size=2, size_y=3)
    light = only_light()
    assert (light.is_ellipse, light.size) == (is_ellipse, size)


def test_spot_scaled_to_an_ellipse_is_told(empty):
    lamp("SPOT", scale=(1, 2, 1))
    assert extracted().warnings == (
        "Light 'Lamp': a spot scaled to an ellipse is not supported; a circle of the same area is used",)


def test_animated_energy(empty):
    owner = lamp("SUN")
    for frame, energy in ((1, 0), (11, 10)):
        owner.data.energy = energy
        owner.data.keyframe_insert("energy", frame=frame)
    empty.frame_set(11)
    assert only_light().emitted == (10, 10, 10)


def test_nodes_that_are_simple_multiply(empty):
    nodes = Nodes(lamp("SUN", energy=1, color=(1, 0.5, 0.25)).data)
    value = nodes.new("Value")
    value.outputs[0].default_value = 3
    color = nodes.new("RGB")
    color.outputs[0].default_value = (0.5, 0.5, 1, 1)
    nodes.owner.use_nodes = True
    nodes.show(nodes.new("Emission", Color=color, Strength=value))
    scene = extracted()
    np.testing.assert_allclose(scene.lights[0].emitted, (1.5, 0.75, 0.75))
    assert scene.warnings == ()


def test_nodes_that_are_not_simple_are_compiled(empty):
    nodes = Nodes(lamp("SUN", energy=1).data)
    nodes.owner.use_nodes = True
    texture = nodes.new("TexImage")
    texture.image = one_color(1, 0, 0, 1)
    nodes.show(nodes.new("Emission", Color=texture))
    scene = extracted()
    assert scene.lights[0].emitted == (1, 1, 1)
    assert [image.name for image in scene.images] == ["Image"]
    assert scene.warnings == () and not scene.lights[0].is_exact and scene.lights[0].graph


def test_lamp_whose_output_is_not_linked_is_dark(empty):
    nodes = Nodes(lamp("SUN", energy=1).data)
    nodes.owner.use_nodes = True
    assert only_light().emitted == (0, 0, 0)


@pytest.mark.skipif(bpy.app.version >= (5, 1, 0), reason="later versions draw every lamp with nodes")
def test_nodes_that_are_switched_off(empty):
    nodes = Nodes(lamp("SUN", energy=1).data)
    nodes.owner.use_nodes = False
    assert only_light().emitted == (1, 1, 1)


def test_lamp_that_is_hidden(empty):
    lamp("SUN").hide_viewport = True
    assert extracted().lights == ()
