# SPDX-License-Identifier: GPL-3.0-or-later
"""The world's image on the device."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...gpu.device import Device
from ...gpu.scope import GpuScope
from ...scene.types import Image


@dataclass(frozen=True, eq=False)
class Sky:
    """texture: with mip levels; one black texel without an image."""

    scope: GpuScope
    texture: Any


def upload_sky(device: Device, image: Image | None) -> Sky:
    """Copy the world's image, if there is one."""
    scope = device.scope()
    if image is None:
        return Sky(scope, scope.texture("no environment", (1, 1), 4, "f4", np.zeros(4, "f4")))
    pixels = linear_pixels(image)
    made = scope.texture("environment", (pixels.shape[1], pixels.shape[0]), 4, "f4", pixels)
    made.repeat_x = True
    made.build_mipmaps()
    return Sky(scope, made)


def linear_pixels(image: Image) -> np.ndarray:
    """(height, width, 4) f4, scene-linear."""
    pixels = image.pixels.astype("f4") / 255 if image.pixels.dtype == np.uint8 else image.pixels
    if not image.is_srgb:
        return pixels
    rgb = pixels[..., :3]
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.concatenate([linear, pixels[..., 3:]], 2).astype("f4")
