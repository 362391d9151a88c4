# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures after each stage: which settings show it, and what of a frame's times belongs to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from svo_engine.film import Film


def combined(film: Film) -> np.ndarray:
    """RGB (h, w, 3) f4 over black."""
    return film.planes["Combined"][..., :3]


def normal(film: Film) -> np.ndarray:
    """Directions -1 to 1 as 0 to 1."""
    return film.planes["Normal"] * 0.5 + 0.5


def direct(film: Film) -> np.ndarray:
    """What lamps send straight to diffuse surfaces, and these to the eye."""
    return film.planes["Diffuse Direct"] * film.planes["Diffuse Color"]


@dataclass(frozen=True)
class Stage:
    """name: of its file. settings: of the render that shows it; times: beginnings of the names of its passes."""

    name: str
    caption: str
    settings: Mapping[str, Any]
    show: Callable[[Film], np.ndarray] = combined
    times: tuple[str, ...] = field(default=())


RAW: dict[str, Any] = {"samples": 1, "denoise": False}
STAGES = (
    Stage("visibility", "Visible surfaces, their normals as colours", {**RAW, "passes": ("Normal",)}, normal,
          ("raster/", "evaluate/")),
    Stage("octree", "The octree's surfels, their albedo in shades; these are of 32 cubed voxels, the time of 128 cubed",
          {**RAW, "view": "cache_albedo", "cache_resolution": "32"}, combined, ("voxelize/", "octree/")),
    Stage("lamps", "The light cache after the lamps", {**RAW, "view": "cache", "bounces": 0}, combined,
          ("cache/direct", "cache/draw")),
    Stage("bounce_1", "after one bounce", {**RAW, "view": "cache", "bounces": 1}),
    Stage("bounce_2", "after two", {**RAW, "view": "cache", "bounces": 2}),
    Stage("cache", "after all", {**RAW, "view": "cache"}, combined, ("cache/link", "cache/found", "cache/bounce")),
    Stage("direct", "Direct light at the pixels, one sample", {**RAW, "passes": ("Diffuse Direct", "Diffuse Color")},
          direct),
    Stage("gather", "With the light that two rays a pixel gather, one sample", RAW, combined,
          ("gather/", "lights/", "path/")),
    Stage("filter", "The same sample after the noise filter", {"samples": 1}, combined,
          ("resolve/", "denoise", "planes/")),
    Stage("samples_16", "16 samples", {"samples": 16}),
    Stage("samples_256", "256 samples", {"samples": 256}),
)


def milliseconds(stage: Stage, times_ms: Mapping[str, float]) -> float:
    """What the passes of `stage` took."""
    return sum(ms for name, ms in times_ms.items() if name.startswith(stage.times)) if stage.times else 0.0
