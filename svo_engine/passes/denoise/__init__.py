# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuFilm -> picture: the mean of the samples, filtered by Open Image Denoise or by a wavelet on the device."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...errors import GpuError
from ...film import Film
from ...gpu.device import Device
from ...gpu.oidn import Oidn
from ...gpu.passes import Pass
from ...gpu.program import Resources
from ..planes import mean, read_pass, read_pixels
from ..resolve import GpuFilm
from .atrous import LIGHTS, smoothed
from .choice import Denoiser

COMPOSE = Pass("denoise/compose.comp.glsl")


def read_picture(device: Device, film: GpuFilm, denoiser: Denoiser, limits: list[str],
                 passes: Sequence[str] = ()) -> Film:
    """The mean of the samples in `film` and the render passes `passes`, which are never filtered, on the host.

    limits  gets a sentence if the denoiser fails
    """
    n, picture = film.n_invocations, denoiser.picture
    none = {"u_plane": -1, "u_color": -1, "u_scale": 1.0}
    common: Resources = {**film.layers(), "u_film": film.sums, "u_tiles": film.tiles, "u_size": film.size,
                         "u_n_samples": float(film.n_samples)}
    device.dispatch(COMPOSE, n, **common, **none, u_light=denoiser.pair[0], u_picture=picture)
    for light in LIGHTS if denoiser.name == "atrous" else ():
        if film.layer(light.plane) >= 0:
            filtered = smoothed(device, film, light, denoiser.pair, common)
            device.dispatch(COMPOSE, n, **light.uniforms(film), **common, u_light=filtered, u_picture=picture)
    pixels = _by_network(device, film, denoiser, denoiser.oidn, limits) if denoiser.oidn else None
    if pixels is None:
        pixels = read_pixels(device, picture, denoiser.staging)
    return Film({"Combined": pixels, **{name: read_pass(device, film, name, denoiser.pair[0], denoiser.staging)
                                        for name in passes}}, film.n_samples)


def _by_network(device: Device, film: GpuFilm, denoiser: Denoiser, oidn: Oidn,
                limits: list[str]) -> np.ndarray | None:
    """The filtered picture; None if the library fails, which `limits` tells."""
    mean(device, film, "Denoising Albedo", denoiser.pair[0])
    mean(device, film, "Normal", denoiser.pair[1])
    for texture, buffer in zip((denoiser.picture, *denoiser.pair), denoiser.images, strict=True):
        texture.copy_to(buffer)
    width, height = film.size
    pixels = np.empty((height, width, 4), "f4")
    try:
        with device.profiler.host("denoise"):
            oidn.run(pixels, denoiser.staging)
    except GpuError as error:
        if (sentence := f"The picture was not filtered: {error}") not in limits:
            limits.append(sentence)
        return None
    return pixels
