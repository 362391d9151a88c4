# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines: where they are, how wide, and that nothing is drawn that is not asked for."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Material, Scene
from svo_engine.settings import Lines
from tests import scenes
from tests.on_gpu import picture_of
from tests.rays import RAYS

NONE = Lines(silhouettes=False, creases=False, materials=False, objects=False)
RED, SIZE = (1.0, 0.0, 0.0), 32
GREY = Material("Grey", (0, 0, 0), specular_level=0, emission=(0.5, 0.5, 0.5))
OTHER = Material("Other", (0, 0, 0), specular_level=0, emission=(0.25, 0.5, 0.5))
ABOVE = Camera("Camera", scenes.look((0, 0, 5), up=(0, 1, 0)), (SIZE, SIZE), is_orthographic=True, ortho_scale=4)


def half(name: str, x: float, material: Material, z: float = 0.0) -> scenes.Thing:
    """Half of the picture and more, from x on."""
    return scenes.Thing(scenes.quad(name, (x, -3, z), (3, 0, 0), (0, 6, 0)), material)


def lines_of(session, scene: Scene, lines: Lines) -> np.ndarray:
    """Where the picture is red: (SIZE, SIZE), 0 to 1."""
    settings: dict[str, Any] = {**RAYS, "samples": 16, "bounces": 0, "filter_width": 0.01}
    picture = picture_of(session, scene, **settings, lines=replace(lines, color=RED, thickness=2.0))
    return (picture[..., 0] - 0.25 > 0.5).astype("f4")


def two(left: Material, right: Material, z: float = 0.0) -> Scene:
    return scenes.scene(half("Left", -3, left), half("Right", 0, right, z), camera=ABOVE)


def joined() -> Scene:
    """One mesh of two faces that meet at a right angle, seen along their bisector."""
    a, b = (scenes.quad("Roof", (0, -3, 0), edge, (0, 6, 0)) for edge in ((-3, 0, -3), (3, 0, -3)))
    mesh = replace(a, positions=np.concatenate([a.positions, b.positions]),
                   triangles=np.concatenate([a.triangles, b.triangles + np.uint32(len(a.positions))]),
                   corner_normals=np.concatenate([a.corner_normals, b.corner_normals]),
                   material_slots=np.concatenate([a.material_slots, b.material_slots]), attributes=(), uv_map="")
    return scenes.scene(scenes.Thing(mesh, GREY), camera=ABOVE)


@pytest.mark.parametrize(("scene", "kind"), [
    (two(GREY, GREY), "objects"), (two(GREY, OTHER), "materials"), (two(GREY, GREY, 1.0), "silhouettes"),
    (joined(), "creases")], ids=["objects", "materials", "silhouettes", "creases"])
def test_a_line_is_drawn_if_its_kind_is_asked_for_and_as_wide_as_asked(session, scene, kind):
    """Down the middle, a pixel on both sides."""
    drawn = lines_of(session, scene, replace(NONE, **{kind: True}))
    assert np.array_equal(np.flatnonzero(drawn[SIZE // 2]), [SIZE // 2 - 1, SIZE // 2])
    assert lines_of(session, scene, NONE).max() == 0


def test_a_plane_seen_from_the_side_has_no_lines_inside(session):
    """Distances grow quickly along it, and yet nothing lies behind anything."""
    floor = scenes.Thing(scenes.quad("Floor", (-50, -50, 0), (100, 0, 0), (0, 100, 0)), GREY)
    camera = Camera("Camera", scenes.look((0, -20, 0.5), (0, 0, 0.4)), (SIZE, SIZE))
    drawn = lines_of(session, scenes.scene(floor, camera=camera), Lines())
    assert drawn[: SIZE // 2 - 4].max() == 0
    assert drawn.max() == 1  # against the sky
