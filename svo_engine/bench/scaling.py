# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow: one series of frames along each axis, all else kept small and fixed.

Each point is a frame with everything anew, in the hall of `shapes.py`. What an axis touches stands out against what it
does not in the parts of the frame, so slopes are fitted to the stages, see `report/scaling.py`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from ..render import Session
from ..scene.types import Scene
from .core import Shooter
from .edits import all_anew
from .progress import Lines
from .rungs import Shot, median, repeat
from .shapes import hall
from .tables import Scaled, pack

SIZE = 320, 240
FIXED = {"samples": 1, "cache_resolution": "64", "denoise": True}


@dataclass(frozen=True)
class Point:
    """One frame of a series. scene: arguments of `hall`; settings: beside FIXED."""

    axis: str
    x: float
    size: tuple[int, int]
    scene: Mapping[str, int]
    settings: Mapping[str, Any]


def points(is_software: bool) -> list[Point]:
    """All frames of all series; shorter ones for a software renderer, which would take hours."""
    return [
        *(Point("triangles", n, SIZE, {"n_triangles": n}, {})
          for n in _series((5_000, 20_000, 80_000, 320_000, 1_280_000, 5_000_000), is_software, 4)),
        *(Point("octree", n, SIZE, {}, {"cache_resolution": str(n)})
          for n in _series((32, 64, 128, 256, 512, 1024), is_software, 4)),
        *(Point("voxel grid", n, SIZE, {}, {"method": "cones", "resolution": str(n)})
          for n in _series((32, 64, 128, 256), is_software, 4)),
        *(Point("lamps", n, SIZE, {"n_lamps": n}, {}) for n in _series((1, 4, 16, 64, 256, 1024), is_software, 4)),
        *(Point("pixels", w * h, (w, h), {}, {})
          for w, h in _series(((160, 120), (320, 240), (640, 480), (1280, 960), (2560, 1920)), is_software, 3)),
        *(Point("bounces", n, SIZE, {}, {"bounces": n}) for n in _series((1, 2, 4, 8, 16, 32), is_software, 5)),
        *(Point("instances", n, SIZE, {"n_triangles": 500, "n_balls": n}, {})
          for n in _series((1, 8, 64, 512, 4096, 32768), is_software, 4)),
    ]


def rows(todo: Sequence[Point], session: Session, lines: Lines) -> Iterator[Scaled]:
    """Measure every point of `todo`; the scene of neighbours with equal arguments is made once."""
    device, last, scene = session.device_info()["renderer"], None, hall()
    for point in todo:
        lines.step(f"{point.axis}: {point.x:,.0f}")
        if point.scene != last:
            last, scene = point.scene, hall(**point.scene)
        shoot = partial(_shoot, Shooter(session, point.size), scene, {**FIXED, **point.settings})
        shoot()
        shots = repeat(shoot)
        yield Scaled(point.axis, device, point.x, median(shots), len(shots), pack(shots[-1].parts), shots[-1].n_bytes)


def _shoot(shooter: Shooter, scene: Scene, settings: Mapping[str, Any]) -> Shot:
    return shooter.shoot(all_anew(scene, 0), settings)


def _series(values: Sequence[Any], is_software: bool, n_short: int) -> Sequence[Any]:
    return values[:n_short] if is_software else values
