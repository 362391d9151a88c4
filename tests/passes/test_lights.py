# SPDX-License-Identifier: GPL-3.0-or-later
"""What light is drawn from: trees of lights, emissive triangles, the world's image."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.passes.lights import emitters, make_lights
from svo_engine.passes.lights.emitters import emitters_of
from svo_engine.passes.lights.glow import make_glow, make_sky_table
from svo_engine.passes.lights.sky import sky_table
from svo_engine.passes.lights.tree import leaf_of_light, light_tree
from svo_engine.passes.upload import linear_pixels, upload
from svo_engine.scene.environment import direction_to_uv
from svo_engine.scene.types import Image, Material, Texture, World
from tests import scenes
from tests.compute import evaluate
from tests.rays import TURN, glow

NO_LEAF = 0xFFFFFFFF
CHANCE = "leaf_probability(tree, leaf, p, normal)"
TREE = ("bind/light_tree.glsl",)
POINTS = np.array([(0, 0, 0), (0.3, -0.2, 0.1), (3, 1, 2), (-20, 5, 1), (0, 0, -9)], "f8")
NORMALS = np.array([(0, 0, 1), (0.6, 0, 0.8), (-1, 0, 0), (0.8, -0.6, 0), (0, 0, 1)], "f8")


def random_lights(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(n)
    low = rng.normal(size=(n, 3)) * (3, 2, 1)
    return low, low + 0.1 * rng.random((n, 3)), 0.1 + rng.random(n) ** 4


def on_device(device, nodes, kind, expression, **inputs):
    """An expression of bind/light_tree.glsl with `tree`, for every row."""
    with device.scope() as scope:
        texture = scope.texels("nodes", nodes)
        tree = f"uvec2(0u, {len(nodes) // 2}u)"
        prelude = (f"uint drawn(vec3 p, vec3 n, float u) {{ float _; return draw_leaf({tree}, p, n, u, _); }}\n"
                   f"float chance(vec3 p, vec3 n, float u) {{ float c; draw_leaf({tree}, p, n, u, c); return c; }}\n")
        rows = {name: np.asarray(rows, rows.dtype if rows.dtype.kind == "u" else "f4") for name, rows in inputs.items()}
        return evaluate(device, kind, expression.replace("tree", tree), TREE, prelude,
                        textures={"u_light_nodes": texture}, **rows)


@pytest.mark.parametrize("n", [1, 2, 3, 9, 64, 100, 1000])
def test_a_tree_holds_every_light_once_in_a_leaf(n):
    low, high, intensity = random_lights(n)
    nodes = light_tree(low, high, intensity)
    leaves = nodes[len(nodes) // 2:]
    assert len(leaves) < 2 * n
    assert sorted(leaves["light"][leaves["intensity"] > 0]) == list(range(n))
    found = leaves[leaf_of_light(nodes)]
    assert (found["light"] == np.arange(n)).all()
    assert np.allclose(found["low"], low) and np.allclose(found["high"], high)


@pytest.mark.parametrize("n", [2, 100, 1000])
def test_a_node_is_all_that_lies_below_it(n):
    nodes = light_tree(*random_lights(n))
    for i in range(1, len(nodes) // 2):
        children = nodes[2 * i:2 * i + 2]
        full = children[children["intensity"] > 0]
        assert np.isclose(nodes[i]["intensity"], full["intensity"].sum(), rtol=1e-6)
        if len(full):
            assert (nodes[i]["low"] == full["low"].min(0)).all() and (nodes[i]["high"] == full["high"].max(0)).all()


def test_a_hundred_thousand_lights_make_a_tree():
    nodes = light_tree(*random_lights(100_000))
    assert len(nodes) == 2**18
    size = np.linalg.norm(nodes["high"] - nodes["low"], axis=1)
    assert size[2**17:].mean() < size[2**10:2**11].mean() < size[2:4].mean()  # nodes get smaller downwards


def test_no_light_is_an_empty_tree():
    assert not light_tree(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))["intensity"].any()


@pytest.mark.parametrize("n", [1, 9, 100])
@pytest.mark.parametrize("i", range(len(POINTS)))
def test_the_probabilities_of_all_leaves_are_one(device, n, i):
    """Where all lights lie above the horizon; a box may seem to when what lies in it does not: then none is drawn."""
    nodes = light_tree(*random_lights(n))
    leaves = np.arange(len(nodes) // 2, dtype="u4")
    p, normal = (np.tile(rows[i], (len(leaves), 1)) for rows in (POINTS, NORMALS))
    found = on_device(device, nodes, "float", CHANCE, leaf=leaves, p=p, normal=normal)
    assert found.min() >= 0
    assert found.sum() <= 1 + 1e-5
    lowest = np.where(NORMALS[i] > 0, nodes["low"][1], nodes["high"][1])
    assert found.sum() == pytest.approx(1, rel=1e-5) or (lowest - POINTS[i]) @ NORMALS[i] < 0
    assert not found[nodes[len(nodes) // 2:]["intensity"] == 0].any() or n == 1


@pytest.mark.parametrize("i", range(len(POINTS)))
def test_a_leaf_is_drawn_as_often_as_its_probability_says(device, i):
    """Of 65536 even steps of u, each leaf gets its share to within its two ends; u has 24 bits and seven cuts."""
    nodes, n = light_tree(*random_lights(100)), 65536
    u = (np.arange(n) + 0.5) / n
    p, normal = (np.tile(rows[i], (n, 1)) for rows in (POINTS, NORMALS))
    drawn = on_device(device, nodes, "uint", "drawn(p, normal, u)", p=p, normal=normal, u=u)
    chance = on_device(device, nodes, "float", "chance(p, normal, u)", p=p, normal=normal, u=u)
    is_drawn = drawn != NO_LEAF
    assert is_drawn.any()
    drawn, chance, p, normal = drawn[is_drawn], chance[is_drawn], p[is_drawn], normal[is_drawn]
    found = on_device(device, nodes, "float", CHANCE, p=p, normal=normal, leaf=drawn)
    assert np.allclose(found, chance, rtol=1e-5)
    counts, expected = np.bincount(drawn, minlength=128), np.zeros(128)
    expected[drawn] = found * n
    assert np.abs(counts - expected).max() < 2


def test_no_light_above_the_horizon_is_left_out(device):
    """The probability of whatever shines on the front of a surface is above zero."""
    low, high, intensity = random_lights(100)
    nodes = light_tree(low, high, intensity)
    leaves = leaf_of_light(nodes)
    for p, normal in zip(POINTS, NORMALS, strict=True):
        rows = [np.tile(row, (100, 1)) for row in (p, normal)]
        found = on_device(device, nodes, "float", CHANCE, leaf=leaves, p=rows[0],
                          normal=rows[1])
        top = ((np.where(normal > 0, high, low) - p) * normal).sum(1)
        assert (found[top > 1e-4] > 0).all()


def bright_quad(name="Panel", radiance=5.0, place=None, n=1):
    place = np.eye(4) if place is None else place
    return scenes.Thing(scenes.quad(name, (0, 0, 1), (0.5, 0, 0), (0, 0.25, 0), n), glow(radiance), (place,))


def drawn_from(device, scene):
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        return emitters_of(gpu_scene.placing, gpu_scene.emission)


def test_emitters_are_the_glowing_triangles_where_they_are_placed(device):
    double = TURN @ np.diag([2, 2, 2, 1])
    scene = scenes.scene(scenes.Thing(scenes.floor(9.0)), bright_quad(n=2), bright_quad("Turned", 3.0, double))
    found = drawn_from(device, scene)
    assert len(found.work) == 8 + 2
    assert (np.diff(found.work.astype("i8")) > 0).all()
    assert found.intensity[:8].sum() == pytest.approx(5 * 0.125)
    assert found.intensity[8:].sum() == pytest.approx(3 * 0.125 * 4)
    assert (found.high >= found.low).all()
    corners = (TURN[:3, :3] @ (2 * np.array([(0, 0, 1), (0.5, 0, 1), (0, 0.25, 1), (0.5, 0.25, 1)]).T)).T
    low, high = scene.bounds()
    assert np.allclose(found.low[8:].min(0), corners.min(0) - (low + high) / 2, atol=1e-6)


def test_only_slots_that_glow_are_emitters(device):
    mesh = scenes.quad("Two slots", (0, 0, 0), (1, 0, 0), (0, 1, 0), 2)
    slots = (np.arange(8) % 2).astype("u4")
    two = scenes.scene(scenes.Thing(replace(mesh, material_slots=slots)), scenes.Thing(scenes.floor(9.0)))
    inst = two.instances
    placed = type(inst)(inst.names, inst.mesh, inst.world_from_object, np.array([0, 2, 3], "u4"),
                        np.array([0, 1, 0], "u4"))
    scene = type(two)(two.meshes, placed, (scenes.WHITE, glow(1.0)))
    assert drawn_from(device, scene).triangle.tolist() == [1, 3, 5, 7]


def test_what_glows_on_all_sides_is_left_to_rays(device):
    """More than a quarter of all rays hit it, and where all is equally bright they have no noise."""
    assert len(drawn_from(device, scenes.scene(bright_quad())).work) == 0
    assert len(drawn_from(device, scenes.scene(bright_quad(), scenes.Thing(scenes.floor(9.0)))).work) == 2


def test_what_has_most_triangles_is_left_to_rays(device, monkeypatch):
    monkeypatch.setattr(emitters, "MOST", 10)
    scene = scenes.scene(bright_quad("Fine", n=4), bright_quad("Coarse"), scenes.Thing(scenes.floor(9.0)))
    found = drawn_from(device, scene)
    assert len(found.work) == 2 and found.instance.tolist() == [1, 1]


def test_emission_counts_by_the_mean_of_its_image(device):
    pixels = np.zeros((2, 2, 4), "f4")
    pixels[0, 0] = 1
    material = Material("Image", emission=(8, 8, 8), emission_texture=0, alpha=0.5)
    panel = scenes.Thing(scenes.quad("Panel", (0, 0, 1), (1, 0, 0), (0, 1, 0), uvs=True), material)
    scene = scenes.scene(panel, scenes.Thing(scenes.floor(9.0)), textures=(Texture(0),), images=(Image("I", pixels),))
    assert drawn_from(device, scene).intensity.sum() == pytest.approx(8 / 4 * 0.5)


def sky_scene(light: np.ndarray, **more):
    pixels = np.ones((*light.shape, 4), "f4")
    pixels[..., :3] = light[..., None]
    return scenes.scene(scenes.Thing(scenes.floor()), images=(Image("Sky", pixels),), world=World((1, 1, 1), 0, **more))


def table_of(scene):
    return sky_table(scene.images[scene.world.image] if scene.world.image >= 0 else None, scene.world)


def glow_of(device, gpu_scene):
    table = make_sky_table(device, gpu_scene.sky, gpu_scene.scene.world)
    glow = make_glow(device, gpu_scene.placing, gpu_scene.emission, table)
    glow.scope.adopt(table.scope)
    return glow


def sunny(height=32, width=64):
    light = np.full((height, width), 0.1)
    light[22:24, 40:42] = 500
    return light


@pytest.mark.parametrize("light", [np.ones((8, 16)), np.zeros((8, 16)), np.linspace(1, 1.5, 8)[:, None] * np.ones(16)])
def test_an_even_sky_is_not_drawn(light):
    assert table_of(sky_scene(light)) is None


def test_a_sky_that_cannot_be_turned_back_is_not_drawn():
    assert table_of(sky_scene(sunny())) is not None
    assert table_of(sky_scene(sunny(), env_from_world=np.diag([1.0, 1, 0]))) is None
    assert table_of(scenes.scene(world=World((1, 1, 1)))) is None


def test_the_table_ascends_to_one():
    table = table_of(sky_scene(sunny()))
    assert table.shape == (32, 65)
    assert table[-1, 0] == 1 and (np.diff(table[:, 0]) >= 0).all()
    assert (table[:, -1] == 1).all() and (np.diff(table[:, 1:], axis=1) >= 0).all()


SKY = ("bind/sky.glsl",)
MAPPINGS = {"plain": np.eye(3), "turned": TURN[:3, :3], "stretched": np.diag([1.0, -2, 0.7]) @ TURN[:3, :3]}


@pytest.fixture(params=MAPPINGS, ids=list(MAPPINGS))
def sky(request, device):
    """A function that evaluates an expression of bind/sky.glsl for every row."""
    scene = sky_scene(sunny(), env_from_world=MAPPINGS[request.param])

    def of(kind, expression, **inputs):
        gpu_scene = upload(device, scene)
        with gpu_scene.scope:
            glow = glow_of(device, gpu_scene)
            with glow.scope:
                uniforms = {**gpu_scene.world(), **glow.sky()}
                textures = {name: uniforms.pop(name) for name in ("u_sky", "u_env")}
                rows = {name: values.astype("f4") for name, values in inputs.items()}
                return evaluate(device, kind, expression, SKY, uniforms=uniforms, textures=textures,
                                **rows).astype("f8")

    return of


def sphere_points(n: int) -> np.ndarray:
    """(2 n^2, 3) directions, each of the solid angle 2 pi / n^2."""
    z, phi = np.meshgrid((np.arange(n) + 0.5) / n * 2 - 1, (np.arange(2 * n) + 0.5) / n * np.pi)
    r = np.sqrt(1 - z**2)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], -1).reshape(-1, 3)


def test_the_density_of_the_sky_is_one_over_all_directions(sky):
    """2 n^2 midpoints cut texels, whose density is a step: 1e-2."""
    density = sky("float", "world_density(d)", d=sphere_points(500))
    assert density.mean() * 4 * np.pi == pytest.approx(1, rel=1e-2)


def test_what_is_drawn_of_the_sky_has_that_density(sky):
    """Directions on a texel's edge, where rounding decides, are a few in 65536."""
    u = np.random.default_rng(1).random((65536, 2))
    d, pdf = sky("vec3", "draw_sky(u).wi", u=u), sky("float", "draw_sky(u).pdf", u=u)
    found = sky("float", "world_density(d)", d=d)
    assert np.allclose(np.linalg.norm(d, axis=1), 1, atol=1e-5)
    assert (np.isclose(found, pdf, rtol=1e-3)).mean() > 0.999


