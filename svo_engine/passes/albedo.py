# SPDX-License-Identifier: GPL-3.0-or-later
"""Directional albedos of microfacet surfaces: a table for every scene. See shaders/bind/albedo.glsl."""

from __future__ import annotations

from dataclasses import dataclass

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..gpu.texture import Layers

N, LAYERS = 32, 26

INTEGRATE = Pass("albedo/integrate.comp.glsl")


@dataclass(frozen=True, eq=False)
class Albedo:
    """table: LAYERS pictures of N by N RGBA f4; one texel for scenes where nothing reflects."""

    scope: GpuScope
    table: Layers


def albedo(device: Device, is_needed: bool) -> Albedo:
    """The table, integrated on the device."""
    scope = device.scope()
    table = scope.layers("albedo", (N, N) if is_needed else (1, 1), LAYERS if is_needed else 1, is_smooth=True)
    if is_needed:
        device.dispatch(INTEGRATE, LAYERS * N * N, u_table=table, u_albedo=None)  # which it does not read
    return Albedo(scope, table)
