# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel "Sampling" and its parts, in the order in which Cycles shows its own."""

from __future__ import annotations

from typing import Any

import bpy

from .panel_base import CLOSED, RenderPanel


class SVO_PT_sampling(RenderPanel, bpy.types.Panel):
    """What both parts below have in common."""

    bl_label = "Sampling"

    def draw(self, context: bpy.types.Context) -> None:
        self.column().prop(context.scene.svo, "method")


def _samples(column: Any, svo: Any, prefix: str = "") -> None:
    """The noise threshold and the samples, as Cycles shows them."""
    is_adaptive = getattr(svo, f"{prefix}adaptive_sampling")
    row = column.column(align=True, heading="Noise Threshold").row(align=True)
    row.prop(svo, f"{prefix}adaptive_sampling", text="")
    threshold = row.row()
    threshold.active = is_adaptive
    threshold.prop(svo, f"{prefix}noise_threshold", text="")
    samples = column.column(align=True)
    samples.prop(svo, f"{prefix}samples", text="Max Samples" if is_adaptive else "Samples")
    if is_adaptive:
        samples.prop(svo, f"{prefix}min_samples", text="Min Samples")


class _DenoisePanel(RenderPanel):
    """Whether and how noise is smoothed, as Cycles shows it."""

    bl_label = "Denoise"
    bl_options = CLOSED
    prefix: str

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.scene.svo, f"{self.prefix}denoise", text="")

    def draw(self, context: bpy.types.Context) -> None:
        column, svo = self.column(), context.scene.svo
        column.active = getattr(svo, f"{self.prefix}denoise")
        column.prop(svo, f"{self.prefix}denoiser")
        quality = column.column()
        quality.active = getattr(svo, f"{self.prefix}denoiser") != "atrous"
        quality.prop(svo, f"{self.prefix}denoising_quality")


class SVO_PT_sampling_viewport(RenderPanel, bpy.types.Panel):
    """The viewport's samples."""

    bl_label = "Viewport"
    bl_parent_id = "SVO_PT_sampling"

    def draw(self, context: bpy.types.Context) -> None:
        _samples(self.column(), context.scene.svo, "viewport_")


class SVO_PT_sampling_viewport_denoise(_DenoisePanel, bpy.types.Panel):
    """How the viewport's noise is smoothed."""

    bl_parent_id = "SVO_PT_sampling_viewport"
    prefix = "viewport_"


class SVO_PT_sampling_render(RenderPanel, bpy.types.Panel):
    """The final render's samples."""

    bl_label = "Render"
    bl_parent_id = "SVO_PT_sampling"

    def draw(self, context: bpy.types.Context) -> None:
        column = self.column()
        _samples(column, context.scene.svo)
        column.prop(context.scene.svo, "time_limit")


class SVO_PT_sampling_render_denoise(_DenoisePanel, bpy.types.Panel):
    """How the final render's noise is smoothed."""

    bl_parent_id = "SVO_PT_sampling_render"
    prefix = ""


class SVO_PT_sampling_advanced(RenderPanel, bpy.types.Panel):
    """What is rarely touched."""

    bl_label = "Advanced"
    bl_parent_id = "SVO_PT_sampling"
    bl_options = CLOSED

    def draw(self, context: bpy.types.Context) -> None:
        self.column().prop(context.scene.svo, "seed")


CLASSES = (SVO_PT_sampling, SVO_PT_sampling_viewport, SVO_PT_sampling_viewport_denoise, SVO_PT_sampling_render,
           SVO_PT_sampling_render_denoise, SVO_PT_sampling_advanced)
