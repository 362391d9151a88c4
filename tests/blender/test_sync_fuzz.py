# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever is done in whatever order, what is kept equals what is read anew."""

from __future__ import annotations

import random

import bpy
import numpy as np
import pytest

from svo_engine.blender.sync import copies
from tests.blender.build import image, material, place, plane
from tests.blender.following import Followed, area_of_window, differences, space_of_window, studio
from tests.blender.test_extract_instances import Geometry

N_STEPS = 30


def busy_studio():
    """The studio, and what else can go wrong: geometry nodes, particles, a group of nodes, texts, a world's image."""
    scene = studio()
    scatter()
    bpy.ops.object.text_add(location=(0, 9, 0))
    emitter = plane(name="Emitter", at=(9, 9, 0))
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.type, settings.count, settings.render_type = "HAIR", 5, "OBJECT"
    settings.instance_object = bpy.data.objects["Plain"]
    group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    group.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    color, end = group.nodes.new("ShaderNodeRGB"), group.nodes.new("NodeGroupOutput")
    group.links.new(color.outputs[0], end.inputs[0])
    for i in range(2):
        made = material(f"Grouped {i}")
        inner = made.tree.nodes.new("ShaderNodeGroup")
        inner.node_tree = group
        plane(made.show(made.new("BsdfDiffuse", Color=inner.outputs[0])), name=f"Grouped {i}", at=(0, -3, i))
    image(np.full((2, 4, 4), 0.5), name="Sky", is_float=True).pack()
    nest()
    animate()
    return scene


def animate():
    """A material and the object that has it change in the same frames."""
    owner = bpy.data.objects["Plain"]
    roughness = bpy.data.materials["Plain"].node_tree.nodes["Principled BSDF"].inputs["Roughness"]
    for frame, value in ((1, 0), (10, 1)):
        owner.pass_index, roughness.default_value = value * 9, value
        owner.keyframe_insert("pass_index", frame=frame)
        roughness.keyframe_insert("default_value", frame=frame)


def nest():
    """A collection that shows another one, shown twice."""
    nested = bpy.data.collections.new("Nest")
    for name in ("Nested Instancer", "Nest 0", "Nest 1"):
        made = place(None, name, at=(0, 0, 5))
        made.instance_type = "COLLECTION"
        made.instance_collection = nested if name.startswith("Nest ") else bpy.data.collections["Inner"]
    inner = bpy.data.objects["Nested Instancer"]
    bpy.context.scene.collection.objects.unlink(inner)
    nested.objects.link(inner)


def scatter():
    """Instances of two meshes that geometry nodes make, beside the generator's own."""
    nodes = Geometry()
    nodes.owner.name = "Generator"
    join = nodes.new("GeometryNodeJoinGeometry")
    for kind in ("GeometryNodeMeshIcoSphere", "GeometryNodeMeshCube"):
        shape, on_points = nodes.new(kind), nodes.new("GeometryNodeInstanceOnPoints")
        nodes.link(shape, on_points, "Instance")
        nodes.link(nodes.input, on_points, "Points")
        nodes.link(on_points, join)
    nodes.link(nodes.input, join)
    nodes.link(join, nodes.output)


