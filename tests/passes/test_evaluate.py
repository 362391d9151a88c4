# SPDX-License-Identifier: GPL-3.0-or-later
"""Points of hits, held against numpy: where they are, which way they face, what they look like."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from svo_engine.gpu.device import Device
from svo_engine.needs import Needs, needs_of
from svo_engine.passes.evaluate import MATTE, PRINCIPLED, all_slots
from svo_engine.passes.parts import EYE, Parts, make_parts
from svo_engine.passes.upload import GpuScene, upload
from svo_engine.scene import layouts
from svo_engine.scene.types import Image, Material, Mesh, Scene, Texture
from svo_engine.settings import RenderSettings
from tests import scenes

C = layouts.CONSTANTS
N = 128  # hits
MISS, DONE = C["BVH_NONE"], C["HIT_DONE"]
EVERYTHING = needs_of(Scene(), RenderSettings(skip_unneeded=False))
TURNED = scenes.look((0.3, 0.5, 0.4)) * (1, 1, 1, 0) + np.diag([0, 0, 0, 1])
MATTE_RED = Material("Red", (0.8, 0.1, 0.05), specular_level=0, emission=(0.5, 0.0, 2.0))
BALL = scenes.sphere("Ball", 1.0, 4)


@dataclass(frozen=True, eq=False)
class Points:
    """What was made of n hits, (n,) or (n, 3) each. words: all planes of it, and what was there before."""

    words: np.ndarray
    kind: np.ndarray
    position: np.ndarray
    normal: np.ndarray
    normal_geometric: np.ndarray
    diffuse: np.ndarray
    emission: np.ndarray
    chance: np.ndarray
    t: np.ndarray
    number: np.ndarray
    seed: np.ndarray
    weight: np.ndarray

    def has(self, kinds: int) -> np.ndarray:
        return (self.kind & kinds) != 0


def wide(mesh: Mesh) -> np.ndarray:
    """Triangles whose normals can be told: at its poles a sphere has some that are next to nothing."""
    a, b, c = mesh.positions[mesh.triangles].swapaxes(0, 1)
    return np.flatnonzero(np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-3)


def hits(scene: Scene, seed: int = 1, **fixed: Any) -> np.ndarray:
    """N random hits (planes, N, 4) u4 of instance 0 from all around; `fixed` are fields of theirs."""
    rng = np.random.default_rng(seed)
    bary = rng.dirichlet((1, 1, 1), N)[:, :2]
    direction = rng.normal(size=(N, 3))
    given = {"instance": np.zeros(N, "u4"), "triangle": rng.choice(wide(scene.meshes[0]), N), "bary": bary, "direction":
             direction / np.linalg.norm(direction, axis=1, keepdims=True), "t": rng.random(N),
             "number": np.arange(N), "seed": np.arange(N) + 7, "pdf": np.ones(N), "weight": rng.random(N), **fixed}
    rows = np.zeros((C["HIT_PLANES"], N, 4), "f4")
    words = rows.view("u4")
    words[0, :, 0], words[0, :, 1], rows[0, :, 2:] = given["instance"], given["triangle"], given["bary"]
    rows[1, :, :3], rows[1, :, 3] = given["direction"], given["t"]
    words[2, :, 0], words[2, :, 1], rows[2, :, 2], rows[2, :, 3] = (
        given[name] for name in ("number", "seed", "pdf", "weight"))
    return words


def run(device: Device, gpu_scene: GpuScene, parts: Parts, takes_all: bool) -> None:
    part = next(iter(parts))
    common = {**gpu_scene.geometry, **parts.of(part, EYE), **all_slots(parts, part)}
    if not takes_all:
        device.dispatch(MATTE, N, Materials=gpu_scene.materials["Materials"], **common)
    device.dispatch(PRINCIPLED, N, **gpu_scene.materials, **common, u_albedo=gpu_scene.table.table,
                    u_takes_all=takes_all)


def points(device: Device, scene: Scene, of: np.ndarray, takes_all: bool = False, needs: Needs = EVERYTHING) -> Points:
    """Both programs, or the one that takes all, run for some hits."""
    with ExitStack() as made:
        gpu_scene = upload(device, scene)
        made.callback(gpu_scene.scope.close)
        parts = make_parts(device, (8 * N // 64, 8), 0, 0, needs)
        made.callback(parts.scope.close)
        parts.wave.clear()
        parts.wave.write(of)
        run(device, gpu_scene, parts, takes_all)
        size = C["HIT_PLANES"] + C["POINT_PLANES"] + C["LOBES_PLANES"]
        words = np.frombuffer(parts.wave.read(16 * N * size), "u4").reshape(size, N, 4)
        centre = gpu_scene.centre_ws
    at, rows = C["HIT_PLANES"], words.view("f4").astype("f8")
    return Points(words, words[at, :, 3], rows[at, :, :3] + centre, rows[at + 1, :, :3], rows[at + 2, :, :3],
                  rows[at + 3, :, :3], rows[at + 5, :, :3], rows[at + 4, :, 3], rows[at + 3, :, 3], words[at + 1, :, 3],
                  words[at + 2, :, 3], rows[at + 5, :, 3])


def plain(scene: Scene, of: np.ndarray) -> dict[str, np.ndarray]:
    """The same by numpy, of instance 0: positions, both normals on the ray's side, direction towards the eye."""
    mesh, place = scene.meshes[0], scene.instances.world_from_object[0]
    rows = of.view("f4").astype("f8")
    weights = np.stack([1 - rows[0, :, 2] - rows[0, :, 3], rows[0, :, 2], rows[0, :, 3]], 1)
    triangle, wo = of[0, :, 1], -rows[1, :, :3]
    corners = mesh.positions[mesh.triangles[triangle]].astype("f8") @ place[:3, :3].T + place[:3, 3]
    normals = mesh.corner_normals[triangle].astype("f8") @ np.linalg.inv(place[:3, :3])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    geometric = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    geometric *= np.sign(np.linalg.det(place[:3, :3])) / np.linalg.norm(geometric, axis=1, keepdims=True)
    normal = np.einsum("nc,ncx->nx", weights, normals)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    side = np.where(np.einsum("nx,nx->n", geometric, wo) < 0, -1, 1)[:, None]
    return {"position": np.einsum("nc,ncx->nx", weights, corners), "normal": side * normal,
            "normal_geometric": side * geometric, "wo": wo}


