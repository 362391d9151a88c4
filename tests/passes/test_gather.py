# SPDX-License-Identifier: GPL-3.0-or-later
"""Cones through lit voxels. They approximate: here is what must hold for any of them; their errors: tests/physics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.passes.light import injection_of, light
from svo_engine.passes.upload import upload
from svo_engine.passes.voxelize import voxelize
from svo_engine.scene.types import Camera, Material, World
from tests import scenes
from tests.compute import evaluate
from tests.on_gpu import picture_of

N = 32
GLOW = Material("Glow", (0, 0, 0), emission=(4, 2, 1), specular_level=0)


def cones(device, scene, p, d, tan_half=0.1, t_max=1e9, **settings) -> np.ndarray:
    """RGBA (k, 4) that cones from world points p along d meet; offset and step as by default."""
    scene = replace(scene, camera=Camera("Camera", np.eye(4)))
    chosen = replace(scenes.SMALL, **settings)
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        voxels = voxelize(device, *gpu_scene.matter, N)
        lit = light(device, gpu_scene.lamps, voxels, injection_of(chosen, gpu_scene.lamps, scenes.view(scene)))
        with voxels.scope, lit.scope:
            uniforms = {**voxels.grid.uniforms(), "u_cone_offset": chosen.cone_offset, "u_cone_step": chosen.cone_step,
                        "u_cone_distance": 2.0 * N}
            at = (np.atleast_2d(p) - gpu_scene.centre_ws).astype("f4")
            d = np.array(d, "f8") / np.linalg.norm(d)
            call = f"trace_cone(to_voxels(p), vec3(0), d, {tan_half}, {t_max})"
            return evaluate(device, "vec4", call, ("bind/cones.glsl",), uniforms=uniforms, p=at,
                            textures={"u_radiance": lit.radiance}, d=np.tile(d, (len(at), 1)).astype("f4"))


def two_walls():
    """A glowing wall at y = 1 and a black one at y = -1."""
    return scenes.scene(scenes.Thing(scenes.quad("Glow", (-1, 1, -1), (2, 0, 0), (0, 0, 2)), GLOW),
                        scenes.Thing(scenes.quad("Black", (-1, -1, -1), (0, 0, 2), (2, 0, 0)), scenes.BLACK))


@pytest.mark.parametrize(("tan_half", "least"), [(0.01, 0.8), (0.1, 0.65), (0.3, 0.45)])
def test_a_cone_meets_the_wall_that_it_faces(device, tan_half, least):
    """It takes on the wall's colour. A wall of one layer of voxels should be opaque; filtered, it lets through what is
    measured here: a sixth of a narrow cone, half of a wide one.
    """
    rgba = cones(device, two_walls(), [[0, 0, 0], [0.2, 0.3, -0.1]], (0, 1, 0), tan_half)
    assert (rgba[:, 3] > least).all() and (rgba[:, 3] <= 1).all()
    assert np.allclose(rgba[:, :3] / rgba[:, 3:], (4, 2, 1), rtol=0.1)


def test_a_cone_that_faces_away_sees_none_of_the_light(device):
    rgba = cones(device, two_walls(), [[0, 0, 0]], (0, -1, 0), 0.05)
    assert rgba[0, 3] > 0.65
    assert rgba[0, 0] < 1e-3


def test_a_cone_along_the_walls_leaves_the_grid(device):
    assert not cones(device, two_walls(), [[0, 0, 0]], (0, 0, 1), 0.05).any()


def test_a_cone_ends_at_its_length(device):
    voxels_to_wall = 13.5
    near = cones(device, two_walls(), [[0, 0, 0]], (0, 1, 0), 0.05, t_max=voxels_to_wall - 3)
    assert near[0, 3] == 0


@pytest.mark.parametrize("tan_half", [0.01, 0.3, 1.0, 20.0])
def test_opacity_and_light_keep_their_bounds_from_anywhere(device, tan_half):
    rng = np.random.default_rng(1)
    p, d = rng.uniform(-1.2, 1.2, (200, 3)), rng.normal(size=3)
    rgba = cones(device, scenes.cornell(), p, d, tan_half)
    assert np.isfinite(rgba).all()
    assert rgba.min() >= 0
    assert rgba[:, 3].max() <= 1
    brightest = 0.8 / np.pi * 5 / 0.1**2  # a voxel can hardly be nearer to the lamp
    assert rgba[:, :3].max() < brightest


def floor_scene(**more):
    camera = Camera("Camera", scenes.look((0, -2, 1.5)), (24, 16), lens=60.0)
    return scenes.scene(scenes.Thing(scenes.floor(4.0)), camera=camera, **more)


def test_indirect_light_comes_from_lit_walls(session):
    """A sun along the floor lights a red wall beside it, and nothing else lights the floor."""
    red = scenes.Thing(scenes.quad("Red", (0.5, -1, 0), (0, 0, 1), (0, 2, 0)), scenes.RED)
    sun = scenes.lamp("SUN", (-1, 0, 0.0), emitted=10.0)  # along the floor
    scene = scenes.scene(scenes.Thing(scenes.floor(2.0)), red, camera=floor_scene().camera, lights=(sun,))
    with_wall = picture_of(session, scene)[4, 12]
    assert with_wall[0] > 0.05
    assert with_wall[0] > 4 * with_wall[1]


def test_a_roof_darkens_the_sky(session):
    roof = scenes.Thing(scenes.quad("Roof", (-2, -0.5, 1.0), (4, 0, 0), (0, 2.5, 0)), scenes.BLACK)
    world = World((1, 1, 1))
    open_, closed = floor_scene(world=world), scenes.scene(scenes.Thing(scenes.floor(4.0)), roof, world=world,
                                                           camera=floor_scene().camera)
    assert picture_of(session, closed)[6, 12, 0] < 0.6 * picture_of(session, open_)[6, 12, 0]


def test_lamps_that_cast_no_shadow_shine_through(session):
    roof = scenes.Thing(scenes.quad("Roof", (-2, -0.6, 1.0), (4, 0, 0), (0, 2.6, 0)), scenes.BLACK)
    pictures = [picture_of(session, scenes.scene(scenes.Thing(scenes.floor(4.0)), roof, camera=floor_scene().camera,
                                                 lights=(scenes.lamp("SUN", (0, 0, 1), casts_shadow=casts_shadow),)))
                for casts_shadow in (True, False)]
    assert pictures[0][6, 12, 0] < 0.1 * pictures[1][6, 12, 0]  # filtered voxels let some through


def test_the_specular_cone_can_be_switched_off(session):
    shiny = Material("Shiny", (1, 1, 1), roughness=0.1, metallic=1.0)
    camera = floor_scene().camera
    scene = scenes.scene(scenes.Thing(scenes.floor(4.0), shiny), camera=camera, world=World((1, 1, 1)))
    on, off = (picture_of(session, scene, specular_cone=value)[8, 12, 0] for value in (True, False))
    assert on > 0.5
    assert off == 0
