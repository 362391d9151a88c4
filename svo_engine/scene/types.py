# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene contract: what a renderer needs, as frozen dataclasses of numpy arrays. No bpy, no OpenGL.

Spaces: object (`_os`), world (`_ws`, metres, Z up, right-handed), light and camera (look along -Z, Y up).
Matrices multiply column vectors and are named target first: `p_ws = world_from_object @ p_os`.
Colours are scene-linear RGB in Blender's working space. Radiometric units are W, m and sr (see `units.py`).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from ..errors import SceneError
from .bounds import bounds, mesh_boxes

Color = tuple[float, float, float]


def _check(owner: str, name: str, array: np.ndarray, dtype: str, shape: tuple[int | None, ...]) -> None:
    """Raise SceneError unless `array` has `dtype` and `shape` (None: any length) and holds finite numbers only."""
    matches = array.ndim == len(shape) and all(w is None or w == s for w, s in zip(shape, array.shape, strict=True))
    if array.dtype != np.dtype(dtype) or not matches:
        wanted = "x".join("n" if s is None else str(s) for s in shape)
        raise SceneError(f"{owner}: {name} must be {wanted} of {dtype}, not {array.shape} of {array.dtype}")
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise SceneError(f"{owner}: {name} holds a number that is not finite")


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles of one evaluated mesh, stored once however many instances show it. Build with `meshes.make_mesh`.

    positions       (n_vertices, 3) f4, metres, object space
    triangles       (n_triangles, 3) u4, indices into positions
    corner_normals  (n_triangles, 3, 3) f4, unit shading normals, object space
    corner_uvs      (n_triangles, 3, 2) f4, texture coordinates of the active UV map, zeros without one
    material_slots  (n_triangles,) u4, the slot of each triangle; an instance says which material sits in a slot
    """

    name: str
    positions: np.ndarray
    triangles: np.ndarray
    corner_normals: np.ndarray
    corner_uvs: np.ndarray
    material_slots: np.ndarray

    def __post_init__(self) -> None:
        owner = f"Mesh '{self.name}'"
        n = len(self.triangles)
        _check(owner, "positions", self.positions, "f4", (None, 3))
        _check(owner, "triangles", self.triangles, "u4", (None, 3))
        _check(owner, "corner_normals", self.corner_normals, "f4", (n, 3, 3))
        _check(owner, "corner_uvs", self.corner_uvs, "f4", (n, 3, 2))
        _check(owner, "material_slots", self.material_slots, "u4", (n,))
        if n and self.triangles.max() >= len(self.positions):
            raise SceneError(f"{owner}: a triangle names vertex {self.triangles.max()} of {len(self.positions)}")


@dataclass(frozen=True, eq=False)
class Instances:
    """Every visible placing of a mesh. Instance i has the materials `slot_materials[first_slot[i]:first_slot[i + 1]]`.

    names              n strings, the object's name, for messages
    mesh               (n,) u4, index into Scene.meshes
    world_from_object  (n, 4, 4) f8, metres
    first_slot         (n + 1,) u4, ascending
    slot_materials     (k,) u4, indices into Scene.materials
    """

    names: tuple[str, ...]
    mesh: np.ndarray
    world_from_object: np.ndarray
    first_slot: np.ndarray
    slot_materials: np.ndarray

    def __post_init__(self) -> None:
        n = len(self.names)
        _check("Instances", "mesh", self.mesh, "u4", (n,))
        _check("Instances", "world_from_object", self.world_from_object, "f8", (n, 4, 4))
        _check("Instances", "first_slot", self.first_slot, "u4", (n + 1,))
        _check("Instances", "slot_materials", self.slot_materials, "u4", (int(self.first_slot[-1]),))
        if (np.diff(self.first_slot.astype("i8")) < 1).any():
            raise SceneError("Instances: every instance needs a material slot")

    def __len__(self) -> int:
        return len(self.names)

    @staticmethod
    def empty() -> Instances:
        """No instance at all."""
        return Instances((), np.zeros(0, "u4"), np.zeros((0, 4, 4)), np.zeros(1, "u4"), np.zeros(0, "u4"))


@dataclass(frozen=True, eq=False)
class Image:
    """Pixels as Blender holds them: row 0 is the bottom row.

    pixels  (height, width, 4) u1 or f4, RGB as a material reads it, whether or not it was multiplied by alpha. u1 is
            sRGB-encoded when `is_srgb`; f4 is scene-linear
    """

    name: str
    pixels: np.ndarray
    is_srgb: bool = False

    def __post_init__(self) -> None:
        dtype = "u1" if self.pixels.dtype == np.uint8 else "f4"
        _check(f"Image '{self.name}'", "pixels", self.pixels, dtype, (None, None, 4))
        if self.is_srgb and dtype == "f4":
            raise SceneError(f"Image '{self.name}': float pixels are scene-linear and cannot be sRGB-encoded")


@dataclass(frozen=True)
class Texture:
    """How a material reads an image: `uv' = uv_from_mesh @ (u, v, 1)`, then one channel or all of them.

    channel  -1: RGB as it is, or its Rec. 709 luminance for a number; 0, 1, 2, 3: that channel of RGBA, as a grey value
    """

    image: int
    uv_from_mesh: tuple[float, float, float, float, float, float] = (1, 0, 0, 0, 1, 0)
    extension: Literal["REPEAT", "EXTEND", "CLIP", "MIRROR"] = "REPEAT"
    interpolation: Literal["Linear", "Closest"] = "Linear"
    channel: int = -1


@dataclass(frozen=True)
class Material:
    """The Principled BSDF's values. A texture (index into Scene.textures, -1: none) multiplies the value of its name.

    emission         radiance [W m^-2 sr^-1] that the surface sends out by itself, colour times strength
    specular_level   Principled's "Specular IOR Level"; 0.5 leaves the reflectance that `ior` gives
    normal_strength  Normal Map node's strength; the map is in tangent space
    """

    name: str
    base_color: Color = (0.8, 0.8, 0.8)
    roughness: float = 0.5
    metallic: float = 0.0
    ior: float = 1.5
    specular_level: float = 0.5
    specular_tint: Color = (1.0, 1.0, 1.0)
    transmission: float = 0.0
    alpha: float = 1.0
    emission: Color = (0.0, 0.0, 0.0)
    normal_strength: float = 1.0
    base_color_texture: int = -1
    roughness_texture: int = -1
    metallic_texture: int = -1
    emission_texture: int = -1
    alpha_texture: int = -1
    normal_texture: int = -1

    @property
    def textures(self) -> tuple[int, ...]:
        """All of its textures' indices, -1 for each that is not set."""
        return (self.base_color_texture, self.roughness_texture, self.metallic_texture, self.emission_texture,
                self.alpha_texture, self.normal_texture)


