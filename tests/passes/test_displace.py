# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that move vertices, against what their trees say by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.passes.upload import upload
from svo_engine.scene.graph import Graph, Link, Node
from svo_engine.scene.moved import flat_faces, moved_mesh
from svo_engine.scene.types import Camera, Material, Scene
from tests import scenes
from tests.on_gpu import film_of, picture_of
from tests.rays import RAYS

DISPATCHED = "displace/vertices invocations"
OPEN = {**RAYS, "samples": 1, "bounces": 0}


def lifting(height: float, method: str = "DISPLACEMENT", color: float = 1.0, space: str = "OBJECT") -> Material:
    """A Displacement node of a constant height: by 2 (height - 0.5) metres."""
    nodes = (Node("ShaderNodeEmission", inputs={"Color": (color, color, color, 1.0), "Strength": 1.0}),
             Node("ShaderNodeDisplacement", {"space": space},
                  {"Height": height, "Midlevel": 0.5, "Scale": 2.0, "Normal": None}))
    graph = Graph(nodes, Link(0, "Emission"), displacement=Link(1, "Displacement"),
                  settings={"displacement_method": method})
    return Material("Lift", (0, 0, 0), specular_level=0, emission=(color,) * 3, graph=graph, is_exact=False)


def square(name: str = "Square") -> scenes.Mesh:
    return scenes.quad(name, (0, 0, 0), (1, 0, 0), (0, 1, 0), n=3)


def meshes_of(device, scene: Scene) -> list[np.ndarray]:
    """What each instance shows, in the scene's order."""
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        return [gpu_scene.placing.shapes.meshes[m] for m in gpu_scene.placing.placed.mesh]


@pytest.mark.parametrize(("method", "by"), [("BUMP", 0.0), ("DISPLACEMENT", 0.6), ("BOTH", 0.6)])
def test_a_square_is_lifted(device, method, by):
    """Beside another mesh that nothing moves, which stays the same object."""
    plane, other = square("A"), square("B")
    scene = scenes.scene(scenes.Thing(plane, lifting(0.8, method)), scenes.Thing(other, scenes.RED))
    moved, still = meshes_of(device, scene)
    assert np.allclose(moved.positions, plane.positions + np.array([0, 0, by]), atol=1e-6)
    assert np.allclose(moved.corner_normals, plane.corner_normals, atol=1e-6)
    assert still is scene.plain.meshes[1]


def test_objects_that_share_a_mesh_move_it_as_their_materials_say(device):
    """Two alike by one mesh, one by another, and one not at all."""
    mesh = square()
    things = [scenes.Thing(mesh, material) for material in (
        lifting(0.8), lifting(0.6), replace(lifting(0.8, color=0.5), name="Other"), scenes.RED)]
    scene = scenes.scene(*things)
    scene = replace(scene, meshes=scene.meshes[:1], instances=replace(scene.instances, mesh=np.zeros(4, "u4")))
    found = meshes_of(device, scene)
    assert np.allclose([m.positions[:, 2].max() for m in found], [0.6, 0.2, 0.6, 0.0], atol=1e-6)
    assert found[0] is found[2]


def test_a_triangle_of_another_material_stays_but_for_vertices_that_it_shares(device):
    mesh = square()
    first = mesh.positions[mesh.triangles].mean(1)[:, 0] < 1 / 3
    mesh = replace(mesh, material_slots=np.where(first, 0, 1).astype("u4"))
    scene = scenes.scene(scenes.Thing(mesh, lifting(1.0)))
    inst = replace(scene.instances, first_slot=np.array([0, 2], "u4"), slot_materials=np.array([0, 1], "u4"))
    (moved,) = meshes_of(device, replace(scene, instances=inst, materials=(*scene.materials, scenes.RED)))
    assert np.allclose(moved.positions[:, 2], np.where(mesh.positions[:, 0] < 0.34, 1.0, 0.0), atol=1e-6)


def glowing(material: Material, at: float = 0.0) -> Scene:
    camera = Camera("Camera", scenes.look((0, -4, 2)), (16, 12))
    return scenes.scene(scenes.Thing(scenes.floor(), material, (scenes.moved(x=at),)), camera=camera)


def test_only_edits_of_moves_move_anew(session):
    """Nor where an object stands, unless its material asks for that."""
    def dispatched(material, at=0.0):
        return film_of(session, glowing(material, at), **OPEN).stats["counts"].get(DISPATCHED, 0)

    assert dispatched(lifting(0.7)) == 4
    assert dispatched(lifting(0.7)) == 0
    assert dispatched(lifting(0.7, color=0.3)) == 0
    assert dispatched(lifting(0.7), at=0.5) == 0
    assert dispatched(lifting(0.9)) == 4
    assert dispatched(lifting(0.9, "BUMP")) == 0
    assert dispatched(lifting(0.9, space="WORLD")) == 4
    assert dispatched(lifting(0.9, space="WORLD"), at=0.5) == 4


