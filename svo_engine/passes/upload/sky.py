# SPDX-License-Identifier: GPL-3.0-or-later
"""The world's image on the device."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.texture import Texture
from ...scene.types import Color, Image, Light, World


@dataclass(frozen=True)
class SeenSun:
    """The disc of a world's sun as the camera sees it.

    axis     unit vector to its middle; radius: radians; horizon: sine of the elevation below which it is hidden
    middle   radiance of its middle; slope: by how much that grows upwards over its radius
    """

    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    radius: float = 0.0
    horizon: float = -1.0
    middle: Color = (0.0, 0.0, 0.0)
    slope: Color = (0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Sky:
    """The world as rays find it.

    texture  of `image` with mip levels; one black texel without an image
    seen     what the camera sees, if that is another picture: its texture, or a colour without one
    suns     lamps that its nodes make
    sun      the first of them for the camera
    notes    a sentence for each thing that is not as in Blender
    """

    scope: GpuScope
    texture: Texture
    image: Image | None
    seen: Texture | None = None
    seen_color: Color | None = None
    suns: tuple[Light, ...] = ()
    sun: SeenSun = field(default_factory=SeenSun)
    notes: tuple[str, ...] = ()

    def for_camera(self) -> Resources:
        """What bind/world_seen.glsl reads beside what bind/environment.glsl does."""
        sun = self.sun
        return {"u_env_seen": self.seen or self.texture, "u_has_env_seen": self.seen is not None,
                "u_has_color_seen": self.seen_color is not None, "u_color_seen": self.seen_color or (0.0, 0.0, 0.0),
                "u_sun_axis": sun.axis, "u_sun_radius": sun.radius, "u_sun_horizon": sun.horizon,
                "u_sun_middle": sun.middle, "u_sun_slope": sun.slope}


def upload_sky(device: Device, image: Image | None) -> Sky:
    """Copy the world's image, if there is one."""
    scope = device.scope()
    if image is None:
        return Sky(scope, scope.texture("no environment", (1, 1), 4, "f4", np.zeros((1, 1, 4), "f4")), None)
    return Sky(scope, sky_texture(scope, linear_pixels(image)), image)


def world_uniforms(sky: Sky, world: World) -> Resources:
    """What bind/environment.glsl reads."""
    return {"u_env": sky.texture, "u_world_radiance": world.radiance, "u_env_from_world": world.env_from_world,
            "u_has_env": sky.image is not None}


def sky_texture(scope: GpuScope, pixels: np.ndarray) -> Texture:
    """An equirectangular picture (height, width, 4) f4 with mip levels."""
    made = scope.texture("environment", (pixels.shape[1], pixels.shape[0]), 4, "f4", pixels)
    made.go_round()
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
