# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a material the last picture left out or replaced: a line for each sentence."""

from __future__ import annotations

import textwrap

import bpy

from . import told
from .panel_base import ENGINE

_PIXELS_OF_A_LETTER = 7
_FEWEST_LETTERS = 20


class SVO_PT_material_notes(bpy.types.Panel):
    """Shown for materials of which something was told."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    bl_label = "Not as in Cycles"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        material = getattr(context, "material", None)
        return context.engine == ENGINE and material is not None and bool(told.of_material(material.name))

    def draw(self, context: bpy.types.Context) -> None:
        scale = context.preferences.system.ui_scale
        n_letters = max(int(context.region.width / (_PIXELS_OF_A_LETTER * scale)) - 4, _FEWEST_LETTERS)
        for sentence in told.of_material(context.material.name):
            lines = self.layout.column(align=True)
            for i, line in enumerate(textwrap.wrap(sentence, n_letters)):
                lines.label(text=line, icon="BLANK1" if i else "ERROR")


CLASSES = (SVO_PT_material_notes,)
