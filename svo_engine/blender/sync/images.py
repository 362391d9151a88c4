# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels that stay until their image changes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...scene.types import Image
from ..extract.images import read_images
from .changes import Changes, Uid, uid_of
from .same import keep

# Texels that are read again, all images together, to find edits that Blender does not report: 3 ms
_MOST_COMPARED = 1 << 18


Key = tuple[Uid, int]  # of an image, and the frame of it


@dataclass(eq=False)
class _Kept:
    """One image, or one frame of it, as it was read: `marks` and `file` as they were then."""

    marks: tuple[Any, ...]
    file: tuple[int, int]
    images: tuple[Image, ...]
    notes: tuple[str, ...]
    is_stale: bool = False


class KeptImages:
    """A Source for `extract.images.Images`."""

    def __init__(self) -> None:
        self.n_read = 0
        self._kept: dict[Key, _Kept] = {}

    def get(self, image: Any, frame: int, warn: Callable[[str], object]) -> tuple[Image, ...]:
        """As `Source.get`, over all updates."""
        key = key_of(image, frame)
        kept = self._kept.get(key)
        if kept is None or kept.is_stale:
            self.n_read += image is not None
            kept = self._kept[key] = self._read(image, frame, kept)
        for note in kept.notes:
            warn(note)
        return kept.images

    def are_stale(self) -> bool:
        """Whether any is known to have changed."""
        return any(kept.is_stale for kept in self._kept.values())

    def compare(self) -> bool:
        """Whether any has changed, also if nobody has told, as far as that can be seen in 3 ms: pixels are compared if
        they are few, and not saved. Who sets more of them must call `Image.update_tag`."""
        n_left = _MOST_COMPARED
        for (_, frame), kept, image in self._found():
            kept.is_stale |= _marks(image) != kept.marks
            if image.is_dirty and not kept.is_stale:
                n_left -= image.size[0] * image.size[1]
                kept.is_stale = n_left >= 0 and self._read(image, frame, kept) is not kept
        return self.are_stale()

    def look(self, changes: Changes, images_of: Callable[[Uid], frozenset[Uid]]) -> frozenset[Uid]:
        """The images that must be read again. Blender does not report all that is done to pixels.

        Of a material that is named for nothing else, images were reloaded; but undo names materials so, too, and the
        scene with them: there only files that have changed on disk count.

        images_of  the images that a material reads
        """
        reloaded = frozenset().union(*(images_of(uid) for uid in changes.reloaded))
        for (uid, _), kept, image in self._found():
            kept.is_stale |= uid in changes.images
            if uid in reloaded:
                kept.is_stale |= not changes.has_scene or _file(image) != kept.file
        self.compare()
        return frozenset(uid for (uid, _), kept in self._kept.items() if kept.is_stale)

    def keep_only(self, used: frozenset[Key]) -> None:
        """Give up all others."""
        self._kept = {key: kept for key, kept in self._kept.items() if key in used}

    def distrust(self) -> None:
        """Have all read again; what is the same stays."""
        for kept in self._kept.values():
            kept.is_stale = True

    def _found(self) -> list[tuple[Key, _Kept, Any]]:
        """What is kept, with its datablock: by uid, for a datablock's address may hold another one by now."""
        images = {uid_of(image): image for image in bpy.data.images}
        return [(key, kept, images[key[0]]) for key, kept in self._kept.items() if key[0] in images]

    def _read(self, image: Any, frame: int, last: _Kept | None) -> _Kept:
        """`image` anew; `last` itself if that is the same."""
        notes: dict[str, None] = {}
        images = read_images(image, frame, notes.setdefault)
        if last is not None:
            images = keep(last.images, images)
        marks, file = _marks(image), _file(image)
        if last is not None and images is last.images and (marks, tuple(notes)) == (last.marks, last.notes):
            last.is_stale, last.file = False, file
            return last
        return _Kept(marks, file, images, tuple(notes))


def key_of(image: Any, frame: int) -> Key:
    """Of a datablock, or None."""
    return uid_of(image) if image else 0, frame


def _marks(image: Any) -> tuple[Any, ...]:
    """What costs little to ask for and tells of most edits that Blender does not report."""
    if image is None:
        return ()
    space = image.colorspace_settings
    return (image.name_full, *image.size, *(tile.number for tile in image.tiles), image.alpha_mode, image.source,
            image.filepath, image.is_dirty, image.is_float, space.name, space.is_data)


def _file(image: Any) -> tuple[int, int]:
    """When the image's file was written, and its size; zeros without one."""
    if image is None or image.source != "FILE":
        return 0, 0
    try:
        found = Path(bpy.path.abspath(image.filepath, library=image.library)).stat()
    except (OSError, ValueError):
        return 0, 0
    return found.st_mtime_ns, found.st_size
