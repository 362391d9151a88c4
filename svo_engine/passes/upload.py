# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene -> GpuScene: the arrays as buffers in the layouts that the shaders read, positions relative to its centre."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..gpu.device import Device
from ..gpu.scope import GpuScope
from ..scene import layouts
from ..scene.types import Image, Light, Material, Scene, Texture
from .albedo import Albedo, albedo


@dataclass(frozen=True)
class Draw:
    """Instances of one mesh that lie one after another: what one draw call shows."""

    first_instance: int
    n_instances: int
    first_triangle: int
    n_triangles: int


@dataclass(frozen=True, eq=False)
class GpuScene:
    """The scene on the device. centre_ws: (3,) f8, metres; subtracted from every position, so that f4 does far away."""

    scope: GpuScope
    scene: Scene
    centre_ws: np.ndarray
    extent: float
    draws: tuple[Draw, ...]
    n_work: int
    geometry: dict[str, Any]
    materials: dict[str, Any]
    lights: Any
    env: Any
    albedo: Any
    has_textures: bool
    has_alpha: bool
    has_specular: bool
    has_glass: bool
    emission_unit: float

    @property
    def n_instances(self) -> int:
        """Placed meshes."""
        return sum(draw.n_instances for draw in self.draws)

    @property
    def has_light(self) -> bool:
        """Whether anything in the scene sends out light at all, the world included."""
        return bool(self.scene.lights) or self.emission_unit > 0 or max(self.scene.world.radiance) > 0

    def surface_constants(self) -> dict[str, bool]:
        """What bind/principled.glsl can leave out, and textures."""
        return {"HAS_TEXTURES": self.has_textures, "HAS_SPECULAR": self.has_specular, "HAS_GLASS": self.has_glass}

    def world(self) -> dict[str, Any]:
        """The uniforms of bind/environment.glsl."""
        world = self.scene.world
        return {"u_env": self.env, "u_world_radiance": world.radiance, "u_env_from_world": world.env_from_world,
                "u_has_env": world.image >= 0}


def is_specular(scene: Scene) -> bool:
    """Whether any material does more than send out and reflect light diffusely."""
    return any(m.metallic > 0 or m.metallic_texture >= 0 or m.specular_level > 0 or m.transmission > 0
               for m in scene.materials)


def upload(device: Device, scene: Scene, table: Albedo | None = None) -> GpuScene:
    """Copy `scene` to the device, beside the `table` of the surfaces that reflect.

    GpuError names the buffer that does not fit.
    """
    scope = device.scope()
    low, high = scene.bounds()
    centre = (low + high) / 2
    geometry, draws, n_work = _geometry(scope, scene, centre)
    words = [_words(image) for image in scene.images] if scene.textures else []
    firsts = np.cumsum([0] + [len(w) for w in words])
    texels = np.concatenate(words) if words else np.zeros(0, "u4")
    materials = {
        "Materials": scope.buffer("materials", _materials(scene.materials)),
        "Textures": scope.buffer("textures", _textures(scene.textures, scene.images, firsts)),
        "Texels": scope.buffer("texels", texels)}
    return GpuScene(
        scope, scene, centre, float((high - low).max()), draws, n_work, geometry, materials,
        scope.buffer("lights", light_rows(scene.lights, centre)), _environment(scope, scene),
        albedo=(table or albedo(device, is_specular(scene))).table,
        has_textures=any(_texture_slots(m) for m in scene.materials),
        has_alpha=any(m.alpha < 1 or m.alpha_texture >= 0 for m in scene.materials),
        has_specular=is_specular(scene),
        has_glass=any(m.transmission > 0 for m in scene.materials),
        emission_unit=max((_emission_bound(scene, m) for m in scene.materials), default=0.0))


