# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pixels see what: the device's rasteriser against projection in numpy."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace

import numpy as np
import pytest

from svo_engine.passes import raster as raster_module
from svo_engine.passes.bvh import build_bvh, build_meshes
from svo_engine.passes.parts import Part, make_parts
from svo_engine.passes.raster import look, make_targets, raster
from svo_engine.passes.resolve import make_film
from svo_engine.passes.tracer import make_rest, tracer_of
from svo_engine.passes.upload import upload
from svo_engine.scene import layouts
from svo_engine.scene.camera import make_view
from svo_engine.scene.types import Camera, Image, Material, Texture
from svo_engine.settings import RenderSettings
from tests import scenes
from tests.on_gpu import picture_of

GLOW = Material("Glow", (0, 0, 0), emission=(1, 2, 3), specular_level=0)
CAMERA = Camera("Camera", scenes.look((0.4, -5, 1.2), (0.1, 0, 0.2)), (64, 48), lens=50, shift=(0.05, -0.02))
TILTED = ((-1.1, 0.2, -0.9), (2.1, 0.7, 0.1), (-0.2, 0.9, 2.0))  # corner and sides of a parallelogram


def shown(session, *things, camera=CAMERA, view=None, samples=1, **more):
    """The picture of glowing things on a transparent film."""
    scene = scenes.scene(*things, camera=camera, film_transparent=True, **more)
    return picture_of(session, scene, view, samples=samples)


def projected(points, view) -> np.ndarray:
    """Pixel coordinates (n, 2) of world points, row 0 at the bottom."""
    p = np.concatenate([points, np.ones((len(points), 1))], 1) @ np.linalg.inv(view.world_from_view).T
    clip = p @ view.clip_from_view.T
    return (clip[:, :2] / clip[:, 3:] + 1) / 2 * view.size


def inside(polygon: np.ndarray, size) -> tuple[np.ndarray, np.ndarray]:
    """Which pixel centres lie inside a convex polygon (n, 2), and which too close to its edge to tell: (h, w) each."""
    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    sides = []
    for p, q in zip(polygon, np.roll(polygon, -1, 0), strict=True):
        e = (q - p) / np.linalg.norm(q - p)
        sides.append(e[0] * (y - p[1]) - e[1] * (x - p[0]))
    distance = np.array(sides) * np.sign(np.median(sides))
    return (distance > 0).all(0), np.abs(distance).min(0) < 5e-3  # positions are snapped to 1/256 pixel


@pytest.mark.parametrize("camera", [
    CAMERA,
    replace(CAMERA, size=(40, 56), pixel_aspect=(1.0, 1.6)),
    replace(CAMERA, is_orthographic=True, ortho_scale=4.0),
], ids=["perspective", "tall", "orthographic"])
def test_the_pixels_that_see_a_quad(session, camera):
    corner, u, v = (np.array(x, "f8") for x in TILTED)
    quad = np.array([corner, corner + u, corner + u + v, corner + v])
    picture = shown(session, scenes.Thing(scenes.quad("Quad", *TILTED), GLOW), camera=camera)
    view = make_view(camera)
    sees, unsure = inside(projected(quad, view), view.size)
    assert 0.05 < sees.mean() < 0.95
    assert unsure.mean() < 0.02
    assert np.array_equal((picture[..., 3] == 1)[~unsure], sees[~unsure])
    assert np.allclose(picture[..., :3][sees & ~unsure], (1, 2, 3))
    assert not picture[~sees & ~unsure].any()


def test_the_nearer_surface_is_seen(session):
    near = scenes.Thing(scenes.quad("Near", (-0.5, -1, -0.5), (1, 0, 0), (0, 0, 1)), GLOW)
    far = scenes.Thing(scenes.quad("Far", (-1, 1, -1), (2, 0, 0), (0, 0, 2)), replace(GLOW, emission=(9, 9, 9)))
    one, other = shown(session, near, far), shown(session, far, near)
    assert np.array_equal(one, other)
    reds = set(np.unique(one[..., 0]).tolist())
    assert reds == {0.0, 1.0, 9.0}
    assert one[24, 32, 0] == 1


