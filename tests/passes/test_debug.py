# SPDX-License-Identifier: GPL-3.0-or-later
"""The voxel views: through the middle of every column, the first voxel that numpy finds there too. The views of the
light cache: what is known of a lit floor.
"""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes.voxelize import make_grid
from svo_engine.scene.types import Camera, Material
from tests import scenes
from tests.on_gpu import picture_of
from tests.oracle import slow_voxels
from tests.rays import above

N = 32
BALL = scenes.sphere("Ball", 1.0, 12)
GLOW = Material("Glow", (0.2, 0.4, 0.6), emission=(3, 2, 1), specular_level=0)


def from_above(*things: scenes.Thing, level: int = 0):
    """A scene seen from above so that each pixel looks down the middle of one column of texels."""
    plain = scenes.scene(*things)
    low, high = plain.bounds()
    grid = make_grid(float((high - low).max()), N)
    side = N * grid.voxel_size
    middle = (low + high) / 2 + np.array(grid.low) + side / 2
    m = np.eye(4)
    m[:3, 3] = middle[0], middle[1], middle[2] + side
    camera = Camera("Camera", m, (N >> level, N >> level), is_orthographic=True, ortho_scale=side, clip_end=100.0)
    return scenes.scene(*things, camera=camera), grid


@pytest.fixture(scope="module")
def ball_from_above():
    return from_above(scenes.Thing(BALL, GLOW))


def highest(grid) -> np.ndarray:
    """Height (n, n) of the highest voxel of the ball in each column, -1 for none; rows along y."""
    triangles = (BALL.positions[BALL.triangles] - np.array(grid.low)) / grid.voxel_size
    top = np.full((N, N), -1)
    for triangle in triangles.astype("f8"):
        for x, y, z in slow_voxels.touched(triangle, N, 1e-4):
            top[y, x] = max(top[y, x], z)
    return top


def test_pixels_see_a_voxel_where_there_is_one(session, ball_from_above):
    scene, grid = ball_from_above
    picture = picture_of(session, scene, view="voxel_albedo")
    differs = (picture[..., 3] == 1) != (highest(grid) >= 0)
    assert differs.sum() <= 2  # voxels that are only touched


def test_albedo_is_that_of_the_surface(session, ball_from_above):
    """Seen on their upper faces, which are not darkened."""
    scene, _ = ball_from_above
    picture = picture_of(session, scene, view="voxel_albedo")
    assert np.allclose(picture[picture[..., 3] == 1][:, :3], (0.2, 0.4, 0.6), atol=1.5 / 255)


def test_normals_are_the_spheres(session, ball_from_above):
    """n / 2 + 1 / 2; a voxel of 1/13 of the radius holds normals up to 8 degrees apart."""
    scene, grid = ball_from_above
    picture = picture_of(session, scene, view="voxel_normal")
    y, x = np.nonzero((picture[..., 3] == 1) & (highest(grid) >= 0))
    cells = np.stack([x, y, highest(grid)[y, x]], 1)
    at = np.array(grid.low) + (cells + 0.5) * grid.voxel_size
    n = 2 * picture[y, x, :3] - 1
    cosine = (n * at).sum(1) / np.linalg.norm(n, axis=1) / np.linalg.norm(at, axis=1)
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).max() < 15


def test_radiance_is_what_the_voxels_send_out(session, ball_from_above):
    scene, _ = ball_from_above
    picture = picture_of(session, scene, view="voxel_radiance")
    assert np.allclose(picture[picture[..., 3] == 1][:, :3], (3, 2, 1), rtol=5e-3)


def test_coverage_is_grey_and_full_on_a_floor(session):
    scene, _ = from_above(scenes.Thing(scenes.floor()))
    picture = picture_of(session, scene, view="voxel_coverage")
    inner = picture[4:-4, 4:-4]
    assert np.allclose(inner, 1, atol=0.01)


@pytest.mark.parametrize("level", [1, 3, 5])
def test_coarser_levels_cover_what_finer_ones_do(session, level):
    fine_scene, _ = from_above(scenes.Thing(BALL, GLOW))
    coarse_scene, _ = from_above(scenes.Thing(BALL, GLOW), level=level)
    fine = picture_of(session, fine_scene, view="voxel_albedo")[..., 3]
    coarse = picture_of(session, coarse_scene, view="voxel_albedo", view_lod=level)[..., 3]
    m = N >> level
    assert np.array_equal(fine.reshape(m, N // m, m, N // m).max((1, 3)), coarse)


def test_a_level_beyond_the_last_is_the_last(session, ball_from_above):
    scene, _ = ball_from_above
    last, beyond = (picture_of(session, scene, view="voxel_albedo", view_lod=level) for level in (5, 8))
    assert np.array_equal(last, beyond)


def test_voxels_are_seen_from_inside_the_grid(session):
    scene = scenes.cornell(camera=Camera("Camera", scenes.look((0, 0, 1), (0.3, 1, 0.8)), (32, 24), lens=20.0))
    assert picture_of(session, scene, view="voxel_normal")[..., 3].min() == 1


def lit_floor():
    """A red floor under the sun that fills the picture, and a roof that shadows its left half."""
    roof = scenes.Thing(scenes.quad("Roof", (-2, -2, 5), (2, 0, 0), (0, 4, 0)), scenes.BLACK)
    return scenes.scene(scenes.Thing(scenes.floor(4.0), scenes.RED), roof, camera=above(),
                        lights=(scenes.lamp("SUN", (0, 0, 1), emitted=np.pi),))


def test_surfels_show_the_light_that_they_send_out(session):
    """L = rho / pi E on one side, nothing on the other; a column of pixels apart, as surfels are wider than pixels."""
    picture = picture_of(session, lit_floor(), view="cache", cache_resolution="64", bounces=0)
    assert np.allclose(picture[:, 18:], (0.8, 0.1, 0.1, 1), atol=1e-3)
    assert np.allclose(picture[:, :14], (0, 0, 0, 1))


def test_surfels_show_their_albedo_in_shades(session):
    picture = picture_of(session, lit_floor(), view="cache_albedo", cache_resolution="64")
    shade = picture[..., 0] / 0.8
    assert np.allclose(picture[..., :3], 0.8 * shade[..., None] * (1, 0.125, 0.125), atol=1e-3)
    assert 0.7 < shade.min() < 0.75 and 0.95 < shade.max() < 1


def test_surfels_show_nothing_where_there_is_nothing(session):
    far = scenes.scene(scenes.Thing(scenes.floor(0.5)), camera=above())
    alpha = picture_of(session, far, view="cache_albedo")[..., 3]
    assert 0 < alpha.mean() < 0.2 and set(np.unique(alpha)) == {0, 1}
