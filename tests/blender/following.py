# SPDX-License-Identifier: GPL-3.0-or-later
"""A Sync that Blender tells of each change, as it tells a viewport, and a file with something of everything."""

from __future__ import annotations

from dataclasses import fields, replace

import bpy
import numpy as np

from svo_engine.blender.extract import extract
from svo_engine.blender.sync import Sync, keep_picture
from svo_engine.blender.sync.same import is_same
from svo_engine.scene.types import Scene
from tests.blender.build import image, lamp, material, place, plane, world


def space_of_window():
    """A 3D viewport of the open file."""
    return next(s for s in area_of_window().spaces if s.type == "VIEW_3D")


def area_of_window():
    return next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")


class Followed:
    """`scene` is the newest one, `picture` that of which the viewport has its picture. Blender calls handlers where it
    calls `RenderEngine.view_update`, with the same updates; a file that is opened takes them away."""

    def __init__(self, space=None) -> None:
        self.sync = Sync()
        self.space = space
        self.scene, self.picture = Scene(), None
        bpy.app.handlers.depsgraph_update_post.append(self._update)
        bpy.app.handlers.frame_change_post.append(self._update)
        bpy.context.view_layer.update()
        self._update(None, bpy.context.evaluated_depsgraph_get())

    def _update(self, _scene, depsgraph):
        self.scene = self.sync.update(depsgraph, self.space)
        self.picture = keep_picture(self.picture, self.scene)

    def after(self, act) -> Scene:
        """The Scene after `act`, as it is when the viewport has looked for silent changes and drawn itself."""
        act()
        bpy.context.view_layer.update()
        self.sync.images.compare()
        if self.sync.is_stale(self.space):
            self._update(None, bpy.context.evaluated_depsgraph_get())
        return self.scene

    def fresh(self) -> Scene:
        """What extraction finds now, and `scene` must be."""
        found = extract(bpy.context.evaluated_depsgraph_get(), space=self.space)
        return found if self.space is None else replace(found, camera=None)  # a viewport has its own

    def counts(self) -> dict[str, int]:
        """What has been done so far."""
        sync = self.sync
        return {"walks": sync.n_walks, "rows": sync.n_rows, "meshes": sync.meshes.n_read,
                "images": sync.images.n_read, "materials": sync.materials.n_read}


def studio():
    """A file of which tests edit parts by their names. Nothing that it makes is held: undo makes all anew."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    textured = material("Textured")
    texture = textured.new("TexImage")
    texture.image = image(np.full((4, 4, 4), 0.5), name="Image")
    texture.image.pack()  # else undo would paint it black
    textured.show(textured.new("BsdfPrincipled", Base_Color=texture))
    for name, roughness in (("Plain", 0.5), ("Other", 0.9)):
        made = material(name)
        made.show(made.new("BsdfPrincipled", Roughness=roughness))
    plane(textured.owner, name="Textured")
    plane(bpy.data.materials["Plain"], name="Plain", at=(3, 0, 0)).modifiers.new("Array", "ARRAY")
    place(bpy.data.meshes["Plain"], "Copy", at=(6, 0, 0))
    outer = bpy.data.collections.new("Outer")
    scene.collection.children.link(outer)
    outer.objects.link(bpy.data.objects["Copy"])
    scene.collection.objects.unlink(bpy.data.objects["Copy"])
    plane(name="Animated")
    _animate()
    _instances()
    lamp("POINT", at=(0, 0, 3), energy=100.0)
    sky = world()
    sky.show(sky.new("Background", Color=(0.1, 0.2, 0.3, 1)))
    for name in ("Camera", "Unused"):
        place(bpy.data.cameras.new(name), name, at=(0, 0, 9))
    scene.camera = bpy.data.objects["Camera"]
    place(None, "Empty")
    scene.frame_set(20)
    return scene


def _animate():
    """Moves from frame 1 to 10, then rests."""
    animated = bpy.data.objects["Animated"]
    for frame, x in ((1, 0.0), (10, 5.0)):
        animated.location.x = x
        animated.keyframe_insert("location", frame=frame)


def _instances():
    inner = bpy.data.collections.new("Inner")
    for made in (plane(name="Inside"), lamp("POINT", at=(0, 1, 1))):
        bpy.context.scene.collection.objects.unlink(made)
        inner.objects.link(made)
        made.name = made.data.name = "Inside Lamp" if made.type == "LIGHT" else "Inside"
    for i in range(2):
        shows = place(None, f"Instancer {i}", at=(i, 5, 0))
        shows.instance_type, shows.instance_collection = "COLLECTION", inner


def differences(a, b) -> list[str]:
    """The parts in which two Scenes differ by value."""
    return [f.name for f in fields(a) if not is_same(getattr(a, f.name), getattr(b, f.name))]
