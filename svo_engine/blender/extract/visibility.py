# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport hides for itself alone: by local view, local collections, or types of objects."""

from __future__ import annotations

from typing import Any

# Type of an object -> SpaceView3D's switch for it
_SWITCHES = {kind: "show_object_viewport_" + kind.lower() for kind in (
    "MESH", "CURVE", "META", "FONT", "CURVES", "POINTCLOUD", "VOLUME", "ARMATURE", "LATTICE", "EMPTY", "LIGHT",
    "LIGHT_PROBE", "CAMERA", "SPEAKER")} | {"SURFACE": "show_object_viewport_surf"} | dict.fromkeys(
        ("GPENCIL", "GREASEPENCIL"), "show_object_viewport_grease_pencil")


def hiding_of(space: Any) -> tuple[Any, ...]:
    """Another value when `space` (None: no viewport) begins or ends to hide something; Blender does not always tell."""
    if space is None:
        return ()
    hidden = (kind for kind in _SWITCHES if not _shows_type(space, kind))
    return (bool(space.local_view), space.use_local_collections, *hidden)


def is_seen(instance: Any, space: Any) -> bool:
    """Whether `space` (None: no viewport) shows the depsgraph's `instance`.

    What an object places by instancing is seen with that object. The placed one cannot be asked: Blender gives the
    object itself in its stead once any script has looked at that, and it may lie in no visible collection.
    """
    if space is None or not instance.is_instance:
        return sees(instance.object, space)
    return _shows_type(space, instance.object.type) and sees(instance.parent, space, is_holder=True)


def sees(owner: Any, space: Any, is_holder: bool = False) -> bool:
    """Whether `space` shows the evaluated object `owner`, or what it places: that has a type of its own."""
    if space is None:
        return True
    if _shows_type(space, owner.type):
        return bool(owner.visible_in_viewport_get(space))
    return is_holder and (not space.local_view or owner.local_view_get(space))


def _shows_type(space: Any, kind: str) -> bool:
    return getattr(space, _SWITCHES.get(kind, ""), True)
