# SPDX-License-Identifier: GPL-3.0-or-later
"""What Attribute and Particle Info nodes ask of instances: looked up as Blender does."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.blender import cycles
from tests.blender.build import extracted, material, plane
from tests.blender.following import Followed


def asking(kind, name):
    """A material that shines with the attribute of that type and name."""
    nodes = material()
    node = nodes.new("Attribute")
    node.attribute_type, node.attribute_name = kind, name
    return nodes.show(nodes.new("Emission", Color=node.outputs["Color"]))


def rows(scene, name):
    found, = (a for a in scene.instances.attributes if a.name == name)
    assert found.domain == "INSTANCE"
    return found.values


@pytest.mark.parametrize(("value", "expected"), [
    (0.25, (0.25, 0.25, 0.25)), (3, (3, 3, 3)), ((0.1, 0.2, 0.3), (0.1, 0.2, 0.3)),
    ((0.1, 0.2, 0.3, 0.4), (0.1, 0.2, 0.3)), ((0.1, 0.2), (0.1, 0.2, 0)), ("text", (0, 0, 0))])
@pytest.mark.parametrize(("kind", "owner"), [
    ("OBJECT", "object"), ("OBJECT", "mesh"), ("INSTANCER", "object"), ("VIEW_LAYER", "layer"),
    ("VIEW_LAYER", "scene")])
def test_custom_properties_are_what_cycles_shows(empty, tmp_path, kind, owner, value, expected):
    shown = plane(asking(kind, "heat"))
    owners = {"object": shown, "mesh": shown.data, "layer": bpy.context.view_layer, "scene": empty}
    owners[owner]["heat"] = value
    found = rows(extracted(), f"{kind.lower()}:heat")
    np.testing.assert_allclose(found[0, :3], expected, rtol=1e-6)
    cycles.look_down()
    np.testing.assert_allclose(cycles.render(tmp_path, samples=1)[..., :3].mean((0, 1)), expected, rtol=1e-3)


def test_property_by_its_path(empty):
    plane(asking("OBJECT", "color"), at=(1, 2, 3)).color = (0.1, 0.2, 0.3, 0.4)
    np.testing.assert_allclose(rows(extracted(), "object:color"), [(0.1, 0.2, 0.3, 0.4)], rtol=1e-6)


def test_nothing_is_looked_up_for_values_that_say_all(empty):
    nodes = material()
    plane(nodes.show(nodes.new("BsdfDiffuse")))["heat"] = 1.0
    assert extracted().instances.attributes == ()


def test_instancer_before_the_object(empty):
    shown = plane(asking("INSTANCER", "heat"))
    holder = plane(name="Holder", at=(5, 0, 0))
    holder.instance_type = "VERTS"
    shown.parent = holder
    shown["heat"], holder["heat"] = 1.0, 2.0
    # The holder has another material, and the object itself is seen at its own place too
    assert sorted(set(rows(extracted(), "instancer:heat")[:, 0])) == [0, 1, 2]


@pytest.mark.skipif(not hasattr(bpy.types.Object, "evaluated_geometry"), reason="Blender 4.5 brought it")
def test_attributes_of_geometry_nodes_instances(empty):
    owner = plane(name="Points")
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    start, end, put, cube, paint, store, at = (tree.nodes.new(kind) for kind in (
        "NodeGroupInput", "NodeGroupOutput", "GeometryNodeInstanceOnPoints", "GeometryNodeMeshCube",
        "GeometryNodeSetMaterial", "GeometryNodeStoreNamedAttribute", "GeometryNodeInputPosition"))
    paint.inputs["Material"].default_value = asking("INSTANCER", "tint")
    store.data_type, store.domain = "FLOAT_VECTOR", "INSTANCE"
    store.inputs["Name"].default_value = "tint"
    value = next(s for s in store.inputs if s.name == "Value" and s.enabled)
    for a, b in ((start.outputs[0], put.inputs["Points"]), (cube.outputs[0], paint.inputs[0]),
                 (paint.outputs[0], put.inputs["Instance"]), (put.outputs[0], store.inputs[0]),
                 (at.outputs[0], value), (store.outputs[0], end.inputs[0])):
        tree.links.new(a, b)
    owner.modifiers.new("Scatter", "NODES").node_group = tree
    scene = extracted()
    np.testing.assert_allclose(rows(scene, "instancer:tint")[:, :3], scene.instances.world_from_object[:, :3, 3])


def test_particles(empty):
    nodes = material()
    shown = plane(nodes.show(nodes.new("Emission", Strength=nodes.new("ParticleInfo").outputs["Index"])), at=(9, 0, 0))
    owner = plane(name="Emitter")
    owner.modifiers.new("P", "PARTICLE_SYSTEM")
    settings = owner.particle_systems[0].settings
    settings.count, settings.frame_end, settings.render_type = 5, 1, "OBJECT"
    settings.instance_object = shown
    empty.frame_set(1)
    scene = extracted()
    numbers = rows(scene, "particle:numbers")[[name == "Plane" for name in scene.instances.names]]
    assert sorted(numbers[:, 0].tolist()) == [0, 0, 1, 2, 3, 4]  # and the plane itself, which is none
    assert rows(scene, "particle:location").any()


@pytest.mark.parametrize("kind", ["OBJECT", "VIEW_LAYER"])
def test_edits_are_followed(empty, kind):
    shown = plane(asking(kind, "heat"))
    owner = shown if kind == "OBJECT" else empty
    owner["heat"] = 0.25
    followed = Followed()

    def edit():
        owner["heat"] = 0.5
        owner.update_tag()

    assert rows(followed.after(edit), f"{kind.lower()}:heat")[0, 0] == 0.5
