# SPDX-License-Identifier: GPL-3.0-or-later
"""Incident -> Film: the light that leaves towards the eye, summed over the samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene import layouts
from .cache import WORLD, LightCache
from .gather import CAMERA, PLANES, Incident
from .raster import GBuffer
from .upload import GpuScene
from .voxelize import GEOMETRY, MATERIALS

ACCUMULATE = Pass(("resolve/accumulate.comp.glsl",), (*GEOMETRY, *MATERIALS),
                  textures=("u_visibility", "u_env", *PLANES), images=("u_film",),
                  uniforms=(*CAMERA, *WORLD, "u_film_transparent"))


@dataclass(eq=False)
class GpuFilm:
    """The running sums on the device: a layer for each of layouts.FILM_PLANES.

    gbuffer  of the latest sample
    is_last  whether the frame ends with this one
    limits   a sentence for each setting that the device was too small for
    cache    the light that its rays found, if there were rays
    """

    scope: GpuScope
    size: tuple[int, int]
    sums: Any
    n_samples: int = 0
    is_last: bool = False
    gbuffer: GBuffer | None = None
    limits: list[str] = field(default_factory=list)
    cache: LightCache | None = None


def make_film(device: Device, size: tuple[int, int]) -> GpuFilm:
    """An empty film of `size` pixels."""
    scope = device.scope()
    return GpuFilm(scope, size, scope.layers("film", size, len(layouts.FILM_PLANES)))


def resolve(device: Device, gpu_scene: GpuScene, gbuffer: GBuffer, incident: Incident, film: GpuFilm) -> None:
    """Add one sample to `film`."""
    constants = {"HAS_TEXTURES": gpu_scene.has_textures, "HAS_SPECULAR": gpu_scene.has_specular}
    device.dispatch(ACCUMULATE, gbuffer.n_invocations, constants, **gpu_scene.geometry, **gpu_scene.materials,
                    **gpu_scene.world(), **gbuffer.uniforms(), **incident.planes, u_film=film.sums,
                    u_film_transparent=gpu_scene.scene.film_transparent)
    film.n_samples += 1
