# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests that need Blender as a Python module share."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy", exc_type=ImportError)


@pytest.fixture
def empty():
    """The scene of a new and empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


@pytest.fixture
def extension():
    """The extension, registered for one test."""
    from svo_engine import blender

    blender.register()
    yield blender
    blender.unregister()


@pytest.fixture(autouse=True)
def no_handlers():
    """None is left: Blender 4.5 hangs at its end if there is one."""
    yield
    bpy.app.handlers.depsgraph_update_post.clear()
    bpy.app.handlers.frame_change_post.clear()
