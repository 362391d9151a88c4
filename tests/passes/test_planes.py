# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes: what each holds, that they add up to the picture, and that nobody pays for what was not asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.errors import SvoError
from svo_engine.needs import needs_of
from svo_engine.passes.denoise.choice import wanted
from svo_engine.passes.planes import SOURCES, planes_for
from svo_engine.passes.resolve import PLANES
from svo_engine.scene.types import Material, World
from svo_engine.settings import PASSES, RenderSettings, with_text
from tests import scenes
from tests.on_gpu import film_of
from tests.rays import RAYS, above, directions, floor_points, glow, rectangle_share

ALL = tuple(PASSES)
LAMP = Material("Lamp", (0.2, 0.2, 0.2), emission=(3.0, 2.0, 1.0), specular_level=0)
METAL = Material("Metal", (0.9, 0.6, 0.3), roughness=0.3, metallic=1.0)
COATED = Material("Coated", (0.3, 0.3, 0.8), roughness=0.4)


def room(**more):
    """Diffuse walls, a metal ball, a coated one, something that glows, and a sky beside it all."""
    things = (scenes.Thing(scenes.sphere("Metal", 0.25), METAL, (scenes.moved(0.4, -0.5, 0.3),)),
              scenes.Thing(scenes.sphere("Coated", 0.25), COATED, (scenes.moved(-0.5, -0.7, 0.3),)),
              scenes.Thing(scenes.quad("Glow", (-0.3, 0.9, 1.2), (0.6, 0, 0), (0, 0, 0.4)), LAMP))
    return scenes.cornell(things=things, world=World((0.1, 0.2, 0.4)), **more)


@pytest.fixture(scope="module")
def film(session):
    return film_of(session, room(), **RAYS, samples=3, passes=ALL)


def total(planes) -> np.ndarray:
    """What the light passes add up to."""
    lit = sum((planes[f"{kind} Direct"] + planes[f"{kind} Indirect"]) * planes[f"{kind} Color"]
              for kind in ("Diffuse", "Glossy", "Transmission"))
    return lit + planes["Emission"] + planes["Environment"]


@pytest.mark.parametrize("method", ["rays", "cones"])
def test_the_passes_add_up_to_the_picture(session, method):
    """To the rounding of about a dozen sums of 32-bit floats."""
    planes = film_of(session, room(), **{**RAYS, "method": method}, samples=3, passes=ALL).planes
    assert np.allclose(total(planes), planes["Combined"][..., :3], rtol=1e-5, atol=1e-6)
    assert all(planes[name].max() > 0.05 for name in ("Diffuse Direct", "Diffuse Indirect", "Glossy Color", "Emission"))
    assert planes["Glossy Indirect"].max() > 0.05


def test_names_and_channels(film):
    assert film.planes.keys() == {"Combined", *ALL} == {"Combined", *SOURCES}
    for name, channels in PASSES.items():
        assert film.planes[name].shape == (48, 64, len(channels))
        assert film.planes[name].dtype == np.float32


def test_the_picture_is_the_same_with_and_without_passes(session):
    plain, with_all = (film_of(session, room(), **RAYS, samples=2, passes=passes) for passes in ((), ALL))
    assert set(plain.planes) == {"Combined"}
    assert np.allclose(plain.planes["Combined"], with_all.planes["Combined"], rtol=1e-6)


def test_passes_are_what_the_filter_has_not_touched(session):
    film = film_of(session, room(), **{**RAYS, "denoise": True}, samples=2, passes=ALL)
    noisy, smooth = film.planes["Noisy Image"], film.planes["Combined"]
    assert np.allclose(total(film.planes), noisy[..., :3], rtol=1e-5, atol=1e-6)
    assert not np.allclose(noisy, smooth, rtol=0.01)


def test_emission_counts_as_direct_light_of_what_it_shines_on(session):
    """A black board that glows 1 m above a floor is all there is, so that nothing bounces back to the floor."""
    board = scenes.quad("Board", (-0.5, -0.5, 1), (0, 1, 0), (1, 0, 0))
    camera = above(2.0, z=0.9)
    scene = scenes.scene(scenes.Thing(scenes.floor(4)), scenes.Thing(board, glow(3.0)), camera=camera)
    planes = film_of(session, scene, **{**RAYS, "gather_rays": 16}, samples=64, passes=ALL).planes
    share = rectangle_share(floor_points(camera), (-0.5, -0.5), (0.5, 0.5), 1.0)
    assert np.sqrt(((planes["Diffuse Direct"][..., 0] / (3 * share) - 1) ** 2).mean()) < 0.1  # 1024 rays, noisy
    assert planes["Diffuse Direct"].mean() == pytest.approx(3 * share.mean(), rel=0.01)
    assert np.abs(planes["Diffuse Indirect"]).max() < 1e-6


def test_a_world_alone_is_direct_light(session):
    """An empty floor sees nothing but the sky."""
    scene = scenes.scene(scenes.Thing(scenes.floor(20)), world=World((0.5, 1.0, 2.0)), camera=room().camera)
    planes = film_of(session, scene, **RAYS, samples=4, passes=ALL).planes
    on_floor = planes["Normal"][..., 2] > 0.99
    assert np.allclose(planes["Diffuse Direct"][on_floor], (0.5, 1, 2), rtol=1e-4)
    assert np.abs(planes["Diffuse Indirect"]).max() < 1e-5
    assert np.allclose(planes["Diffuse Color"][on_floor], 0.8, rtol=1e-5)


