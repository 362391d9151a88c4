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
                    others: tuple[int, ...], shares: tuple[int, ...] = ()) -> Pictures:
    """Copy the images that textures read, and `others`, with all of their tiles. All images have a row, and one more is
    of none; those after it are made of what textures need several channels for.

    shares  the textures of which rays read one number
    """
    scope, used = device.scope(), {*others, *(texture.image for texture in textures)}
    numbers = sorted({i + tile for i in used if i < len(images) for tile in range(images[i].n_tiles)})
    rows_of_textures = _textures(textures)
    made = _shares(rows_of_textures, shares, textures, images)
    used_images = [*(images[i] for i in numbers), *made]
    pictures, limits = fitted(used_images, room_for(device.calls, device.context.is_software))
    words = [_words(image) for image in pictures]
    firsts = np.cumsum([0] + [-(-len(w) // WIDTH) * WIDTH for w in words])
    n_words = int(firsts[-2]) + len(words[-1]) if words else 0
    device.profiler.counts["texture words"] = n_words
    texels = scope.words("texels", n_words)
    for first, part in zip(firsts[:-1], words, strict=True):
        texels.put(int(first), part)
    rows = np.zeros(len(images) + 1 + len(made), layouts.dtype(layouts.PICTURE))
    rows[[*numbers, *range(len(images) + 1, len(rows))]] = _rows(pictures, firsts)
    for i in shares:
        if images[textures[i].image].tile:
            rows_of_textures["share"][i] = len(rows)
            rows = np.concatenate([rows, _dense(rows, textures[i].image)])
    return Pictures(scope, {"Textures": scope.buffer("textures", rows_of_textures),
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


def _shares(rows: np.ndarray, shares: tuple[int, ...], textures: tuple[Texture, ...],
            images: tuple[Image, ...]) -> list[Image]:
    """Pictures of one number, for those of the textures `shares` that make it of several channels; the rows of all
    textures say where rays read. Of an image with tiles one channel stands for all.
    """
    made: list[Image] = []
    rows["share"], rows["share_channel"] = rows["picture"], np.where(rows["channel"] < 0, 1, rows["channel"])
    for i in shares:
        texture = textures[i]
        image = images[texture.image]
        divides = texture.divides and image.is_associated and texture.channel < 3
        if (texture.channel < 0 or divides) and not image.tile:
            rows["share"][i], rows["share_channel"][i] = len(images) + 1 + len(made), 0
            made.append(_share(image, texture.channel, bool(divides)))
    return made


def _dense(rows: np.ndarray, first: int) -> np.ndarray:
    """The rows of an image's tiles from 1001 on, with rows of nothing for those that are not there."""
    own = rows[first:first + int(rows["n_tiles"][first])]
    dense = np.zeros(int(own["tile"].max()) - 1000, rows.dtype)
    dense["tile"] = own["tile"][0]
    dense[own["tile"] - 1001] = own
    dense["n_tiles"] = len(dense)
    return dense


def _share(image: Image, channel: int, divides: bool) -> Image:
    """What a material reads of `image` as a number, 8 bits."""
    pixels = image.pixels.astype("f4") / (255 if image.pixels.dtype == np.uint8 else 1)
    rgb = pixels[..., :3]
    if divides:
        alpha = pixels[..., 3:]
        rgb = rgb / np.where(alpha > 0, alpha, 1)
    if image.is_srgb:
        rgb = np.where(rgb <= 0.04045, rgb / 12.92, ((np.maximum(rgb, 0) + 0.055) / 1.055) ** 2.4)
    value = rgb @ np.array([0.2126, 0.7152, 0.0722], "f4") if channel < 0 else rgb[..., channel]
    grey = np.round(np.clip(np.nan_to_num(value), 0, 1) * 255).astype("u1")
    return Image(image.name, np.repeat(grey[..., None], 4, 2))


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
