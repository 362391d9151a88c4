# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow: one series of frames along each axis, all else kept small and fixed.

Each point is a frame with everything anew, in the hall of `shapes.py`. What an axis touches stands out against what it
does not in the parts of the frame, so slopes are fitted to the stages, see `report/scaling.py`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from typing import Any

from ..errors import GpuError
from ..render import Session
from ..scene.types import Scene
from .core import Shooter
from .edits import KINDS
from .progress import Lines
from .rungs import Shot, median, repeat
from .shapes import hall
from .tables import Scaled, pack

GPU_SIZE, SOFTWARE_SIZE = (800, 600), (160, 120)
GPU_CACHE, SOFTWARE_CACHE = "128", "32"


@dataclass(frozen=True)
class Point:
    """One frame of a series. scene: arguments of `hall`; settings: of ours, all others at their defaults."""

    axis: str
    x: float
    size: tuple[int, int]
    scene: Mapping[str, int]
    settings: Mapping[str, Any]


def points(is_software: bool) -> list[Point]:
    """All frames of all series; smaller and shorter ones for a software renderer, which would take hours."""
    size = SOFTWARE_SIZE if is_software else GPU_SIZE
    fixed = {"samples": 1, "cache_resolution": SOFTWARE_CACHE if is_software else GPU_CACHE}
    plain: Mapping[str, int] = {}

    def cut(values: Sequence[Any], n_short: int = 4) -> Sequence[Any]:
        return values[:n_short] if is_software else values

    return [
        *(Point("triangles", n, size, {"n_triangles": n}, fixed)
          for n in cut((5_000, 20_000, 80_000, 320_000, 1_280_000, 5_000_000))),
        *(Point("octree", n, size, plain, {**fixed, "cache_resolution": str(n)})
          for n in cut((32, 64, 128, 256, 512, 1024))),
        *(Point("voxel grid", n, size, plain, {**fixed, "method": "cones", "resolution": str(n)})
          for n in cut((32, 64, 128, 256))),
        *(Point("lamps", n, size, {"n_lamps": n}, fixed) for n in cut((1, 4, 16, 64, 256, 1024))),
        *(Point("pixels", w * h, (w, h), plain, fixed)
          for w, h in cut(((80, 60), (160, 120), (320, 240), (640, 480), (1280, 960), (2560, 1920)))),
        *(Point("bounces", n, size, plain, {**fixed, "bounces": n}) for n in cut((1, 2, 4, 8, 16, 32), 5)),
        *(Point("instances", n, size, {"n_triangles": 500, "n_balls": n}, fixed)
          for n in cut((1, 8, 64, 512, 4096, 32768))),
    ]


def rows(todo: Sequence[Point], lines: Lines) -> Iterator[Scaled]:
    """Measure every point of `todo` that fits the device. Each series has a device of its own, so that memory is its
    own; neighbours with equal arguments share a scene."""
    for _, series in groupby(todo, lambda point: point.axis):
        with closing(Session()) as session:
            yield from _series_rows(list(series), session, lines)


def _series_rows(series: Sequence[Point], session: Session, lines: Lines) -> Iterator[Scaled]:
    device = session.device_info()["renderer"]
    for same, points_of_scene in groupby(series, lambda point: point.scene):
        scene = hall(**same)
        for point in points_of_scene:
            lines.step(what := f"{point.axis}: {point.x:,.0f}")
            shoot = partial(_shoot, Shooter(session, point.size), scene, point.settings)
            try:
                limits = shoot().limits
            except GpuError as error:
                limits = [str(error)]
            if limits:
                lines.say(f"{what} is left out: {limits[0]}")
                continue
            shots = repeat(shoot)
            yield Scaled(point.axis, device, point.x, median(shots), len(shots), pack(shots[-1].parts),
                         shots[-1].n_bytes)


def _shoot(shooter: Shooter, scene: Scene, settings: Mapping[str, Any]) -> Shot:
    return shooter.shoot(scene, settings, anew=KINDS["all"])