LightKind = Literal["POINT", "SUN", "SPOT", "AREA"]


@dataclass(frozen=True, eq=False)
class Light:
    """A lamp. It shines along its own -Z; `world_from_light` is a rotation and a translation, scale is in the sizes.

    emitted      POINT, SPOT: radiant intensity I [W sr^-1] along the axis; SUN: irradiance E [W m^-2] of a surface that
                 faces it; AREA: radiance L [W m^-2 sr^-1] of its front at spread 180 degrees
    radius       POINT, SPOT: metres of the glowing sphere, 0 for a point
    angle        SUN: angular diameter, radians
    size         AREA: full width and height, metres, world scale
    is_ellipse   AREA: disk and ellipse shapes
    spread       AREA: full angle 2h, radians; pi is a Lambertian emitter, below it the radiance at angle a to the axis
                 is `emitted * max(tan h - tan a, 0) / (tan h - h)`
    spot_angle   SPOT: full angle 2h of the cone, radians
    spot_blend   SPOT: 0 to 1, soft part of the cone's edge: `smoothstep(0, 1, (cos a - cos h) / (blend (1 - cos h)))`
    soft_falloff POINT, SPOT: not a sphere but a disk of `radius` that faces the point it lights, so that on the axis
                 E = I / (d^2 + radius^2); Blender's default
    """

    name: str
    kind: LightKind
    world_from_light: np.ndarray
    emitted: Color
    radius: float = 0.0
    angle: float = 0.0
    size: tuple[float, float] = (0.0, 0.0)
    is_ellipse: bool = False
    spread: float = np.pi
    spot_angle: float = np.pi
    spot_blend: float = 0.0
    casts_shadow: bool = True
    soft_falloff: bool = False

    def __post_init__(self) -> None:
        owner = f"Light '{self.name}'"
        _check(owner, "world_from_light", self.world_from_light, "f8", (4, 4))
        if not np.isfinite(self.emitted).all():
            raise SceneError(f"{owner}: its power is not finite")


