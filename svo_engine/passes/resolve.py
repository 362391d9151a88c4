# SPDX-License-Identifier: GPL-3.0-or-later
"""Incident -> Film: the light that leaves towards the eye, summed over the samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene.types import View
from .adaptive import Progress
from .cache import WORLD, LightCache
from .gather import CAMERA, Incident
from .raster import GBuffer
from .upload import GpuScene
from .voxelize import GEOMETRY, MATERIALS

if TYPE_CHECKING:
    from .denoise.choice import Denoiser

ACCUMULATE = Pass(("resolve/accumulate.comp.glsl",), (*GEOMETRY, *MATERIALS),
                  textures=("u_visibility", "u_tiles", "u_env", "u_albedo"), images=("u_film", "u_incident"),
                  uniforms=(*CAMERA, *WORLD, "u_film_transparent", "u_sample"))

# What bind/film.glsl knows, in the order of layers
PLANES = ("COMBINED", "DIFFUSE_DIRECT", "DIFFUSE_INDIRECT", "DIFFUSE_FOUND", "DIFFUSE_COLOR", "GLOSSY_DIRECT",
          "GLOSSY_INDIRECT", "GLOSSY_COLOR", "TRANSMISSION_DIRECT", "TRANSMISSION_INDIRECT", "TRANSMISSION_COLOR",
          "EMISSION", "ENVIRONMENT", "ALBEDO", "NORMAL_DEPTH", "HALF", "POSITION")


@dataclass(eq=False)
class GpuFilm:
    """The running sums on the device.

    planes   those of PLANES that were asked for: a layer of `sums` each
    centre   (3,) f8, metres: what positions are relative to
    progress which tiles are done, if any can be before the last sample
    gbuffer  of the latest sample
    is_last  whether the frame ends with this one
    limits   a sentence for each setting that the device was too small for
    cache    the light that its rays found, if there were rays
    denoiser what makes a picture of it, if one is wanted
    """

    view: View
    planes: tuple[str, ...]
    sums: Any
    centre: np.ndarray
    progress: Progress | None = None
    n_samples: int = 0
    is_last: bool = False
    gbuffer: GBuffer | None = None
    limits: list[str] = field(default_factory=list)
    cache: LightCache | None = None
    denoiser: Denoiser | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.view.size

    def layer(self, plane: str) -> int:
        """Where a plane is; -1: nowhere."""
        return self.planes.index(plane) if plane in self.planes else -1

    def constants(self) -> dict[str, int]:
        """The constants of bind/film.glsl and bind/tiles.glsl."""
        return {**{f"PLANE_{plane}": self.layer(plane) for plane in PLANES}, "N_PLANES": len(self.planes),
                "IS_ADAPTIVE": self.progress is not None}

    @property
    def tiles(self) -> Any:
        """The texture of bind/tiles.glsl; None: there is no such thing."""
        return self.progress and self.progress.tiles


def make_film(scope: GpuScope, view: View, planes: tuple[str, ...], centre: np.ndarray,
              progress: Progress | None = None, is_black: bool = True) -> GpuFilm:
    """A film in `scope` for what `view` sees; it need not be black where `resolve` sets it with the first sample."""
    sums = scope.layers("film", view.size, len(planes), is_black=is_black)
    return GpuFilm(view, planes, sums, centre, progress)


def resolve(device: Device, gpu_scene: GpuScene, gbuffer: GBuffer, incident: Incident, film: GpuFilm) -> None:
    """Add one sample to `film`."""
    constants = {**gpu_scene.surface_constants(), **film.constants(), **incident.constants()}
    device.dispatch(ACCUMULATE, gbuffer.n_invocations, constants, **gpu_scene.geometry, **gpu_scene.materials,
                    **gpu_scene.world(), **gbuffer.uniforms(), u_tiles=gbuffer.tiles, u_film=film.sums,
                    u_incident=incident.layers, u_albedo=gpu_scene.albedo,
                    u_film_transparent=gpu_scene.scene.film_transparent, u_sample=film.n_samples)
    film.n_samples += 1
