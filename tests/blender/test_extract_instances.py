# SPDX-License-Identifier: GPL-3.0-or-later
"""Where meshes stand: each stored once, however it is repeated, with the materials that each placing has."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.blender.build import extracted, extracted_by_render, lamp, material, place, plane


def places(scene):
    """Where the instances stand, sorted: (n, 3)."""
    return np.array(sorted(scene.instances.world_from_object[:, :3, 3].tolist()))


def materials_of(scene, i):
    """Names of the materials in the slots of instance i."""
    inst = scene.instances
    return [scene.materials[m].name for m in inst.slot_materials[inst.first_slot[i]:inst.first_slot[i + 1]]]


def shade(name):
    made = material(name)
    return made.show(made.new("Emission"))


def collection_of(*owners):
    made = bpy.data.collections.new("Collection")
    for owner in owners:
        bpy.context.scene.collection.objects.unlink(owner)
        made.objects.link(owner)
    return made


def show_collection(collection, **where):
    made = place(None, "Show", **where)
    made.instance_type, made.instance_collection = "COLLECTION", collection
    return made


class Geometry:
    """Geometry nodes on a new object whose own mesh is one triangle."""

    def __init__(self):
        self.tree = bpy.data.node_groups.new("Geometry", "GeometryNodeTree")
        for way in ("INPUT", "OUTPUT"):
            self.tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
        self.input, self.output = self.new("NodeGroupInput"), self.new("NodeGroupOutput")
        self.owner = plane(name="Generator")
        self.owner.modifiers.new("Nodes", "NODES").node_group = self.tree

    def new(self, kind, **inputs):
        node = self.tree.nodes.new(kind)
        for name, value in inputs.items():
            node.inputs[name.replace("_", " ")].default_value = value
        return node

    def link(self, source, target, name=0):
        self.tree.links.new(source.outputs[0], target.inputs[name])


def test_linked_objects_share_a_mesh(empty):
    owner = plane()
    for i in range(1, 5):
        place(owner.data, f"Copy {i}", at=(i, 0, 0))
    scene = extracted()
    assert len(scene.meshes) == 1
    assert scene.instances.mesh.tolist() == [0] * 5
    np.testing.assert_allclose(places(scene), [(i, 0, 0) for i in range(5)])


def test_modifier_makes_it_another_mesh(empty):
    owner = plane()
    place(owner.data, "Copy", at=(1, 0, 0)).modifiers.new("Array", "ARRAY")
    scene = extracted()
    assert sorted(len(m.triangles) for m in scene.meshes) == [2, 4]


def test_parents_scale_and_rotation(empty):
    parent = place(None, "Parent", at=(1, 2, 3), turn=(0.1, 0.2, 0.3), scale=(1, 2, -3))
    owner = plane(turn=(1, 0, 0))
    owner.parent = parent
    scene = extracted()
    np.testing.assert_allclose(scene.instances.world_from_object[0], np.array(owner.matrix_world), rtol=1e-6)
    assert np.linalg.det(scene.instances.world_from_object[0]) < 0


def test_collection_instances(empty):
    collection = collection_of(plane(at=(1, 0, 0)))
    show_collection(collection, at=(0, 5, 0))
    show_collection(collection, at=(0, 7, 0))
    scene = extracted()
    assert len(scene.meshes) == 1
    np.testing.assert_allclose(places(scene), [(1, 5, 0), (1, 7, 0)])
    assert scene.instances.names == ("Plane", "Plane")


def test_text_in_a_collection_instance(empty):
    bpy.ops.object.text_add()
    collection = collection_of(bpy.context.object)
    show_collection(collection, at=(0, 5, 0))
    show_collection(collection, at=(0, 7, 0))
    scene = extracted()
    assert len(scene.meshes) == 1
    np.testing.assert_allclose(places(scene), [(0, 5, 0), (0, 7, 0)])


def test_lamps_of_a_collection_instance(empty):
    collection = collection_of(lamp("POINT", at=(1, 0, 0)))
    show_collection(collection, at=(0, 5, 0))
    show_collection(collection, at=(0, 7, 0))
    np.testing.assert_allclose([light.world_from_light[:3, 3] for light in extracted().lights], [(1, 5, 0), (1, 7, 0)])


@pytest.mark.parametrize("shows_itself", [False, True])
def test_instancer_that_hides_itself(empty, shows_itself):
    owner = plane(name="Instancer")
    child = plane(name="Child")
    child.parent, owner.instance_type = owner, "VERTS"
    owner.show_instancer_for_viewport = shows_itself
    names = extracted().instances.names
    assert names.count("Instancer") == shows_itself
    assert names.count("Child") >= 4  # once at each vertex; the viewport shows the child itself, too


@pytest.mark.parametrize("shows_itself", [False, True])
def test_particles(empty, shows_itself):
    child = plane(name="Child", at=(0, 0, 9), size=0.1)
    emitter = plane(name="Emitter")
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.type, settings.count, settings.render_type, settings.instance_object = "HAIR", 20, "OBJECT", child
    emitter.show_instancer_for_viewport = shows_itself
    scene = extracted()
    assert scene.instances.names.count("Child") == 20 + 1
    assert scene.instances.names.count("Emitter") == shows_itself
    assert len(scene.meshes) == 1 + shows_itself


def test_hair_strands_are_told(empty):
    emitter = plane(name="Emitter")
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    emitter.particle_systems[0].settings.type = "HAIR"
    assert extracted().warnings == ("Object 'Emitter' has hair strands, which are not supported; they are left out",)


def test_geometry_nodes_instances_of_two_meshes_are_not_mixed_up(empty):
    """All instances bear the generator's name and data: only the evaluated mesh tells them apart."""
    nodes = Geometry()
    join = nodes.new("GeometryNodeJoinGeometry")
    for kind in ("GeometryNodeMeshIcoSphere", "GeometryNodeMeshCube"):
        shape, on_points = nodes.new(kind), nodes.new("GeometryNodeInstanceOnPoints")
        nodes.link(shape, on_points, "Instance")
        nodes.link(nodes.input, on_points, "Points")
        nodes.link(on_points, join)
    nodes.link(join, nodes.output)
    scene = extracted()
    assert sorted(len(m.triangles) for m in scene.meshes) == [12, 20]
    assert np.bincount(scene.instances.mesh).tolist() == [4, 4]
    assert set(scene.instances.names) == {"Generator"}


