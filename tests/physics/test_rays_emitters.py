# SPDX-License-Identifier: GPL-3.0-or-later
"""Emissive surfaces, many lamps and a bright spot in the sky, drawn and found, against closed forms and sums. Each
pixel sees the point in its centre.
"""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes import lights
from svo_engine.passes.lights import emitters
from svo_engine.scene.types import Camera, Image, Material, Texture, World
from tests import scenes
from tests.on_gpu import film_of
from tests.rays import RAYS, above, floor_points, glow, rectangle_share, shot

FLAT = 0.8 / np.pi  # what the white floor sends back of the irradiance
UNDER = above(z=0.2, size=(24, 16))  # it sees the floor below what hangs over it
POINTS = floor_points(UNDER)
FLOOR = scenes.Thing(scenes.floor(4.0))
LOW, HIGH = (-0.2, -0.1), (0.3, 0.2)


def floor_light(session, *things, samples=16, **more) -> np.ndarray:
    """Irradiance (height, width) of the floor, without bounces."""
    scene = scenes.scene(FLOOR, *things, camera=UNDER, **more)
    return shot(session, scene, samples=samples, bounces=0)[..., 0] / FLAT


def panel(z=0.6, radiance=2.0, n=1, material=None, faces_down=True) -> scenes.Thing:
    """A level rectangle that glows."""
    u, v = (HIGH[0] - LOW[0], 0, 0), (0, HIGH[1] - LOW[1], 0)
    first, second = (v, u) if faces_down else (u, v)
    mesh = scenes.quad("Panel", (*LOW, z), first, second, n, uvs=material is not None)
    return scenes.Thing(mesh, material or glow(radiance))


@pytest.mark.parametrize(("z", "n"), [(0.6, 1), (0.6, 6), (0.25, 1), (0.25, 6)])
def test_a_panel_brings_its_form_factor(session, z, n):
    """E = pi L F at every point. What is drawn is uniform in the solid angle, so that of 16 samples 32 draws only the
    cosine and the choice of the triangle vary: no more than by half, which leaves a tenth of noise a pixel.
    """
    found = floor_light(session, panel(z, n=n))
    expected = 2 * np.pi * rectangle_share(POINTS, LOW, HIGH, z)
    assert abs(found.mean() / expected.mean() - 1) < 4 * 0.1 / np.sqrt(found.size)
    assert np.sqrt(((found / expected - 1) ** 2).mean()) < 0.1


def test_an_emitter_does_not_hide_itself(session):
    """Rays start off the floor by more than rounding, and all the more the farther it is from the scene's middle."""
    far = scenes.Thing(scenes.quad("Far", (40, -1, -90), (2, 0, 0), (0, 2, 0)), scenes.BLACK)
    found = floor_light(session, panel(), far)
    assert found.mean() == pytest.approx(floor_light(session, panel()).mean(), rel=0.01)


def test_both_sides_send_out(session):
    up, down = (floor_light(session, panel(faces_down=faces_down)) for faces_down in (False, True))
    assert np.isclose(up.mean(), down.mean(), rtol=4 * 0.1 / np.sqrt(up.size))


@pytest.mark.parametrize("alpha", [1.0, 0.25])
def test_emission_has_its_image_and_its_alpha(session, alpha):
    """Half of the panel glows: E is that of the half. A veil lets the floor's own rays through."""
    pixels = np.zeros((1, 2, 4), "f4")
    pixels[0, 1] = 1
    material = Material("Image", (0, 0, 0), specular_level=0, emission=(2, 2, 2), emission_texture=0, alpha=alpha)
    image = {"textures": (Texture(0, interpolation="Closest"),), "images": (Image("I", pixels),)}
    found = floor_light(session, panel(material=material, faces_down=False), samples=32, **image)
    expected = alpha * 2 * np.pi * rectangle_share(POINTS, (0.05, LOW[1]), HIGH, 0.6)
    assert found.mean() == pytest.approx(expected.mean(), rel=0.03)
    assert np.corrcoef(found.ravel(), expected.ravel())[0, 1] > 0.9


def rough_floor(roughness) -> scenes.Thing:
    return scenes.Thing(scenes.floor(4.0), Material("Metal", (1, 1, 1), roughness=roughness, metallic=1.0))


def seen_in_metal(session, thing, roughness, samples, **more) -> np.ndarray:
    """(height, width): what a metal floor reflects."""
    camera = Camera("Camera", scenes.look((0.1, -1.5, 0.8), (0, 0, 0)), (16, 12), lens=60.0)
    scene = scenes.scene(rough_floor(roughness), *thing, camera=camera, **more)
    return shot(session, scene, samples=samples, bounces=0)[..., 0]


@pytest.mark.parametrize("roughness", [0.1, 0.3, 0.6, 1.0])
def test_draws_and_rays_agree_on_what_metal_reflects(session, monkeypatch, roughness):
    """A panel weighed by the balance heuristic, and found by rays alone with four times the samples."""
    both = seen_in_metal(session, [panel()], roughness, 256)
    monkeypatch.setattr(emitters, "MOST", 0)
    session.forget()
    alone = seen_in_metal(session, [panel(n=2)], roughness, 1024)
    assert both.mean() == pytest.approx(alone.mean(), rel=0.02)


