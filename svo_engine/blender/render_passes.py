# SPDX-License-Identifier: GPL-3.0-or-later
"""The render passes that a view layer asks for, by Blender's own switches and, where it has none, by `layer.svo`."""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from ..settings import PASSES

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
    bpy.utils.register_class(SVOLayerSettings)
    bpy.types.ViewLayer.svo = bpy.props.PointerProperty(type=SVOLayerSettings)


def unregister() -> None:
    """Take them away; what a file has stored stays in it."""
    del bpy.types.ViewLayer.svo
    bpy.utils.unregister_class(SVOLayerSettings)
