# SPDX-License-Identifier: GPL-3.0-or-later
"""Acts after which a finished viewport picture stays, beside those after which it must begin anew."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.blender.build import place
from tests.blender.following import Followed, area_of_window, differences, space_of_window, studio


def thing(name):
    return bpy.data.objects[name]


def shader(name, kind="Principled BSDF"):
    return bpy.data.materials[name].node_tree.nodes[kind]


def sky():
    return bpy.context.scene.world.node_tree.nodes["Background"]


def change(owner, **values):
    for name, value in values.items():
        setattr(owner, name, value)


def set_pixels(value):
    picture = bpy.data.images["Image"]
    picture.pixels.foreach_set(np.full(64, value, "f4"))
    picture.update()


def edit_mesh(name="Textured"):
    mesh = bpy.data.meshes[name]
    mesh.vertices[0].co.z = 1
    mesh.update()


def edit_in_edit_mode():
    bpy.context.view_layer.objects.active = thing("Textured")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    bpy.ops.object.mode_set(mode="OBJECT")


def edit_mode_and_back():
    bpy.context.view_layer.objects.active = thing("Textured")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.object.mode_set(mode="OBJECT")


def toggle_local_view():
    for each in bpy.context.view_layer.objects:
        each.select_set(each.name == "Plain")
    area = area_of_window()
    with bpy.context.temp_override(window=bpy.context.window, area=area,
                                   region=next(r for r in area.regions if r.type == "WINDOW")):
        bpy.ops.view3d.localview()


def scene():
    return bpy.context.scene


STAY = {
    "nothing": lambda: None,
    "select": lambda: thing("Plain").select_set(True),
    "active object": lambda: change(bpy.context.view_layer.objects, active=thing("Copy")),
    "3D cursor": lambda: change(scene().cursor, location=(1, 2, 3)),
    "name of an object": lambda: change(thing("Plain"), name="Renamed"),
    "name of a mesh": lambda: change(bpy.data.meshes["Textured"], name="Renamed"),
    "name of a material": lambda: change(bpy.data.materials["Plain"], name="Renamed"),
    "name of a lamp": lambda: change(thing("Lamp"), name="Renamed"),
    "name of an image": lambda: change(bpy.data.images["Image"], name="Renamed"),
    "output path": lambda: change(scene().render, filepath="//elsewhere"),
    "resolution": lambda: change(scene().render, resolution_x=77),
    "exposure": lambda: change(scene().view_settings, exposure=2.0),
    "view transform": lambda: change(scene().view_settings, view_transform="Raw"),
    "display colour of an object": lambda: change(thing("Plain"), color=(1, 0, 0, 1)),
    "display colour of a material": lambda: change(bpy.data.materials["Plain"], diffuse_color=(1, 0, 0, 1)),
    "display as wire": lambda: change(thing("Plain"), display_type="WIRE"),
    "display of the name": lambda: change(thing("Plain"), show_name=True),
    "display size of an empty": lambda: change(thing("Empty"), empty_display_size=3.0),
    "empty moved": lambda: change(thing("Empty"), location=(1, 2, 3)),
    "empty added": lambda: place(None, "New Empty"),
    "lens of another camera": lambda: change(bpy.data.cameras["Unused"], lens=20.0),
    "another camera moved": lambda: change(thing("Unused"), location=(1, 2, 3)),
    "the scene's camera moved": lambda: change(thing("Camera"), location=(1, 2, 3)),
    "another camera is the scene's": lambda: change(scene(), camera=thing("Unused")),
    "frame at which nothing moves": lambda: scene().frame_set(21),
    "material that nothing shows": lambda: change(shader("Other").inputs["Roughness"], default_value=0.1),
    "node moved in the editor": lambda: change(shader("Plain"), location=(9, 9)),
    "value set to what it is": lambda: change(bpy.data.lights["Lamp"], energy=100.0),
    "hidden from renders": lambda: change(thing("Plain"), hide_render=True),
    "overlays": lambda: change(space_of_window().overlay, show_overlays=False),
    "edit mode and back": edit_mode_and_back,
}

RESTART = {
    "lamp's power": lambda: change(bpy.data.lights["Lamp"], energy=5.0),
    "lamp's colour": lambda: change(bpy.data.lights["Lamp"], color=(1, 0, 0)),
    "lamp's type": lambda: change(bpy.data.lights["Lamp"], type="SUN"),
    "lamp's shadow": lambda: change(bpy.data.lights["Lamp"], use_shadow=False),
    "lamp moved": lambda: change(thing("Lamp"), location=(1, 2, 3)),
    "lamp of an instanced collection": lambda: change(thing("Inside Lamp").data, energy=5.0),
    "lamp added": lambda: place(bpy.data.lights["Lamp"], "New Lamp"),
    "colour": lambda: change(shader("Plain").inputs["Base Color"], default_value=(1, 0, 0, 1)),
    "roughness": lambda: change(shader("Plain").inputs["Roughness"], default_value=0.1),
    "texture muted": lambda: change(shader("Textured", "Image Texture"), mute=True),
    "image's colour space": lambda: change(bpy.data.images["Image"].colorspace_settings, name="Non-Color"),
    "object moved": lambda: change(thing("Textured"), location=(1, 2, 3)),
    "object scaled": lambda: change(thing("Copy"), scale=(1, 2, 3)),
    "instancer moved": lambda: change(thing("Instancer 1"), location=(1, 2, 3)),
    "object inside of a collection moved": lambda: change(thing("Inside"), location=(1, 2, 3)),
    "collection's offset": lambda: change(bpy.data.collections["Inner"], instance_offset=(1, 2, 3)),
    "instancing switched off": lambda: change(thing("Instancer 1"), instance_type="NONE"),
    "parent": lambda: change(thing("Textured"), parent=thing("Copy")),
    "object added": lambda: place(bpy.data.meshes["Plain"], "New"),
    "object deleted": lambda: bpy.data.objects.remove(thing("Textured")),
    "object's mesh": lambda: change(thing("Textured"), data=bpy.data.meshes["Animated"]),
    "mesh edited": edit_mesh,
    "mesh edited in edit mode": edit_in_edit_mode,
    "face's material": lambda: (bpy.data.meshes["Textured"].materials.append(bpy.data.materials["Other"]),
                                change(bpy.data.meshes["Textured"].polygons[0], material_index=1)),
    "modifier changed": lambda: change(thing("Plain").modifiers["Array"], count=3),
    "modifier switched off": lambda: change(thing("Plain").modifiers["Array"], show_viewport=False),
    "modifier added": lambda: thing("Copy").modifiers.new("Array", "ARRAY"),
    "slot assigned": lambda: change(thing("Plain").material_slots[0], material=bpy.data.materials["Other"]),
    "slot linked to the object": lambda: (
        change(thing("Copy").material_slots[0], link="OBJECT"),
        change(thing("Copy").material_slots[0], material=bpy.data.materials["Other"])),
    "override of materials": lambda: change(bpy.context.view_layer, material_override=bpy.data.materials["Other"]),
    "world's colour": lambda: change(sky().inputs["Color"], default_value=(1, 0, 0, 1)),
    "world's strength": lambda: change(sky().inputs["Strength"], default_value=3.0),
    "another world": lambda: change(scene(), world=bpy.data.worlds.new("New")),
    "hide": lambda: thing("Plain").hide_set(True),
    "hide in viewports": lambda: change(thing("Plain"), hide_viewport=True),
    "collection excluded": lambda: change(bpy.context.view_layer.layer_collection.children["Outer"], exclude=True),
    "collection hidden": lambda: change(bpy.context.view_layer.layer_collection.children["Outer"], hide_viewport=True),
    "transparent film": lambda: change(scene().render, film_transparent=True),
}

# Undo does not bring these back
RESTART_WITHOUT_UNDO = {
    "pixels": lambda: (set_pixels(1.0), bpy.data.images["Image"].update_tag()),
    "image scaled": lambda: bpy.data.images["Image"].scale(2, 2),
    "image's alpha": lambda: (set_pixels(0.25), change(bpy.data.images["Image"], alpha_mode="NONE")),
    "frame at which something moves": lambda: scene().frame_set(5),
    "local view": toggle_local_view,
    "types that the viewport shows": lambda: change(space_of_window(), show_object_viewport_mesh=False),
}


@pytest.fixture
def followed():
    studio()
    bpy.ops.ed.undo_push(message="Studio")
    bpy.ops.ed.undo_push(message="Once more, so that there is one to come back to")
    return Followed(space_of_window())


def assert_is_fresh(followed):
    assert differences(followed.scene, followed.fresh()) == []


@pytest.mark.parametrize("act", STAY.values(), ids=STAY)
def test_picture_stays(followed, act):
    before = followed.picture
    after = followed.after(act)
    assert differences(after.plain, before.plain) == []
    assert followed.picture is before
    assert_is_fresh(followed)


@pytest.mark.parametrize("act", (RESTART | RESTART_WITHOUT_UNDO).values(), ids=RESTART | RESTART_WITHOUT_UNDO)
def test_picture_restarts(followed, act):
    before = followed.picture
    followed.after(act)
    assert differences(followed.picture, before)
    assert_is_fresh(followed)


@pytest.mark.parametrize("act", RESTART.values(), ids=RESTART)
def test_undo_and_redo(followed, act):
    before = followed.scene
    edited = followed.after(act)
    bpy.ops.ed.undo_push(message="Edit")
    undone = followed.after(bpy.ops.ed.undo)
    assert differences(undone, before) == []
    assert_is_fresh(followed)
    assert differences(followed.after(bpy.ops.ed.redo), edited) == []
    assert_is_fresh(followed)
