# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender extension. All code is in `svo_engine`; nothing is imported before Blender calls `register`."""


def register() -> None:
    """Blender enables the extension."""
    from .svo_engine import blender

    blender.register()


def unregister() -> None:
    """Blender disables the extension."""
    from .svo_engine import blender

    blender.unregister()
