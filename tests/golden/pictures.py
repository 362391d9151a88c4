# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures that are kept, each a scene and settings; SIZE is chosen so that a file stays below 30 kB."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from svo_engine.film import Film
from svo_engine.render import Session
from svo_engine.scene.types import Material, Scene, World
from svo_engine.settings import RenderSettings
from tests import scenes

FOLDER = Path(__file__).parent
SIZE = (48, 36)
RENDERER = "llvmpipe"

PLAIN = replace(scenes.SMALL, samples=2)
SETTINGS: dict[str, RenderSettings] = {
    "cones": replace(PLAIN, resolution="64"),
    "rays": replace(PLAIN, method="rays", gather_rays=4, bounces=2, cache_rays=4, cache_resolution="64"),
    "voxels": replace(PLAIN, view="voxel_radiance"),
}


def scene() -> Scene:
    """The room with a lamp of each sort of shadow, a metal ball and a little sky."""
    metal = Material("Metal", (0.9, 0.7, 0.4), roughness=0.3, metallic=1.0)
    ball = scenes.Thing(scenes.sphere("Ball", 0.3, 12), metal, (scenes.moved(0.45, -0.2, 0.3),))
    lamps = (scenes.lamp("AREA", (0, 0, 1.95), emitted=8.0, size=(0.6, 0.4)),
             scenes.lamp("POINT", (-0.7, -0.8, 1.0), emitted=0.3))
    return scenes.cornell(*lamps, things=(ball,), world=World((0.05, 0.06, 0.08)))


def render(session: Session, name: str) -> Film:
    """The picture called `name`."""
    of = scene()
    return list(session.films(of, scenes.view(of, size=SIZE), SETTINGS[name]))[-1]
