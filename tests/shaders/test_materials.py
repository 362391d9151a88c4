# SPDX-License-Identifier: GPL-3.0-or-later
"""bind/materials.glsl and bind/environment.glsl: texture look-ups against slow ones in numpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.passes.upload import upload
from svo_engine.scene.environment import direction_to_uv
from svo_engine.scene.types import Image, Material, Scene, Texture, World
from tests.compute import evaluate

MATERIALS = ("bind/materials.glsl",)
RNG = np.random.default_rng(1)
BYTES = RNG.integers(0, 256, (5, 7, 4)).astype("u1")
FLOATS = RNG.normal(size=(4, 3, 4)).astype("f4")
UV = np.concatenate([RNG.uniform(-2.5, 3.5, (400, 2)), [[0, 0], [1, 1], [0.5, 0.5], [1 / 7, 2 / 5]]]).astype("f4")


def meant(sums: np.ndarray, image: Image, texture: Texture) -> np.ndarray:
    """What sums (n, 4) of texels as they are stored mean."""
    rgb, alpha = sums[:, :3], sums[:, 3:]
    if texture.divides and image.is_associated:
        rgb = np.where((alpha == 0) | (alpha == 1), rgb, rgb / np.where(alpha == 0, 1, alpha))
    if image.is_srgb:
        rgb = np.where(rgb <= 0.04045, rgb / 12.92, ((np.maximum(rgb, 0) + 0.055) / 1.055) ** 2.4)
    return np.concatenate([rgb, alpha], 1)


def texel(pixels: np.ndarray, x: int, y: int, extension: str) -> np.ndarray:
    index = []
    for i, n in ((y, pixels.shape[0]), (x, pixels.shape[1])):
        if extension == "CLIP" and not 0 <= i < n:
            return np.zeros(4)
        mirrored = i % (2 * n) if i % (2 * n) < n else 2 * n - 1 - i % (2 * n)
        index.append({"REPEAT": i % n, "EXTEND": min(max(i, 0), n - 1), "CLIP": i, "MIRROR": mirrored}[extension])
    return pixels[index[0], index[1]]


def look_up(image: Image, texture: Texture, uv: np.ndarray) -> np.ndarray:
    """(n, 4) f8, one look-up after the other."""
    found: list[np.ndarray] = []
    pixels = image.pixels.astype("f8") / (255 if image.pixels.dtype == np.uint8 else 1)
    m = np.array(texture.uv_from_mesh).reshape(2, 3)
    for u, v in uv.astype("f8") @ m[:, :2].T + m[:, 2]:
        x, y = u * pixels.shape[1], v * pixels.shape[0]
        if texture.interpolation == "Closest":
            found.append(texel(pixels, int(np.floor(x)), int(np.floor(y)), texture.extension))
            continue
        x, y = x - 0.5, y - 0.5
        i, j = int(np.floor(x)), int(np.floor(y))
        corners = [[texel(pixels, i + a, j + b, texture.extension) for a in (0, 1)] for b in (0, 1)]
        rows = [(1 - (x - i)) * row[0] + (x - i) * row[1] for row in corners]
        found.append((1 - (y - j)) * rows[0] + (y - j) * rows[1])
    return meant(np.array(found), image, texture)


def on_device(device, kind, expression, scene, **inputs):
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        read = dict(gpu_scene.materials)
        words = {"u_words": read.pop("u_words")}
        return evaluate(device, kind, expression, MATERIALS, buffers=read, textures=words, **inputs)


def scene_of(image: Image, *textures: Texture) -> Scene:
    other = Image("Other", np.full((3, 3, 4), 99, "f4"))  # so that the first word is not 0
    return Scene(images=(other, image), textures=tuple(replace(texture, image=1) for texture in textures))


IMAGES = {"sRGB": Image("B", BYTES, is_srgb=True), "bytes": Image("B", BYTES), "floats": Image("F", FLOATS)}


@pytest.mark.parametrize("image", IMAGES.values(), ids=IMAGES.keys())
@pytest.mark.parametrize("extension", ["REPEAT", "EXTEND", "CLIP", "MIRROR"])
def test_linear_look_ups(device, image, extension):
    texture = Texture(0, extension=extension)
    found = on_device(device, "vec3", "texture_color(0, uv)", scene_of(image, texture), uv=UV)
    assert np.allclose(found, look_up(image, texture, UV)[:, :3], atol=2e-5)  # f4: coordinates up to 25 texels


@pytest.mark.parametrize("kind", ["sRGB", "floats"])
def test_alpha_is_divided_out_after_the_filter(device, kind):
    image = replace(IMAGES[kind], is_associated=True, pixels=np.maximum(IMAGES[kind].pixels, np.array(1).astype(
        IMAGES[kind].pixels.dtype)))
    texture = Texture(0, divides=True)
    found = on_device(device, "vec3", "texture_color(0, uv)", scene_of(image, texture), uv=UV)
    assert np.allclose(found, look_up(image, texture, UV)[:, :3], rtol=2e-4, atol=5e-5)  # f4, and divided


def test_tiles_lie_where_their_numbers_say(device):
    """Beyond them is magenta, as in Cycles, and coordinates below zero belong to the first."""
    tiles = tuple(Image("T", np.full((2, 2, 4), n / 10, "f4"), tile=n + 1000, n_tiles=3 - i)
                  for i, n in enumerate((1, 2, 11)))
    scene = Scene(images=(Image("Other", FLOATS), *tiles), textures=(Texture(1),))
    uv = np.array([[0.5, 0.5], [1.5, 0.5], [0.5, 1.5], [1.5, 1.5], [2.5, 0.5], [-0.5, 0.5]], "f4")
    found = on_device(device, "vec3", "texture_color(0, uv)", scene, uv=uv)
    assert np.allclose(found, [[0.1] * 3, [0.2] * 3, [1.1] * 3, [1, 0, 1], [1, 0, 1], [0.1] * 3], atol=1e-6)


@pytest.mark.parametrize("extension", ["REPEAT", "EXTEND", "CLIP", "MIRROR"])
def test_closest_look_ups(device, extension):
    """Away from the borders between texels, where rounding decides."""
    texture, image = Texture(0, extension=extension, interpolation="Closest"), IMAGES["bytes"]
    to_border = np.abs((UV * (7, 5) + 0.5) % 1 - 0.5)
    uv = UV[to_border.min(1) > 1e-3]
    found = on_device(device, "vec3", "texture_color(0, uv)", scene_of(image, texture), uv=uv)
    assert np.allclose(found, look_up(image, texture, uv)[:, :3], atol=1e-6)


@pytest.mark.parametrize("channel", [0, 1, 2, 3])
def test_one_channel_as_grey(device, channel):
    """Alpha is never sRGB-encoded."""
    texture, image = Texture(0, channel=channel), IMAGES["sRGB"]
    expected = look_up(image, texture, UV)[:, channel]
    scene = scene_of(image, texture)
    assert np.allclose(on_device(device, "vec3", "texture_color(0, uv)", scene, uv=UV), expected[:, None], atol=2e-5)
    assert np.allclose(on_device(device, "float", "texture_value(0, uv)", scene, uv=UV), expected, atol=2e-5)


def test_a_colour_as_number_is_its_luminance(device):
    texture, image = Texture(0), IMAGES["floats"]
    expected = look_up(image, texture, UV)[:, :3] @ [0.2126, 0.7152, 0.0722]
    found = on_device(device, "float", "texture_value(0, uv)", scene_of(image, texture), uv=UV)
    assert np.allclose(found, expected, atol=5e-5)


def test_the_mapping_moves_turns_and_scales(device):
    texture, image = Texture(0, uv_from_mesh=(0.5, -0.3, 0.1, 0.2, 0.7, -0.4)), IMAGES["floats"]
    found = on_device(device, "vec3", "texture_color(0, uv)", scene_of(image, texture), uv=UV)
    assert np.allclose(found, look_up(image, texture, UV)[:, :3], atol=5e-5)


def test_an_image_of_one_texel(device):
    image = Image("One", np.array([[[10, 20, 30, 255]]], "u1"))
    for extension in ("REPEAT", "EXTEND", "MIRROR"):
        scene = scene_of(image, Texture(0, extension=extension))
        found = on_device(device, "vec3", "texture_color(0, uv)", scene, uv=UV)
        assert np.allclose(found, np.array([10, 20, 30]) / 255, atol=1e-6)


def test_textures_multiply_the_materials_values(device):
    """All slots but the normal's, each with a texture of its own that is one number."""
    images = tuple(Image(str(i), np.full((1, 1, 4), 0.1 * (i + 1), "f4")) for i in range(5))
    material = Material("M", (0.5, 0.6, 0.7), roughness=0.9, metallic=0.8, alpha=0.5, emission=(1, 2, 3),
                        base_color_texture=0, roughness_texture=1, metallic_texture=2, emission_texture=3,
                        alpha_texture=4)
    scene = Scene(images=images, textures=tuple(Texture(i) for i in range(5)), materials=(material,))
    uv = np.full((1, 2), 0.5, "f4")

    def shading(kind, field):
        return on_device(device, kind, f"shading_at(materials[0], uv).{field}", scene, uv=uv)[0]

    assert np.allclose(shading("vec3", "base_color"), np.array([0.5, 0.6, 0.7]) * 0.1)
    assert np.allclose(shading("vec3", "emission"), np.array([1, 2, 3]) * 0.4)
    values = [shading("float", name) for name in ("roughness", "metallic", "alpha")]
    assert np.allclose(values, [0.9 * 0.2, 0.8 * 0.3, 0.5 * 0.5])