def ball(material: Material, place: np.ndarray | None = None, **more: Any) -> Scene:
    return scenes.scene(scenes.Thing(BALL, material, (np.eye(4) if place is None else place,)), **more)


PLACES = [np.eye(4), scenes.moved(100, 20, 3) @ TURNED, TURNED @ np.diag([2, 0.5, 1, 1.0]), np.diag([-1, 1, 1, 1.0])]


@pytest.mark.parametrize("material", [MATTE_RED, Material("Coat", (0.8, 0.1, 0.05))], ids=["matte", "principled"])
@pytest.mark.parametrize("place", PLACES, ids=["as it is", "far off", "squeezed", "mirrored"])
def test_points_lie_and_face_as_in_numpy(device, material, place):
    scene = ball(material, place)
    of = hits(scene)
    found, expected = points(device, scene, of), plain(scene, of)
    assert np.allclose(found.position, expected["position"], atol=2e-6 * max(1, np.abs(place).max()))
    assert np.allclose(found.normal_geometric, expected["normal_geometric"], atol=1e-5)
    sees_it = np.einsum("nx,nx->n", expected["normal"], expected["wo"]) > 2e-3
    assert np.allclose(found.normal[sees_it], expected["normal"][sees_it], atol=2e-4)
    assert sees_it.sum() > N / 2


@pytest.mark.parametrize("material", [MATTE_RED, Material("Coat", (0.8, 0.1, 0.05))], ids=["matte", "principled"])
def test_normals_face_the_eye(device, material):
    scene = ball(material)
    of = hits(scene)
    found, expected = points(device, scene, of), plain(scene, of)
    assert (np.einsum("nx,nx->n", expected["normal"], expected["wo"]) < 1e-3).any()  # those that have to be bent
    assert (np.einsum("nx,nx->n", found.normal, expected["wo"]) > 0).all()


def test_normals_of_maps_face_the_eye_and_are_unit(device):
    """A map of all sorts of slopes, steeper than what most eyes see."""
    slopes = np.random.default_rng(2).random((8, 8, 4)).astype("f4")
    quad = scenes.quad("Quad", (-1, -1, 0), (2, 0, 0), (0, 2, 0), 2, uvs=True)
    scene = scenes.scene(scenes.Thing(quad, Material("Map", normal_texture=0)), textures=(Texture(0),),
                         images=(Image("Slopes", slopes),))
    of = hits(scene)
    found, wo = points(device, scene, of).normal, plain(scene, of)["wo"]
    assert (np.einsum("nx,nx->n", found, wo) > 0).all()
    assert np.allclose(np.linalg.norm(found, axis=1), 1, atol=1e-5)
    assert np.abs(found[:, 2]).min() < 0.9


def test_a_matte_point_has_its_colour_and_what_it_sends_out(device):
    scene = ball(MATTE_RED)
    of = hits(scene)
    found = points(device, scene, of)
    assert np.allclose(found.diffuse, MATTE_RED.base_color)
    assert np.allclose(found.emission, MATTE_RED.emission)
    assert (found.kind & ~np.uint32(C["POINT_LIFTED"]) == C["POINT_SURFACE"] | C["POINT_GLOWS"]).all()