class Chance:
    """Draws what to do, and to what."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def one(self, found):
        return self.random.choice(sorted(found, key=lambda each: each.name))

    def thing(self, *kinds):
        """An object of the view layer, of one of `kinds` if any are named."""
        found = [each for each in bpy.context.view_layer.objects if each and (not kinds or each.type in kinds)]
        return self.one(found) if found else place(bpy.data.meshes[0], "Made anew")

    def vector(self):
        return [self.random.uniform(-5, 5) for _ in range(3)]

    def color(self):
        return [self.random.random() for _ in range(3)] + [1.0]

    def flip(self):
        return self.random.random() < 0.5


def move(chance):
    chance.thing().location = chance.vector()


def scale(chance):
    chance.thing().scale = chance.vector()


def parent(chance):
    child, owner = chance.thing(), chance.thing()
    above = owner
    while above is not None and above != child:
        above = above.parent
    child.parent = owner if above is None and chance.flip() else None


def add(chance):
    place(chance.one(bpy.data.meshes), "Added", at=chance.vector())


def add_lamp(chance):
    place(chance.one(bpy.data.lights), "Added Lamp", at=chance.vector())


def add_instancer(chance):
    made = place(None, "Added Instancer", at=chance.vector())
    made.instance_type, made.instance_collection = "COLLECTION", bpy.data.collections["Inner"]


def delete(chance):
    bpy.data.objects.remove(chance.thing())


def delete_and_add(chance):
    name = (old := chance.thing("MESH")).name
    bpy.data.objects.remove(old)
    place(chance.one(bpy.data.meshes), name, at=chance.vector())


def rename(chance):
    chance.thing().name = chance.random.choice("ABC")


def setting(chance):
    owner = chance.thing("MESH")
    what = chance.random.randrange(3)
    if what == 0:
        owner.pass_index = chance.random.randrange(9)
    elif what == 1:
        owner.color = chance.color()
    else:
        owner.visible_camera = not owner.visible_camera


def light(chance):
    data = chance.one(bpy.data.lights)
    if chance.flip():
        data.energy = chance.random.uniform(0, 100)
    else:
        data.type = chance.random.choice(("POINT", "SUN", "SPOT", "AREA"))


def shade(chance):
    nodes = chance.one(bpy.data.materials).node_tree.nodes
    for node in nodes:
        for socket in node.inputs:
            if socket.identifier in ("Roughness", "Metallic", "Emission Strength"):
                socket.default_value = chance.random.random()
            elif socket.identifier in ("Base Color", "Color"):
                socket.default_value = chance.color()


def link(chance):
    tree = bpy.data.materials["Textured"].node_tree
    texture, shader = tree.nodes["Image Texture"], tree.nodes["Principled BSDF"]
    name = chance.random.choice(("Base Color", "Roughness", "Alpha", "Emission Color"))
    if shader.inputs[name].is_linked:
        tree.links.remove(shader.inputs[name].links[0])
    else:
        tree.links.new(texture.outputs["Alpha" if name == "Alpha" else "Color"], shader.inputs[name])


def group(chance):
    next(n for n in bpy.data.node_groups["Group"].nodes if n.type == "RGB").outputs[0].default_value = chance.color()


def assign(chance):
    owner = chance.thing("MESH")
    if not owner.material_slots:
        owner.data.materials.append(chance.one(bpy.data.materials))
        return
    slot = owner.material_slots[0]
    slot.link = chance.random.choice(("DATA", "OBJECT"))
    slot.material = chance.one(bpy.data.materials) if chance.flip() else None


def edit(chance):
    mesh = chance.one(bpy.data.meshes)
    mesh.vertices[0].co = chance.vector()
    mesh.update()


def swap(chance):
    chance.thing("MESH").data = chance.one(bpy.data.meshes)


def modify(chance):
    owner = chance.thing("MESH")
    if not owner.modifiers:
        owner.modifiers.new("Array", "ARRAY").count = chance.random.randrange(1, 4)
    elif chance.flip():
        owner.modifiers[0].show_viewport = not owner.modifiers[0].show_viewport
    else:
        owner.modifiers.clear()


def hide(chance):
    owner = chance.thing()
    if chance.flip():
        owner.hide_set(not owner.hide_get())
    else:
        owner.hide_viewport = not owner.hide_viewport


def show_all(chance):
    for each in filter(None, bpy.context.view_layer.objects):
        each.hide_set(False)
        each.hide_viewport = False


def collection(chance):
    outer = bpy.context.view_layer.layer_collection.children["Outer"]
    if chance.flip():
        outer.hide_viewport = not outer.hide_viewport
    elif chance.flip():
        outer.exclude = not outer.exclude
    else:
        bpy.data.collections["Inner"].instance_offset = chance.vector()


def sky(chance):
    scene = bpy.context.scene
    if chance.flip():
        scene.world = None if chance.random.random() < 0.2 else chance.one(bpy.data.worlds)
    if scene.world is None:
        return
    tree = scene.world.node_tree
    shader = tree.nodes["Background"]
    shader.inputs["Color"].default_value = chance.color()
    if chance.flip():
        texture = tree.nodes.get("Environment Texture") or tree.nodes.new("ShaderNodeTexEnvironment")
        texture.image = bpy.data.images["Sky"]
        tree.links.new(texture.outputs[0], shader.inputs["Color"])
    else:
        for each in list(shader.inputs["Color"].links):
            tree.links.remove(each)


def pixels(chance):
    picture = chance.one(bpy.data.images[name] for name in ("Image", "Sky"))
    picture.pixels.foreach_set(np.full(len(picture.pixels), chance.random.random(), "f4"))
    picture.update()
    if chance.flip():
        picture.update_tag()


def picture(chance):
    owner = bpy.data.images["Image"]
    what = chance.random.randrange(3)
    if what == 0:
        owner.reload()
    elif what == 1:
        owner.colorspace_settings.name = chance.random.choice(("sRGB", "Non-Color"))
    else:
        owner.alpha_mode = chance.random.choice(("STRAIGHT", "NONE", "CHANNEL_PACKED"))


def frame(chance):
    bpy.context.scene.frame_set(chance.random.randrange(1, 15))


def generate(chance):
    tree = bpy.data.node_groups["Geometry"]
    if chance.flip():
        tree.nodes["Cube"].inputs["Size"].default_value = chance.vector()
    else:
        tree.nodes["Ico Sphere"].inputs["Subdivisions"].default_value = chance.random.randrange(1, 3)


def particles(chance):
    bpy.data.particles[0].count = chance.random.randrange(1, 9)


def override(chance):
    bpy.context.view_layer.material_override = chance.one(bpy.data.materials) if chance.flip() else None


def select(chance):
    owner = chance.thing()
    owner.select_set(chance.flip())
    bpy.context.view_layer.objects.active = owner


def edit_mode(chance):
    bpy.context.view_layer.objects.active = owner = chance.thing("MESH")
    if owner.visible_get():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
        bpy.ops.object.mode_set(mode="OBJECT")


def local_view(chance):
    area = area_of_window()
    with bpy.context.temp_override(window=bpy.context.window, area=area,
                                   region=next(r for r in area.regions if r.type == "WINDOW")):
        if bpy.ops.view3d.localview.poll():
            bpy.ops.view3d.localview()


def types(chance):
    space = space_of_window()
    name = f"show_object_viewport_{chance.random.choice(('mesh', 'light', 'empty'))}"
    setattr(space, name, not getattr(space, name))


def undo(chance):
    if bpy.ops.ed.undo.poll():
        bpy.ops.ed.undo()


def redo(chance):
    if bpy.ops.ed.redo.poll():
        bpy.ops.ed.redo()


ACTS = (move, move, scale, parent, add, add_lamp, add_instancer, delete, delete_and_add, rename, setting, light, shade,
        link, group, assign, assign, edit, swap, modify, hide, show_all, collection, sky, pixels, picture, frame,
        generate, particles, override, select, edit_mode, local_view, types, undo, undo, redo)
ALONE = (undo, redo, edit_mode, local_view, frame, setting, rename)


@pytest.mark.parametrize("seed", [*range(16), 148])  # 148: undo of what a frame change made of a material
def test_what_is_kept_is_what_is_read_anew(seed, monkeypatch):
    if seed % 4 < 2:  # as if all meshes were large
        monkeypatch.setattr(copies, "_FEWEST_CORNERS", 0)
    busy_studio()
    bpy.ops.ed.undo_push(message="Studio")
    followed = Followed(space_of_window() if seed % 2 else None)
    chance, trail = Chance(seed), []
    for _ in range(N_STEPS):
        acts = [chance.random.choice(ACTS) for _ in range(chance.random.choice((1, 1, 1, 2, 3)))]
        if set(acts) & set(ALONE):
            acts = acts[:1]
        trail.append(" and ".join(act.__name__ for act in acts))

        def all_acts(acts=acts):
            for act in acts:
                act(chance)

        followed.after(all_acts)
        assert differences(followed.scene, followed.fresh()) == [], f"seed {seed}: {', '.join(trail)}"
        if not set(acts) & {undo, redo}:
            bpy.ops.ed.undo_push(message=trail[-1])
