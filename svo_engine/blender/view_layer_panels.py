# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of the view layer tab: which render passes there are to be, as Cycles shows its own; outlines."""

from __future__ import annotations

from typing import Any

import bpy

from .engine import SVORenderEngine


class _LayerPanel:
    """A panel of the view layer tab that only our engine shows."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "view_layer"
    COMPAT_ENGINES = {SVORenderEngine.bl_idname}
    layout: Any

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine in cls.COMPAT_ENGINES

    def columns(self, layer: bpy.types.ViewLayer, *columns: tuple[str, dict[str, str]]) -> None:
        """For each column its heading, and properties with their labels."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        for heading, labels in columns:
            column = self.layout.column(heading=heading, align=True)
            for name, label in labels.items():
                column.prop(layer, name, text=label)


class SVO_PT_passes(_LayerPanel, bpy.types.Panel):
    """What both parts below have in common."""

    bl_label = "Passes"

    def draw(self, _context: bpy.types.Context) -> None:
        """Nothing of its own."""


class SVO_PT_passes_data(_LayerPanel, bpy.types.Panel):
    """What lies where."""

    bl_label = "Data"
    bl_parent_id = "SVO_PT_passes"

    def draw(self, context: bpy.types.Context) -> None:
        layer = context.view_layer
        self.columns(layer, ("Include", {"use_pass_combined": "Combined", "use_pass_z": "Z",
                                         "use_pass_position": "Position", "use_pass_normal": "Normal"}))
        self.columns(layer.svo, ("", {"denoising_data": "Denoising Data"}))


class SVO_PT_passes_light(_LayerPanel, bpy.types.Panel):
    """What the light did on its way."""

    bl_label = "Light"
    bl_parent_id = "SVO_PT_passes"

    def draw(self, context: bpy.types.Context) -> None:
        kinds = [(kind, {f"use_pass_{kind.lower()}_{part.lower()}": part for part in ("Direct", "Indirect", "Color")})
                 for kind in ("Diffuse", "Glossy", "Transmission")]
        self.columns(context.view_layer, *kinds,
                     ("Other", {"use_pass_emit": "Emission", "use_pass_environment": "Environment"}))


class SVO_PT_lines(_LayerPanel, bpy.types.Panel):
    """Outlines."""

    bl_label = "Lines"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context: bpy.types.Context) -> None:
        """The switch."""
        self.layout.prop(context.view_layer.svo_lines, "show", text="")

    def draw(self, context: bpy.types.Context) -> None:
        lines = context.view_layer.svo_lines
        self.layout.active = lines.show
        self.columns(lines, ("", {"thickness": "Thickness", "color": "Color"}),
                     ("Draw", {"silhouettes": "Silhouettes", "objects": "Object Borders",
                               "materials": "Material Borders", "creases": "Creases"}))
        angle = self.layout.column()
        angle.active = lines.creases
        angle.prop(lines, "crease_angle")


_CLASSES = (SVO_PT_passes, SVO_PT_passes_data, SVO_PT_passes_light, SVO_PT_lines)


def register() -> None:
    """Show the panels."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Undo `register`."""
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
