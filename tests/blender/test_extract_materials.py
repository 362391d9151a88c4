# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as the values of a Principled BSDF: what is read, what is exact, and what is told."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest

from svo_engine.scene.types import Material
from tests.blender import cycles
from tests.blender.build import extracted, image, lamp, material, one_color, place, plane, world

BLACK = Material("Material", base_color=(0, 0, 0), specular_level=0, roughness=1)


def read(nodes, shader):
    """The scene in which a plane has the material whose surface is `shader`."""
    plane(nodes.show(shader))
    return extracted()


def only_material(nodes, shader):
    """That material, of which the values must say all."""
    scene = read(nodes, shader)
    assert scene.warnings == ()
    found, = scene.materials
    assert found.is_exact
    return found


def stand_in(nodes, shader):
    """That material, of which the values must not say all; its tree does."""
    found, = read(nodes, shader).materials
    assert not found.is_exact
    assert found.graph.surface is not None
    return found


def only_warning(scene):
    warning, = scene.warnings
    assert warning.startswith("Material 'Material': ")
    return warning.removeprefix("Material 'Material': ")


def assert_same(found, expected):
    """Equal but for the 32-bit floats of Blender, and for what the tree says more."""
    for name, value in vars(replace(expected, graph=found.graph, is_exact=found.is_exact)).items():
        exact = isinstance(value, (str, int))
        assert getattr(found, name) == (value if exact else pytest.approx(value, abs=1e-6)), name


def textured(nodes, *rgba, **options):
    node = nodes.new("TexImage")
    node.image = one_color(*rgba or (1, 0, 0, 1), **options)
    return node


def test_default_principled_is_the_default_material(empty):
    nodes = material()
    assert_same(only_material(nodes, nodes.new("BsdfPrincipled")), Material("Material"))


def test_values_of_principled(empty):
    nodes = material()
    assert_same(
        only_material(nodes, nodes.new(
            "BsdfPrincipled", Base_Color=(0.1, 0.2, 0.3, 1), Roughness=0.4, Metallic=0.6, IOR=1.7,
            Specular_IOR_Level=0.8, Specular_Tint=(0.9, 0.8, 0.7, 1), Transmission_Weight=0.3, Alpha=0.9,
            Emission_Color=(0.5, 0.25, 1, 1), Emission_Strength=4)),
        Material("Material", (0.1, 0.2, 0.3), 0.4, 0.6, 1.7, 0.8, (0.9, 0.8, 0.7), 0.3, 0.9, (2, 1, 4)))


@pytest.mark.parametrize(("socket", "field", "constant"), [
    ("Base Color", "base_color", (1, 1, 1)), ("Roughness", "roughness", 1), ("Metallic", "metallic", 1),
    ("Alpha", "alpha", 1), ("Emission Color", "emission", (3, 3, 3))])
def test_textures_of_principled(empty, socket, field, constant):
    """The constant beside the socket does not matter: what is left is 1, or the emission's strength."""
    nodes = material()
    shader = nodes.new("BsdfPrincipled", Emission_Strength=3 if field == "emission" else 0)
    nodes.set(shader, socket, textured(nodes))
    found = only_material(nodes, shader)
    assert getattr(found, field) == constant
    assert getattr(found, f"{field}_texture") == 0
    assert sorted(found.textures) == [-1, -1, -1, -1, -1, 0]


def test_one_image_for_several_values(empty):
    """Occlusion, roughness, metallic packed into one image, as glTF files have it."""
    nodes = material()
    split = nodes.new("SeparateColor", Color=textured(nodes, space="Non-Color"))
    found = read(nodes, nodes.new("BsdfPrincipled", Roughness=split.outputs["Green"], Metallic=split.outputs["Blue"]))
    assert len(found.images) == 1
    shown = found.materials[0]
    assert [found.textures[i].channel for i in (shown.roughness_texture, shown.metallic_texture)] == [1, 2]