def test_a_draft_moves_nothing_until_that_is_compiled(session):
    """A structure that no other test has: two Displacement nodes, one in the other."""
    material = lifting(0.7)
    graph = material.graph
    assert graph
    nodes = (*graph.nodes, Node("ShaderNodeDisplacement", {"space": "OBJECT"},
                                {"Height": Link(1, "Displacement"), "Midlevel": 0.0, "Scale": 5.0, "Normal": None}))
    scene = glowing(replace(material, graph=replace(graph, nodes=nodes, displacement=Link(2, "Displacement"))))
    view, settings = scenes.view(scene), replace(scenes.SMALL, **OPEN)

    def draft():
        return list(session.client().films(scene, view, settings, is_draft=True))[-1].planes["Combined"]

    at_rest = picture_of(session, glowing(lifting(0.5)), **OPEN)
    assert np.array_equal(draft(), at_rest)
    whole = picture_of(session, scene, **OPEN)
    assert not np.array_equal(whole, at_rest)
    assert np.array_equal(draft(), whole)


def test_a_limit_is_told(session):
    material = lifting(0.7)
    assert material.graph
    graph = replace(material.graph, settings={**material.graph.settings, "max_vertex_displacement": 0.1})
    (told,) = film_of(session, glowing(replace(material, graph=graph)), **OPEN).stats["limits"]
    assert told == "Material 'Lift': vertices are moved farther than Max Vertex Displacement, as Cycles does"


def moved(mesh: scenes.Mesh, moves: np.ndarray) -> scenes.Mesh:
    """All of its materials move it."""
    n = len(mesh.triangles)
    return moved_mesh(mesh, moves, np.ones(n, bool), np.zeros(n, bool))


def test_a_vertex_that_moves_turns_the_normals_of_a_smooth_mesh():
    sphere = scenes.sphere("S", 1.0, 8)
    grown = moved(sphere, sphere.positions)
    corners = sphere.positions[sphere.triangles]
    away = corners / np.linalg.norm(corners, axis=2, keepdims=True)
    assert np.allclose(grown.positions, 2 * sphere.positions)
    assert (grown.corner_normals * away).sum(2).min() > 0.97  # triangles are not alike around a vertex


@pytest.mark.parametrize("is_flat", [True, False])
def test_a_level_square_says_whether_it_is_flat(is_flat):
    """Its normals cannot say that."""
    mesh = replace(square(), flat=np.full(18, is_flat))
    moves = np.zeros_like(mesh.positions)
    moves[5, 2] = 0.3
    found = moved(mesh, moves)
    normals = found.corner_normals[found.triangles == 5]
    assert len(normals) == 6
    assert (np.ptp(normals, axis=0).max() > 0.1) == is_flat
    assert np.array_equal(flat_faces(found), mesh.flat)


def test_flat_faces_stay_flat():
    box = scenes.box("B", (0, 0, 0), (1, 1, 1))
    moves = np.zeros_like(box.positions)
    moves[7] = 0.5, 0.3, 0.2
    found = moved(box, moves)
    corners = found.positions[found.triangles]
    own = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    assert np.allclose(found.corner_normals, own[:, None], atol=1e-5)


def test_sharp_edges_stay_sharp():
    """A box whose faces are smooth and its edges sharp, lifted: nothing turns."""
    box = scenes.box("B", (0, 0, 0), (1, 1, 1))
    box = replace(box, flat=np.zeros(len(box.triangles), bool))
    found = moved(box, np.full_like(box.positions, 0.25))
    assert np.allclose(found.corner_normals, box.corner_normals, atol=1e-6)


def test_triangles_that_lose_their_area_are_left_out():
    """With their rows of all attributes."""
    mesh = scenes.quad("Q", (0, 0, 0), (1, 0, 0), (0, 1, 0), n=2, uvs=True)
    moves = np.zeros_like(mesh.positions)
    moves[mesh.positions[:, 0] == 0, 0] = 0.5
    found = moved(mesh, moves)
    assert len(found.triangles) == 4
    assert np.array_equal(found.positions[found.triangles][:, :, 0] >= 0.5, np.ones((4, 3), bool))
    keep = mesh.positions[mesh.triangles][:, :, 0].min(1) >= 0.5
    assert np.array_equal(found.corner_uvs, mesh.corner_uvs[keep])