@pytest.mark.parametrize(("strength", "map_", "expected"), [
    (1.0, (0.5, 0.5, 1.0), (0, 0, 1)),
    (1.0, (1.0, 0.5, 0.5), (1, 0, 0)),
    (1.0, (0.5, 0.0, 0.5), (0, 1, 0)),  # v runs against y: the bitangent is -y
    (0.0, (1.0, 0.5, 0.5), (0, 0, 1)),
    (0.5, (1.0, 0.5, 0.5), (np.sqrt(0.5), 0, np.sqrt(0.5))),
])
def test_a_normal_map_is_in_tangent_space(device, strength, map_, expected):
    material = Material("M", normal_strength=strength, normal_texture=0)
    image = Image("Map", np.array([[[*map_, 1]]], "f4"))
    scene = Scene(images=(image,), textures=(Texture(0),), materials=(material,))
    call = "mapped_normal(materials[0], uv, vec3(0, 0, 1), vec3(3, 0, 1), vec3(0, -2, 0))"
    found = on_device(device, "vec3", call, scene, uv=np.zeros((1, 2), "f4"))
    assert np.allclose(found, [expected], atol=1e-6)


def directions(n: int = 500) -> np.ndarray:
    d = np.random.default_rng(2).normal(size=(n, 3))
    return (d / np.linalg.norm(d, axis=1, keepdims=True)).astype("f4")


