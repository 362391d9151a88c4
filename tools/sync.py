# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.sync`: what edits cost on Blender's main thread, beside the whole extraction that they once took."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import bpy
import numpy as np

from svo_engine.blender.extract import extract
from svo_engine.blender.sync import Sync

N_INSTANCES = 10_000
N_REPEATS = 7

Act = Callable[[int], object]

HEAD = """
## {title}

Extraction {extract:.1f} ms, once the price of each edit; full sync {full:.1f} ms.

| edit | ours, ms | of a full sync | walks | meshes read | images read |
|---|---|---|---|---|---|"""


class Timed:
    """A Sync that is told of changes as a viewport is, and what each update took."""

    def __init__(self) -> None:
        self.sync, self.milliseconds = Sync(), 0.0
        bpy.app.handlers.depsgraph_update_post.append(self.update)
        bpy.context.view_layer.update()

    def update(self, _scene: Any, depsgraph: Any) -> None:
        """Sync, and add up the time."""
        start = time.perf_counter()
        self.sync.update(depsgraph)
        self.milliseconds += (time.perf_counter() - start) * 1e3

    def counts(self) -> np.ndarray:
        """Walks, meshes read and images read so far."""
        return np.array([self.sync.n_walks, self.sync.meshes.n_read, self.sync.images.n_read])

    def row(self, name: str, act: Act, full: float) -> str:
        """The median of some edits, of which the first, that fills caches, does not count."""
        found = []
        for i in range(N_REPEATS + 1):
            before, self.milliseconds = self.counts(), 0.0
            act(i)
            bpy.context.view_layer.update()
            found.append(self.milliseconds)
        done = " | ".join(map(str, self.counts() - before))
        took = statistics.median(found[1:])
        return f"| {name} | {took:.2f} | {took / full:.2%} | {done} |"


def main() -> None:
    """Print a table for each scene."""
    for title, make in SCENES.items():
        bpy.ops.wm.read_factory_settings(use_empty=True)
        edits = make()
        graph = bpy.context.evaluated_depsgraph_get()
        extract(graph)
        whole = min(_milliseconds(partial(extract, graph)) for _ in range(3))
        full = min(_milliseconds(lambda: Sync().update(graph)) for _ in range(3))  # noqa: B023 - called here
        print(HEAD.format(title=title, extract=whole, full=full))
        timed = Timed()
        timed.update(None, bpy.context.evaluated_depsgraph_get())
        for name, act in edits.items():
            print(timed.row(name, act, full))


def _milliseconds(act: Callable[[], object]) -> float:
    start = time.perf_counter()
    act()
    return (time.perf_counter() - start) * 1e3


def _heavy() -> dict[str, Act]:
    """A million triangles with an image of 4096 x 4096."""
    _grid(708)
    _textured(bpy.context.object, 4096)
    big = bpy.context.object
    small = _plane("Small")
    return _edits() | {
        "move of the large object": lambda i: setattr(big, "location", (i, 0, 0)),
        "move of a small object": lambda i: setattr(small, "location", (i, 0, 0)),
        "edit of a small mesh": lambda i: _edit(small.data, i),
        "slot of a small object": lambda i: setattr(small.material_slots[0], "material", bpy.data.materials[i % 2]),
        "slot of the large object": lambda i: setattr(big.material_slots[0], "material", bpy.data.materials[i % 2]),
        "edit of the large mesh": lambda i: _edit(big.data, i),
    }


def _linked() -> dict[str, Act]:
    """Objects that share one mesh."""
    mesh = _plane("Object").data
    for i in range(N_INSTANCES - 1):
        _place(f"Object {i}", mesh, i)
    return _edits() | _many("Object 77")


def _instanced() -> dict[str, Act]:
    """Empties that each show one collection."""
    inside = _plane("Inside")
    shown = bpy.data.collections.new("Shown")
    bpy.context.scene.collection.objects.unlink(inside)
    shown.objects.link(inside)
    for i in range(N_INSTANCES):
        empty = _place(f"Object {i}", None, i)
        empty.instance_type, empty.instance_collection = "COLLECTION", shown
    return _edits() | _many("Object 77")