@pytest.mark.parametrize("pixels", [(0.5, 0.5, 0.5, 1), (0.5, 0.1, 0.1, 1)])
def test_texture_as_strength(empty, pixels):
    nodes = material()
    strength = textured(nodes, *pixels)
    scene = read(nodes, nodes.new("BsdfPrincipled", Emission_Color=(1, 0.5, 0, 1), Emission_Strength=strength))
    found = scene.materials[0]
    assert found.emission == (1, 0.5, 0)
    assert scene.textures[found.emission_texture].channel == 0
    assert found.is_exact == (pixels[0] == pixels[1])


def test_two_textures_that_multiply_are_not_exact(empty):
    nodes = material()
    found = stand_in(nodes, nodes.new("Emission", Color=textured(nodes), Strength=textured(nodes, 0, 1, 0, 1)))
    assert found.emission_texture >= 0


def test_normal_map(empty):
    nodes = material()
    bumps = nodes.new("NormalMap", Color=textured(nodes, 0.5, 0.5, 1, 1, space="Non-Color"), Strength=0.7)
    found = only_material(nodes, nodes.new("BsdfPrincipled", Normal=bumps))
    assert found.normal_texture == 0
    assert found.normal_strength == pytest.approx(0.7)


def test_normal_map_without_a_texture_is_none(empty):
    nodes = material()
    assert only_material(nodes, nodes.new("BsdfPrincipled", Normal=nodes.new("NormalMap"))).normal_texture == -1


@pytest.mark.parametrize("kind", ["Bump", "NormalMap"])
def test_other_normals_are_not_exact(empty, kind):
    nodes = material()
    bumps = nodes.new(kind)
    if kind == "NormalMap":
        bumps.space = "OBJECT"
    assert stand_in(nodes, nodes.new("BsdfPrincipled", Normal=bumps)).normal_texture == -1


def test_constant_normal_map_is_not_exact(empty):
    nodes = material()
    bumps = nodes.new("NormalMap", Color=(0.6, 0.5, 1, 1))
    assert stand_in(nodes, nodes.new("BsdfPrincipled", Normal=bumps)).normal_texture == -1


def test_diffuse_shader(empty):
    nodes = material()
    found = only_material(nodes, nodes.new("BsdfDiffuse", Color=(0.2, 0.4, 0.6, 1)))
    assert_same(found, replace(BLACK, base_color=(0.2, 0.4, 0.6)))


@pytest.mark.parametrize("is_white", [True, False])
@pytest.mark.parametrize(("kind", "inputs", "expected"), [
    ("BsdfAnisotropic", {"Roughness": 0.3}, {"metallic": 1, "base_color": (0.2, 0.4, 0.6)}),
    ("BsdfGlass", {"Roughness": 0.3, "IOR": 1.3}, {"transmission": 1, "ior": 1.3, "base_color": (0.04, 0.16, 0.36)})])
def test_shaders_that_reflect(empty, kind, inputs, expected, is_white):
    """Their colour is that of all angles, where the values reflect white at grazing ones: white is exact."""
    nodes = material()
    color = (1, 1, 1, 1) if is_white else (0.2, 0.4, 0.6, 1)
    found = (only_material if is_white else stand_in)(nodes, nodes.new(kind, Color=color, **inputs))
    white = {"base_color": (1, 1, 1)} if is_white else {}
    assert_same(found, replace(BLACK, **{**expected, **white, "roughness": 0.3, "specular_level": 0.5}))


@pytest.mark.parametrize("kind", ["BsdfPrincipled", "BsdfAnisotropic", "BsdfGlass"])
def test_other_distributions_are_not_exact(empty, kind):
    nodes = material()
    shader = nodes.new(kind)
    if kind != "BsdfPrincipled":
        nodes.set(shader, "Color", (1, 1, 1, 1))
    shader.distribution = "GGX"
    stand_in(nodes, shader)


@pytest.mark.skipif(not hasattr(bpy.types, "ShaderNodeBsdfMetallic"), reason="Blender 4.3 brought it")
def test_metallic_shader(empty):
    nodes = material()
    metal = nodes.new("BsdfMetallic", Base_Color=(0.2, 0.4, 0.6, 1), Edge_Tint=(0.9, 0.5, 0.1, 1), Roughness=0.3)
    assert_same(only_material(nodes, metal),
                Material("Material", (0.2, 0.4, 0.6), 0.3, 1.0, specular_tint=(0.9, 0.5, 0.1)))


