# SPDX-License-Identifier: GPL-3.0-or-later
"""Which filter a picture gets, and what that needs on the device."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import GpuError
from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.oidn import IMAGES, Oidn, OidnDevice
from ...gpu.scope import GpuScope
from ...gpu.texture import Texture
from ...settings import RenderSettings


@dataclass(frozen=True, eq=False)
class Denoiser:
    """Textures f4 of a picture's size: the picture, and two to filter from and into; what filters them.

    staging  a buffer on the way to the host
    images   buffers for what `oidn` reads and writes
    name     "openimagedenoise", "atrous", or "" where nothing is filtered
    limits   a sentence if that is not what was asked for
    """

    scope: GpuScope
    picture: Texture
    pair: tuple[Texture, Texture]
    staging: Buffer
    images: tuple[Buffer, ...]
    name: str
    oidn: Oidn | None
    limits: tuple[str, ...]


def wanted(settings: RenderSettings) -> str:
    """The denoiser that the settings ask for; "": none."""
    return settings.denoiser if settings.denoise and settings.view == "combined" else ""


def make_denoiser(device: Device, size: tuple[int, int], asked: str, quality: str = "high",
                  is_clean: bool = True) -> Denoiser:
    """For pictures of `size` pixels. is_clean: whether their normals and albedo have no noise of their own."""
    scope = device.scope()
    picture, *pair = (scope.texture(name, size, 4, "f4") for name in ("picture", "light", "spare"))
    staging = scope.pixels("staging", size, for_host=True)
    oidn, images, limits = None, tuple[Buffer, ...](), list[str]()
    try:
        if runs_on := _runs_on(device, asked):
            images = tuple(scope.pixels(label, size) for label in IMAGES)
            oidn = Oidn(runs_on, images, size, quality, is_clean)
            scope.adopt(oidn)
    except GpuError as error:
        limits += [f"The picture was filtered by the a-trous wavelet: {error}"] * (asked != "automatic")
    name = "openimagedenoise" if oidn else "atrous" if asked else ""
    return Denoiser(scope, picture, (pair[0], pair[1]), staging, images, name, oidn, tuple(limits))


def _runs_on(device: Device, asked: str) -> OidnDevice | None:
    """Where Open Image Denoise is to run; if the choice is free, only where pictures need not go elsewhere for it."""
    is_software = device.profiler.is_software
    if asked == "openimagedenoise":
        return device.denoising
    if asked == "automatic" and (is_software or (device.cuda and device.denoising.cuda)):
        return device.denoising
    return None
