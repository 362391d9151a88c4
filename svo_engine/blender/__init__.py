# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender side: the only part that imports bpy."""

from __future__ import annotations

import atexit

from . import compare, engine, final, panels, properties, render_passes, session, view_layer_panels, viewport

_PARTS = (properties, render_passes, engine, compare, panels, view_layer_panels)


def register() -> None:
    """Add the engine, its settings, operators and panels."""
    for part in _PARTS:
        part.register()
    atexit.register(unregister)


def unregister() -> None:
    """Undo `register`; free the GPU. Does no harm a second time: at exit Blender and Python both call it.

    Blender 4.2 crashes and 4.5 hangs if our classes outlive Python. With a window Blender has taken them by then.
    """
    atexit.unregister(unregister)
    if engine.SVORenderEngine.is_registered:
        for part in reversed(_PARTS):
            part.unregister()
    viewport.close_all()
    final.forget()
    session.close()