@pytest.mark.parametrize("roughness", [0.0, 0.1, 0.3, 0.6, 1.0])
@pytest.mark.parametrize("kind", ["AREA", "POINT", "SPOT", "SUN"])
def test_metal_shows_a_lamp_as_it_shows_a_glowing_surface(session, kind, roughness):
    """A lamp with a size and a mesh of the same radiance in the same place; beside what is wide, the mesh is drawn."""
    down = (0.05, 0.05, 0.6)
    if kind == "AREA":
        size = (HIGH[0] - LOW[0], HIGH[1] - LOW[1])
        lamp, thing = scenes.lamp("AREA", down, (*down[:2], 0), emitted=2.0, size=size), panel()
    elif kind == "SUN":
        lamp = scenes.lamp("SUN", (0, 0.88, 0.475), emitted=2 * np.pi * 0.1**2, angle=2 * np.arctan(0.1))
        far = scenes.moved(0, 880, 475) @ np.diag([100, 100, 100, 1])
        thing = scenes.Thing(scenes.sphere("Far", 1.0, 48), glow(2.0), (far,))
    else:
        radius = 0.15
        lamp = scenes.lamp(kind, down, (*down[:2], 0), emitted=2 * np.pi * radius**2, radius=radius, spot_angle=np.pi)
        thing = scenes.Thing(scenes.sphere("Bulb", radius, 24), glow(2.0), (scenes.moved(*down),))
    from_lamp = seen_in_metal(session, [], roughness, 256, lights=(lamp,))
    wide = scenes.Thing(scenes.quad("Wide", (-900, -900, -9), (1800, 0, 0), (0, 1800, 0)), scenes.BLACK)
    from_mesh = seen_in_metal(session, [thing, wide], roughness, 256)
    assert from_mesh.mean() > 0
    assert from_lamp.mean() == pytest.approx(from_mesh.mean(), rel=0.04)


def lamps(n: int, seed: int = 3):
    """n point lamps over the floor, the brightest a hundred times as bright as the faintest."""
    rng = np.random.default_rng(seed)
    at = rng.uniform((-1.5, -1.5, 0.3), (1.5, 1.5, 0.8), (n, 3))
    power = 10 ** rng.uniform(-2, 0, n)
    return tuple(scenes.lamp("POINT", p, emitted=e, radius=0.01) for p, e in zip(at, power, strict=True))


def sum_of(lamps_) -> np.ndarray:
    """I cos / d^2 of all, exactly."""
    total = np.zeros(POINTS.shape[:2])
    for lamp in lamps_:
        to = lamp.world_from_light[:3, 3] - POINTS
        total += lamp.emitted[0] * to[..., 2] / np.linalg.norm(to, axis=2) ** 3
    return total


@pytest.mark.parametrize("n", [9, 100, 1000])
def test_many_lamps_are_the_sum_of_them(session, n):
    """64 samples of four draws; the tree's choice is off by a factor of two at most times, so noise is some 1/16."""
    all_lamps = lamps(n)
    found, expected = floor_light(session, samples=64, lights=all_lamps), sum_of(all_lamps)
    assert abs(found.mean() / expected.mean() - 1) < 0.01
    assert np.sqrt(((found / expected - 1) ** 2).mean()) < 0.15


def test_a_thousand_lamps_cost_what_nine_do(session):
    """Draws, not lamps, are counted: and those of 1000 are as many as those of 9."""
    counts = []
    for n in (2, 9, 1000):
        scene = scenes.scene(FLOOR, camera=UNDER, lights=lamps(n))
        counts.append(film_of(session, scene, **RAYS).stats["counts"])
    assert [c["lamps in tree"] for c in counts] == [0, 9, 1000]
    assert [c["draws"] for c in counts] == [2, lights.TREE_DRAWS, lights.TREE_DRAWS]
    pixels = UNDER.size[0] * UNDER.size[1]
    assert [c["light draws"] for c in counts] == [c["draws"] * pixels for c in counts]


def test_what_is_not_there_is_not_drawn(session):
    scene = scenes.scene(FLOOR, camera=UNDER, world=World((1, 1, 1)))
    counts = film_of(session, scene, **RAYS).stats["counts"]
    assert (counts["draws"], counts["emitters"], counts["lamps in tree"]) == (0, 0, 0)


def test_a_small_bright_spot_in_the_sky_converges(session):
    """The sun as four texels of 64 x 128: rays hit it once in two thousand times, draws nearly always. Interpolation
    makes the radiance in a texel vary by as much as its mean; 16 draws leave a fourth of that.
    """
    light = np.full((64, 128, 4), 0.05, "f4")
    light[48:50, 70:72, :3] = 2000
    image = Image("Sky", light)
    found = floor_light(session, images=(image,), world=World((1, 1, 1), 0))
    rows = np.broadcast_to(np.arange(64)[:, None], (64, 128))
    latitude = (rows + 0.5) / 64 * np.pi - np.pi / 2
    fine = light[..., 0].astype("f8")
    expected = (fine * np.clip(np.sin(latitude), 0, None) * np.cos(latitude)).sum() * (np.pi / 64) * (2 * np.pi / 128)
    assert found.mean() == pytest.approx(expected, rel=0.02)
    assert found.std() / found.mean() < 0.3
