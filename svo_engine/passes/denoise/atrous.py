# SPDX-License-Identifier: GPL-3.0-or-later
"""The edge-avoiding a-trous wavelet [Dammertz10], guided by variance [Schied17]: light is smoothed as it is noisy."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from ...gpu.device import Device
from ...gpu.passes import Pass
from ...gpu.program import Resources
from ...gpu.texture import Texture
from ..resolve import GpuFilm

PREPARE = Pass("denoise/prepare.comp.glsl")
ATROUS = Pass("denoise/atrous.comp.glsl")

STEPS = (1, 2, 4, 8)  # pixels between the taps of each pass
SIGMAS = 8.0  # with one sample, differences of so many standard deviations are noise; with n, 1 / sqrt(n) of that


@dataclass(frozen=True)
class Light:
    """A plane of the film to be filtered without the albedo in plane `color`; `scale` times that light is its unit."""

    plane: str
    color: str
    scale: float = 1.0

    def uniforms(self, film: GpuFilm) -> dict[str, int | float]:
        """Those of denoise/prepare and denoise/compose."""
        return {"u_plane": film.layer(self.plane), "u_color": film.layer(self.color), "u_scale": self.scale}

LIGHTS = (Light("DIFFUSE_DIRECT", "DIFFUSE_COLOR", pi), Light("DIFFUSE_INDIRECT", "DIFFUSE_COLOR", pi),
          Light("GLOSSY_DIRECT", "GLOSSY_COLOR"), Light("GLOSSY_INDIRECT", "GLOSSY_COLOR"))


def smoothed(device: Device, film: GpuFilm, light: Light, pair: tuple[Texture, Texture],
             common: Resources) -> Texture:
    """The one of two textures RGBA f4 that holds the filtered light in the end."""
    assert film.eye is not None, "a film without a sample"
    n, (here, there) = film.n_invocations, pair
    device.dispatch(PREPARE, n, **light.uniforms(film), **common, u_light=here)
    for step in STEPS:
        device.dispatch(ATROUS, n, **{**film.eye.camera(), **common}, u_light_in=here, u_light=there,
                        u_step=step, u_sigmas=SIGMAS,
                        u_is_glossy=light.color == "GLOSSY_COLOR")
        here, there = there, here
    return here