@pytest.mark.parametrize("kind", ["Emission", "Background"])
def test_emission(empty, kind):
    nodes = material()
    found = only_material(nodes, nodes.new(kind, Color=(0.2, 0.4, 0.6, 1), Strength=2))
    assert_same(found, replace(BLACK, emission=(0.4, 0.8, 1.2)))


def test_transparent(empty):
    nodes = material()
    assert_same(only_material(nodes, nodes.new("BsdfTransparent")), replace(BLACK, alpha=0))


def test_coloured_transparency_is_not_exact(empty):
    nodes = material()
    assert stand_in(nodes, nodes.new("BsdfTransparent", Color=(1, 0, 0, 1))).alpha == 0


def mixed(nodes, first, second, factor):
    return nodes.new("MixShader", Fac=factor, Shader=first, Shader_001=second)


def test_mix_with_transparent_is_alpha(empty):
    nodes = material()
    clear, solid = nodes.new("BsdfTransparent"), nodes.new("BsdfPrincipled", Alpha=0.5)
    assert_same(only_material(nodes, mixed(nodes, clear, solid, 0.3)), Material("Material", alpha=0.15))


def test_mix_with_transparent_the_other_way_round(empty):
    nodes = material()
    clear, solid = nodes.new("BsdfTransparent"), nodes.new("BsdfPrincipled")
    assert_same(only_material(nodes, mixed(nodes, solid, clear, 0.3)), Material("Material", alpha=0.7))


def test_mix_with_transparent_by_a_texture(empty):
    nodes = material()
    leaf = textured(nodes)
    clear, solid = nodes.new("BsdfTransparent"), nodes.new("BsdfPrincipled", Base_Color=leaf)
    scene = read(nodes, mixed(nodes, clear, solid, leaf.outputs["Alpha"]))
    found = scene.materials[0]
    assert scene.warnings == ()
    assert found.alpha == 1
    assert scene.textures[found.alpha_texture].channel == 3
    assert scene.textures[found.base_color_texture].channel == -1


@pytest.mark.parametrize("factor", [0.0, 1.0])
def test_mix_that_is_all_one_shader(empty, factor):
    nodes = material()
    first, second = nodes.new("BsdfGlass"), nodes.new("BsdfPrincipled", Roughness=0.1)
    found = only_material(nodes, mixed(nodes, first, second, factor))
    assert found.transmission == 1 - factor


def test_mix_of_two_that_reflect_is_not_exact(empty):
    nodes = material()
    found = stand_in(nodes, mixed(nodes, nodes.new("BsdfGlass"), nodes.new("BsdfPrincipled", Roughness=0.1), 0.7))
    assert found.roughness == pytest.approx(0.1)


def test_sum_of_two_that_reflect_is_not_exact(empty):
    nodes = material()
    both = nodes.new("AddShader", Shader=nodes.new("BsdfGlass"), Shader_001=nodes.new("BsdfPrincipled"))
    assert stand_in(nodes, both).transmission == 1


def test_shader_that_many_show_is_read_once(empty):
    """2^300 ways through it, and deeper than Python may call itself."""
    nodes = material()
    before = nodes.new("BsdfPrincipled", Roughness=0.1)
    for _ in range(300):
        before = mixed(nodes, before, before, 0.3)
    stand_in(nodes, before)


def test_colour_as_a_surface_shines(empty):
    nodes = material()
    color = nodes.new("RGB")
    color.outputs[0].default_value = (0.1, 0.2, 0.3, 1)
    assert_same(only_material(nodes, color), replace(BLACK, emission=(0.1, 0.2, 0.3)))


def _add_emission(nodes):
    return nodes.new("AddShader", Shader=nodes.new("BsdfDiffuse", Color=(0.2, 0.4, 0.6, 1)),
                     Shader_001=nodes.new("Emission", Color=(0.3, 0.2, 0.1, 1)))


