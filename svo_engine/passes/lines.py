# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines, as the thesis's cartoon shading has them: drawn in each sample, so as smooth as all edges are."""

from __future__ import annotations

from math import cos

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..settings import Lines
from .parts import EYE, Part, Parts
from .raster import Eye
from .tracer import Tracer

DRAW = Pass("lines/draw.comp.glsl")

NO_EDGE = -2.0  # a cosine that no angle has


def draw_lines(device: Device, eye: Eye, tracer: Tracer, parts: Parts, part: Part, lines: Lines) -> None:
    """Turn the points on outlines into the lines' colour. Each takes four rays of the camera."""
    device.dispatch(
        DRAW, part.n, tracer.constants(), **{**tracer.resources(), "u_sees_trees": True}, **eye.pixels(part),
        **parts.of(part, EYE), Positions=tracer.placing.geometry["Positions"], u_tiles=eye.tiles, u_sample=eye.sample,
        u_n_samples=0, u_seed=0, u_depth=eye.rays[2], u_reach=lines.thickness / 2, u_color=lines.color,
        u_crease=cos(lines.crease_angle) if lines.creases else NO_EDGE, u_silhouettes=lines.silhouettes,
        u_materials=lines.materials, u_objects=lines.objects)