def _geometry(scope: GpuScope, scene: Scene, centre: np.ndarray) -> tuple[dict[str, Any], tuple[Draw, ...], int]:
    """Buffers of bind/geometry.glsl, the draws, and the triangles with instances counted as often as placed."""
    meshes, inst = scene.meshes, scene.instances
    first_vertex = np.cumsum([0] + [len(m.positions) for m in meshes])
    first_triangle = np.cumsum([0] + [len(m.triangles) for m in meshes])
    triangles = np.zeros((int(first_triangle[-1]), 4), "u4")
    for i, mesh in enumerate(meshes):
        part = triangles[first_triangle[i]:first_triangle[i + 1]]
        part[:, :3] = mesh.triangles + np.uint32(first_vertex[i])
        part[:, 3] = mesh.material_slots
    order = np.argsort(inst.mesh, kind="stable")
    n_triangles = np.diff(first_triangle)[inst.mesh[order]] if len(inst) else np.zeros(0, "i8")
    work = np.concatenate([[0], np.cumsum(n_triangles)])
    rows = np.zeros(len(inst), layouts.dtype(layouts.INSTANCE))
    matrices = inst.world_from_object[order].copy()
    matrices[:, :3, 3] -= centre
    rows["row_x"], rows["row_y"], rows["row_z"] = matrices[:, 0], matrices[:, 1], matrices[:, 2]
    rows["first_triangle"] = first_triangle[inst.mesh[order]]
    rows["n_triangles"], rows["first_work"] = n_triangles, work[:-1]
    slots, rows["first_slot"] = _slots(scene, order)

    def joined(name: str, width: int) -> np.ndarray:
        return np.concatenate([getattr(m, name).reshape(-1, width) for m in meshes] or [np.zeros((0, width), "f4")])

    has_uvs = any(_texture_slots(m) for m in scene.materials)
    buffers = {
        "Instances": scope.buffer("instances", rows),
        "Positions": scope.buffer("positions", joined("positions", 3)),
        "Triangles": scope.buffer("triangles", triangles),
        "CornerNormals": scope.buffer("corner normals", pack_units(joined("corner_normals", 3))),
        "CornerUvs": scope.buffer("corner uvs", joined("corner_uvs", 2) if has_uvs else np.zeros((1, 2), "f4")),
        "SlotMaterials": scope.buffer("slot materials", slots)}
    found, firsts, counts = np.unique(inst.mesh[order], return_index=True, return_counts=True)
    draws = tuple(Draw(int(f), int(c), int(first_triangle[m]), len(meshes[m].triangles))
                  for m, f, c in zip(found, firsts, counts, strict=True) if len(meshes[m].triangles))
    return buffers, draws, int(work[-1])


