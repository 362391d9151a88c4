# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of many files: UDIM tiles, frames of sequences. Blender shows scripts the pixels of one of them, so that all
others are read as images of their own, which are gone again at once.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy

from ...scene.types import Image, frame_name
from .pixels import MAGENTA, read_image

_DIGITS = re.compile(r"(\d+)(\D*)$")

Warn = Callable[[str], object]


def read_tiles(image: Any, warn: Warn) -> tuple[Image, ...]:
    """All tiles of `image` that can be read; magenta in place of the others, with one sentence for all of them."""
    made, missing = [], []
    for tile in image.tiles:
        path = _tile_path(image, tile.number)
        is_first = tile.number == image.tiles[0].number
        found = None if image.packed_files else _read_file(image, path)
        if found is None:
            found = _of_packed(image, path, tile.number)
        if found is None and is_first and image.has_data:
            found = read_image(image, warn)
        if found is None:
            missing.append(tile.number)
            found = Image(image.name_full, MAGENTA, True)
        made.append(replace(found, name=image.name_full, tile=tile.number))
    if missing:
        which = ", ".join(map(str, missing))
        warn(f"Image '{image.name}': its tiles {which} cannot be read; they are drawn in magenta")
    return tuple(replace(image, n_tiles=len(made) - i) for i, image in enumerate(made))


def read_frame(image: Any, frame: int, warn: Warn) -> Image:
    """One frame of a sequence; of a movie the one that Blender has at hand."""
    name = frame_name(image.name_full, frame)
    if image.source == "MOVIE":
        warn(f"Image '{image.name}' is a movie, of which only one frame is drawn")
        return replace(read_image(image, warn), name=name)
    path = _absolute(image)
    path = path.with_name(_frame_file(path.name, frame))
    found = _read_file(image, path)
    if found is None:
        warn(f"Image '{image.name}' cannot be read from '{path}'; it is drawn in magenta")
        found = Image(name, MAGENTA, True)
    return replace(found, name=name)


def _frame_file(name: str, frame: int) -> str:
    """The name of another frame's file: the last number before its ending is that of the frame."""
    stem, dot, ending = name.rpartition(".")
    match = _DIGITS.search(stem)
    if match is None:
        return name
    return f"{stem[:match.start()]}{frame:0{len(match[1])}d}{match[2]}{dot}{ending}"


def _absolute(image: Any, path: str = "") -> Path:
    return Path(bpy.path.abspath(path or image.filepath, library=image.library))


def _tile_path(image: Any, number: int) -> Path:
    u, v = (number - 1001) % 10 + 1, (number - 1001) // 10 + 1
    return _absolute(image, image.filepath.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u}_v{v}"))


def _of_packed(image: Any, path: Path, number: int) -> Image | None:
    """A tile that is packed into the .blend."""
    for packed in image.packed_files:
        if packed.tile_number == number or Path(packed.filepath).name == path.name:
            made = bpy.data.images.new(image.name, 1, 1)
            made.pack(data=packed.packed_file.data, data_len=packed.packed_file.size)
            made.source = "FILE"
            return _read_as(image, made)
    return None


def _read_file(image: Any, path: Path) -> Image | None:
    """The pixels of another file with the settings of `image`; None if it cannot be read."""
    try:
        return _read_as(image, bpy.data.images.load(str(path)))
    except RuntimeError:
        return None


def _read_as(image: Any, other: Any) -> Image | None:
    """The pixels of `other`, which is removed, with the settings of `image`; None if there are none."""
    try:
        # Of an image that Blender itself has not read yet there is none: Cycles takes such values as they are
        other.colorspace_settings.name = image.colorspace_settings.name or "Non-Color"
        other.alpha_mode = image.alpha_mode
        return read_image(other, lambda _sentence: None) if other.has_data or other.size[0] else None
    finally:
        bpy.data.images.remove(other)