def test_environment_is_there_behind_a_transparent_film(session):
    filled, clear = (film_of(session, room(film_transparent=is_clear), **RAYS, samples=3, passes=("Environment",))
                     for is_clear in (False, True))
    assert np.array_equal(filled.planes["Environment"], clear.planes["Environment"])
    assert np.allclose(filled.planes["Environment"][-1, 0], (0.1, 0.2, 0.4), rtol=1e-6)


def test_depth_is_that_of_the_first_sample_along_the_camera_s_axis(session):
    """A wall across the view has one depth; where there is nothing it is as far as in Cycles."""
    wall = scenes.Thing(scenes.quad("Wall", (-0.5, 2, -9), (9, 0, 0), (0, 0, 18)))
    camera = replace(room().camera, world_from_camera=scenes.look((0, -1, 0)))
    scene = scenes.scene(wall, camera=camera)
    one, many = (film_of(session, scene, **{**RAYS, "filter_width": 1.5}, samples=n, passes=("Depth", "Position"))
                 for n in (1, 9))
    depth = one.planes["Depth"][..., 0]
    assert (depth == 1e10).any()
    assert np.allclose(depth[depth < 1e10], 3, rtol=1e-5)
    assert np.array_equal(depth, many.planes["Depth"][..., 0])
    assert np.allclose(one.planes["Position"], many.planes["Position"], atol=1e-5)


def test_position_is_in_the_world_also_far_from_its_origin(session):
    """Thirty kilometres away a 32-bit float knows 2 mm."""
    far = (2e4, -3e4, 100.0)
    wall = scenes.Thing(scenes.quad("Wall", (-9, 2, -9), (18, 0, 0), (0, 0, 18)), places=(scenes.moved(*far),))
    camera = replace(room().camera, world_from_camera=scenes.moved(*far) @ scenes.look((0, -1, 0)))
    seen = film_of(session, scenes.scene(wall, camera=camera), **RAYS, samples=2, passes=("Position", "Depth")).planes
    assert np.allclose(seen["Position"][..., 1], far[1] + 2, atol=0.004)
    assert np.allclose(seen["Depth"], 3, rtol=1e-4)
    middle = seen["Position"][23:25, 31:33].mean((0, 1))
    assert np.allclose(middle, np.add(far, (0, 2, 0)), atol=0.004)


def test_normals(session):
    """In the world, and for denoisers in the camera's space whose z points away; shorter where only half is covered."""
    camera = replace(room().camera, world_from_camera=scenes.look((0, -4, 2)))
    film = film_of(session, scenes.scene(scenes.Thing(scenes.floor(2)), camera=camera), **{**RAYS, "filter_width": 1.5},
                   samples=8, passes=("Normal", "Denoising Normal"))
    normal, turned = film.planes["Normal"], film.planes["Denoising Normal"]
    whole = normal[..., 2] > 0.999
    assert np.allclose(normal[whole], (0, 0, 1), atol=1e-5)
    assert np.allclose(turned[whole], np.array((0, 4, -2)) / np.sqrt(20), atol=1e-5)
    assert ((normal[..., 2] > 0.1) & (normal[..., 2] < 0.9)).any()
    assert not normal[-1, 0].any()


def test_denoising_albedo_and_depth(film):
    """The sky counts with its light and no depth; depth begins at the near clipping plane, as in Cycles."""
    albedo, depth = film.planes["Denoising Albedo"], film.planes["Denoising Depth"]
    colors = sum(film.planes[f"{kind} Color"] for kind in ("Diffuse", "Glossy", "Transmission"))
    assert np.allclose(albedo, colors + film.planes["Emission"] + film.planes["Environment"], atol=1e-6)
    camera = room().camera
    cos = directions(camera) @ (0, 1, 0)
    expected = (film.planes["Depth"][..., 0] - camera.clip_start) / cos
    inside = film.planes["Depth"][..., 0] < 1e10
    assert np.mean(np.isclose(depth[..., 0], expected, rtol=1e-3)[inside]) > 0.9  # all but edges
    assert not depth[~inside].all()


def test_only_the_planes_that_are_needed_exist():
    """Nobody who did not ask pays memory or time."""

    def planes(scene, **settings):
        settings = RenderSettings(**settings)
        return planes_for(needs_of(scene, settings), settings, wanted(settings))

    diffuse = scenes.cornell()
    assert planes(diffuse, denoise=False) == ("COMBINED",)
    assert planes(diffuse, denoise=False, passes=("Depth",)) == ("COMBINED", "POSITION")
    assert planes(diffuse, denoise=True) == ("COMBINED", "ALBEDO", "NORMAL_DEPTH")
    filtered = ("COMBINED", "DIFFUSE_DIRECT", "DIFFUSE_INDIRECT", "DIFFUSE_COLOR", "NORMAL_DEPTH")
    assert planes(diffuse, denoise=True, denoiser="atrous") == filtered
    glossy = {*filtered, "GLOSSY_DIRECT", "GLOSSY_INDIRECT", "GLOSSY_COLOR"}
    assert set(planes(room(), denoise=True, denoiser="atrous")) == glossy
    assert planes(room(), denoise=True, passes=ALL, samples=65) == PLANES


def test_an_unknown_pass_is_told():
    with pytest.raises(SvoError, match="There is no render pass 'Mist'; there are Depth, Position, "):
        RenderSettings(passes=("Depth", "Mist"))


def test_passes_as_text():
    settings = with_text(RenderSettings(), "passes", "Depth, Diffuse Color")
    assert settings.passes == ("Depth", "Diffuse Color")
    assert with_text(settings, "passes", "").passes == ()