def test_surfaces_are_seen_from_both_sides(session):
    front = scenes.Thing(scenes.quad("Quad", (-1, 0, -1), (2, 0, 0), (0, 0, 2)), GLOW)
    back = scenes.Thing(scenes.quad("Quad", (-1, 0, -1), (0, 0, 2), (2, 0, 0)), GLOW)
    assert np.array_equal(shown(session, front), shown(session, back))


def test_a_floor_under_the_camera_is_cut_at_the_near_plane(session):
    camera = Camera("Camera", scenes.look((0, 0, 0.5), (0, 10, 0.5)), (64, 48))
    picture = shown(session, scenes.Thing(scenes.floor(1000.0), GLOW), camera=camera)
    assert (picture[:22, :, 3] == 1).all()
    assert (picture[26:, :, 3] == 0).all()


@pytest.mark.parametrize("alpha", [0.0, 0.25, 0.5, 1.0])
def test_alpha_is_a_share_of_the_samples(session, alpha):
    """0 is never drawn and 1 always; between, 256 quasi-random numbers a pixel are within 0.04 of the share, also where
    two triangles meet and each decides about a part of the samples.
    """
    sheet = scenes.Thing(scenes.quad("Sheet", (-9, 0, -9), (18, 0, 0), (0, 0, 18)), replace(GLOW, alpha=alpha))
    picture = shown(session, sheet, camera=replace(CAMERA, size=(16, 12)), samples=1 if alpha in (0, 1) else 256)
    assert np.allclose(picture[..., 3], alpha, atol=0 if alpha in (0, 1) else 0.04)
    assert np.allclose(picture[..., :3], picture[..., 3:] * (1, 2, 3), atol=1e-5)


def test_another_seed_cuts_out_other_pixels(session):
    sheet = scenes.Thing(scenes.quad("Sheet", (-9, 0, -9), (18, 0, 0), (0, 0, 18)), replace(GLOW, alpha=0.5))
    scene = scenes.scene(sheet, camera=CAMERA, film_transparent=True)
    patterns = [picture_of(session, scene, filter_width=0.01, seed=seed)[..., 3] for seed in (0, 1)]
    assert 0.3 < (patterns[0] != patterns[1]).mean() < 0.7


def test_an_alpha_texture_cuts_out(session):
    """The left half of the image is clear."""
    image = Image("Half", np.array([[[1, 1, 1, 0], [1, 1, 1, 1]]], "f4"))
    mesh = scenes.quad("Sheet", (-1, 0, -1), (2, 0, 0), (0, 0, 2), uvs=True)
    sheet = scenes.Thing(mesh, replace(GLOW, alpha_texture=0))
    texture = Texture(0, interpolation="Closest", channel=3)
    camera = Camera("Camera", scenes.look((0, -5, 0)), (64, 48), is_orthographic=True, ortho_scale=2.0)
    picture = shown(session, sheet, camera=camera, images=(image,), textures=(texture,))
    assert not picture[:, :31].any()
    assert (picture[:, 33:, 3] == 1).all()


def test_a_border_shows_its_part_of_the_picture(session):
    """The same pixels, but for those that an edge crosses: there the projection's rounding may decide otherwise."""
    scene = scenes.cornell(scenes.lamp("POINT", (0.2, -0.3, 1.7), emitted=5.0))
    whole = picture_of(session, scene)
    part = picture_of(session, scene, scenes.view(scene, border=(0.25, 0.25, 0.75, 0.875)))
    assert part.shape == (30, 32, 4)
    same = np.isclose(part, whole[12:42, 16:48], rtol=1e-3, atol=1e-4).all(2)
    assert same.mean() > 0.995


def test_instances_of_one_mesh_are_seen_where_copies_of_it_would_be(session):
    places = (scenes.moved(-1, 0, 0), scenes.moved(1, 0.5, 0), scenes.moved(0, 2, 1) @ np.diag([2.0, 1, 0.5, 1]))
    ball = scenes.sphere("Ball", 0.6, 8)
    shared = shown(session, scenes.Thing(ball, GLOW, places))
    copies = shown(session, *(scenes.Thing(ball, GLOW, (place,)) for place in places))
    assert np.array_equal(shared, copies)
    assert 0.05 < shared[..., 3].mean() < 0.95


