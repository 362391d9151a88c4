# SPDX-License-Identifier: GPL-3.0-or-later
"""Image textures: what the extracted texels and matrices show must be what Cycles draws, texel by texel."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.blender import cycles
from tests.blender.build import extracted, image, material, one_color, plane
from tests.blender.following import Followed
from tests.blender.sampling import closest

SIZE = 12  # pixels across the plane
MAGENTA = (1, 0, 1)

# Cycles multiplies bytes by alpha, cuts, and divides again: a step of a byte, decoded where sRGB is steepest
STRAIGHT_ALPHA = {"atol": 1 / 255 * 2.3, "rtol": 1e-4}
EXACT = {"atol": 1e-6, "rtol": 1e-4}  # 32-bit floats


def random_pixels(width=4, height=3):
    return np.random.default_rng(0).uniform(0.05, 1, (height, width, 4)).astype("f4")


def glowing(nodes, texture, output="Color"):
    """A plane with UVs from 0 to 1 that shines with a texture's output."""
    plane(nodes.show(nodes.new("Emission", Color=texture.outputs[output])))
    cycles.look_down(width=2)


def texture_node(nodes, datablock, interpolation="Closest", **settings):
    node = nodes.new("TexImage")
    node.image, node.interpolation = datablock, interpolation
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def pixel_uvs(n=SIZE):
    x, y = np.meshgrid(*[(np.arange(n) + 0.5) / n] * 2)
    return np.stack([x, y], 2)


def assert_shows_what_cycles_draws(folder, n=SIZE):
    """At the centres of pixels; none of them lies on a border between texels, where either side would be right."""
    scene = extracted()
    shown = closest(scene, scene.materials[0].emission_texture, pixel_uvs(n))
    if scene.materials[0].alpha_texture >= 0:
        shown = shown * closest(scene, scene.materials[0].alpha_texture, pixel_uvs(n))
    drawn = cycles.render(folder, size=(n, n), samples=1, filter_width=0.01)
    is_straight = scene.materials[0].alpha_texture >= 0
    np.testing.assert_allclose(shown, drawn[..., :3], **(STRAIGHT_ALPHA if is_straight else EXACT))
    assert np.ptp(shown) > 0.1  # a uniform picture would show nothing
    return scene


@pytest.mark.parametrize("extension", ["REPEAT", "EXTEND", "CLIP", "MIRROR"])
@pytest.mark.parametrize("kind", ["POINT", "TEXTURE", "VECTOR"])
def test_mapping_and_extension(empty, tmp_path, kind, extension):
    nodes = material()
    texture = texture_node(nodes, image(random_pixels(), alpha_mode="NONE"), extension=extension)
    mapping = nodes.new("Mapping", Vector=nodes.new("UVMap"), Location=(0.313, -0.27, 0.5), Rotation=(0.4, -0.7, 0.9),
                        Scale=(2.3, -1.7, 0.6))
    mapping.vector_type = kind
    nodes.set(texture, "Vector", mapping)
    glowing(nodes, texture)
    scene = assert_shows_what_cycles_draws(tmp_path)
    assert scene.warnings == ()


def test_chain_of_mappings(empty, tmp_path):
    nodes = material()
    texture = texture_node(nodes, image(random_pixels(), alpha_mode="NONE"))
    coordinates = nodes.new("TexCoord").outputs["UV"]
    first = nodes.new("Mapping", Vector=coordinates, Rotation=(0.9, 0.1, 0.2), Location=(0.1, 0.2, 0.3))
    second = nodes.new("Mapping", Vector=first, Rotation=(0.3, 0.8, -0.4), Scale=(1.5, 0.5, 2))
    nodes.set(texture, "Vector", second)
    glowing(nodes, texture)
    assert_shows_what_cycles_draws(tmp_path)


@pytest.mark.parametrize("reads_alpha", [False, True])
@pytest.mark.parametrize("alpha_mode", ["STRAIGHT", "CHANNEL_PACKED", "NONE"])
@pytest.mark.parametrize("space", ["sRGB", "Non-Color", "Linear Rec.709"])
def test_bytes_with_alpha(empty, tmp_path, space, alpha_mode, reads_alpha):
    _assert_alpha_is_cycles(tmp_path, image(random_pixels(), space=space, alpha_mode=alpha_mode), reads_alpha)


@pytest.mark.parametrize("reads_alpha", [False, True])
def test_floats_with_alpha(empty, tmp_path, reads_alpha):
    """Beyond 0 to 1, too."""
    made = image(random_pixels() * (9, 9, 9, 1), is_float=True, alpha_mode="PREMUL")
    _assert_alpha_is_cycles(tmp_path, made, reads_alpha)


def _assert_alpha_is_cycles(folder, datablock, reads_alpha):
    """Cycles hands out other colours as soon as the material reads the alpha of the same node."""
    nodes = material()
    texture = texture_node(nodes, datablock)
    shown = nodes.new("Emission", Color=texture)
    if reads_alpha:
        clear = nodes.new("BsdfTransparent")
        shown = nodes.new("MixShader", Fac=texture.outputs["Alpha"], Shader=clear, Shader_001=shown)
    plane(nodes.show(shown))
    cycles.look_down(width=2)
    assert_shows_what_cycles_draws(folder)


