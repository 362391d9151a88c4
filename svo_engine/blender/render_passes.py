# SPDX-License-Identifier: GPL-3.0-or-later
"""What a view layer asks for: render passes, by its switches or where Blender has none by `layer.svo`; and lines."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields

import bpy

from ..settings import PASSES, Lines

# Render pass -> the view layer's switch
SWITCHES = {"Depth": "use_pass_z", "Emission": "use_pass_emit",
            **{name: f"use_pass_{name.lower().replace(' ', '_')}" for name in PASSES
               if name.startswith(("Position", "Normal", "Diffuse", "Glossy", "Transmission", "Environment"))}}

# Before version 5 Blender has shorter names for some
_SHORT = {"Emission": "Emit", "Environment": "Env",
          **{f"{kind} {part}": f"{short}{part_short}"
             for kind, short in (("Diffuse", "Diff"), ("Glossy", "Gloss"), ("Transmission", "Trans"))
             for part, part_short in (("Direct", "Dir"), ("Indirect", "Ind"), ("Color", "Col"))}}

_KINDS = {1: "VALUE", 4: "COLOR"}


class SVOLayerSettings(bpy.types.PropertyGroup):
    """What a view layer asks of the SVO render engine."""

    def _update(self, context: bpy.types.Context) -> None:
        context.view_layer.update_render_passes()

    denoising_data: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Denoising Data", update=_update, default=False,
        description="Passes that a denoiser in the compositor needs: the noisy picture, normals, albedo, depth")


class SVOLineSettings(bpy.types.PropertyGroup):
    """The outlines of a view layer."""

    show: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Lines", default=False, description="Draw the outlines of objects, materials and edges")
    thickness: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Thickness", default=1.5, min=0.1, max=100, subtype="PIXEL", description="Width of a line")
    color: bpy.props.FloatVectorProperty(  # type: ignore[valid-type]
        name="Color", default=(0, 0, 0), size=3, min=0, soft_max=1, subtype="COLOR", description="Of the lines")
    silhouettes: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Silhouettes", default=True, description="Where a surface ends before something behind it")
    creases: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Creases", default=True, description="Edges between faces that meet at more than the angle")
    crease_angle: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Crease Angle", default=Lines.crease_angle, min=0, max=3.141592653589793, subtype="ANGLE",
        description="Angle between the normals of two faces from which their edge is drawn")
    materials: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Material Borders", default=True, description="Where one material ends and another begins")
    objects: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Object Borders", default=True, description="Where one object ends and another begins")


def lines_of(layer: bpy.types.ViewLayer) -> Lines | None:
    """The outlines that `layer` asks for."""
    asked = layer.svo_lines
    if not asked.show:
        return None
    values = {field.name: getattr(asked, field.name) for field in fields(Lines)}
    return Lines(**{**values, "color": tuple(asked.color)})


def blender_name(name: str) -> str:
    """What this version of Blender calls the pass `name`."""
    return _SHORT.get(name, name) if bpy.app.version < (5, 0) else name


def passes_of(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> tuple[str, ...]:
    """Names of the passes that `layer` asks for, without Combined."""
    wanted = {name for name, switch in SWITCHES.items() if getattr(layer, switch)}
    if layer.svo.denoising_data:
        wanted.update(name for name in PASSES if name.startswith("Denoising"))
        if scene.svo.denoise:  # else it is Combined
            wanted.add("Noisy Image")
    return tuple(name for name in PASSES if name in wanted)


def ask_for(layer: bpy.types.ViewLayer, names: Iterable[str]) -> None:
    """Make `layer` ask for these passes alone; for the data of denoisers if it has any of them."""
    names = set(names)
    for name, switch in SWITCHES.items():
        setattr(layer, switch, name in names)
    layer.svo.denoising_data = bool(names - set(SWITCHES))


def list_passes(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> None:
    """Tell Blender which passes there will be, for the compositor's sockets."""
    engine.register_pass(scene, layer, "Combined", 4, "RGBA", "COLOR")
    for name in passes_of(scene, layer):
        channels = PASSES[name]
        kind = "VECTOR" if channels == "XYZ" else _KINDS.get(len(channels), "COLOR")
        engine.register_pass(scene, layer, blender_name(name), len(channels), channels, kind)


def register() -> None:
    """Put the settings on every view layer."""
    for cls in (SVOLayerSettings, SVOLineSettings):
        bpy.utils.register_class(cls)
    bpy.types.ViewLayer.svo_lines = bpy.props.PointerProperty(type=SVOLineSettings)
    bpy.types.ViewLayer.svo = bpy.props.PointerProperty(type=SVOLayerSettings)


def unregister() -> None:
    """Take them away; what a file has stored stays in it."""
    del bpy.types.ViewLayer.svo, bpy.types.ViewLayer.svo_lines
    for cls in (SVOLineSettings, SVOLayerSettings):
        bpy.utils.unregister_class(cls)
