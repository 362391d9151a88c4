# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures on the device: texels of all images in one texture of words, the largest halved where there is no room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.words import WIDTH, room_for
from ...scene import layouts
from ...scene.types import Image, Texture


@dataclass(frozen=True, eq=False)
class Pictures:
    """read: what bind/textures.glsl reads; limits: a sentence for each image that was halved."""

    scope: GpuScope
    read: Resources
    limits: tuple[str, ...]


def upload_pictures(device: Device, textures: tuple[Texture, ...], images: tuple[Image, ...],
                    others: tuple[int, ...]) -> Pictures:
    """Copy the images that textures read, and `others`, with all of their tiles. All images have a row, and one more is
    of none.
    """
    scope, used = device.scope(), {*others, *(texture.image for texture in textures)}
    numbers = sorted({i + tile for i in used if i < len(images) for tile in range(images[i].n_tiles)})
    pictures, limits = fitted([images[i] for i in numbers], room_for(device.calls, device.context.is_software))
    words = [_words(image) for image in pictures]
    firsts = np.cumsum([0] + [-(-len(w) // WIDTH) * WIDTH for w in words])
    n_words = int(firsts[-2]) + len(words[-1]) if words else 0
    device.profiler.counts["texture words"] = n_words
    texels = scope.words("texels", n_words)
    for first, part in zip(firsts[:-1], words, strict=True):
        texels.put(int(first), part)
    rows = np.zeros(len(images) + 1, layouts.dtype(layouts.PICTURE))
    rows[numbers] = _rows(pictures, firsts)
    return Pictures(scope, {"Textures": scope.buffer("textures", _textures(textures)),
                            "Pictures": scope.buffer("pictures", rows), "u_words": texels}, limits)


def fitted(images: Sequence[Image], budget: int) -> tuple[list[Image], tuple[str, ...]]:
    """The images, the largest at half its size again and again until all need no more than `budget` bytes."""
    made, sentences = list(images), {}
    sizes = [image.pixels.nbytes for image in made]
    while sum(sizes) > budget and max(sizes) > 16:
        i = int(np.argmax(sizes))
        made[i] = replace(made[i], pixels=halved(made[i].pixels))
        sizes[i] = made[i].pixels.nbytes
        height, width = made[i].pixels.shape[:2]
        sentences[i] = (f"Image '{made[i].name}' is read at {width}x{height} pixels: all images together do not fit "
                        f"into {budget >> 20} MiB")
    return made, tuple(sentences.values())


def halved(pixels: np.ndarray) -> np.ndarray:
    """Means of two by two pixels; of an odd row or column at the end nothing."""
    for axis in (0, 1):
        if (n := pixels.shape[axis]) > 1:
            pairs = np.moveaxis(pixels, axis, 0)[: n // 2 * 2]
            sums = pairs[::2].astype("f4") + pairs[1::2]
            half = sums / 2 if pixels.dtype != np.uint8 else np.floor(sums / 2 + 0.5)
            pixels = np.moveaxis(half.astype(pixels.dtype), 0, axis)
    return np.ascontiguousarray(pixels)


def _words(image: Image) -> np.ndarray:
    """The image's texels as words (n,) u4: one a texel of bytes, four a texel of floats."""
    return np.ascontiguousarray(image.pixels).reshape(-1, 4).view("u4").ravel()


def _rows(images: Sequence[Image], firsts: np.ndarray) -> np.ndarray:
    rows = np.zeros(len(images), layouts.dtype(layouts.PICTURE))
    for row, image, first in zip(rows, images, firsts[:-1], strict=True):
        kind = "FLOAT" if image.pixels.dtype != np.uint8 else "SRGB8" if image.is_srgb else "LINEAR8"
        row["first_word"], row["format"] = first, layouts.CONSTANTS[f"FORMAT_{kind}"]
        row["height"], row["width"] = image.pixels.shape[:2]
        row["is_associated"], row["tile"], row["n_tiles"] = image.is_associated, image.tile, image.n_tiles
    return rows


def _textures(textures: tuple[Texture, ...]) -> np.ndarray:
    rows = np.zeros(len(textures), layouts.dtype(layouts.TEXTURE))
    for row, texture in zip(rows, textures, strict=True):
        row["u_from_uv"], row["v_from_uv"] = texture.uv_from_mesh[:3], texture.uv_from_mesh[3:]
        row["picture"] = texture.image
        row["extension"] = layouts.CONSTANTS[f"EXTENSION_{texture.extension}"]
        row["closest"], row["channel"] = texture.interpolation == "Closest", texture.channel
        row["divides"] = texture.divides
    return rows
