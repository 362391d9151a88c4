# SPDX-License-Identifier: GPL-3.0-or-later
"""Voxels -> Film: the voxels themselves, one of their attributes at any mip level."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from .gather import CAMERA
from .raster import GBuffer
from .resolve import GpuFilm
from .voxelize import GRID, Grid, Voxels

ATTRIBUTE = Pass(("debug/attribute.comp.glsl",), ("Voxels",), images=("u_attribute",))
VOXELS = Pass(("debug/voxels.comp.glsl",), textures=("u_attribute",), images=("u_film",),
              uniforms=(*CAMERA, *GRID, "u_lod"))
ATTRIBUTES = ("voxel_albedo", "voxel_normal", "voxel_coverage")  # numbers as in debug/attribute.comp.glsl


@dataclass(frozen=True, eq=False)
class Attribute:
    """values: 3D texture f2, rgb value times opacity, a opacity, all mip levels."""

    scope: GpuScope
    values: Any


def make_attribute(device: Device, voxels: Voxels, view: str) -> Attribute:
    """The attribute that the debug view named `view` shows."""
    scope = device.scope()
    values = scope.texture3d(view, voxels.grid.n, 4, "f2")
    device.dispatch(ATTRIBUTE, voxels.n_voxels, {"ATTRIBUTE": ATTRIBUTES.index(view)}, Voxels=voxels.voxels,
                    u_attribute=values)
    values.build_mipmaps()
    return Attribute(scope, values)


def show_voxels(device: Device, grid: Grid, values: Any, gbuffer: GBuffer, lod: int, film: GpuFilm) -> None:
    """Add one sample to `film`: the first filled texel of mip level `lod` along each pixel's ray."""
    lod = min(lod, grid.n.bit_length() - 1)
    device.dispatch(VOXELS, gbuffer.n_invocations, u_attribute=values, u_film=film.combined, **gbuffer.camera(),
                    **grid.uniforms(), u_lod=lod)
    film.n_samples += 1
