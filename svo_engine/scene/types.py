# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene contract: what a renderer needs, as frozen dataclasses of numpy arrays. No bpy, no OpenGL.

Spaces: object (`_os`), world (`_ws`, metres, Z up, right-handed), light and camera (look along -Z, Y up).
Matrices multiply column vectors and are named target first: `p_ws = world_from_object @ p_os`.
Colours are scene-linear RGB in Blender's working space. Radiometric units are W, m and sr (see `units.py`).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np

from ..errors import SceneError
from .bounds import bounds, mesh_boxes
from .checks import check
from .geometry import Attribute, Instances, Mesh, with_fields
from .graph import Graph

__all__ = ["Attribute", "Camera", "Color", "Graph", "Image", "Instances", "Light", "LightKind", "Material", "Mesh",
           "Scene", "Texture", "View", "World"]

Color = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Image:
    """Pixels as Cycles filters them: row 0 is the bottom row.

    name           by which graphs know it; a frame of a sequence has its number behind it, see `frame_name`
    pixels         (height, width, 4) u1 or f4. u1 is sRGB-encoded when `is_srgb`; f4 is scene-linear
    is_associated  RGB was multiplied by alpha, bytes as they are encoded. Who reads alpha as well divides by it
    tile           its UDIM number, 0 for all others. The tiles of an image have its name and follow one another
    n_tiles        how many of them there are from this one on
    """

    name: str
    pixels: np.ndarray
    is_srgb: bool = False
    is_associated: bool = False
    tile: int = 0
    n_tiles: int = 1

    def __post_init__(self) -> None:
        dtype = "u1" if self.pixels.dtype == np.uint8 else "f4"
        check(f"Image '{self.name}'", "pixels", self.pixels, dtype, (None, None, 4))
        if self.is_srgb and dtype == "f4":
            raise SceneError(f"Image '{self.name}': float pixels are scene-linear and cannot be sRGB-encoded")

    @cached_property
    def plain(self) -> Image:
        """As `Scene.plain`."""
        return with_fields(self, name="")


def frame_name(name: str, frame: int) -> str:
    """What a frame of the sequence or movie `name` is called in `Scene.images`."""
    return f"{name} [{frame}]"


@dataclass(frozen=True)
class Texture:
    """How a material reads an image: `uv' = uv_from_mesh @ (u, v, 1)`, then one channel or all of them.

    image    of tiles the first one
    channel  -1: RGB as it is, or its Rec. 709 luminance for a number; 0, 1, 2, 3: that channel of RGBA, as a grey value
    divides  RGB that was multiplied by alpha is divided by it, as Cycles does once a material reads alpha too
    """

    image: int
    uv_from_mesh: tuple[float, float, float, float, float, float] = (1, 0, 0, 0, 1, 0)
    extension: Literal["REPEAT", "EXTEND", "CLIP", "MIRROR"] = "REPEAT"
    interpolation: Literal["Linear", "Closest"] = "Linear"
    channel: int = -1
    divides: bool = False


@dataclass(frozen=True)
class Material:
    """The Principled BSDF's values. A texture (index into Scene.textures, -1: none) multiplies the value of its name.

    Where they do not say all that the graph does, they stand in for it while that is compiled.

    emission         radiance [W m^-2 sr^-1] that the surface sends out by itself, colour times strength
    specular_level   Principled's "Specular IOR Level"; 0.5 leaves the reflectance that `ior` gives
    normal_strength  Normal Map node's strength; the map is in tangent space
    graph            the nodes that all these values were read from
    pass_index       Blender's Pass Index
    is_exact         whether the values say all that the graph does
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
    graph: Graph | None = None
    pass_index: int = 0
    is_exact: bool = True

    @cached_property
    def plain(self) -> Material:
        """As `Scene.plain`. A name stays with its tree, for what is told of that."""
        return replace(self, name="", graph=None, pass_index=0) if self.is_exact else self

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
    falloff      how the light falls with distance: as in nature, with one power of it less, or not at all; and, with
                 `smoothing` s [m^2], weaker near the lamp by d^2 / (s + d^2)
    graph        the lamp's nodes, if it uses any
    is_exact     whether the values say all that the graph does; else its colour multiplies `emitted`
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
    falloff: Literal["QUADRATIC", "LINEAR", "CONSTANT"] = "QUADRATIC"
    smoothing: float = 0.0
    graph: Graph | None = None
    is_exact: bool = True

    def __post_init__(self) -> None:
        owner = f"Light '{self.name}'"
        check(owner, "world_from_light", self.world_from_light, "f8", (4, 4))
        if not np.isfinite(self.emitted).all():
            raise SceneError(f"{owner}: its power is not finite")

    @cached_property
    def plain(self) -> Light:
        """As `Scene.plain`."""
        return with_fields(self, name="", graph=None) if self.is_exact else self


@dataclass(frozen=True, eq=False)
class World:
    """What a ray meets that leaves the scene: `radiance` [W m^-2 sr^-1] times the equirectangular image, if any.

    env_from_world  (3, 3) f8, from world directions to the image's own (Mapping node), where `environment.py` says what
                    they see; a rotation, unless the Mapping node mirrors or scales
    graph           the world's nodes, if it uses any
    is_exact        whether the values say all that the graph does; else it is compiled, and they stand in meanwhile
    """

    radiance: Color = (0.0, 0.0, 0.0)
    image: int = -1
    env_from_world: np.ndarray = field(default_factory=lambda: np.eye(3))
    graph: Graph | None = None
    is_exact: bool = True

    def __post_init__(self) -> None:
        check("World", "env_from_world", self.env_from_world, "f8", (3, 3))

    @cached_property
    def plain(self) -> World:
        """As `Scene.plain`."""
        return with_fields(self, graph=None) if self.is_exact and self.graph is not None else self


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
        check(f"Camera '{self.name}'", "world_from_camera", self.world_from_camera, "f8", (4, 4))


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
        check("View", "world_from_view", self.world_from_view, "f8", (4, 4))
        check("View", "clip_from_view", self.clip_from_view, "f8", (4, 4))
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

    @cached_property
    def plain(self) -> Scene:
        """The scene without what no picture depends on: names, trees of which the materials' values say all, and where
        no other material is shown, other attributes than the active UV map and numbers of instances. Renders are made
        of this, so that an edit of the rest makes nothing anew.
        """
        shaded = self._shaded
        instances = self.instances.shaded if shaded else self.instances.plain
        return with_fields(
            self, meshes=tuple(m.shaded if i in shaded else m.plain for i, m in enumerate(self.meshes)),
            instances=instances, materials=tuple(m.plain for m in self.materials), images=self._plain_images,
            lights=tuple(light.plain for light in self.lights), world=self.world.plain)

    @property
    def _plain_images(self) -> tuple[Image, ...]:
        """Images without names, unless there are trees that name them."""
        is_exact = [self.world.is_exact, *(m.is_exact for m in self.materials), *(k.is_exact for k in self.lights)]
        return tuple(image.plain for image in self.images) if all(is_exact) else self.images

    @property
    def _shaded(self) -> set[int]:
        """The meshes that show a material whose tree says more than its values."""
        inst = self.instances
        is_exact = np.array([m.is_exact for m in self.materials], bool)
        if is_exact.all() or not len(inst):
            return set()
        slots = np.logical_or.reduceat(~is_exact[inst.slot_materials], inst.first_slot[:-1].astype("i8"))
        return set(inst.mesh[slots].tolist())

    def bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """World-space box of all instances: (lowest, highest), each (3,) f8, metres; zeros for an empty scene."""
        return bounds(mesh_boxes(self.meshes), self.instances)