def test_every_sample_moves_the_pixels_by_less_than_the_filter(session):
    """A half plane: its edge is soft over about twice the filter's width, and sharp under a narrow filter."""
    half = scenes.Thing(scenes.quad("Half", (0, 0, -5), (5, 0, 0), (0, 0, 10)), GLOW)
    camera = Camera("Camera", scenes.look((0, -5, 0)), (32, 8), is_orthographic=True, ortho_scale=4.0)
    scene = scenes.scene(half, camera=camera, film_transparent=True)
    wide = picture_of(session, scene, samples=64, filter_width=2.0)[4, :, 3]
    narrow = picture_of(session, scene, samples=64, filter_width=0.01)[4, :, 3]
    assert set(narrow.tolist()) == {0.0, 1.0}
    assert np.all(np.diff(wide) >= 0)
    assert 2 <= ((wide > 0) & (wide < 1)).sum() <= 4
    assert wide.sum() == pytest.approx(16, abs=0.1)


def pixels_of(scene, view, order: np.ndarray, first_triangle: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Where on the picture the points that hits (k, 4) are on lie, (k, 2) pixels."""
    placed = order[seen[:, 0]]
    mesh = scene.instances.mesh[placed]
    triangle = seen[:, 1] - first_triangle[mesh]
    corners = np.array([scene.meshes[m].positions[scene.meshes[m].triangles[t]]
                        for m, t in zip(mesh, triangle, strict=True)], "f8")
    b, c = seen[:, 2:].copy().view("f4").astype("f8").T[..., None]
    points = corners[:, 0] * (1 - b - c) + corners[:, 1] * b + corners[:, 2] * c
    clip_from_world = view.clip_from_view @ np.linalg.inv(view.world_from_view)
    clip_from_object = clip_from_world @ scene.instances.world_from_object[placed]
    clip = (clip_from_object @ np.concatenate([points, np.ones((len(points), 1))], 1)[..., None])[..., 0]
    return clip[:, :2] / clip[:, 3:] * np.array(view.size) / 2


@pytest.mark.parametrize("camera", [CAMERA, replace(CAMERA, is_orthographic=True, ortho_scale=4.0),
                                    replace(CAMERA, clip_start=4.5, clip_end=5.6)],
                         ids=["perspective", "orthographic", "clipped"])
def test_rays_see_what_the_rasteriser_sees(device, monkeypatch, camera):
    """Triangle and place; but for pixels whose centres lie on an edge, which either may give to a neighbour."""
    scene = scenes.cornell()
    view = make_view(camera)
    monkeypatch.setattr(raster_module, "can_trace", lambda *_: True)
    with ExitStack() as made:

        def keep(result):
            made.callback(result.scope.close)
            return result

        gpu_scene, targets = keep(upload(device, scene)), keep(make_targets(device, view.size))
        bvh = keep(build_bvh(device, gpu_scene.placing, keep(build_meshes(device, scene.meshes))))
        rays = tracer_of(gpu_scene, bvh, keep(make_rest(device, bvh.height)))
        parts = keep(make_parts(device, view.size, 0, 0, gpu_scene.needs))
        film = make_film(made.enter_context(device.scope()), view, ("COMBINED",), gpu_scene.centre_ws)
        settings, whole, seen = RenderSettings(), Part(0, parts.n_slots), []
        for tracer in (None, rays):
            eye = look(device, gpu_scene, view, targets, settings, 3, film.tiles, tracer)
            assert eye.is_drawn == (tracer is None)
            raster(device, gpu_scene, eye, targets, tracer, settings, parts, whole)
            seen.append(np.frombuffer(parts.wave.read(16 * whole.n), "u4").reshape(-1, 4))
    same = (seen[0][:, :2] == seen[1][:, :2]).all(1)
    is_hit = seen[0][:, 0] != layouts.CONSTANTS["BVH_NONE"]
    assert same.mean() > 0.99
    assert is_hit.mean() > 0.1
    is_seen = same & is_hit
    order, first = gpu_scene.placing.order, gpu_scene.placing.shapes.first_triangle
    places = [pixels_of(scene, view, order, first, part[is_seen]) for part in seen]
    assert np.abs(places[0] - places[1]).max() < 1 / 256  # to which the rasteriser rounds corners, up or down