def _add_two_emissions(nodes):
    return nodes.new("AddShader", Shader=nodes.new("Emission", Color=(0.3, 0.2, 0.1, 1)),
                     Shader_001=nodes.new("Emission", Color=(0, 0.1, 0.5, 1)))


def _mix_emission(nodes):
    return mixed(nodes, nodes.new("BsdfDiffuse", Color=(0.2, 0.4, 0.6, 1)), nodes.new("Emission", Strength=2), 0.3)


def _mix_with_nothing(nodes):
    return nodes.new("MixShader", Fac=0.25, Shader=nodes.new("BsdfDiffuse", Color=(0.2, 0.4, 0.6, 1)))


def _mix_with_clear(nodes):
    return mixed(nodes, _mix_emission(nodes), nodes.new("BsdfTransparent"), 0.4)


def _add_nothing(nodes):
    return nodes.new("AddShader", Shader_001=nodes.new("BsdfDiffuse", Color=(0.2, 0.4, 0.6, 1)))


@pytest.mark.parametrize("make", [_add_emission, _add_two_emissions, _mix_emission, _mix_with_nothing, _mix_with_clear,
                                  _add_nothing])
def test_sums_that_are_exact_look_as_in_cycles(empty, tmp_path, make):
    """A plane over a glowing world, under a sun: L = alpha (rho E / pi + emission) + (1 - alpha) L_world."""
    nodes = material()
    plane(nodes.show(make(nodes)))
    lamp("SUN", energy=2, angle=0)
    cycles.look_down()
    sky = world()
    sky.show(sky.new("Background", Color=(0.5, 0.5, 0.5, 1)))
    scene = extracted()
    assert scene.warnings == ()
    found = scene.materials[0]
    assert found.specular_level == 0
    reflected = np.multiply(found.base_color, (2 + np.pi * 0.5) / np.pi)
    expected = found.alpha * (reflected + found.emission) + (1 - found.alpha) * 0.5
    seen = cycles.render(tmp_path, samples=256)[..., :3].mean((0, 1))
    # The world is sampled: 16 pixels times 256 directions
    np.testing.assert_allclose(seen, expected, rtol=5e-3)


def test_groups_reroutes_and_muted_nodes(empty):
    """A group in a group: colours go in by the outer one's constant and by a link, the shader comes out."""
    inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    outer = bpy.data.node_groups.new("Outer", "ShaderNodeTree")
    for tree in (inner, outer):
        tree.interface.new_socket("Color", in_out="INPUT", socket_type="NodeSocketColor")
        tree.interface.new_socket("Rough", in_out="INPUT", socket_type="NodeSocketFloat")
        tree.interface.new_socket("Out", in_out="OUTPUT", socket_type="NodeSocketShader")
    start, end, shader = (inner.nodes.new(n) for n in ("NodeGroupInput", "NodeGroupOutput", "ShaderNodeBsdfPrincipled"))
    inner.links.new(start.outputs["Color"], shader.inputs["Base Color"])
    inner.links.new(start.outputs["Rough"], shader.inputs["Roughness"])
    inner.links.new(shader.outputs[0], end.inputs[0])
    start, end, group = (outer.nodes.new(n) for n in ("NodeGroupInput", "NodeGroupOutput", "ShaderNodeGroup"))
    group.node_tree = inner
    reroute = outer.nodes.new("NodeReroute")
    outer.links.new(start.outputs["Color"], reroute.inputs[0])
    outer.links.new(reroute.outputs[0], group.inputs["Color"])
    outer.links.new(start.outputs["Rough"], group.inputs["Rough"])
    outer.links.new(group.outputs[0], end.inputs[0])
    nodes = material()
    shown = nodes.new("Group")
    shown.node_tree = outer
    shown.inputs["Rough"].default_value = 0.25
    muted = nodes.new("HueSaturation", Color=textured(nodes))
    muted.mute = True
    nodes.tree.links.new(muted.outputs[0], shown.inputs["Color"])
    found = only_material(nodes, shown)
    assert found.roughness == 0.25
    assert found.base_color_texture == 0


