# SPDX-License-Identifier: GPL-3.0-or-later
"""What tells instances from each other: ids, random numbers as Cycles has them, index, colour, visibility."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from svo_engine.scene.geometry import ALL_VISIBLE, IS_HOLDOUT, IS_SHADOW_CATCHER, VISIBLE
from tests.blender import cycles
from tests.blender.build import extracted, material, place, plane
from tests.blender.test_extract_instances import Geometry


def field(name):
    """That field of Instances by object's name, for objects that stand once."""
    inst = extracted().instances
    return dict(zip(inst.names, getattr(inst, name).tolist(), strict=True))


@pytest.mark.parametrize("name", ["Plane", "x.001", "Stra\u00dfe", "\u6728"])
def test_random_is_that_of_cycles(empty, name, tmp_path):
    nodes = material()
    info = nodes.new("ObjectInfo")
    nodes.show(nodes.new("Emission", Color=info.outputs["Random"]))
    plane(nodes.owner, name=name)
    cycles.look_down()
    assert field("random")[name] == pytest.approx(cycles_color(tmp_path)[0], rel=1e-6)


def test_random_and_place_of_instances_are_those_of_cycles(empty, tmp_path):
    nodes = material()
    info, at = nodes.new("ObjectInfo"), nodes.new("TexCoord")
    at.from_instancer = True
    shade = nodes.new("Emission", Color=info.outputs["Random"])
    child, parent = plane(nodes.show(shade), name="Child"), plane(name="Instancer", size=0.4)
    child.parent, parent.instance_type = parent, "FACES"
    child.location = (0, 0, 0.5)
    cycles.look_down(height=1)
    inst = extracted().instances
    row = [i for i, m in enumerate(inst.world_from_object) if inst.names[i] == "Child" and m[2, 3] == 0.5][-1]
    assert inst.random[row] == pytest.approx(cycles_color(tmp_path)[0], rel=1e-6)
    for output, expected in (("Generated", inst.generated[row]), ("UV", (*inst.uv[row], 0))):
        nodes.set(shade, "Color", at.outputs[output])
        assert cycles_color(tmp_path) == pytest.approx(expected, abs=1e-6)


def cycles_color(folder):
    """What Cycles shows from above the origin: RGB."""
    return cycles.render(folder, samples=1)[2, 2, :3]


def points_as_instances(n):
    geometry = Geometry()
    line, cubes = geometry.new("GeometryNodeMeshLine", Count=n), geometry.new("GeometryNodeMeshCube")
    scatter = geometry.new("GeometryNodeInstanceOnPoints")
    geometry.link(line, scatter, "Points")
    geometry.link(cubes, scatter, "Instance")
    geometry.link(scatter, geometry.output)
    return geometry


def test_instances_of_geometry_nodes_differ_and_stay_who_they_are(empty):
    geometry = points_as_instances(5)
    first = extracted().instances
    assert len(set(first.ids.tolist())) == len(set(first.random.tolist())) == 5
    assert ((first.random >= 0) & (first.random <= 1)).all()
    geometry.owner.location.x = 3
    place(None, "Another")
    bpy.context.scene.frame_set(7)
    again = extracted().instances
    np.testing.assert_array_equal(again.ids, first.ids)
    np.testing.assert_array_equal(again.random, first.random)


def test_ids_do_not_depend_on_the_order(empty):
    plane(name="B")
    before = field("ids")
    plane(name="A")
    after = field("ids")
    assert after["B"] == before["B"] != after["A"]


def test_index_and_color(empty):
    first, _ = plane(name="One"), plane(name="Two")
    first.pass_index, first.color = 7, (0.1, 0.2, 0.3, 0.4)
    assert field("object_index") == {"One": 7, "Two": 0}
    assert field("color")["One"] == pytest.approx((0.1, 0.2, 0.3, 0.4))
    assert field("color")["Two"] == [1, 1, 1, 1]


def test_visibility_is_told_and_changes_nothing_yet(empty):
    first, second = plane(name="One"), plane(name="Two")
    plane(name="Three")
    first.visible_camera = first.visible_volume_scatter = False
    second.is_holdout = second.is_shadow_catcher = True
    assert field("visibility") == {
        "One": ALL_VISIBLE - VISIBLE["camera"] - VISIBLE["volume"], "Three": ALL_VISIBLE,
        "Two": ALL_VISIBLE | IS_HOLDOUT | IS_SHADOW_CATCHER}


def test_pass_index_of_materials(empty):
    shade = material().owner
    shade.pass_index = 9
    plane(shade)
    assert extracted().materials[0].pass_index == 9
