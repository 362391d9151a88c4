# SPDX-License-Identifier: GPL-3.0-or-later
"""Incident -> Film: the light that leaves towards the eye, summed over the samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..film import Film
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from .gather import CAMERA, PLANES, WORLD, Incident
from .raster import GBuffer
from .upload import GpuScene
from .voxelize import GEOMETRY, MATERIALS

ACCUMULATE = Pass(("resolve/accumulate.comp.glsl",), (*GEOMETRY, *MATERIALS),
                  textures=("u_visibility", "u_env", *PLANES), images=("u_film",),
                  uniforms=(*CAMERA, *WORLD, "u_film_transparent"))


@dataclass(eq=False)
class GpuFilm:
    """The running sums on the device: texture f4, premultiplied RGBA; `n_samples` of them are in it.

    is_last  whether the frame ends with this one
    """

    scope: GpuScope
    combined: Any
    n_samples: int = 0
    is_last: bool = False

    def read(self, device: Device) -> Film:
        """The mean so far, on the host."""
        with device.profiler.host("read back"):
            width, height = self.combined.size
            sums = np.frombuffer(self.combined.read(alignment=1), "f4").reshape(height, width, 4)
            return Film({"Combined": sums / np.float32(max(self.n_samples, 1))}, self.n_samples)


def make_film(device: Device, size: tuple[int, int]) -> GpuFilm:
    """An empty film of `size` pixels."""
    scope = device.scope()
    zeros = np.zeros((size[1], size[0], 4), "f4")
    return GpuFilm(scope, scope.texture("film", size, 4, "f4", zeros))


def resolve(device: Device, gpu_scene: GpuScene, gbuffer: GBuffer, incident: Incident, film: GpuFilm) -> None:
    """Add one sample to `film`."""
    constants = {"HAS_TEXTURES": gpu_scene.has_textures, "HAS_SPECULAR": gpu_scene.has_specular}
    device.dispatch(ACCUMULATE, gbuffer.n_invocations, constants, **gpu_scene.geometry, **gpu_scene.materials,
                    **gpu_scene.world(), **gbuffer.uniforms(), **incident.planes, u_film=film.combined,
                    u_film_transparent=gpu_scene.scene.film_transparent)
    film.n_samples += 1
