# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels of one image, as Cycles filters them: times alpha where the image's own setting wants that."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

from ...scene.types import Image
from .spaces import ENCODED, LINEAR, linear_of

# What Blender shows for an image that it cannot read
MAGENTA = np.array([[[255, 0, 255, 255]]], "u1")

Warn = Callable[[str], object]


def read_image(image: Any, warn: Warn) -> Image:
    """A datablock that has pixels of its own."""
    name = image.name_full
    width, height = image.size
    if min(width, height) == 0 or len(image.pixels) != width * height * 4:
        warn(f"Image '{image.name}' {_missing(image)}; it is drawn in magenta")
        return Image(name, MAGENTA, True)
    if sentence := _other_working_space(image):
        warn(sentence)
    pixels = np.empty((height, width, 4), "f4")
    image.pixels.foreach_get(pixels.ravel())
    if image.alpha_mode == "NONE":
        pixels[..., 3] = 1
    divides = not image.colorspace_settings.is_data and image.alpha_mode in ("STRAIGHT", "PREMUL")
    if image.is_float:  # which Blender holds in linear light, and times alpha
        return Image(name, np.nan_to_num(pixels, copy=False), is_associated=divides)
    return _of_bytes(image, pixels, divides and bool((pixels[..., 3] != 1).any()), warn)


def _of_bytes(image: Any, pixels: np.ndarray, divides: bool, warn: Warn) -> Image:
    """From straight alpha. divides: colours are to be multiplied by it."""
    space = image.colorspace_settings
    if not space.is_data and space.name not in ENCODED + LINEAR:
        linear = linear_of(pixels[..., :3], space.name)
        if linear is not None:
            pixels[..., :3] = linear * (pixels[..., 3:] if divides else 1)
            return Image(image.name_full, pixels, is_associated=divides)
        warn(f"Image '{image.name}' is in the colour space '{space.name}', which is not supported; sRGB is used")
    made = _bytes(pixels)
    if divides:  # Cycles multiplies the encoded bytes and cuts; only so are its colours the same
        made[..., :3] = made[..., :3].astype("u2") * made[..., 3:] // 255
    return Image(image.name_full, made, not space.is_data and space.name not in LINEAR, divides)


def _bytes(pixels: np.ndarray) -> np.ndarray:
    """The u1 that `pixels` were; row by row, for what fits into the processor's cache is quick."""
    made = np.empty(pixels.shape, "u1")
    for row, to in zip(pixels, made, strict=True):
        row *= 255
        row += 0.5
        to[...] = row
    return made


def _missing(image: Any) -> str:
    """Why there are no pixels."""
    return f"cannot be read from '{image.filepath}'" if image.filepath else "has no pixels"


def _other_working_space(image: Any) -> str:
    """A sentence on an image whose colours would have to be converted to something else than we do; '' for others."""
    working = bpy.data.colorspace.working_space if hasattr(bpy.data, "colorspace") else "Linear Rec.709"
    if working != "Linear Rec.709" and not image.is_float and not image.colorspace_settings.is_data:
        return f"Image '{image.name}' is read as Linear Rec.709, but the file's working space is {working}"
    return ""