def test_alpha_output(empty, tmp_path):
    nodes = material()
    glowing(nodes, texture_node(nodes, image(random_pixels())), output="Alpha")
    scene = assert_shows_what_cycles_draws(tmp_path)
    assert scene.textures[0].channel == 3


@pytest.mark.parametrize("channel", [0, 1, 2])
@pytest.mark.parametrize("separate", ["SeparateColor", "SeparateXYZ"])
def test_one_channel(empty, tmp_path, separate, channel):
    nodes = material()
    texture = texture_node(nodes, image(random_pixels(), space="Non-Color", alpha_mode="NONE"))
    node = nodes.new(separate)
    nodes.set(node, node.inputs[0].identifier, texture)
    plane(nodes.show(nodes.new("Emission", Color=node.outputs[channel])))
    cycles.look_down(width=2)
    assert_shows_what_cycles_draws(tmp_path)


def test_image_file(empty, tmp_path):
    made = image(random_pixels(), alpha_mode="NONE")
    made.filepath_raw, made.file_format = str(tmp_path / "image.png"), "PNG"
    made.save()
    loaded = bpy.data.images.load(made.filepath_raw)
    bpy.data.images.remove(made)
    nodes = material()
    glowing(nodes, texture_node(nodes, loaded))
    assert_shows_what_cycles_draws(tmp_path)


def test_packed_image_needs_no_file(empty, tmp_path):
    path = tmp_path / "image.png"
    made = image(random_pixels(), alpha_mode="NONE")
    made.filepath_raw, made.file_format = str(path), "PNG"
    made.save()
    loaded = bpy.data.images.load(str(path))
    loaded.pack()
    path.unlink()
    nodes = material()
    glowing(nodes, texture_node(nodes, loaded))
    assert assert_shows_what_cycles_draws(tmp_path).warnings == ()


def test_generated_image(empty):
    made = bpy.data.images.new("Grid", 16, 8)
    made.generated_type = "COLOR_GRID"
    nodes = material()
    glowing(nodes, texture_node(nodes, made))
    found, = extracted().images
    assert found.pixels.shape == (8, 16, 4)
    assert found.is_srgb


def _missing(tmp_path):
    made = bpy.data.images.new("Wood", 4, 4)
    made.source, made.filepath = "FILE", str(tmp_path / "wood.png")
    return made, f"Image 'Wood' cannot be read from '{tmp_path / 'wood.png'}'; it is drawn in magenta"


def _nonsense(tmp_path):
    (tmp_path / "wood.png").write_bytes(b"no image at all")
    return _missing(tmp_path)


def _no_image(_tmp_path):
    return None, "Material 'Material': node 'Image Texture' has no image; it is drawn in magenta"


@pytest.mark.parametrize("make", [_missing, _nonsense, _no_image])
def test_missing_image_is_magenta_as_in_cycles(empty, tmp_path, make):
    datablock, warning = make(tmp_path)
    nodes = material()
    glowing(nodes, texture_node(nodes, datablock))
    scene = extracted()
    assert scene.warnings == (warning,)
    np.testing.assert_array_equal(closest(scene, 0, (0.3, 0.3)), MAGENTA)
    np.testing.assert_allclose(cycles.render(tmp_path, samples=1)[..., :3], np.broadcast_to(MAGENTA, (4, 4, 3)))


def _files(folder, name, colors):
    """Files of one colour each, by number."""
    for number, color in colors.items():
        made = one_color(*color)
        made.filepath_raw, made.file_format = str(folder / name.format(number)), "PNG"
        made.save()
        bpy.data.images.remove(made)


def test_frames_of_a_sequence(empty, tmp_path):
    _files(tmp_path, "wood_{:04d}.png", {n: (n / 5, 0.2, 0, 1) for n in (1, 2, 3)})
    made = bpy.data.images.load(str(tmp_path / "wood_0001.png"))
    made.source = "SEQUENCE"
    nodes = material()
    texture = texture_node(nodes, made)
    texture.image_user.frame_duration, texture.image_user.use_auto_refresh = 3, True
    glowing(nodes, texture)
    for frame in (1, 3):
        bpy.context.scene.frame_set(frame)
        n_before = len(bpy.data.images)
        scene = extracted()
        assert len(bpy.data.images) == n_before
        assert scene.images[0].name == f"wood_0001.png [{frame}]"
        shown = closest(scene, 0, (0.3, 0.3))
        np.testing.assert_allclose(cycles.render(tmp_path, samples=1)[..., :3], np.broadcast_to(shown, (4, 4, 3)), 1e-4)


def test_frame_that_is_missing_is_magenta(empty, tmp_path):
    made, _ = _missing(tmp_path)
    made.source = "SEQUENCE"
    nodes = material()
    glowing(nodes, texture_node(nodes, made))
    sentence, = extracted().warnings
    assert sentence.startswith("Image 'Wood' cannot be read from")


