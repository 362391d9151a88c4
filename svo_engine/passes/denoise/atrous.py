# SPDX-License-Identifier: GPL-3.0-or-later
"""The edge-avoiding a-trous wavelet [Dammertz10], guided by variance [Schied17]: light is smoothed as it is noisy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Any

from ...gpu.device import Device
from ...gpu.passes import Pass
from ..raster import GBuffer
from ..resolve import GpuFilm

PREPARE = Pass(("denoise/prepare.comp.glsl",), textures=("u_film", "u_tiles"), images=("u_light",),
               uniforms=("u_size", "u_n_samples"))
ATROUS = Pass(("denoise/atrous.comp.glsl",), textures=("u_film", "u_tiles", "u_light_in"), images=("u_light",),
              uniforms=("u_ray_origin", "u_ray_direction", "u_size", "u_step", "u_sigmas", "u_n_samples"))

STEPS = (1, 2, 4, 8)  # pixels between the taps of each pass
SIGMAS = 8.0  # with one sample, differences of so many standard deviations are noise; with n, 1 / sqrt(n) of that


@dataclass(frozen=True)
class Light:
    """A plane of the film to be filtered without the albedo in plane `color`; `scale` times that light is its unit."""

    plane: str
    color: str
    scale: float = 1.0

    def constants(self, film: GpuFilm) -> dict[str, int | float]:
        """The constants of its shaders."""
        return {"PLANE": film.layer(self.plane), "COLOR": film.layer(self.color), "SCALE": self.scale,
                **film.constants()}


LIGHTS = (Light("DIFFUSE_DIRECT", "DIFFUSE_COLOR", pi), Light("DIFFUSE_INDIRECT", "DIFFUSE_COLOR", pi),
          Light("GLOSSY_DIRECT", "GLOSSY_COLOR"), Light("GLOSSY_INDIRECT", "GLOSSY_COLOR"))


def smoothed(device: Device, film: GpuFilm, gbuffer: GBuffer, light: Light, pair: tuple[Any, Any],
             common: Mapping[str, Any]) -> Any:
    """The one of two textures RGBA f4 that holds the filtered light in the end."""
    n, (here, there) = gbuffer.n_invocations, pair
    device.dispatch(PREPARE, n, light.constants(film), **common, u_light=here)
    constants = {"IS_GLOSSY": light.color == "GLOSSY_COLOR", **film.constants()}
    for step in STEPS:
        device.dispatch(ATROUS, n, constants, **{**gbuffer.camera(), **common}, u_light_in=here, u_light=there,
                        u_step=step, u_sigmas=SIGMAS)
        here, there = there, here
    return here