def test_material_set_by_geometry_nodes(empty):
    nodes = Geometry()
    shape = nodes.new("GeometryNodeMeshCube")
    setter = nodes.new("GeometryNodeSetMaterial", Material=shade("Set"))
    nodes.link(shape, setter, "Geometry")
    nodes.link(setter, nodes.output)
    scene = extracted()
    slots = set(scene.meshes[0].material_slots)
    assert {materials_of(scene, 0)[slot] for slot in slots} == {"Set"}


def test_hidden_source_of_geometry_nodes_is_still_instanced(empty):
    source = plane(name="Source", size=0.1)
    source.hide_viewport = True
    nodes = Geometry()
    info = nodes.new("GeometryNodeObjectInfo", Object=source, As_Instance=True)
    on_points = nodes.new("GeometryNodeInstanceOnPoints")
    nodes.tree.links.new(info.outputs["Geometry"], on_points.inputs["Instance"])
    nodes.link(nodes.input, on_points, "Points")
    nodes.link(on_points, nodes.output)
    assert extracted().instances.names == ("Source",) * 4


def test_object_hidden_from_view(empty):
    plane().hide_viewport = True
    assert len(extracted().instances) == 0


def test_final_render_has_its_own_visibility_and_detail(empty):
    plane(name="Shown").modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    plane(name="Hidden").hide_render = True
    instancer = plane(name="Instancer")
    plane(name="Child").parent, instancer.instance_type = instancer, "VERTS"
    instancer.show_instancer_for_render = False
    empty.camera = place(bpy.data.cameras.new("Camera"), "Camera")
    scene = extracted_by_render()
    assert sorted(scene.instances.names) == ["Child"] * 4 + ["Shown"]
    assert len(scene.meshes[scene.instances.mesh[scene.instances.names.index("Shown")]].triangles) == 2 * 16


def test_object_hidden_in_one_viewport_alone(empty):
    """The types that a 3D viewport can hide: the other way than local view to hide in one viewport only."""
    plane()
    lamp("POINT")
    space = next(s for screen in bpy.data.screens for area in screen.areas for s in area.spaces if s.type == "VIEW_3D")
    assert len(extracted(space=space).instances) == len(extracted(space=space).lights) == 1
    space.show_object_viewport_mesh = False
    assert len(extracted(space=space).instances) == 0
    assert len(extracted(space=space).lights) == 1
    assert len(extracted().instances) == 1


def test_slots_of_data_and_object(empty):
    owner = plane(shade("A"), shade("B"))
    copy = place(owner.data, "Copy")
    copy.material_slots[1].link, copy.material_slots[1].material = "OBJECT", shade("C")
    scene = extracted()
    assert len(scene.meshes) == 1
    assert sorted(materials_of(scene, i) for i in range(2)) == [["A", "B"], ["A", "C"]]


def test_empty_object_slot_shows_the_material_of_the_data(empty):
    slot = plane(shade("A")).material_slots[0]
    slot.link, slot.material = "OBJECT", None
    assert materials_of(extracted(), 0) == ["A"]


def test_no_slot_and_empty_slot_are_the_default(empty):
    plane()
    plane(None)
    scene = extracted()
    assert [materials_of(scene, i) for i in range(2)] == [["Default"], ["Default"]]
    assert len(scene.materials) == 1


def test_material_override_of_the_view_layer(empty):
    owner = plane(shade("A"), shade("B"))
    owner.data.polygons[0].material_index = 1
    bpy.context.view_layer.material_override = shade("All")
    assert materials_of(extracted(), 0) == ["All"]


def test_place_that_is_not_finite_is_told(empty):
    plane(name="Lost", at=(np.nan, 0, 0))
    scene = extracted()
    assert len(scene.instances) == 0
    assert scene.warnings == ("Object 'Lost' is left out: its place is not a finite number",)


def test_only_what_is_shown_is_read(empty):
    """Materials and meshes that nothing shows are not even looked at."""
    made = material("Unused")
    made.show(made.new("BsdfHair"))
    hidden = plane(made.owner)
    hidden.hide_viewport = True
    scene = extracted()
    assert scene.materials == scene.meshes == scene.warnings == ()


def test_animated_place(empty):
    owner = plane()
    for frame, x in ((1, 0), (11, 10)):
        owner.location.x = x
        owner.keyframe_insert("location", frame=frame)
    empty.frame_set(11)
    assert places(extracted())[0, 0] == 10