@pytest.mark.parametrize("is_packed", [False, True])
def test_tiles(empty, tmp_path, is_packed):
    _files(tmp_path, "t.{}.png", {1001: (0, 1, 0, 1), 1002: (1, 0, 0, 1), 1011: (0, 0, 1, 1)})
    tiled = bpy.data.images.load(str(tmp_path / "t.1001.png"))
    tiled.source, tiled.filepath, tiled.name = "TILED", str(tmp_path / "t.<UDIM>.png"), "Tiles"
    if is_packed:
        tiled.pack()
        for path in tmp_path.glob("t.*.png"):
            path.unlink()
    nodes = material()
    glowing(nodes, texture_node(nodes, tiled))
    scene = extracted()
    assert scene.warnings == ()
    assert [(image.name, image.tile) for image in scene.images] == [("Tiles", n) for n in (1001, 1002, 1011)]
    assert [tuple(image.pixels[0, 0]) for image in scene.images] == [
        (0, 255, 0, 255), (255, 0, 0, 255), (0, 0, 255, 255)]


@pytest.mark.parametrize("space", [
    "ACEScg", "ACES2065-1", "Linear Rec.2020", "Linear DCI-P3 D65", "Display P3", "Rec.1886", "Rec.2020",
    "Linear CIE-XYZ D65", "Linear CIE-XYZ E", "Linear FilmLight E-Gamut"])
def test_colour_spaces(empty, tmp_path, space):
    """Cycles keeps them as halves, of 11 bits, cut before and after the matrix."""
    try:
        made = image(random_pixels(), space=space, alpha_mode="NONE")
    except TypeError:
        pytest.skip("this Blender does not have the space")
    nodes = material()
    glowing(nodes, texture_node(nodes, made))
    scene = extracted()
    assert scene.warnings == ()
    shown = closest(scene, scene.materials[0].emission_texture, pixel_uvs())
    drawn = cycles.render(tmp_path, size=(SIZE, SIZE), samples=1, filter_width=0.01)
    np.testing.assert_allclose(shown, drawn[..., :3], atol=4e-3)


def test_colour_space_that_is_not_supported_is_told(empty):
    nodes = material()
    glowing(nodes, texture_node(nodes, one_color(1, 1, 1, 1, space="Filmic Log")))
    scene = extracted()
    assert scene.images[0].is_srgb
    assert scene.warnings == (
        "Image 'Image' is in the colour space 'Filmic Log', which is not supported; sRGB is used",)


def test_each_image_is_stored_once(empty):
    shared = one_color(1, 0, 0, 1)
    for name in ("A", "B"):
        nodes = material(name)
        glowing(nodes, texture_node(nodes, shared))
    nodes = material("C")
    texture = texture_node(nodes, shared)
    nodes.new("Emission", Strength=texture.outputs["Alpha"])
    glowing(nodes, texture)
    scene = extracted()
    assert len(scene.images) == 1
    assert [texture.divides for texture in scene.textures] == [False, True]


def test_image_that_nothing_shows_is_not_read(empty):
    nodes = material()
    texture_node(nodes, one_color(1, 0, 0, 1))
    plane(nodes.show(nodes.new("BsdfPrincipled")))
    other = material("Unused")
    other.show(other.new("Emission", Color=texture_node(other, one_color(0, 1, 0, 1))))
    assert extracted().images == ()


def test_images_of_nodes_that_a_plain_material_does_not_read(empty):
    """Once each, by full name."""
    nodes = material()
    shared = one_color(1, 0, 0, 1)
    inside = nodes.new("BrightContrast", Color=texture_node(nodes, shared))
    glowing(nodes, inside, "Color")
    nodes = material("Other")
    plane(nodes.show(nodes.new("BsdfPrincipled", Base_Color=texture_node(nodes, shared))), name="Other")
    assert [image.name for image in extracted().images] == [shared.name_full]


@pytest.mark.parametrize(("setting", "value"), [("projection", "BOX"), ("interpolation", "Cubic")])
def test_how_the_values_cannot_read_an_image(empty, setting, value):
    nodes = material()
    texture = texture_node(nodes, one_color(1, 0, 0, 1))
    setattr(texture, setting, value)
    glowing(nodes, texture)
    scene = extracted()
    assert not scene.materials[0].is_exact
    assert scene.warnings == ()


def test_other_coordinates_than_uvs_are_not_exact(empty):
    nodes = material()
    texture = texture_node(nodes, one_color(1, 0, 0, 1))
    nodes.set(texture, "Vector", nodes.new("TexCoord").outputs["Generated"])
    glowing(nodes, texture)
    assert not extracted().materials[0].is_exact


def test_uv_map_other_than_the_active_one_is_not_exact(empty):
    nodes = material()
    texture, uv_map = texture_node(nodes, one_color(1, 0, 0, 1)), nodes.new("UVMap")
    nodes.set(texture, "Vector", uv_map)
    glowing(nodes, texture)
    followed = Followed()
    for name in ("", "UVMap", "Second"):
        scene = followed.after(lambda name=name: setattr(uv_map, "uv_map", name))
        assert scene.materials[0].is_exact == extracted().materials[0].is_exact == (name != "Second")
        assert scene.warnings == ()
