# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that move vertices, against what their trees say by hand."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes.upload import upload
from svo_engine.scene.graph import Graph, Link, Node
from svo_engine.scene.moved import moved_mesh
from svo_engine.scene.types import Material
from tests import scenes


def lifting(method: str, height: float) -> Material:
    """A Displacement node of a constant height."""
    nodes = (Node("ShaderNodeEmission", inputs={"Color": (1.0, 1.0, 1.0, 1.0), "Strength": 1.0}),
             Node("ShaderNodeDisplacement", {"space": "OBJECT"},
                  {"Height": height, "Midlevel": 0.5, "Scale": 2.0, "Normal": None}))
    graph = Graph(nodes, Link(0, "Emission"), displacement=Link(1, "Displacement"),
                  settings={"displacement_method": method})
    return Material("Lift", graph=graph, is_exact=False)


@pytest.mark.parametrize(("method", "by"), [("BUMP", 0.0), ("DISPLACEMENT", 0.6), ("BOTH", 0.6)])
def test_a_plane_is_lifted(device, method, by):
    """Beside another mesh that nothing moves, which stays the same object."""
    plane, other = (scenes.quad(name, (0, 0, 0), (1, 0, 0), (0, 1, 0), n=3) for name in "AB")
    scene = scenes.scene(scenes.Thing(plane, lifting(method, 0.8)), scenes.Thing(other, scenes.RED))
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        moved, still = gpu_scene.placing.shapes.meshes
    assert np.allclose(moved.positions, plane.positions + np.array([0, 0, by]), atol=1e-6)
    assert np.allclose(moved.corner_normals, plane.corner_normals, atol=1e-6)
    assert still is scene.plain.meshes[1]


def test_a_vertex_that_moves_turns_the_normals_of_a_smooth_mesh():
    sphere = scenes.sphere("S", 1.0, 8)
    grown = moved_mesh(sphere, sphere.positions, np.zeros(len(sphere.triangles), bool))
    corners = sphere.positions[sphere.triangles]
    away = corners / np.linalg.norm(corners, axis=2, keepdims=True)
    assert np.allclose(grown.positions, 2 * sphere.positions)
    assert (grown.corner_normals * away).sum(2).min() > 0.97  # triangles are not alike around a vertex


def test_flat_faces_stay_flat():
    box = scenes.box("B", (0, 0, 0), (1, 1, 1))
    moves = np.zeros_like(box.positions)
    moves[7] = 0.5, 0.3, 0.2
    found = moved_mesh(box, moves, np.zeros(len(box.triangles), bool))
    corners = found.positions[found.triangles]
    own = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    assert np.allclose(found.corner_normals, own[:, None], atol=1e-5)
