# SPDX-License-Identifier: GPL-3.0-or-later
"""The world: what the extracted one shows in every direction must be what Cycles draws."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from svo_engine.scene.camera import make_view
from svo_engine.scene.environment import direction_to_uv
from tests.blender import cycles
from tests.blender.build import extracted, image, material, place, plane, world
from tests.blender.sampling import texels

SIZE = 16


@pytest.fixture
def camera(empty):
    """The scene's camera, 90 degrees wide, turned to nowhere in particular."""
    data = bpy.data.cameras.new("Camera")
    data.lens, data.sensor_width = 18, 36
    empty.camera = place(data, "Camera", turn=(1.1, 0.3, 0.7))
    empty.render.resolution_x = empty.render.resolution_y = SIZE
    empty.render.resolution_percentage = 100
    return empty.camera


def environment(nodes, **settings):
    """An Environment Texture node of few and different texels, without a blend between them."""
    rgba = np.random.default_rng(0).uniform(0.1, 1, (6, 12, 4))
    node = nodes.new("TexEnvironment")
    node.image, node.interpolation = image(rgba * (3, 3, 3, 1), is_float=True, alpha_mode="NONE"), "Closest"
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def directions(view):
    """World directions (SIZE, SIZE, 3) through the centres of the pixels."""
    x, y = np.meshgrid(*[(np.arange(SIZE) + 0.5) / SIZE * 2 - 1] * 2)
    near = np.stack([x, y, -np.ones_like(x), np.ones_like(x)], -1) @ np.linalg.inv(view.clip_from_view).T
    return near[..., :3] / near[..., 3:] @ view.world_from_view[:3, :3].T


def shown(scene):
    """The contract of `World`, slow and obvious: (SIZE, SIZE, 3)."""
    radiance = np.broadcast_to(scene.world.radiance, (SIZE, SIZE, 3))
    if scene.world.image < 0:
        return radiance
    pixels = texels(scene.images[scene.world.image])
    uv = direction_to_uv(directions(make_view(scene.camera)) @ scene.world.env_from_world.T)
    x, y = ((uv[..., i] * pixels.shape[1 - i]).astype(int) % pixels.shape[1 - i] for i in range(2))
    return radiance * pixels[y, x, :3]


def assert_shows_what_cycles_draws(folder):
    scene = extracted()
    drawn = cycles.render(folder, size=(SIZE, SIZE), samples=1, filter_width=0.01)
    np.testing.assert_allclose(shown(scene), drawn[..., :3], rtol=1e-4)
    return scene


@pytest.mark.parametrize("turn", [(1.1, 0.3, 0.7), (2.0, -0.5, 2.2), (0.2, 0.1, -1.4)])
def test_equirectangular_image(camera, tmp_path, turn):
    camera.rotation_euler = turn
    nodes = world()
    nodes.show(nodes.new("Background", Color=environment(nodes), Strength=0.5))
    assert assert_shows_what_cycles_draws(tmp_path).warnings == ()


@pytest.mark.parametrize("output", ["Generated", "Object"])
@pytest.mark.parametrize("kind", ["POINT", "TEXTURE", "VECTOR"])
def test_turned_image(camera, tmp_path, kind, output):
    nodes = world()
    mapping = nodes.new("Mapping", Vector=nodes.new("TexCoord").outputs[output], Rotation=(0.4, 0.9, -1.3))
    mapping.vector_type = kind
    texture = environment(nodes)
    nodes.set(texture, "Vector", mapping)
    nodes.show(nodes.new("Background", Color=texture))
    scene = assert_shows_what_cycles_draws(tmp_path)
    rotation = scene.world.env_from_world
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-6)


@pytest.mark.parametrize("scale", [(-1, 1, 1), (2, 2, 2), (1, 3, 0.5)])
def test_mirrored_and_scaled_image(camera, tmp_path, scale):
    nodes = world()
    texture = environment(nodes)
    nodes.set(texture, "Vector", nodes.new("Mapping", Vector=nodes.new("TexCoord").outputs["Generated"], Scale=scale))
    nodes.show(nodes.new("Background", Color=texture))
    rows = assert_shows_what_cycles_draws(tmp_path).world.env_from_world
    if len({abs(s) for s in scale}) == 1:
        np.testing.assert_allclose(rows @ rows.T, np.eye(3), atol=1e-6)


def test_moved_image_is_left_to_the_tree(camera):
    nodes = world()
    texture = environment(nodes)
    nodes.set(texture, "Vector",
              nodes.new("Mapping", Vector=nodes.new("TexCoord").outputs["Generated"], Location=(1, 0, 0)))
    nodes.show(nodes.new("Background", Color=texture))
    assert_is_compiled(extracted())