@dataclass(frozen=True, eq=False)
class World:
    """What a ray meets that leaves the scene: `radiance` [W m^-2 sr^-1] times the equirectangular image, if any.

    env_from_world  (3, 3) f8, from world directions to the image's own (Mapping node), where `environment.py` says what
                    they see; a rotation, unless the Mapping node mirrors or scales
    """

    radiance: Color = (0.0, 0.0, 0.0)
    image: int = -1
    env_from_world: np.ndarray = field(default_factory=lambda: np.eye(3))

    def __post_init__(self) -> None:
        _check("World", "env_from_world", self.env_from_world, "f8", (3, 3))


@dataclass(frozen=True, eq=False)
class Camera:
    """Blender's camera. Lens and sensor in millimetres, the rest in metres; `camera.make_view` makes the matrices.

    size          (width, height) pixels of the render, percentage included
    pixel_aspect  (x, y), Blender's pixel_aspect_x and _y
    shift         (x, y) in units of the sensor's fitted side
    """

    name: str
    world_from_camera: np.ndarray
    size: tuple[int, int] = (1920, 1080)
    pixel_aspect: tuple[float, float] = (1.0, 1.0)
    is_orthographic: bool = False
    lens: float = 50.0
    sensor: tuple[float, float] = (36.0, 24.0)
    sensor_fit: Literal["AUTO", "HORIZONTAL", "VERTICAL"] = "AUTO"
    ortho_scale: float = 6.0
    shift: tuple[float, float] = (0.0, 0.0)
    clip_start: float = 0.1
    clip_end: float = 1000.0

    def __post_init__(self) -> None:
        _check(f"Camera '{self.name}'", "world_from_camera", self.world_from_camera, "f8", (4, 4))


@dataclass(frozen=True, eq=False)
class View:
    """What the frame looks through: made from a Camera, or from a viewport's own matrices.

    world_from_view  (4, 4) f8, rigid
    clip_from_view   (4, 4) f8, OpenGL clip space, already cropped to the border if there is one
    size             (width, height) in pixels
    """

    world_from_view: np.ndarray
    clip_from_view: np.ndarray
    size: tuple[int, int]

    def __post_init__(self) -> None:
        _check("View", "world_from_view", self.world_from_view, "f8", (4, 4))
        _check("View", "clip_from_view", self.clip_from_view, "f8", (4, 4))
        if min(self.size) < 1:
            raise SceneError(f"View: the picture would be {self.size[0]}x{self.size[1]} pixels")


@dataclass(frozen=True, eq=False)
class Scene:
    """All that is rendered. `warnings`: one sentence for each thing that had to be left out or replaced."""

    meshes: tuple[Mesh, ...] = ()
    instances: Instances = field(default_factory=Instances.empty)
    materials: tuple[Material, ...] = ()
    textures: tuple[Texture, ...] = ()
    images: tuple[Image, ...] = ()
    lights: tuple[Light, ...] = ()
    world: World = field(default_factory=World)
    camera: Camera | None = None
    film_transparent: bool = False
    warnings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        inst = self.instances
        if len(inst) and inst.mesh.max() >= len(self.meshes):
            raise SceneError(f"Instances: mesh {inst.mesh.max()} of {len(self.meshes)} is named")
        if len(inst.slot_materials) and inst.slot_materials.max() >= len(self.materials):
            raise SceneError(f"Instances: material {inst.slot_materials.max()} of {len(self.materials)} is named")
        for texture in self.textures:
            if not 0 <= texture.image < len(self.images):
                raise SceneError(f"Texture: image {texture.image} of {len(self.images)} is named")
        for material in self.materials:
            if (highest := max(material.textures)) >= len(self.textures):
                raise SceneError(f"Material '{material.name}': texture {highest} of {len(self.textures)} is named")
        if self.world.image >= len(self.images):
            raise SceneError(f"World: image {self.world.image} of {len(self.images)} is named")

    @property
    def n_triangles(self) -> int:
        """Triangles with instances counted as often as they are placed."""
        counts = np.array([len(m.triangles) for m in self.meshes] or [0], "i8")
        return int(counts[self.instances.mesh].sum()) if len(self.instances) else 0

    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """World-space box of all instances: (lowest, highest), each (3,) f8, metres; zeros for an empty scene."""
        return bounds(mesh_boxes(self.meshes), self.instances)
