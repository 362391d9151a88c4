# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether what was read again says something new. If not, the old object stays, by which downstream knows it."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np

from ...scene.types import Camera, Instances, Light, Material, Mesh, Scene

T = TypeVar("T")

# Their names stand in messages only; images are known by theirs
_NAMED = (Mesh, Instances, Material, Light, Camera)


def is_same(old: Any, new: Any) -> bool:
    """Whether both are the same by value, but for names."""
    if old is new:
        return True
    if type(old) is not type(new):
        return False
    if isinstance(old, np.ndarray):
        return old.dtype == new.dtype and np.array_equal(old, new)
    if isinstance(old, tuple) and not _is_text(old):
        return len(old) == len(new) and all(map(is_same, old, new))
    if is_dataclass(old):
        left_out = ("name", "names") if isinstance(old, _NAMED) else ()
        return all(is_same(getattr(old, f.name), getattr(new, f.name)) for f in fields(old) if f.name not in left_out)
    return bool(old == new)


def keep(old: T | None, new: T) -> T:
    """`old` if both are the same, else `new` with those items of a tuple that are."""
    if old is not None and is_same(old, new):
        return old
    if isinstance(old, tuple) and isinstance(new, tuple) and not _is_text(new):
        return tuple(keep(a, b) for a, b in zip(old, new, strict=False)) + new[len(old):]  # type: ignore[return-value]
    return new


def keep_picture(last: Scene | None, scene: Scene) -> Scene:
    """`last` if `scene` differs from it in nothing that pictures depend on."""
    return last if last is not None and is_same(last.plain, scene.plain) else scene


def _is_text(items: tuple[Any, ...]) -> bool:
    return bool(items) and isinstance(items[0], str)


def keep_fields(old: Any, new: Any) -> Any:
    """`old` if both records are the same, else `new` with all fields of `old` that are."""
    if is_same(old, new):
        return old
    return replace(new, **{f.name: keep(getattr(old, f.name), getattr(new, f.name)) for f in fields(old)})
