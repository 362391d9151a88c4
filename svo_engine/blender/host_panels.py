# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of Blender's own panels our engine shows: those of any engine, EEVEE's for what we render, and no others.

A panel is shown for the engines that its `COMPAT_ENGINES` names; Blender's panels are the same objects for all engines.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy

# Panels of any engine that we replace (lights, simplify) or do not render (Freestyle, view layer passes)
_LEFT_OUT = {"DATA_PT_light", "NODE_DATA_PT_light", "DATA_PT_falloff_curve", "VIEWLAYER_PT_filter",
             "VIEWLAYER_PT_layer_passes"}
_LEFT_OUT_PARTS = ("RENDER_PT_simplify", "freestyle")

# EEVEE's panels for what we render too; these names are the same in every Blender from 4.2 to 5.2
_TAKEN_FROM_EEVEE = {"DATA_PT_EEVEE_light", "NODE_DATA_PT_EEVEE_light", "EEVEE_MATERIAL_PT_context_material",
                     "EEVEE_MATERIAL_PT_surface", "MATERIAL_PT_preview", "EEVEE_WORLD_PT_surface"}


def opt_in(engine: str) -> None:
    """Show Blender's panels for `engine` too."""
    for panel in _panels():
        panel.COMPAT_ENGINES.add(engine)


def opt_out(engine: str) -> None:
    """Undo `opt_in`."""
    for panel in _panels():
        panel.COMPAT_ENGINES.discard(engine)


def _panels() -> Iterator[type[bpy.types.Panel]]:
    """Blender's panels that fit our engine."""
    for panel in bpy.types.Panel.__subclasses__():
        name = panel.__name__
        left_out = name in _LEFT_OUT or any(part in name for part in _LEFT_OUT_PARTS)
        if name in _TAKEN_FROM_EEVEE or ("BLENDER_RENDER" in getattr(panel, "COMPAT_ENGINES", ()) and not left_out):
            yield panel