def test_the_mean_of_the_draws_is_the_skys_light(sky):
    """The integral of radiance over all directions, by draws and by midpoints."""
    u = (np.stack(np.meshgrid(*[np.arange(512)] * 2), -1).reshape(-1, 2) + 0.5) / 512
    light = sky("vec3", "draw_sky(u).E_perp", u=u)[:, 0].mean()
    radiance = sky("vec3", "world_radiance(d, 0.0)", d=sphere_points(500))[:, 0]
    assert light == pytest.approx(radiance.mean() * 4 * np.pi, rel=1e-2)


def test_the_sun_in_the_image_is_where_most_draws_go(device):
    table = table_of(sky_scene(sunny()))
    rows = np.diff(table[:, 0], prepend=0)
    assert rows[21:25].sum() > 0.9
    uv = direction_to_uv(np.array([1.0, 0, 0]))
    assert np.allclose(uv, 0.5)


def test_linear_pixels_undo_the_encoding():
    image = Image("S", np.full((1, 1, 4), 188, "u1"), is_srgb=True)
    assert np.allclose(linear_pixels(image)[0, 0, :3], 0.5029, atol=1e-3)


@pytest.mark.parametrize(("n", "own", "in_tree"), [(0, 0, 0), (1, 1, 0), (8, 8, 0), (9, 0, 9)])
def test_a_few_lamps_are_drawn_each_by_itself(device, n, own, in_tree):
    """Suns always are, and black lamps never."""
    lamps = [scenes.lamp("POINT", (0.1 * i, 0, 1)) for i in range(n)]
    more = [scenes.lamp("SUN", (0, 0, 1)), scenes.lamp("POINT", (0, 0, 2), emitted=0.0)]
    gpu_scene = upload(device, scenes.scene(scenes.Thing(scenes.floor()), lights=(*lamps, *more)))
    with gpu_scene.scope:
        glow = glow_of(device, gpu_scene)
        lights = make_lights(device, gpu_scene.lamps, glow)
        with lights.scope, glow.scope:
            assert (lights.n_own, lights.n_in_tree) == (own + 1, in_tree)
            assert (lights.draws()["u_n_tree_draws"] > 0) == (in_tree > 0)