def test_bytes_are_decoded(camera, tmp_path):
    nodes = world()
    texture = environment(nodes)
    texture.image = image(np.random.default_rng(0).uniform(0.1, 1, (6, 12, 4)))
    nodes.show(nodes.new("Background", Color=texture))
    assert_shows_what_cycles_draws(tmp_path)


def test_colour_and_strength(camera, tmp_path):
    nodes = world()
    nodes.show(nodes.new("Background", Color=(0.2, 0.4, 0.6, 1), Strength=2.5))
    scene = assert_shows_what_cycles_draws(tmp_path)
    np.testing.assert_allclose(scene.world.radiance, (0.5, 1.0, 1.5))


def test_mix_of_backgrounds(camera, tmp_path):
    nodes = world()
    first, second = (nodes.new("Background", Color=color) for color in ((1, 0, 0, 1), (0, 1, 0, 1)))
    nodes.show(nodes.new("MixShader", Fac=0.25, Shader=first, Shader_001=second))
    assert assert_shows_what_cycles_draws(tmp_path).warnings == ()


def test_no_world(camera, tmp_path):
    assert assert_shows_what_cycles_draws(tmp_path).world.radiance == (0, 0, 0)


def test_world_whose_output_is_not_linked(camera, tmp_path):
    world()
    assert assert_shows_what_cycles_draws(tmp_path).world.radiance == (0, 0, 0)


@pytest.mark.skipif(bpy.app.version >= (5, 0, 0), reason="Blender 5 draws every world with nodes")
def test_world_without_nodes(camera, tmp_path):
    nodes = world()
    nodes.show(nodes.new("Background", Color=(1, 0, 0, 1)))
    nodes.owner.use_nodes, nodes.owner.color = False, (0.1, 0.2, 0.3)
    np.testing.assert_allclose(assert_shows_what_cycles_draws(tmp_path).world.radiance, (0.1, 0.2, 0.3))


def test_sky_is_compiled_and_the_colour_beside_it_stands_in(empty):
    nodes = world()
    background = nodes.new("Background", Color=(0.1, 0.2, 0.3, 1), Strength=2)
    nodes.set(background, "Color", nodes.new("TexSky"))
    nodes.show(background)
    scene = extracted()
    np.testing.assert_allclose(scene.world.radiance, (0.2, 0.4, 0.6))
    assert_is_compiled(scene)


def test_missing_image_is_magenta(camera, tmp_path):
    nodes = world()
    nodes.show(nodes.new("Background", Color=nodes.new("TexEnvironment")))
    scene = assert_shows_what_cycles_draws(tmp_path)
    assert scene.warnings == (
        "World 'World': node 'Environment Texture' has no image; it is drawn in magenta",)


def test_mirror_ball_is_compiled(empty):
    nodes = world()
    nodes.show(nodes.new("Background", Color=environment(nodes, projection="MIRROR_BALL")))
    assert_is_compiled(extracted())


def assert_is_compiled(scene):
    """The tree says what the values cannot, and nothing is told before it is compiled."""
    assert not scene.world.is_exact and scene.world.graph and scene.warnings == ()
    assert scene.plain.world.graph is scene.world.graph


def test_volume_is_told(empty):
    nodes = world()
    nodes.show(nodes.new("VolumePrincipled"), "Volume")
    assert extracted().warnings == ("World 'World': volume is left out",)


def test_image_that_world_and_material_share_is_read_once(empty):
    nodes = world()
    texture = environment(nodes)
    nodes.show(nodes.new("Background", Color=texture))
    surface = material()
    flat = surface.new("TexImage")
    flat.image = texture.image
    plane(surface.show(surface.new("Emission", Color=flat)))
    scene = extracted()
    assert len(scene.images) == 1
    assert scene.world.image == scene.textures[0].image == 0


def test_animated_strength(empty):
    nodes = world()
    background = nodes.new("Background", Color=(0.1, 0.2, 0.3, 1))
    nodes.show(background)
    strength = background.inputs["Strength"]
    for frame, value in ((1, 0), (11, 10)):
        strength.default_value = value
        strength.keyframe_insert("default_value", frame=frame)
    strength.default_value = 0
    empty.frame_set(11)
    np.testing.assert_allclose(extracted().world.radiance, (1, 2, 3))


def test_film_transparent(empty):
    assert not extracted().film_transparent
    empty.render.film_transparent = True
    assert extracted().film_transparent
