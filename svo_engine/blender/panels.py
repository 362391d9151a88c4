# SPDX-License-Identifier: GPL-3.0-or-later
"""Our own panels, in the order in which Cycles shows its own. A panel of a group shows every setting of that group."""

from __future__ import annotations

from typing import Any

import bpy
from bl_ui import properties_render

from ..settings import specs
from . import host_panels, material_panels, sampling_panels
from .panel_base import CLOSED, ENGINE, RenderPanel

_OF_LIT_VOXELS = {"injection_ambient", "injection_specular", "injection_shininess"}


def _has_voxels(svo: Any) -> bool:
    """Whether there are filtered voxels at all: for cones, or to be looked at."""
    return svo.method == "cones" or svo.view.startswith("voxel")


def _has_effect(svo: Any, name: str) -> bool:
    """Whether the setting does anything beside the others; if not, it is greyed out."""
    if name == "view_lod":
        return svo.view.startswith("voxel")
    return name not in _OF_LIT_VOXELS or _has_voxels(svo)


class _GroupPanel(RenderPanel):
    """All settings of one group of `settings.py`."""

    group: str

    def draw(self, context: bpy.types.Context) -> None:
        column, svo = self.column(), context.scene.svo
        for name, spec in specs().items():
            if spec.group == self.group:
                part = column.column()
                part.active = _has_effect(svo, name)
                part.prop(svo, name)


class SVO_PT_rays(_GroupPanel, bpy.types.Panel):
    """The rays that gather light, and the octree that holds it."""

    bl_label = group = "Rays"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.scene.svo.method == "rays"


class SVO_PT_voxel_grid(_GroupPanel, bpy.types.Panel):
    """How fine the voxels are: those of the cones, and those that can be looked at."""

    bl_label = group = "Voxel Grid"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and _has_voxels(context.scene.svo)


class SVO_PT_cones(_GroupPanel, bpy.types.Panel):
    """The cones that gather light."""

    bl_label = group = "Cones"
    bl_options = CLOSED

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.scene.svo.method == "cones"


class SVO_PT_light_injection(_GroupPanel, bpy.types.Panel):
    """How the lamps light the voxels."""

    bl_label = group = "Light Injection"
    bl_options = CLOSED


class SVO_PT_simplify(RenderPanel, bpy.types.Panel):
    """Blender's own Simplify, which every engine that shows it elsewhere than on top has to repeat."""

    bl_label = "Simplify"
    bl_options = CLOSED
    draw_header = properties_render.RENDER_PT_simplify.draw_header
    draw = properties_render.RENDER_PT_simplify.draw


class SVO_PT_simplify_viewport(RenderPanel, bpy.types.Panel):
    """Blender's own, for the viewport."""

    bl_label = "Viewport"
    bl_parent_id = "SVO_PT_simplify"
    draw = properties_render.RENDER_PT_simplify_viewport.draw


class SVO_PT_simplify_render(RenderPanel, bpy.types.Panel):
    """Blender's own, for the final render."""

    bl_label = "Render"
    bl_parent_id = "SVO_PT_simplify"
    draw = properties_render.RENDER_PT_simplify_render.draw


class SVO_PT_film(RenderPanel, bpy.types.Panel):
    """The pixel filter, and whether the world is seen behind the scene."""

    bl_label = "Film"

    def draw(self, context: bpy.types.Context) -> None:
        column = self.column()
        column.prop(context.scene.svo, "filter_width")
        column.prop(context.scene.render, "film_transparent", text="Transparent")


class SVO_PT_debug(_GroupPanel, bpy.types.Panel):
    """What the picture shows."""

    bl_label = group = "Debug"
    bl_options = CLOSED


class SVO_PT_comparison(RenderPanel, bpy.types.Panel):
    """Our picture against that of Cycles."""

    bl_label = "Comparison"
    bl_options = CLOSED

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and hasattr(bpy.types, "SVO_OT_compare")

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.operator("svo.compare")


class _LightPanel:
    """A part of Blender's own Light panel."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"
    bl_parent_id = "DATA_PT_EEVEE_light"


class SVO_PT_light_beam(_LightPanel, bpy.types.Panel):
    """What Blender shows for spots alone."""

    bl_label = "Beam Shape"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine == ENGINE and context.light is not None and context.light.type == "AREA"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        self.layout.prop(context.light, "spread")


class SVO_PT_light_shadow(_LightPanel, bpy.types.Panel):
    """Whether the light casts a shadow."""

    bl_label = "Shadow"
    bl_options = CLOSED

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine == ENGINE and context.light is not None

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        self.layout.prop(context.light, "use_shadow", text="Cast Shadow")


class SVO_PT_viewport_lighting(bpy.types.Panel):
    """In the viewport's shading popover: Blender shows its own there for EEVEE alone."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_label = "Lighting"
    bl_parent_id = "VIEW3D_PT_shading"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine == ENGINE and context.space_data.shading.type == "RENDERED"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.space_data.shading, "use_scene_lights_render")


_CLASSES = (*sampling_panels.CLASSES, SVO_PT_rays, SVO_PT_voxel_grid, SVO_PT_cones, SVO_PT_light_injection,
            SVO_PT_simplify, SVO_PT_simplify_viewport, SVO_PT_simplify_render, SVO_PT_film, SVO_PT_debug,
            SVO_PT_comparison, SVO_PT_light_beam, SVO_PT_light_shadow, SVO_PT_viewport_lighting,
            *material_panels.CLASSES)


def register() -> None:
    """Show our panels, and Blender's for our engine."""
    host_panels.opt_in(ENGINE)
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Undo `register`."""
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
    host_panels.opt_out(ENGINE)
