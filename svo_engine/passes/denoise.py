# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuFilm -> picture: the mean of the samples, its diffuse light filtered as far as it is noisy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..film import Film
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene import layouts
from .raster import GBuffer
from .resolve import GpuFilm

PREPARE = Pass(("denoise/prepare.comp.glsl",), textures=("u_film",), images=("u_light",),
               uniforms=("u_size", "u_n_samples"))
ATROUS = Pass(("denoise/atrous.comp.glsl",), textures=("u_film", "u_light_in"), images=("u_light",),
              uniforms=("u_ray_origin", "u_ray_direction", "u_size", "u_step", "u_sigmas"))
COMPOSE = Pass(("denoise/compose.comp.glsl",), textures=("u_film", "u_direct", "u_indirect"), images=("u_picture",),
               uniforms=("u_size", "u_n_samples"))

STEPS = (1, 2, 4, 8)  # pixels between the taps of each pass
SIGMAS = 8.0  # with one sample, differences of so many standard deviations are noise; with n, 1 / sqrt(n) of that


@dataclass(frozen=True, eq=False)
class Pictures:
    """Working textures f4: the picture, two kinds of filtered light, and one to filter into."""

    scope: GpuScope
    picture: Any
    direct: Any
    indirect: Any
    spare: Any


def make_pictures(device: Device, size: tuple[int, int]) -> Pictures:
    """Textures for pictures of `size` pixels."""
    scope = device.scope()
    return Pictures(scope, *(scope.texture(name, size, 4, "f4") for name in ("picture", "direct", "indirect", "spare")))


def read_picture(device: Device, film: GpuFilm, pictures: Pictures, is_filtered: bool) -> Film:
    """The mean of the samples in `film`, on the host."""
    assert film.gbuffer is not None, "a film without a sample"
    _compose(device, film, film.gbuffer, pictures, is_filtered)
    with device.profiler.host("read back"):
        width, height = film.size
        pixels = np.frombuffer(pictures.picture.read(alignment=1), "f4").reshape(height, width, 4)
    return Film({"Combined": pixels}, film.n_samples)


def _compose(device: Device, film: GpuFilm, gbuffer: GBuffer, pictures: Pictures, is_filtered: bool) -> None:
    """Fill `pictures.picture`."""
    common = {"u_film": film.sums, "u_size": film.size, "u_n_samples": float(film.n_samples)}
    direct, indirect = pictures.direct, pictures.indirect
    if is_filtered:
        direct = _filtered(device, film, gbuffer, "DIFFUSE_DIRECT", direct, pictures.spare)
        spare = pictures.spare if direct is pictures.direct else pictures.direct
        indirect = _filtered(device, film, gbuffer, "DIFFUSE_INDIRECT", indirect, spare)
    device.dispatch(COMPOSE, gbuffer.n_invocations, {"IS_FILTERED": is_filtered}, **common, u_direct=direct,
                    u_indirect=indirect, u_picture=pictures.picture)


def _filtered(device: Device, film: GpuFilm, gbuffer: GBuffer, plane: str, light: Any, spare: Any) -> Any:
    """The filtered irradiance of one plane, in `light` or in `spare`."""
    n = gbuffer.n_invocations
    device.dispatch(PREPARE, n, {"PLANE": layouts.CONSTANTS[f"PLANE_{plane}"]}, u_film=film.sums, u_light=light,
                    u_size=film.size, u_n_samples=float(film.n_samples))
    for step in STEPS:
        device.dispatch(ATROUS, n, u_film=film.sums, u_light_in=light, u_light=spare, **gbuffer.camera(), u_step=step,
                        u_sigmas=SIGMAS / film.n_samples**0.5)
        light, spare = spare, light
    return light
