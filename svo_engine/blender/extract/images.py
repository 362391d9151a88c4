# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels of the images that materials and the world use. Each is read once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import bpy
import numpy as np

from ...scene.types import Image

# What Blender shows for an image that it cannot read
MAGENTA = np.array([[[255, 0, 255, 255]]], "u1")

_ENCODED, _LINEAR = ("sRGB",), ("Linear Rec.709", "scene_linear")


class Source(Protocol):
    """Where Images takes pixels from."""

    def get(self, image: Any, has_straight_alpha: bool, warn: Callable[[str], object]) -> Image:
        """The same object whenever `image` (a datablock, or None) is asked for in the same way, or alpha is all one."""


class Pixels:
    """Reads each image when it is first asked for."""

    def __init__(self) -> None:
        self._read: dict[int, Image] = {}
        self._made: dict[tuple[int, bool], Image] = {}

    def get(self, image: Any, has_straight_alpha: bool, warn: Callable[[str], object]) -> Image:
        pointer = image.as_pointer() if image else 0
        if (pointer, has_straight_alpha) not in self._made:
            if pointer not in self._read:
                self._read[pointer] = read_image(image, warn)
            self._made[pointer, has_straight_alpha] = with_alpha(image, self._read[pointer], has_straight_alpha)
        return self._made[pointer, has_straight_alpha]


class Images:
    """Collects images; `found` are those asked for so far, in the order of `Scene.images`."""

    def __init__(self, warn: Callable[[str], object], source: Source | None = None) -> None:
        self.found: list[Image] = []
        self._warn = warn
        self._source = source or Pixels()

    def index(self, image: Any, has_straight_alpha: bool = False) -> int:
        """Where `image` (a datablock, or None) stands in `found`.

        has_straight_alpha  RGB is what the image shows where it is opaque. Blender gives that to a material only if
                            it also reads the image's alpha; otherwise transparent parts are darker.
        """
        return place(self._source.get(image, has_straight_alpha, self._warn), self.found)


def place(made: Image, found: list[Image]) -> int:
    """The index of `made` in `found`, where it may stand already."""
    known = next((i for i, image in enumerate(found) if image is made), None)
    if known is not None:
        return known
    found.append(made)
    return len(found) - 1


def read_image(image: Any, warn: Callable[[str], object]) -> Image:
    """Straight alpha for bytes, associated alpha for floats: what Blender holds."""
    if image is None:
        return Image("none", MAGENTA, True)
    width, height = image.size
    if min(width, height) == 0 or len(image.pixels) != width * height * 4:
        warn(f"Image '{image.name}' {_missing(image)}; it is drawn in magenta")
        return Image(image.name, MAGENTA, True)
    if sentence := _defect(image):
        warn(sentence)
    pixels = np.empty((height, width, 4), "f4")
    image.pixels.foreach_get(pixels.ravel())
    if image.alpha_mode == "NONE":
        pixels[..., 3] = 1
    if image.is_float:
        return Image(image.name, np.nan_to_num(pixels, copy=False))
    return Image(image.name, _bytes(pixels), _is_encoded(image, warn))


def _bytes(pixels: np.ndarray) -> np.ndarray:
    """The u1 that `pixels` were; row by row, for what fits into the processor's cache is quick."""
    made = np.empty(pixels.shape, "u1")
    for row, to in zip(pixels, made, strict=True):
        row *= 255
        row += 0.5
        to[...] = row
    return made


def with_alpha(image: Any, raw: Image, is_straight: bool) -> Image:
    """`raw` with the alpha that is asked for; itself if there is nothing to do."""
    pixels = raw.pixels
    is_float = pixels.dtype != np.uint8
    if is_straight != is_float or image is None or (pixels[..., 3] == (1 if is_float else 255)).all():
        return raw
    if not is_float and (image.colorspace_settings.is_data or image.alpha_mode in ("CHANNEL_PACKED", "NONE")):
        return raw
    alpha = pixels[..., 3:]
    made = pixels.copy()
    if is_float:
        np.divide(pixels[..., :3], alpha, out=made[..., :3], where=alpha != 0)
    else:  # Cycles multiplies the encoded bytes and cuts; only so are its colours the same
        made[..., :3] = pixels[..., :3].astype("u2") * alpha // 255
    return Image(raw.name, made, raw.is_srgb)


def _missing(image: Any) -> str:
    """Why there are no pixels."""
    if image.source in ("SEQUENCE", "MOVIE"):
        return f"is a {image.source.lower()}, which is not supported"
    return f"cannot be read from '{image.filepath}'" if image.filepath else "has no pixels"


def _defect(image: Any) -> str:
    """A sentence on an image that does not look as in Blender although it can be read; '' for all others."""
    if image.source == "TILED" and len(image.tiles) > 1:
        return (f"Image '{image.name}' has {len(image.tiles)} UDIM tiles, which are not supported; "
                f"tile {image.tiles[0].number} is used for all")
    working = bpy.data.colorspace.working_space if hasattr(bpy.data, "colorspace") else "Linear Rec.709"
    if working != "Linear Rec.709" and not image.is_float and not image.colorspace_settings.is_data:
        return f"Image '{image.name}' is read as Linear Rec.709, but the file's working space is {working}"
    return ""


def _is_encoded(image: Any, warn: Callable[[str], object]) -> bool:
    """Whether the bytes are sRGB-encoded; a warning if they are in a colour space that we cannot convert."""
    space = image.colorspace_settings
    if not space.is_data and space.name not in _ENCODED + _LINEAR:
        warn(f"Image '{image.name}' is in the colour space '{space.name}', which is not supported; sRGB is used")
    return not space.is_data and space.name not in _LINEAR
