# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees come as they are, whatever they hold, each node once."""

from __future__ import annotations

import bpy
import pytest

from svo_engine.blender.extract.node_settings import N_SAMPLES
from svo_engine.scene.graph import Link, packed, unpacked
from tests.blender.build import Nodes, extracted, image, lamp, material, plane, world


def graph_of(nodes):
    """The Graph of the material that `nodes` make, which a file gives back the same."""
    plane(nodes.owner)
    graph = extracted().materials[0].graph
    assert unpacked(packed(graph)) == graph
    return graph


def by_name(graph, name):
    found, = (node for node in graph.nodes if node.name == name)
    return found


def fed_by(graph, node, identifier):
    """The node that feeds an input, and the output's identifier."""
    link = node.inputs[identifier]
    assert isinstance(link, Link)
    return graph.nodes[link.node].name, link.output


def group(name, *outputs):
    """A new group with one number as input and the named shaders or numbers as outputs."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    tree.interface.new_socket("In", in_out="INPUT", socket_type="NodeSocketFloat")
    for kind in outputs:
        tree.interface.new_socket("Out", in_out="OUTPUT", socket_type=f"NodeSocket{kind}")
    tree.nodes.new("NodeGroupInput")
    tree.nodes.new("NodeGroupOutput")
    return tree


def test_links_constants_and_settings(empty):
    nodes = material()
    sums = nodes.new("Math", Value=0.25)
    sums.operation, sums.use_clamp = "SUBTRACT", True
    noise = nodes.new("TexNoise", Scale=7.0)
    nodes.set(sums, "Value 001", noise.outputs["Fac"])
    shade = nodes.new("BsdfPrincipled", Roughness=sums)
    nodes.show(shade)
    nodes.new("Emission")  # reached by nothing
    graph = graph_of(nodes)
    assert [n.kind for n in graph.nodes] == ["ShaderNodeMath", "ShaderNodeTexNoise", "ShaderNodeBsdfPrincipled"]
    assert graph.surface == Link(2, "BSDF")
    assert (graph.volume, graph.displacement, graph.aovs, graph.groups) == (None, None, (), {})
    found = by_name(graph, "Math")
    assert found.settings == {"operation": "SUBTRACT", "use_clamp": True}
    assert found.inputs["Value"] == 0.25
    assert fed_by(graph, found, "Value_001")[0] == "Noise Texture"
    assert found.through is None
    assert by_name(graph, "Noise Texture").inputs["Scale"] == 7
    assert by_name(graph, "Noise Texture").inputs["Vector"] is None
    assert "W" not in by_name(graph, "Noise Texture").inputs  # not in use in three dimensions
    assert graph.settings["displacement_method"] == "BUMP"


def test_node_that_many_read_is_there_once(empty):
    nodes = material()
    value = nodes.new("Value")
    value.outputs[0].default_value = 0.5
    before = value
    for _ in range(400):  # 2^400 ways through it
        both = nodes.new("Math", Value=before)
        nodes.set(both, "Value 001", before)
        before = both
    nodes.show(nodes.new("Emission", Strength=before))
    graph = graph_of(nodes)
    assert len(graph.nodes) == 402
    assert by_name(graph, "Value").settings["value"] == 0.5


def test_mute_and_reroute(empty):
    nodes = material()
    rgb = nodes.new("RGB")
    rgb.outputs[0].default_value = (0.1, 0.2, 0.3, 1)
    bend = nodes.tree.nodes.new("NodeReroute")
    nodes.tree.links.new(rgb.outputs[0], bend.inputs[0])
    gamma = nodes.new("Gamma", Color=bend)
    gamma.mute = True
    nodes.show(nodes.new("Emission", Color=gamma, Strength=nodes.new("Value")))
    cut, = (k for k in nodes.tree.links if k.to_socket.name == "Strength")
    cut.is_muted = True
    graph = graph_of(nodes)
    assert by_name(graph, rgb.name).settings["value"] == pytest.approx((0.1, 0.2, 0.3, 1))
    assert by_name(graph, "Reroute").kind == "NodeReroute"
    assert by_name(graph, "Gamma").through == {"Color": "Color"}
    assert fed_by(graph, by_name(graph, "Gamma"), "Color") == ("Reroute", "Output")
    assert by_name(graph, "Emission").inputs["Strength"] == 1


@pytest.mark.parametrize("kind", ["Mapping", "TexNoise", None])
def test_dead_ends_count_for_nothing(empty, kind):
    """Through reroutes and muted nodes: what asks takes what it has without a link, as Cycles shows it."""
    nodes = material()
    node = nodes.new(kind) if kind else nodes.tree.nodes.new("NodeReroute")
    node.mute = kind is not None
    bend = nodes.tree.nodes.new("NodeReroute")
    nodes.tree.links.new(node.outputs[0], bend.inputs[0])
    texture = nodes.new("TexChecker", Vector=bend)
    nodes.show(nodes.new("Emission", Color=texture, Strength=bend))
    graph = graph_of(nodes)
    assert {n.kind for n in graph.nodes} == {"ShaderNodeTexChecker", "ShaderNodeEmission"}
    assert by_name(graph, "Checker Texture").inputs["Vector"] is None
    assert by_name(graph, "Emission").inputs["Strength"] == 1


def test_hidden_colours_count_and_hidden_vectors_do_not(empty):
    nodes = material()
    nodes.show(nodes.new("Emission", Color=nodes.new("Gamma"), Strength=nodes.new("LayerWeight")))
    graph = graph_of(nodes)
    assert by_name(graph, "Gamma").inputs["Color"] == (1, 1, 1, 1)
    assert by_name(graph, "Layer Weight").inputs["Normal"] is None


@pytest.mark.parametrize(("kind", "expected"), [("Vector", None), ("Float", 0.25), ("Color", (1, 0, 0, 1))])
def test_hidden_inputs_of_groups(empty, kind, expected):
    """Assets have a hidden normal that is linked where somebody wants another one."""
    tree = bpy.data.node_groups.new("Asset", "ShaderNodeTree")
    made = tree.interface.new_socket("In", in_out="INPUT", socket_type=f"NodeSocket{kind}")
    tree.interface.new_socket("Out", in_out="OUTPUT", socket_type="NodeSocketColor")
    made.hide_value = True
    nodes = material()
    shown = nodes.new("Group")
    shown.node_tree = tree
    shown.inputs[0].default_value = expected or (0, 0, 0)
    nodes.show(nodes.new("Emission", Color=shown))
    assert list(by_name(graph_of(nodes), "Group").inputs.values()) == [expected]


@pytest.mark.skipif(not hasattr(bpy.types.Material, "inline_shader_nodes"), reason="Blender 5 brought it")
def test_loops_are_as_blender_unrolls_them(empty):
    nodes = material()
    start, end = (nodes.tree.nodes.new(f"GeometryNodeRepeat{side}") for side in ("Input", "Output"))
    start.pair_with_output(end)
    end.repeat_items.new("FLOAT", "Value")
    more = nodes.new("Math", Value_001=0.25)
    nodes.set(more, "Value", start.outputs["Value"])
    nodes.tree.links.new(more.outputs[0], end.inputs["Value"])
    start.inputs["Iterations"].default_value = 3
    nodes.tree.links.new(nodes.new("TexNoise").outputs[0], start.inputs["Value"])
    nodes.show(nodes.new("Emission", Strength=end.outputs["Value"]))
    kinds = [n.kind for n in graph_of(nodes).nodes]
    assert sorted(kinds) == ["ShaderNodeEmission", *["ShaderNodeMath"] * 3, "ShaderNodeTexNoise"]


def test_text_of_a_file(empty, tmp_path):
    (tmp_path / "file").write_text("IESNA")
    nodes = material()
    for path in (tmp_path / "file", tmp_path / "none"):
        node = nodes.new("TexIES")
        node.mode, node.filepath = "EXTERNAL", str(path)
        nodes.set(nodes.new("Math"), "Value", node)
    first, second = (n for n in nodes.tree.nodes if n.bl_idname == "ShaderNodeMath")
    nodes.set(first, "Value 001", second)
    nodes.show(nodes.new("Emission", Strength=first))
    found = [n.settings["ies.text"] for n in graph_of(nodes).nodes if n.kind == "ShaderNodeTexIES"]
    assert sorted(found, key=str) == ["IESNA", None]


def test_cycle(empty):
    nodes = material()
    first, second = nodes.new("Math"), nodes.new("Math")
    nodes.set(first, "Value", second)
    nodes.set(second, "Value", first)
    nodes.show(nodes.new("Emission", Strength=second))
    assert len(graph_of(nodes).nodes) == 3


def test_nothing_at_the_output(empty):
    graph = graph_of(material())
    assert (graph.nodes, graph.surface) == ((), None)


def test_no_output_at_all(empty):
    nodes = material()
    nodes.tree.nodes.clear()
    assert graph_of(nodes).nodes == ()


def test_groups_in_groups(empty):
    inner, outer = group("Inner", "Float"), group("Outer", "Shader")
    inner.links.new(inner.nodes[0].outputs[0], inner.nodes[1].inputs[0])
    deep = outer.nodes.new("ShaderNodeGroup")
    deep.node_tree = inner
    emission = outer.nodes.new("ShaderNodeEmission")
    outer.links.new(outer.nodes["Group Input"].outputs[0], deep.inputs[0])
    outer.links.new(deep.outputs[0], emission.inputs["Strength"])
    outer.links.new(emission.outputs[0], outer.nodes["Group Output"].inputs[0])
    nodes = material()
    shown = nodes.new("Group")
    shown.node_tree = outer
    shown.inputs[0].default_value = 3
    nodes.show(shown)
    graph = graph_of(nodes)
    assert list(graph.groups) == ["Inner", "Outer"]
    node, = graph.nodes
    assert node.settings["node_tree"] == "Outer"
    (name, value), = node.inputs.items()
    assert value == 3
    inside = graph.groups["Outer"]
    assert {n.kind for n in inside.nodes} == {"NodeGroupInput", "ShaderNodeGroup", "ShaderNodeEmission"}
    link, = inside.outputs.values()
    assert inside.nodes[link.node].kind == "ShaderNodeEmission"
    into, = next(n for n in inside.nodes if n.kind == "ShaderNodeGroup").inputs.values()
    assert (inside.nodes[into.node].kind, into.output) == ("NodeGroupInput", name)


def test_missing_group(empty):
    nodes = material()
    value, shown = group("Gone", "Float"), nodes.new("Group")
    shown.node_tree = value
    nodes.show(nodes.new("Emission", Strength=shown))
    bpy.data.node_groups.remove(value)
    graph = graph_of(nodes)
    assert graph.groups == {}
    assert all(n.settings.get("node_tree") is None for n in graph.nodes)


def test_ramp_and_curves(empty):
    nodes = material()
    ramp, curves = nodes.new("ValToRGB"), nodes.new("RGBCurve")
    ramp.color_ramp.interpolation = "EASE"
    ramp.color_ramp.elements.new(0.25).color = (1, 0, 0, 1)
    curves.mapping.curves[3].points.new(0.5, 0.75)
    nodes.set(curves, "Color", ramp.outputs["Color"])
    nodes.show(nodes.new("Emission", Color=curves))
    graph = graph_of(nodes)
    mode, interpolation, _, stops = by_name(graph, "Color Ramp").settings["color_ramp"]
    assert (mode, interpolation) == ("RGB", "EASE")
    assert stops == ((0, 0, 0, 0, 1), (0.25, 1, 0, 0, 1), (1, 1, 1, 1, 1))
    settings = by_name(graph, "RGB Curves").settings
    extend, clip, _, _, points = settings["mapping"]
    assert (extend, clip) == ("EXTRAPOLATED", (0, 0, 1, 1))
    assert [p[:2] for p in points[3]] == [(0, 0), (0.5, 0.75), (1, 1)]
    samples = settings["mapping.samples"]
    assert [len(curve) for curve in samples] == [N_SAMPLES] * 3
    middle = curves.mapping.evaluate(curves.mapping.curves[3], 100 / (N_SAMPLES - 1))
    assert all((curve[0], curve[100], curve[-1]) == pytest.approx((0, middle, 1), abs=1e-6) for curve in samples)


def test_curves_that_change_nothing_have_no_samples(empty):
    nodes = material()
    nodes.show(nodes.new("Emission", Color=nodes.new("RGBCurve")))
    assert by_name(graph_of(nodes), "RGB Curves").settings["mapping.samples"] == ((), (), ())


def test_images_objects_and_records(empty):
    nodes = material()
    texture, at = nodes.new("TexImage"), nodes.new("TexCoord")
    texture.image = image([[(1, 0, 0, 1)]], "Red")
    texture.image_user.frame_offset = 3
    at.object = plane(name="Guide", at=(1, 2, 3))
    nodes.set(texture, "Vector", at.outputs["Object"])
    nodes.show(nodes.new("Emission", Color=texture))
    plane(nodes.owner)
    graph = next(m.graph for m in extracted().materials if m.graph and m.graph.nodes)
    found = by_name(graph, "Image Texture").settings
    assert (found["image"], found["image_user.frame_offset"], found["extension"]) == ("Red", 3, "REPEAT")
    assert found["texture_mapping.scale"] == (1, 1, 1)
    settings = by_name(graph, "Texture Coordinate").settings
    assert settings["object"] == "Guide"
    assert settings["object.matrix_world"][3::4] == (1, 2, 3, 1)


def test_a_still_image_is_the_same_in_every_frame(empty):
    nodes = material()
    texture = nodes.new("TexImage")
    texture.image = image([[(1, 0, 0, 1)]], "Red")
    nodes.show(nodes.new("Emission", Color=texture))
    before = graph_of(nodes)
    empty.frame_set(empty.frame_current + 1)
    assert extracted().materials[0].graph == before


def test_volume_displacement_and_aovs(empty):
    nodes = material()
    nodes.show(nodes.new("VolumeScatter"), "Volume")
    nodes.show(nodes.new("Displacement"), "Displacement")
    nodes.new("OutputAOV", Value=2.0).aov_name = "Own"
    nodes.owner.displacement_method = "BOTH"
    graph = graph_of(nodes)
    assert graph.surface is None
    assert graph.nodes[graph.volume.node].kind == "ShaderNodeVolumeScatter"
    assert graph.nodes[graph.displacement.node].kind == "ShaderNodeDisplacement"
    aov, = (graph.nodes[i] for i in graph.aovs)
    assert (aov.settings["aov_name"], aov.inputs["Value"]) == ("Own", 2)
    assert graph.settings["displacement_method"] == "BOTH"


def test_animated_values_are_those_of_the_frame(empty):
    nodes = material()
    shade = nodes.show(nodes.new("Emission")).node_tree.nodes["Emission"]
    for frame, strength in ((1, 0), (11, 10)):
        shade.inputs["Strength"].default_value = strength
        shade.inputs["Strength"].keyframe_insert("default_value", frame=frame)
    empty.frame_set(11)
    assert by_name(graph_of(nodes), "Emission").inputs["Strength"] == 10


def test_worlds_and_lamps(empty):
    sky = world()
    sky.show(sky.new("Background", Color=sky.new("TexSky")))
    nodes = Nodes(lamp("POINT").data)
    nodes.show(nodes.new("Emission", Strength=nodes.new("LightFalloff")))
    sky.owner.cycles_visibility.camera = False
    scene = extracted()
    assert {n.kind for n in scene.world.graph.nodes} == {"ShaderNodeBackground", "ShaderNodeTexSky"}
    assert scene.world.graph.settings["visible.camera"] is False
    assert {n.kind for n in scene.lights[0].graph.nodes} == {"ShaderNodeEmission", "ShaderNodeLightFalloff"}


def test_without_nodes_there_is_no_graph(empty):
    plane()
    assert extracted().materials[0].graph is None


def test_every_shader_node_can_be_read(empty):
    kinds = sorted(name for name in dir(bpy.types) if name.startswith("ShaderNode") and name != "ShaderNode")
    nodes = material()
    mixes = []
    for kind in kinds:
        try:
            node = nodes.tree.nodes.new(kind)
        except RuntimeError:  # for other trees, or abstract
            continue
        if node.outputs and node.bl_idname != "ShaderNodeGroup":
            mixes.append(nodes.new("AddShader"))
            nodes.tree.links.new(node.outputs[0], mixes[-1].inputs[0])
            if len(mixes) > 1:
                nodes.tree.links.new(mixes[-2].outputs[0], mixes[-1].inputs[1])
    nodes.show(mixes[-1])
    found = {n.kind for n in graph_of(nodes).nodes}
    assert len(found) > 80
