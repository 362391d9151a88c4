# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of the tests as Blender has them, and what Cycles makes of two rooms."""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

from svo_engine.blender import peers
from svo_engine.scene.types import Light, Material, Mesh, Scene

FILTER_REACH = 2  # pixels: what a pixel filter of 1.5 pixels carries over an edge


def half_and_half(file: Path, renderer: str, values: dict[str, object], size: tuple[int, int]) -> tuple[float, float]:
    """Mean radiance of the left and of the right half of what `renderer` makes of `file`; not of the border."""
    with peers.opened(file, size) as scene, peers.renderer(scene, renderer, "cpu") as render:
        picture, middle = render(values).picture, size[0] // 2
    return float(picture[:, :middle - FILTER_REACH].mean()), float(picture[:, middle + FILTER_REACH:].mean())


def cycles_mean(scene: Scene, samples: int) -> float:
    """Mean radiance of Cycles' picture of a scene of grey point lamps and diffuse grey surfaces."""
    assert scene.camera
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "scene.blend")
        _build(scene)
        bpy.ops.wm.save_as_mainfile(filepath=str(file))
        with peers.opened(file, scene.camera.size) as opened, peers.renderer(opened, "cycles", "cpu") as render:
            return float(render({"samples": samples, "max_bounces": 64, "diffuse_bounces": 64}).picture.mean())


def _build(scene: Scene) -> None:
    """Make `scene` the one of an open, otherwise empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    materials = [_material(material) for material in scene.materials]
    meshes = [_mesh(mesh) for mesh in scene.meshes]
    inst = scene.instances
    for i, place in enumerate(inst.world_from_object):
        mesh = meshes[inst.mesh[i]]
        mesh.materials.append(materials[inst.slot_materials[inst.first_slot[i]]])
        _place(mesh, place)
    for light in scene.lights:
        _place(_point(light), light.world_from_light)
    assert scene.camera
    camera = bpy.data.cameras.new("Camera")
    camera.lens, camera.clip_start = scene.camera.lens, scene.camera.clip_start
    bpy.context.scene.camera = _place(camera, scene.camera.world_from_camera)


def _place(data: bpy.types.ID, place: np.ndarray) -> bpy.types.Object:
    made = bpy.data.objects.new(data.name, data)
    made.matrix_world = Matrix(place.tolist())
    bpy.context.scene.collection.objects.link(made)
    return made


def _mesh(mesh: Mesh) -> bpy.types.Mesh:
    made = bpy.data.meshes.new(mesh.name)
    made.from_pydata(mesh.positions.tolist(), [], mesh.triangles.tolist())
    return made


def _material(material: Material) -> bpy.types.Material:
    made = bpy.data.materials.new(material.name)
    if made.node_tree is None:
        made.use_nodes = True
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*material.base_color, 1)
    inputs["Specular IOR Level"].default_value = material.specular_level
    inputs["Roughness"].default_value = 1
    return made


def _point(light: Light) -> bpy.types.PointLight:
    made = bpy.data.lights.new(light.name, "POINT")
    made.energy, made.shadow_soft_size = 4 * math.pi * light.emitted[0], light.radius
    return made
