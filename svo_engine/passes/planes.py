# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuFilm -> Blender's render passes: unfiltered means of the planes that were asked for, as Cycles defines them.

Combined is the sum over diffuse, glossy and transmission of (direct + indirect) x colour, emission and environment.
Depth and position are those of the first sample; all else is the mean over the samples, in which what no surface
covers counts as 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.texture import Texture
from ..needs import Needs
from ..settings import PASSES, RenderSettings
from .adaptive import is_adaptive
from .resolve import PLANES, GpuFilm

MEAN = Pass("planes/mean.comp.glsl")

DEPTH_OF_NOTHING = 1e10  # as in Cycles

_GUIDES = ("ALBEDO", "NORMAL_DEPTH")
_LIGHT = ("DIFFUSE_COLOR", "NORMAL_DEPTH", "DIFFUSE_DIRECT", "DIFFUSE_INDIRECT")
_GLOSSY_LIGHT = ("GLOSSY_DIRECT", "GLOSSY_INDIRECT", "GLOSSY_COLOR")


@dataclass(frozen=True)
class Source:
    """Of a render pass. plus, minus: planes; divisor: a plane, or "" for the number of samples."""

    plus: tuple[str, ...]
    minus: tuple[str, ...] = ()
    divisor: str = ""

    @property
    def planes(self) -> frozenset[str]:
        """All that it needs."""
        return frozenset((*self.plus, *self.minus, self.divisor)) - {""}

SOURCES = {
    "Depth": Source(("POSITION",)),
    "Position": Source(("POSITION",)),
    "Normal": Source(("NORMAL_DEPTH",)),
    "Diffuse Direct": Source(("DIFFUSE_DIRECT", "DIFFUSE_FOUND"), (), "DIFFUSE_COLOR"),
    "Diffuse Indirect": Source(("DIFFUSE_INDIRECT",), ("DIFFUSE_FOUND",), "DIFFUSE_COLOR"),
    "Diffuse Color": Source(("DIFFUSE_COLOR",)),
    "Glossy Direct": Source(("GLOSSY_DIRECT",), (), "GLOSSY_COLOR"),
    "Glossy Indirect": Source(("GLOSSY_INDIRECT",), (), "GLOSSY_COLOR"),
    "Glossy Color": Source(("GLOSSY_COLOR",)),
    "Transmission Direct": Source(("TRANSMISSION_DIRECT",), (), "TRANSMISSION_COLOR"),
    "Transmission Indirect": Source(("TRANSMISSION_INDIRECT",), (), "TRANSMISSION_COLOR"),
    "Transmission Color": Source(("TRANSMISSION_COLOR",)),
    "Emission": Source(("EMISSION",)),
    "Environment": Source(("ENVIRONMENT",)),
    "Noisy Image": Source(("COMBINED",)),
    "Denoising Normal": Source(("NORMAL_DEPTH",)),
    "Denoising Albedo": Source(("ALBEDO",)),
    "Denoising Depth": Source(("NORMAL_DEPTH",)),
}


def planes_for(needs: Needs, settings: RenderSettings, denoiser: str) -> tuple[str, ...]:
    """The planes that the picture and the asked passes are made of, and those that the denoiser of that name needs."""
    wanted = {"COMBINED"}.union(*(SOURCES[name].planes for name in settings.passes))
    if is_adaptive(settings):
        wanted.add("HALF")
    if denoiser == "openimagedenoise":
        wanted.update(_GUIDES)
    elif denoiser:
        wanted.update(_LIGHT, _GLOSSY_LIGHT if needs.gloss else ())
    return tuple(plane for plane in PLANES if plane in wanted)


def mean(device: Device, film: GpuFilm, name: str, texture: Texture) -> None:
    """Make the render pass `name` in `texture`, RGBA f4 of the film's size."""
    source = SOURCES[name]
    plus, minus = (sum(1 << film.layer(plane) for plane in planes) for planes in (source.plus, source.minus))
    device.dispatch(MEAN, film.n_invocations, **film.layers(), u_film=film.sums, u_tiles=film.tiles,
                    u_mean=texture, u_size=film.size, u_plus=plus, u_minus=minus,
                    u_divisor=film.layer(source.divisor), u_n_samples=float(film.n_samples))


def read_pixels(device: Device, texture: Texture, staging: Buffer) -> np.ndarray:
    """What is in a texture RGBA f4, (height, width, 4) f4, by way of a buffer of its size."""
    width, height = texture.size
    pixels = np.empty((height, width, 4), "f4")
    with device.profiler.host("read back"):
        texture.copy_to(staging)
        staging.read_into(pixels)
    return pixels


def read_pass(device: Device, film: GpuFilm, name: str, texture: Texture, staging: Buffer) -> np.ndarray:
    """The render pass `name`, (height, width, channels) f4; `texture` and `staging` are overwritten."""
    mean(device, film, name, texture)
    pixels, finish = read_pixels(device, texture, staging), _FINISH.get(name)
    return (finish(film, pixels) if finish else pixels[..., :len(PASSES[name])]).astype("f4")


def _camera(film: GpuFilm) -> np.ndarray:
    """Rows x, y, z of Cycles' camera space, whose z points away from the eye."""
    return film.view.world_from_view[:3, :3].T * [[1], [1], [-1]]


def _position(film: GpuFilm, first: np.ndarray) -> np.ndarray:
    """World space; 0 where there is nothing. Only the first sample gave anything, so that alpha is 1 / n."""
    return (first[..., :3] / np.maximum(first[..., 3:], 1e-30) + film.centre) * (first[..., 3:] > 0)


def _depth(film: GpuFilm, first: np.ndarray) -> np.ndarray:
    """Along the camera's axis, metres from the camera."""
    depth = (_position(film, first) - film.view.world_from_view[:3, 3]) @ _camera(film)[2]
    return np.where(first[..., 3] > 0, depth, DEPTH_OF_NOTHING)[..., None]


def _denoising_normal(film: GpuFilm, mean: np.ndarray) -> np.ndarray:
    return mean[..., :3] @ _camera(film).T


def _denoising_depth(_film: GpuFilm, mean: np.ndarray) -> np.ndarray:
    """Metres from the eye."""
    return mean[..., 3:]


_FINISH: dict[str, Callable[[GpuFilm, np.ndarray], np.ndarray]] = {
    "Position": _position, "Depth": _depth, "Denoising Normal": _denoising_normal,
    "Denoising Depth": _denoising_depth}
