# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes as pictures: what a node gives, sent out as light by a flat card, by this engine and by Cycles. If that is a
shader, it is the card's surface.

Cards are planes of 2 by 2 metres, seen from above, each with a material of its own and UVs from 0 to 1; nothing else
shines. All cards are in one picture, so that many modes cost one render each.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np

from svo_engine.blender.extract import extract
from svo_engine.render import Session
from svo_engine.scene.camera import make_view
from svo_engine.scene.types import Scene
from svo_engine.settings import RenderSettings
from tests.blender import build, cycles

SIZE = 32  # pixels of a card's side
SETTINGS = RenderSettings(method="rays", samples=1, cache_resolution="32", cache_rays=1, gather_rays=1, bounces=0,
                          denoise=False, filter_width=0.01)

# Makes nodes in the tree of `build.Nodes` and gives the socket or node to look at
Maker = Callable[[build.Nodes], object]


def make_cards(makers: Sequence[Maker]) -> None:
    """A new file with a card for each maker, left to right and bottom to top in a square."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    side = math.ceil(math.sqrt(len(makers)))
    for i, maker in enumerate(makers):
        nodes = build.material(f"Card {i}")
        shown = maker(nodes)
        is_shader = getattr(shown, "type", "") == "SHADER" and hasattr(shown, "is_output")
        nodes.show(shown if is_shader else nodes.new("Emission", Color=shown))
        build.plane(nodes.owner, name=f"Card {i}", at=(2 * (i % side), 2 * (i // side), 0))
    camera = cycles.look_down(2 * side, 4)
    camera.location.x = camera.location.y = side - 1
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = SIZE * side


def cards_by_cycles(makers: Sequence[Maker]) -> np.ndarray:
    """(n, SIZE, SIZE, 3) f4, row 0 at the bottom, of the open file that `make_cards` made."""
    size = bpy.context.scene.render.resolution_x
    with tempfile.TemporaryDirectory() as folder:
        return _cut(cycles.render(Path(folder), size=(size, size), samples=1, filter_width=0.01), len(makers))


def cards_by_us(session: Session, makers: Sequence[Maker]) -> np.ndarray:
    """The same by the compiled trees."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    depsgraph.update()
    scene = by_trees(extract(depsgraph))
    assert scene.camera
    size = bpy.context.scene.render.resolution_x
    view = make_view(replace(scene.camera, size=(size, size)))
    film = list(session.films(scene, view, SETTINGS))[-1]
    return _cut(film.planes["Combined"], len(makers))


def by_trees(scene: Scene) -> Scene:
    """All materials by their compiled trees, also those that need none."""
    return replace(scene, materials=tuple(replace(m, is_exact=False) for m in scene.materials))


def compare(session: Session, makers: Sequence[Maker]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cards by us and by Cycles, and the worst error of each card as a share of the range of its values, at least 1."""
    make_cards(makers)
    ours, theirs = cards_by_us(session, makers), cards_by_cycles(makers)
    span = np.maximum(np.ptp(theirs.reshape(len(makers), -1), axis=1), 1.0)
    return ours, theirs, np.abs(ours - theirs).reshape(len(makers), -1).max(1) / span


def _cut(picture: np.ndarray, n: int) -> np.ndarray:
    """The cards of a picture."""
    side = picture.shape[1] // SIZE
    cards = picture[..., :3].reshape(side, SIZE, side, SIZE, 3).swapaxes(1, 2).reshape(-1, SIZE, SIZE, 3)
    return cards[:n]
