# SPDX-License-Identifier: GPL-3.0-or-later
"""The world's image on the device."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.texture import Texture
from ...scene.types import Image, World


@dataclass(frozen=True, eq=False)
class Sky:
    """texture: of `image` with mip levels; one black texel without an image."""

    scope: GpuScope
    texture: Texture
    image: Image | None


def upload_sky(device: Device, image: Image | None) -> Sky:
    """Copy the world's image, if there is one."""
    scope = device.scope()
    if image is None:
        return Sky(scope, scope.texture("no environment", (1, 1), 4, "f4", np.zeros((1, 1, 4), "f4")), None)
    pixels = linear_pixels(image)
    made = scope.texture("environment", (pixels.shape[1], pixels.shape[0]), 4, "f4", pixels)
    made.go_round()
    made.build_mipmaps()
    return Sky(scope, made, image)


def world_uniforms(sky: Sky, world: World) -> Resources:
    """What bind/environment.glsl reads."""
    return {"u_env": sky.texture, "u_world_radiance": world.radiance, "u_env_from_world": world.env_from_world,
            "u_has_env": sky.image is not None}


def linear_pixels(image: Image) -> np.ndarray:
    """(height, width, 4) f4, scene-linear."""
    pixels = image.pixels.astype("f4") / 255 if image.pixels.dtype == np.uint8 else image.pixels
    if not image.is_srgb:
        return pixels
    rgb = pixels[..., :3]
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.concatenate([linear, pixels[..., 3:]], 2).astype("f4")
