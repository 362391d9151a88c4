# SPDX-License-Identifier: GPL-3.0-or-later
"""What our panels have in common."""

from __future__ import annotations

from typing import Any

import bpy

from .engine import SVORenderEngine

ENGINE = SVORenderEngine.bl_idname
CLOSED = {"DEFAULT_CLOSED"}


class RenderPanel:
    """A panel of the render tab that only our engine shows."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {ENGINE}
    layout: Any

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine in cls.COMPAT_ENGINES

    def column(self) -> Any:
        """A column in the layout of Blender's own panels: labels on the left, no dots for keyframes."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout.column()