def test_link_that_is_muted_counts_for_nothing(empty):
    nodes = material()
    shader = nodes.new("BsdfPrincipled")
    nodes.tree.links.new(textured(nodes).outputs[0], shader.inputs["Base Color"]).is_muted = True
    assert only_material(nodes, shader).base_color == pytest.approx((0.8, 0.8, 0.8))


def test_group_that_has_no_output_node(empty):
    tree = bpy.data.node_groups.new("Empty", "ShaderNodeTree")
    tree.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    nodes = material()
    group, shader = nodes.new("Group"), nodes.new("BsdfPrincipled", Base_Color=(0.1, 0.2, 0.3, 1))
    group.node_tree = tree
    nodes.set(shader, "Base Color", group)
    assert only_material(nodes, shader).base_color == pytest.approx((0.1, 0.2, 0.3))


def test_constant_nodes(empty):
    nodes = material()
    color, value = nodes.new("RGB"), nodes.new("Value")
    color.outputs[0].default_value, value.outputs[0].default_value = (0.1, 0.2, 0.3, 1), 0.25
    green = nodes.new("SeparateColor", Color=color).outputs["Green"]
    found = only_material(nodes, nodes.new("BsdfPrincipled", Base_Color=color, Roughness=value, Metallic=green))
    assert found.base_color == pytest.approx((0.1, 0.2, 0.3))
    assert (found.roughness, found.metallic) == pytest.approx((0.25, 0.2))


def test_colour_as_a_number_is_its_luminance(empty, tmp_path):
    nodes = material()
    color = nodes.new("RGB")
    color.outputs[0].default_value = (0.9, 0.3, 0.1, 1)
    plane(nodes.show(nodes.new("Emission", Strength=color)))
    cycles.look_down()
    seen = cycles.render(tmp_path, samples=1)[..., :3].mean((0, 1))
    np.testing.assert_allclose(extracted().materials[0].emission, seen, rtol=1e-3)  # Blender's weights have 4 digits


def test_node_between_texture_and_colour(empty):
    nodes = material()
    found = stand_in(nodes, nodes.new("BsdfPrincipled", Base_Color=nodes.new("HueSaturation", Color=textured(nodes))))
    assert found.base_color_texture == 0


def test_stand_in_of_a_texture_is_the_mean_of_its_colours(empty):
    nodes = material()
    checker = nodes.new("TexChecker", Color1=(1, 0, 0, 1), Color2=(0, 0.5, 1, 1))
    assert stand_in(nodes, nodes.new("BsdfPrincipled", Base_Color=checker)).base_color == (0.5, 0.25, 0.5)


def test_stand_in_of_a_ramp_is_its_mean(empty):
    nodes = material()
    ramp = nodes.new("ValToRGB", Fac=nodes.new("TexNoise"))
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (1, 0, 0, 1), (0, 0.5, 1, 1)
    ramp.color_ramp.elements[1].position = 0.5
    found = stand_in(nodes, nodes.new("BsdfPrincipled", Base_Color=ramp))
    assert found.base_color == pytest.approx((0.25, 0.375, 0.75), abs=0.02)


def test_stand_in_of_a_number_is_the_constant_beside_the_socket(empty):
    nodes = material()
    shader = nodes.new("BsdfPrincipled", Roughness=0.3)
    nodes.set(shader, "Roughness", nodes.new("Math"))
    assert stand_in(nodes, shader).roughness == pytest.approx(0.3)


def test_texture_where_the_values_have_none(empty):
    nodes = material()
    shader = nodes.new("BsdfPrincipled", IOR=1.3)
    nodes.set(shader, "IOR", textured(nodes))
    assert stand_in(nodes, shader).ior == pytest.approx(1.3)


@pytest.mark.parametrize("socket", ["Coat Weight", "Subsurface Weight", "Sheen Weight", "Anisotropic",
                                    "Diffuse Roughness", "Thin Film Thickness"])
@pytest.mark.parametrize("is_linked", [True, False])
def test_what_principled_has_more(empty, socket, is_linked):
    nodes = material()
    shader = nodes.new("BsdfPrincipled")
    nodes.set(shader, socket, nodes.new("Math") if is_linked else 0.5)
    stand_in(nodes, shader)