def world_of(device, world: World, image: Image | None, tan_half_angle: float, d: np.ndarray) -> np.ndarray:
    gpu_scene = upload(device, Scene(world=world, images=(image,) if image else ()))
    uniforms = {**gpu_scene.world()}
    with gpu_scene.scope:
        return evaluate(device, "vec3", f"world_radiance(d, {tan_half_angle})", ("bind/environment.glsl",), d=d,
                        textures={"u_env": uniforms.pop("u_env")}, uniforms=uniforms)


def test_a_world_without_image_is_the_same_everywhere(device):
    assert np.allclose(world_of(device, World((1, 2, 3)), None, 0.5, directions()), [1, 2, 3])


def test_a_world_image_is_seen_where_the_contract_says(device):
    """Bilinear between texel centres, round in longitude, turned by the mapping."""
    image = Image("Sky", np.random.default_rng(3).uniform(size=(8, 16, 4)).astype("f4"))
    turn = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]], "f8")
    d = directions()
    d = d[np.abs(d[:, 2]) < 0.9]  # poles: the row above the highest is the highest, not the one across
    found = world_of(device, World((2, 1, 1), 0, turn), image, 0.0, d)
    x, y = (direction_to_uv(d @ turn.T) * (16, 8) - 0.5).T
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - i)[:, None], (y - j)[:, None]
    rows = [(1 - fx) * image.pixels[jj, i % 16, :3] + fx * image.pixels[jj, (i + 1) % 16, :3] for jj in (j, j + 1)]
    # Filters of graphics cards weigh with 8 bits
    assert np.allclose(found, ((1 - fy) * rows[0] + fy * rows[1]) * (2, 1, 1), atol=2 * 2 / 256)


def test_an_srgb_world_image_is_decoded(device):
    image = Image("Sky", np.full((2, 4, 4), 128, "u1"), is_srgb=True)
    assert np.allclose(world_of(device, World((1, 1, 1), 0), image, 0.0, directions(9)), 0.2158605, atol=1e-4)


def test_a_wide_cone_sees_the_mean_of_the_sky(device):
    image = Image("Sky", np.random.default_rng(3).uniform(size=(8, 16, 4)).astype("f4"))
    found = world_of(device, World((1, 1, 1), 0), image, 1e3, directions(50))
    assert np.allclose(found, image.pixels[..., :3].mean((0, 1)), atol=0.01)