def _slots(scene: Scene, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Material indices of all slots, and the first of each instance in `order`.

    Every instance gets as many entries as its mesh names slots; a triangle whose slot does not exist takes the last
    one, as in Blender.
    """
    inst = scene.instances
    n_used = np.array([int(m.material_slots.max()) + 1 if len(m.material_slots) else 1 for m in scene.meshes], "i8")
    entries: list[np.ndarray] = []
    for i in order:
        own = inst.slot_materials[inst.first_slot[i]:inst.first_slot[i + 1]]
        entries.append(own[np.minimum(np.arange(n_used[inst.mesh[i]]), len(own) - 1)])
    firsts = np.cumsum([0] + [len(e) for e in entries])[:-1]
    return np.concatenate(entries) if entries else np.zeros(0, "u4"), firsts


def pack_units(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 3) as octahedral words (n,) u4, which `unpack_unit` in shaders/lib/math.glsl reads [Meyer10]."""
    v = vectors / np.maximum(np.abs(vectors).sum(1, keepdims=True), 1e-30)
    folded = (1 - np.abs(v[:, 1::-1])) * np.where(v[:, :2] >= 0, 1, -1)
    xy = np.where(v[:, 2:] < 0, folded, v[:, :2])
    words = np.round(np.clip(xy, -1, 1) * 32767).astype("i2").view("u2").astype("u4")
    return (words[:, 0] | words[:, 1] << 16).astype("u4")


def _texture_slots(material: Material) -> list[int]:
    """Textures that the material uses."""
    slots = (material.base_color_texture, material.roughness_texture, material.metallic_texture,
             material.emission_texture, material.alpha_texture, material.normal_texture)
    return [s for s in slots if s >= 0]


def _emission_bound(scene: Scene, material: Material) -> float:
    """The highest radiance that the material can send out: the unit of fixed-point sums."""
    bound = max(material.emission)
    if bound > 0 and material.emission_texture >= 0:
        pixels = scene.images[scene.textures[material.emission_texture].image].pixels
        bound *= 1.0 if pixels.dtype == np.uint8 else float(pixels.max(initial=0.0))
    return max(bound, 0.0)


def _materials(materials: tuple[Material, ...]) -> np.ndarray:
    rows = np.zeros(len(materials), layouts.dtype(layouts.MATERIAL))
    for row, material in zip(rows, materials, strict=True):
        for name in rows.dtype.names or ():
            row[name] = getattr(material, name)
    return rows


def _words(image: Image) -> np.ndarray:
    """The image's texels as words (n,) u4: one a texel of bytes, four a texel of floats."""
    return np.ascontiguousarray(image.pixels).reshape(-1, 4).view("u4").ravel()


def _textures(textures: tuple[Texture, ...], images: tuple[Image, ...], firsts: np.ndarray) -> np.ndarray:
    rows = np.zeros(len(textures), layouts.dtype(layouts.TEXTURE))
    for row, texture in zip(rows, textures, strict=True):
        image = images[texture.image]
        kind = "FLOAT" if image.pixels.dtype != np.uint8 else "SRGB8" if image.is_srgb else "LINEAR8"
        row["u_from_uv"], row["v_from_uv"] = texture.uv_from_mesh[:3], texture.uv_from_mesh[3:]
        row["first_word"], row["format"] = firsts[texture.image], layouts.CONSTANTS[f"FORMAT_{kind}"]
        row["height"], row["width"] = image.pixels.shape[:2]
        row["extension"] = layouts.CONSTANTS[f"EXTENSION_{texture.extension}"]
        row["closest"], row["channel"] = texture.interpolation == "Closest", texture.channel
    return rows


def light_rows(lights: Sequence[Light], centre: np.ndarray) -> np.ndarray:
    """Lamps in layout LIGHT, positions relative to `centre`, (3,) f8, metres."""
    rows = np.zeros(len(lights), layouts.dtype(layouts.LIGHT))
    for row, light in zip(rows, lights, strict=True):
        m = light.world_from_light
        row["position"] = m[:3, 3] - centre
        row["axis_x"], row["axis_y"], row["axis_z"] = (m[:3, i] / np.linalg.norm(m[:3, i]) for i in range(3))
        row["kind"] = layouts.CONSTANTS[f"LIGHT_{light.kind}"]
        row["emitted"], row["casts_shadow"] = light.emitted, light.casts_shadow
        row["is_ellipse"], row["spread"], row["soft_falloff"] = light.is_ellipse, light.spread, light.soft_falloff
        row["spot_cos"], row["spot_blend"] = np.cos(light.spot_angle / 2), light.spot_blend
        if light.kind == "AREA":
            row["size"] = light.size[0] / 2, light.size[1] / 2
        elif light.kind == "SUN":
            row["size"] = np.tan(min(light.angle, 3.1) / 2), 0
        else:
            row["size"] = light.radius, 0
    return rows


def _environment(scope: GpuScope, scene: Scene) -> Any:
    """The world's image with mip levels; one black texel without."""
    if scene.world.image < 0:
        return scope.texture("no environment", (1, 1), 4, "f4", np.zeros(4, "f4"))
    pixels = linear_pixels(scene.images[scene.world.image])
    made = scope.texture("environment", (pixels.shape[1], pixels.shape[0]), 4, "f4", pixels)
    made.repeat_x = True
    made.build_mipmaps()
    return made


def linear_pixels(image: Image) -> np.ndarray:
    """(height, width, 4) f4, scene-linear."""
    pixels = image.pixels.astype("f4") / 255 if image.pixels.dtype == np.uint8 else image.pixels
    if not image.is_srgb:
        return pixels
    rgb = pixels[..., :3]
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.concatenate([linear, pixels[..., 3:]], 2).astype("f4")
