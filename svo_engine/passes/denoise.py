# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuFilm -> picture: the mean of the samples, its light filtered as far as it is noisy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from ..film import Film
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from .planes import read_pass
from .raster import GBuffer
from .resolve import GpuFilm

PREPARE = Pass(("denoise/prepare.comp.glsl",), textures=("u_film", "u_tiles"), images=("u_light",),
               uniforms=("u_size", "u_n_samples"))
ATROUS = Pass(("denoise/atrous.comp.glsl",), textures=("u_film", "u_tiles", "u_light_in"), images=("u_light",),
              uniforms=("u_ray_origin", "u_ray_direction", "u_size", "u_step", "u_sigmas", "u_n_samples"))
COMPOSE = Pass(("denoise/compose.comp.glsl",), textures=("u_film", "u_tiles", "u_light"), images=("u_picture",),
               uniforms=("u_size", "u_n_samples"))

STEPS = (1, 2, 4, 8)  # pixels between the taps of each pass
SIGMAS = 8.0  # with one sample, differences of so many standard deviations are noise; with n, 1 / sqrt(n) of that


@dataclass(frozen=True)
class Light:
    """A plane of the film to be filtered without the albedo in plane `color`; `scale` times that light is its unit."""

    plane: str
    color: str
    scale: float = 1.0


LIGHTS = (Light("DIFFUSE_DIRECT", "DIFFUSE_COLOR", pi), Light("DIFFUSE_INDIRECT", "DIFFUSE_COLOR", pi),
          Light("GLOSSY_DIRECT", "GLOSSY_COLOR"), Light("GLOSSY_INDIRECT", "GLOSSY_COLOR"))


@dataclass(frozen=True, eq=False)
class Pictures:
    """Working textures f4: the picture, and two to filter from and into. staging: a buffer on the way to the host."""

    scope: GpuScope
    picture: Any
    light: Any
    spare: Any
    staging: Any


def make_pictures(device: Device, size: tuple[int, int]) -> Pictures:
    """Textures for pictures of `size` pixels."""
    scope = device.scope()
    picture, light, spare = (scope.texture(name, size, 4, "f4") for name in ("picture", "light", "spare"))
    return Pictures(scope, picture, light, spare, scope.staging("staging", 16 * size[0] * size[1]))


def read_picture(device: Device, film: GpuFilm, pictures: Pictures, is_filtered: bool,
                 passes: Sequence[str] = ()) -> Film:
    """The mean of the samples in `film` and the render passes `passes`, which are never filtered, on the host."""
    assert film.gbuffer is not None, "a film without a sample"
    n = film.gbuffer.n_invocations
    common = {"u_film": film.sums, "u_tiles": film.tiles, "u_size": film.size, "u_n_samples": float(film.n_samples)}
    device.dispatch(COMPOSE, n, film.constants(), **common, u_light=pictures.light, u_picture=pictures.picture)
    for light in LIGHTS if is_filtered else ():
        if film.layer(light.plane) < 0:
            continue
        filtered = _filtered(device, film, film.gbuffer, pictures, light, common)
        device.dispatch(COMPOSE, n, _constants(film, light), **common, u_light=filtered, u_picture=pictures.picture)
    with device.profiler.host("read back"):
        width, height = film.size
        pixels = np.empty((height, width, 4), "f4")
        pictures.picture.read_into(pictures.staging)
        pictures.staging.read_into(pixels)
    return Film({"Combined": pixels, **{name: read_pass(device, film, name, pictures.spare) for name in passes}},
                film.n_samples)


def _constants(film: GpuFilm, light: Light) -> dict[str, int | float]:
    return {"PLANE": film.layer(light.plane), "COLOR": film.layer(light.color), "SCALE": light.scale,
            **film.constants()}


def _filtered(device: Device, film: GpuFilm, gbuffer: GBuffer, pictures: Pictures, light: Light,
              common: Mapping[str, Any]) -> Any:
    """The texture that holds the filtered light."""
    n, here, there = gbuffer.n_invocations, pictures.light, pictures.spare
    device.dispatch(PREPARE, n, _constants(film, light), **common, u_light=here)
    constants = {"IS_GLOSSY": light.color == "GLOSSY_COLOR", **film.constants()}
    for step in STEPS:
        device.dispatch(ATROUS, n, constants, **{**gbuffer.camera(), **common}, u_light_in=here, u_light=there,
                        u_step=step, u_sigmas=SIGMAS)
        here, there = there, here
    return here