def test_points_keep_what_their_rays_were_given(device):
    scene = ball(MATTE_RED)
    of = hits(scene)
    found = points(device, scene, of)
    assert np.array_equal(found.number, of[2, :, 0]) and np.array_equal(found.seed, of[2, :, 1])
    assert np.array_equal(found.t, of.view("f4")[1, :, 3]) and np.array_equal(found.weight, of.view("f4")[2, :, 3])


@pytest.mark.parametrize("material", [MATTE_RED, scenes.WHITE, scenes.BLACK])
def test_the_program_that_takes_all_makes_the_same_of_matte_materials(device, material):
    scene = ball(material, TURNED)
    of = hits(scene)
    own, all_of_them = points(device, scene, of), points(device, scene, of, takes_all=True)
    rough = np.zeros_like(own.words)
    rough[C["HIT_PLANES"], :, 3] = C["POINT_ROUGH"]  # which says nothing where there are no lobes
    assert np.array_equal(own.words, all_of_them.words & ~rough)


def test_each_program_fills_in_its_own_points(device):
    """A matte and a principled instance, in turns."""
    other = replace(BALL, name="Other")
    scene = scenes.scene(scenes.Thing(BALL, MATTE_RED), scenes.Thing(other, Material("Metal", (1, 1, 1), metallic=1.0)))
    instance = np.arange(N, dtype="u4") % 2
    found = points(device, scene, hits(scene, instance=instance, triangle=instance * len(BALL.triangles)))
    assert np.array_equal(found.has(C["POINT_LOBES"]), instance == 1)
    assert np.allclose(found.diffuse, np.where(instance[:, None] == 0, MATTE_RED.base_color, 0))
    assert found.has(C["POINT_SURFACE"]).all()


@pytest.mark.parametrize(("fields", "kinds"), [
    ({"metallic": 1.0, "roughness": 0.0}, {"LOBES", "SMOOTH"}),
    ({"metallic": 1.0, "roughness": 0.3}, {"LOBES"}),
    ({"metallic": 1.0, "roughness": 0.6}, {"LOBES", "ROUGH"}),
    ({"roughness": 0.6}, {"LOBES", "ROUGH"}),
    ({"transmission": 1.0, "roughness": 0.3}, {"LOBES", "BENDING"}),
    ({"transmission": 1.0, "roughness": 0.6}, {"LOBES", "BENDING"}),
    ({"transmission": 1.0, "roughness": 0.0}, {"LOBES", "SMOOTH", "BENDING"}),
    ({"transmission": 1.0, "roughness": 0.0, "ior": 1.0}, {"LOBES", "SMOOTH"}),
    ({"specular_level": 0.0, "emission": (1.0, 0.0, 0.0)}, {"GLOWS", "ROUGH"}),
])
def test_kinds_of_principled_points(device, fields, kinds):
    scene = ball(Material("One", **{"roughness": 1.0, **fields}, base_color_texture=0), textures=(Texture(0),),
                 images=(Image("White", np.ones((1, 1, 4), "f4")),))
    found = points(device, scene, hits(scene))
    names = [name for name in ("LOBES", "SMOOTH", "BENDING", "ROUGH", "GLOWS") if found.has(C[f"POINT_{name}"]).all()]
    assert set(names) == kinds
    assert not found.has(C["POINT_DONE"]).any()


def test_paths_go_on_with_twice_the_albedo(device):
    scene = ball(Material("Dark", (0.2, 0.2, 0.2), metallic=1.0, roughness=0.0))
    of = hits(scene)
    found, expected = points(device, scene, of), plain(scene, of)
    cosine = np.einsum("nx,nx->n", expected["normal"], expected["wo"])
    assert (found.chance <= 1).all()
    assert np.allclose(found.chance[cosine > 0.99], 0.4, atol=5e-3)


@pytest.mark.parametrize("takes_all", [False, True])
@pytest.mark.parametrize("material", [MATTE_RED, Material("Coat")], ids=["matte", "principled"])
def test_rays_that_meet_nothing_have_no_surface(device, takes_all, material):
    scene = ball(material)
    found = points(device, scene, hits(scene, instance=np.full(N, MISS, "u4")), takes_all)
    assert not found.kind.any() and not found.diffuse.any() and not found.emission.any()


@pytest.mark.parametrize("takes_all", [False, True])
def test_tiles_that_are_done_are_marked(device, takes_all):
    scene = ball(Material("Coat"))
    instance = np.where(np.arange(N) < 64, DONE, 0).astype("u4")
    found = points(device, scene, hits(scene, instance=instance), takes_all)
    assert np.array_equal(found.kind == C["POINT_DONE"], instance == DONE)
    assert np.array_equal(found.has(C["POINT_SURFACE"]), instance == 0)
