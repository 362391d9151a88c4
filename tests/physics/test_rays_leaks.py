# SPDX-License-Identifier: GPL-3.0-or-later
"""Two rooms with a wall without thickness between them, a lamp in one: the other is dark, as no light can get there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Scene
from tests import scenes
from tests.rays import shot

# Where one stands in each room and what one looks at, by the wall's angle to the axes
LIT = {0: ((-0.15, -0.8, 0.8), (-1.6, 0.6, -0.8)), 45: ((-0.9, 0.9, 0.9), (0.2, 0.3, -0.7))}
DARK = {0: ((1.8, -0.8, 0.8), (0.2, 0.5, -0.8)), 45: ((0.9, -0.9, 0.9), (-0.2, -0.3, -0.7))}


def rooms(degrees: int, n: int = 1) -> Scene:
    """Two rooms of 2 m side by side, or one cut from edge to edge, by a wall of 2 n^2 triangles. All is white."""
    if degrees == 0:
        shell, wall = scenes.box("Shell", (-2, -1, -1), (2, 1, 1)), ((0, -1, -1), (0, 2, 0), (0, 0, 2))
        lamp = scenes.lamp("POINT", (-0.9, 0.1, 0.3), emitted=5.0)
    else:
        shell, wall = scenes.box("Shell", (-1, -1, -1), (1, 1, 1)), ((-1, -1, -1), (2, 2, 0), (0, 0, 2))
        lamp = scenes.lamp("POINT", (-0.5, 0.5, 0.3), emitted=5.0)
    return scenes.scene(scenes.Thing(shell), scenes.Thing(scenes.quad("Wall", *wall, n)), lights=(lamp,))


def seen(session, scene: Scene, eye: tuple, **settings) -> np.ndarray:
    """(height, width) of what one sees from there."""
    camera = Camera("Camera", scenes.look(*eye), (32, 24), lens=15.0, clip_start=0.001)
    return shot(session, replace(scene, camera=camera), samples=4, **settings)[..., 0]


@pytest.mark.parametrize(("degrees", "most"), [(0, 1e-3), (45, 0.01)])
@pytest.mark.parametrize("resolution", ["32", "64"])
def test_the_room_behind_the_wall_is_dark(session, degrees, most, resolution):
    """The voxels at the wall's foot hold floor of both rooms. At 45 degrees the wall and the side walls that it meets
    share surfels along two edges, from the floor to the ceiling.
    """
    scene = rooms(degrees)
    lit, dark = (seen(session, scene, eyes[degrees], cache_resolution=resolution) for eyes in (LIT, DARK))
    assert dark.mean() < most * lit.mean()


@pytest.mark.parametrize("degrees", [0, 45])
def test_the_wall_may_have_twenty_thousand_triangles(session, degrees):
    fine = rooms(degrees, 100)
    lit, dark = (seen(session, fine, eyes[degrees]) for eyes in (LIT, DARK))
    assert lit.mean() == pytest.approx(seen(session, rooms(degrees), LIT[degrees]).mean(), rel=0.01)
    assert dark.mean() < 0.01 * lit.mean()
