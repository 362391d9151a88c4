# SPDX-License-Identifier: GPL-3.0-or-later
"""Points, Arrivals and Gloss -> Film: the light that leaves towards the eye, summed over the samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..gpu.texture import Layers, Texture
from ..scene.types import View
from .parts import EYE, Part, Parts
from .raster import Eye
from .upload import GpuScene

ACCUMULATE = Pass("resolve/accumulate.comp.glsl")

# What bind/film.glsl knows, in the order of layers
PLANES = ("COMBINED", "DIFFUSE_DIRECT", "DIFFUSE_INDIRECT", "DIFFUSE_FOUND", "DIFFUSE_COLOR", "GLOSSY_DIRECT",
          "GLOSSY_INDIRECT", "GLOSSY_COLOR", "TRANSMISSION_DIRECT", "TRANSMISSION_INDIRECT", "TRANSMISSION_COLOR",
          "EMISSION", "ENVIRONMENT", "ALBEDO", "NORMAL_DEPTH", "HALF", "POSITION")


TILE = 8  # pixels a side: a workgroup of the passes over pixels


@dataclass(eq=False)
class GpuFilm:
    """The running sums on the device.

    planes     those of PLANES that were asked for: a layer of `sums` each
    centre     (3,) f8, metres: what positions are relative to
    tiles      texture u4: the samples with which a tile of 8 by 8 pixels was done, 0 while it is not
    n_samples  so far
    eye        of the latest sample
    """

    view: View
    planes: tuple[str, ...]
    sums: Layers
    centre: np.ndarray
    tiles: Texture
    n_samples: int = 0
    eye: Eye | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.view.size

    @property
    def n_invocations(self) -> int:
        """Invocations of a pass over all pixels in tiles of 8 by 8."""
        return self.tiles.size[0] * self.tiles.size[1] * TILE * TILE

    def layer(self, plane: str) -> int:
        """Where a plane is; -1: nowhere."""
        return self.planes.index(plane) if plane in self.planes else -1

    def layers(self) -> dict[str, tuple[int, ...]]:
        """The uniform of bind/film.glsl."""
        return {"u_planes": tuple(self.layer(plane) for plane in PLANES)}


def make_film(scope: GpuScope, view: View, planes: tuple[str, ...], centre: np.ndarray,
              is_black: bool = True) -> GpuFilm:
    """A film in `scope` for what `view` sees; it need not be black where `resolve` sets it with the first sample."""
    tiles = -(-view.size[0] // TILE), -(-view.size[1] // TILE)
    none_done = scope.texture("tiles", tiles, 1, "u4", np.zeros(tiles[0] * tiles[1], "u4"))
    return GpuFilm(view, planes, scope.layers("film", view.size, len(planes), is_black=is_black), centre, none_done)


def resolve(device: Device, gpu_scene: GpuScene, eye: Eye, parts: Parts, part: Part, film: GpuFilm) -> None:
    """Add one part of a sample to `film`."""
    device.dispatch(ACCUMULATE, part.n, **gpu_scene.world(), **gpu_scene.sky.for_camera(), **eye.pixels(part),
                    **parts.of(part, EYE),
                    **film.layers(), u_gloss=parts.planes["gloss"], u_film=film.sums, u_n_planes=len(film.planes),
                    u_film_transparent=gpu_scene.scene.film_transparent, u_sample=film.n_samples,
                    u_has_lobes=gpu_scene.needs.gloss)
