# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract of `Texture` and `Image`, slow and obvious: what a texture shows at coordinates."""

from __future__ import annotations

import numpy as np


def decode_srgb(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def meant(rgba, image, divides):
    """What stored RGBA (..., 4) means, in scene-linear light."""
    rgb, alpha = rgba[..., :3], rgba[..., 3:]
    if divides and image.is_associated:
        rgb = rgb / np.where(alpha == 0, 1, alpha)
    return np.concatenate([decode_srgb(rgb) if image.is_srgb else rgb, alpha], -1)


def texels(image):
    """RGBA (height, width, 4) f8 as texels mean it one by one, times alpha."""
    pixels = image.pixels
    return meant(pixels / 255 if pixels.dtype == np.uint8 else pixels.astype("f8"), image, divides=False)


def extended(i, n, extension):
    """Texel indices within n for any integers, and which of them show the image at all."""
    if extension == "CLIP":
        return np.clip(i, 0, n - 1), (i >= 0) & (i < n)
    if extension == "MIRROR":
        i = i % (2 * n)
        return np.minimum(i, 2 * n - 1 - i), np.ones_like(i, bool)
    return (i % n if extension == "REPEAT" else np.clip(i, 0, n - 1)), np.ones_like(i, bool)


def closest(scene, index, uv):
    """The texel of texture `index` at mesh coordinates uv (..., 2), after its channel: (..., 3)."""
    texture = scene.textures[index]
    pixels = scene.images[texture.image].pixels
    image = pixels / 255 if pixels.dtype == np.uint8 else pixels.astype("f8")
    matrix = np.reshape(texture.uv_from_mesh, (2, 3))
    at = np.asarray(uv) @ matrix[:, :2].T + matrix[:, 2]
    x, y = (np.floor(at[..., i] * image.shape[1 - i]).astype(int) for i in range(2))
    (x, in_x), (y, in_y) = (extended(i, n, texture.extension) for i, n in ((x, image.shape[1]), (y, image.shape[0])))
    rgba = meant(image[y, x] * (in_x & in_y)[..., None], scene.images[texture.image], texture.divides)
    return rgba[..., :3] if texture.channel < 0 else np.repeat(rgba[..., texture.channel, None], 3, -1)
