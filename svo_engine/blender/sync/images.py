# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels that stay until their image changes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...scene.types import Image
from ..extract.images import read_image, with_alpha
from .changes import Changes, Uid, uid_of
from .same import keep

# Texels that are read again, all images together, to find edits that Blender does not report: 3 ms
_MOST_COMPARED = 1 << 18


@dataclass(eq=False)
class _Kept:
    """One image as it was read: `marks` and `file` as they were then, `made` by whether alpha is straight.

    before  `made` of the reading before
    """

    marks: tuple[Any, ...]
    file: tuple[int, int]
    raw: Image
    made: dict[bool, Image]
    before: dict[bool, Image]
    notes: tuple[str, ...]
    is_stale: bool = False


class KeptImages:
    """A Source for `extract.images.Images`."""

    def __init__(self) -> None:
        self.n_read = 0
        self._kept: dict[Uid, _Kept] = {}

    def get(self, image: Any, has_straight_alpha: bool, warn: Callable[[str], object]) -> Image:
        """As `Source.get`, over all updates."""
        uid = uid_of(image) if image else 0
        kept = self._kept.get(uid)
        if kept is None or kept.is_stale:
            self.n_read += image is not None
            kept = self._kept[uid] = self._read(image, kept)
        for note in kept.notes:
            warn(note)
        if has_straight_alpha not in kept.made:
            made = with_alpha(image, kept.raw, has_straight_alpha)
            kept.made[has_straight_alpha] = keep(kept.before.get(has_straight_alpha), made)
        return kept.made[has_straight_alpha]

    def are_stale(self) -> bool:
        """Whether any is known to have changed."""
        return any(kept.is_stale for kept in self._kept.values())

    def compare(self) -> bool:
        """Whether any has changed, also if nobody has told, as far as that can be seen in 3 ms: pixels are compared if
        they are few, and not saved. Who sets more of them must call `Image.update_tag`."""
        n_left = _MOST_COMPARED
        for kept, image in self._found():
            kept.is_stale |= _marks(image) != kept.marks
            if image.is_dirty and not kept.is_stale:
                n_left -= image.size[0] * image.size[1]
                kept.is_stale = n_left >= 0 and self._read(image, kept) is not kept
        return self.are_stale()

    def look(self, changes: Changes, images_of: Callable[[Uid], frozenset[Uid]]) -> frozenset[Uid]:
        """The images that must be read again. Blender does not report all that is done to pixels.

        Of a material that is named for nothing else, images were reloaded; but undo names materials so, too, and the
        scene with them: there only files that have changed on disk count.

        images_of  the images that a material reads
        """
        reloaded = frozenset().union(*(images_of(uid) for uid in changes.reloaded))
        for kept, image in self._found():
            uid = uid_of(image)
            kept.is_stale |= uid in changes.images
            if uid in reloaded:
                kept.is_stale |= not changes.has_scene or _file(image) != kept.file
        self.compare()
        return frozenset(uid for uid, kept in self._kept.items() if kept.is_stale)

    def keep_only(self, used: frozenset[Uid]) -> None:
        """Give up all others, and what was read before."""
        self._kept = {uid: kept for uid, kept in self._kept.items() if uid in used}
        for kept in self._kept.values():
            kept.before = {}

    def distrust(self) -> None:
        """Have all read again; what is the same stays."""
        for kept in self._kept.values():
            kept.is_stale = True

    def _found(self) -> list[tuple[_Kept, Any]]:
        """What is kept, with its datablock: by uid, for a datablock's address may hold another one by now."""
        return [(self._kept[uid], image) for image in bpy.data.images if (uid := uid_of(image)) in self._kept]

    def _read(self, image: Any, last: _Kept | None) -> _Kept:
        """`image` anew; `last` itself if that is the same."""
        notes: dict[str, None] = {}
        raw = read_image(image, notes.setdefault)
        if last is not None:
            raw = keep(last.raw, raw)
        marks, file = _marks(image), _file(image)
        if last is not None and raw is last.raw and (marks, tuple(notes)) == (last.marks, last.notes):
            last.is_stale, last.file = False, file
            return last
        return _Kept(marks, file, raw, {}, last.made if last else {}, tuple(notes))


def _marks(image: Any) -> tuple[Any, ...]:
    """What costs little to ask for and tells of most edits that Blender does not report."""
    if image is None:
        return ()
    space = image.colorspace_settings
    return (*image.size, image.alpha_mode, image.source, image.filepath, image.is_dirty, image.is_float, space.name,
            space.is_data)


def _file(image: Any) -> tuple[int, int]:
    """When the image's file was written, and its size; zeros without one."""
    if image is None or image.source != "FILE":
        return 0, 0
    try:
        found = Path(bpy.path.abspath(image.filepath, library=image.library)).stat()
    except (OSError, ValueError):
        return 0, 0
    return found.st_mtime_ns, found.st_size
