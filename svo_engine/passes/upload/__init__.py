# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene -> GpuScene: the arrays as buffers in the layouts that the shaders read, positions relative to its centre.

In parts, each of which stays while its own arrays are the same: an edit uploads only what it touched.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...gpu.device import Device
from ...gpu.scope import GpuScope
from ...scene.types import Scene
from ..albedo import Albedo, albedo
from .lamps import Lamps, light_rows, upload_lamps
from .placing import Draw, Placing, place
from .shapes import pack_units, upload_shapes
from .sky import Sky, linear_pixels, upload_sky
from .surfaces import Surfaces, has_specular, has_textures, upload_surfaces

__all__ = ["GpuScene", "assemble", "light_rows", "linear_pixels", "pack_units", "upload"]

Make = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class GpuScene:
    """The scene on the device. `scope` owns the parts, unless somebody else keeps them."""

    scope: GpuScope
    scene: Scene
    placing: Placing
    surfaces: Surfaces
    lamps: Lamps
    sky: Sky
    table: Albedo

    @property
    def geometry(self) -> dict[str, Any]:
        """The buffers of bind/geometry.glsl."""
        return self.placing.geometry

    @property
    def materials(self) -> dict[str, Any]:
        """The buffers of bind/materials.glsl."""
        return self.surfaces.buffers

    @property
    def lights(self) -> Any:
        """The buffer of all lamps."""
        return self.lamps.rows

    @property
    def albedo(self) -> Any:
        """The texture of bind/albedo.glsl."""
        return self.table.table

    @property
    def centre_ws(self) -> np.ndarray:
        """(3,) f8, metres: what positions on the device are relative to."""
        return self.placing.centre_ws

    @property
    def extent(self) -> float:
        """Metres, the longest side of the box around everything."""
        return self.placing.extent

    @property
    def draws(self) -> tuple[Draw, ...]:
        """What the rasteriser draws."""
        return self.placing.draws

    @property
    def n_work(self) -> int:
        """Triangles with instances counted as often as placed."""
        return self.placing.n_work

    @property
    def n_instances(self) -> int:
        """Placed meshes."""
        return sum(draw.n_instances for draw in self.draws)

    @property
    def has_textures(self) -> bool:
        """Whether any material reads an image."""
        return self.surfaces.has_textures

    @property
    def has_alpha(self) -> bool:
        """Whether any material lets rays through."""
        return self.surfaces.has_alpha

    @property
    def has_specular(self) -> bool:
        """Whether any material does more than send out and reflect light diffusely."""
        return self.surfaces.has_specular

    @property
    def emission_unit(self) -> float:
        """The highest radiance that any material sends out."""
        return self.surfaces.emission_unit

    @property
    def has_light(self) -> bool:
        """Whether anything in the scene sends out light at all, the world included."""
        return bool(self.scene.lights) or self.emission_unit > 0 or max(self.scene.world.radiance) > 0

    def surface_constants(self) -> dict[str, bool]:
        """What bind/principled.glsl can leave out, and textures."""
        return {"HAS_TEXTURES": self.has_textures, "HAS_SPECULAR": self.has_specular,
                "HAS_GLASS": self.surfaces.has_glass}

    def world(self) -> dict[str, Any]:
        """The uniforms of bind/environment.glsl."""
        world = self.scene.world
        return {"u_env": self.sky.texture, "u_world_radiance": world.radiance,
                "u_env_from_world": world.env_from_world, "u_has_env": world.image >= 0}


def upload(device: Device, scene: Scene) -> GpuScene:
    """Copy `scene` to the device, all of it into one scope. GpuError names the buffer that does not fit."""
    scope = device.scope()

    def make(_name: str, part: Make, *inputs: Any) -> Any:
        made = part(device, *inputs)
        scope.adopt(made.scope)
        return made

    return assemble(scope, scene, make)


def assemble(scope: GpuScope, scene: Scene, make: Make) -> GpuScene:
    """The scene from parts: `make(name, function, *inputs)` gives function(device, *inputs), or the part it kept."""
    shapes = make("shapes", upload_shapes, scene.meshes, has_textures(scene.materials))
    placing = make("placing", place, shapes, scene.instances)
    world = scene.images[scene.world.image] if scene.world.image >= 0 else None
    return GpuScene(
        scope, scene, placing, make("surfaces", upload_surfaces, scene.materials, scene.textures, scene.images),
        make("lamps", upload_lamps, scene.lights, placing.centre_ws), make("sky", upload_sky, world),
        make("albedo", albedo, has_specular(scene.materials)))
