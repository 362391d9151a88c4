# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender side: the only part that imports bpy."""

from __future__ import annotations

import atexit

from . import compare, engine, panels, properties, session, viewport

_PARTS = (properties, engine, compare, panels)


def register(package: str) -> None:  # noqa: ARG001 - for the extension's preferences, which it does not have yet
    """Add the engine, its settings, operators and panels. package: the name by which Blender knows the extension."""
    for part in _PARTS:
        part.register()
    atexit.register(_release_at_exit)


def unregister() -> None:
    """Undo `register`; free the GPU."""
    atexit.unregister(_release_at_exit)
    for part in reversed(_PARTS):
        part.unregister()
    _release()


def _release() -> None:
    """End our threads."""
    viewport.close_all()
    session.close()


def _release_at_exit() -> None:
    """Blender 4.2 crashes and 4.5 hangs if our classes outlive Python. With a window Blender has taken them by now."""
    if engine.SVORenderEngine.is_registered:
        unregister()
    else:
        _release()