def _scattered() -> dict[str, Act]:
    """Instances that one object makes by geometry nodes, and a plain object."""
    tree = bpy.data.node_groups.new("Geometry", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    grid, on_points, cube, end = (tree.nodes.new(kind) for kind in (
        "GeometryNodeMeshGrid", "GeometryNodeInstanceOnPoints", "GeometryNodeMeshCube", "NodeGroupOutput"))
    for name in ("Vertices X", "Vertices Y"):
        grid.inputs[name].default_value = 100
    tree.links.new(grid.outputs[0], on_points.inputs["Points"])
    tree.links.new(cube.outputs[0], on_points.inputs["Instance"])
    tree.links.new(on_points.outputs[0], end.inputs[0])
    _plane("Generator").modifiers.new("Nodes", "NODES").node_group = tree
    _plane("Object 77")
    return _edits() | _many("Object 77") | {
        "move of the generator": lambda i: setattr(bpy.data.objects["Generator"], "location", (i, 0, 0))}


def _edits() -> dict[str, Act]:
    """Those of every scene."""
    scene = bpy.context.scene
    lamp, camera = bpy.data.lights.new("Lamp", "POINT"), bpy.data.cameras.new("Camera")
    lit, scene.camera = _place("Lamp", lamp, 0), _place("Camera", camera, 0)
    shader = bpy.data.materials["Material"].node_tree.nodes["Principled BSDF"]
    scene.world = bpy.data.worlds.new("World")
    return {
        "lamp's power": lambda i: setattr(lamp, "energy", i),
        "lamp moved": lambda i: setattr(lit, "location", (0, 0, i)),
        "camera moved": lambda i: setattr(scene.camera, "location", (0, 0, i)),
        "lens": lambda i: setattr(camera, "lens", 20 + i),
        "roughness": lambda i: setattr(shader.inputs["Roughness"], "default_value", i / 10),
        "world's colour": lambda i: setattr(scene.world, "color", (i / 10, 0, 0)),
        "selection": lambda i: lit.select_set(i % 2 == 0),
        "exposure": lambda i: setattr(scene.view_settings, "exposure", i / 10),
    }


def _many(name: str) -> dict[str, Act]:
    """One among many, by its name."""
    one = bpy.data.objects[name]
    return {"move of one object": lambda i: setattr(one, "location", (0, 0, i)),
            "one object hidden or shown": lambda i: one.hide_set(i % 2 == 0),
            "one object added": lambda i: _place("New", bpy.data.meshes[0], i)}


def _edit(mesh: Any, z: float) -> None:
    mesh.vertices[0].co.z = z
    mesh.update()


def _place(name: str, data: Any, x: float) -> Any:
    made = bpy.data.objects.new(name, data)
    made.location.x = x
    bpy.context.scene.collection.objects.link(made)
    return made


def _plane(name: str) -> Any:
    """A square with the plain material."""
    bpy.ops.mesh.primitive_plane_add()
    made = bpy.context.object
    made.name = name
    if "Material" not in bpy.data.materials:
        _with_nodes(bpy.data.materials.new("Material"))
    made.data.materials.append(bpy.data.materials["Material"])
    return made


def _grid(n: int) -> None:
    """A square of n by n faces, smooth, with the coordinates of an image."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=n, y_subdivisions=n, calc_uvs=True)
    bpy.ops.object.shade_smooth()


def _textured(owner: Any, side: int) -> None:
    """Give `owner` a material with an image of side by side texels, packed into the file."""
    image = bpy.data.images.new("Image", side, side)
    image.pixels.foreach_set(np.random.default_rng(1).random(side * side * 4, "f4"))
    image.pack()
    tree = _with_nodes(material := bpy.data.materials.new("Textured"))
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    tree.links.new(texture.outputs[0], tree.nodes["Principled BSDF"].inputs["Base Color"])
    owner.data.materials.append(material)


def _with_nodes(material: Any) -> Any:
    """Its tree, which Blender 5 makes at birth."""
    if material.node_tree is None:
        material.use_nodes = True
    return material.node_tree


SCENES: dict[str, Callable[[], dict[str, Act]]] = {
    "1 M triangles and an image of 4096 x 4096": _heavy,
    f"{N_INSTANCES:,} objects with one mesh": _linked,
    f"{N_INSTANCES:,} collection instances": _instanced,
    f"{N_INSTANCES:,} instances of geometry nodes": _scattered,
}


if __name__ == "__main__":
    main()