def test_rough_diffuse_is_not_exact(empty):
    nodes = material()
    stand_in(nodes, nodes.new("BsdfDiffuse", Roughness=0.5))


def test_stand_in_of_a_shader_is_diffuse(empty):
    nodes = material()
    found = stand_in(nodes, nodes.new("BsdfToon", Color=(0.2, 0.4, 0.6, 1)))
    assert_same(found, replace(BLACK, base_color=(0.2, 0.4, 0.6)))


def test_displacement_is_not_exact(empty):
    nodes = material()
    nodes.show(nodes.new("Displacement"), "Displacement")
    stand_in(nodes, nodes.new("BsdfDiffuse"))


@pytest.mark.parametrize("is_alone", [True, False])
def test_volume_is_told_and_alone_invisible(empty, is_alone):
    nodes = material()
    nodes.show(nodes.new("VolumeScatter"), "Volume")
    if not is_alone:
        nodes.show(nodes.new("BsdfDiffuse"))
    plane(nodes.owner)
    scene = extracted()
    assert only_warning(scene) == "volume is left out"
    assert scene.materials[0].is_exact
    assert scene.materials[0].alpha == (0 if is_alone else 1)


def test_output_that_is_for_cycles(empty):
    nodes = material()
    nodes.output.target = "EEVEE"
    nodes.show(nodes.new("Emission"))
    nodes.output = nodes.tree.nodes.new("ShaderNodeOutputMaterial")
    nodes.output.target = "CYCLES"
    assert only_material(nodes, nodes.new("BsdfDiffuse")).emission == (0, 0, 0)


def test_nothing_at_the_output_is_black(empty):
    plane(material().owner)
    found = extracted().materials[0]
    assert_same(found, BLACK)
    assert found.is_exact


@pytest.mark.skipif(bpy.app.version >= (5, 0, 0), reason="Blender 5 draws every material with nodes")
def test_material_without_nodes(empty):
    nodes = material()
    nodes.owner.use_nodes = False
    nodes.owner.diffuse_color, nodes.owner.roughness, nodes.owner.metallic = (0.2, 0.4, 0.6, 1), 0.3, 0.7
    plane(nodes.owner)
    assert_same(extracted().materials[0], Material("Material", (0.2, 0.4, 0.6), 0.3, 0.7))


def test_default_material_is_that_of_cycles(empty, tmp_path):
    """Without a specular layer under a sun at the zenith the plane would show rho E / pi."""
    plane()
    lamp("SUN", energy=1, angle=0)
    cycles.look_down()
    seen = cycles.render(tmp_path)[..., 0].mean()
    found = extracted().materials[0]
    assert found.base_color == pytest.approx((0.8, 0.8, 0.8))
    assert (found.specular_level == 0) == (abs(seen - 0.8 / np.pi) < 1e-4)


def test_animated_values_are_those_of_the_frame(empty):
    nodes = material()
    shader = nodes.new("BsdfPrincipled")
    plane(nodes.show(shader))
    for frame, value in ((1, 0.0), (11, 1.0)):
        shader.inputs["Roughness"].default_value = value
        shader.inputs["Roughness"].keyframe_insert("default_value", frame=frame)
    shader.inputs["Roughness"].default_value = 0.123
    empty.frame_set(11)
    assert extracted().materials[0].roughness == 1
    assert extracted().materials[0].name == "Material"


def test_shared_material_is_stored_once(empty):
    nodes = material()
    shown = nodes.show(nodes.new("BsdfPrincipled"))
    plane(shown, name="A")
    place(plane(shown, name="B").data, "C")
    assert len(extracted().materials) == 1


def test_alpha_of_a_picture_with_holes(empty):
    """Base Color and Alpha from one image: the colours are those that the file has, not darkened at the edges."""
    nodes = material()
    node = nodes.new("TexImage")
    node.image = image([[(1, 0.5, 0.25, 0.5)]], space="Non-Color")
    scene = read(nodes, nodes.new("BsdfPrincipled", Base_Color=node, Alpha=node.outputs["Alpha"]))
    assert len(scene.images) == 1
    np.testing.assert_array_equal(scene.images[0].pixels[0, 0], (255, 128, 64, 128))
