# SPDX-License-Identifier: GPL-3.0-or-later
"""What trees of worlds and lamps say without a device: constants, falloffs, photometric files."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.nodes.ies import WATTS, read_ies
from svo_engine.nodes.sources import lamp_tree, settled, told
from svo_engine.scene.graph import Graph, Link, Node
from svo_engine.scene.types import Light, Scene, World

TEXT = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 2 3 {n} 1 2 0 0 0\n1 1 1\n0 45 90\n{across}\n{strengths}\n"


def background(**inputs):
    return Node("ShaderNodeBackground", inputs={"Color": (0.2, 0.4, 0.8, 1.0), "Strength": 1.0, **inputs})


def by_rays():
    """One world for the camera, another one for the rest."""
    nodes = (background(), background(Color=(1.0, 0.0, 0.0, 1.0)), Node("ShaderNodeLightPath"),
             Node("ShaderNodeMixShader", inputs={"Fac": Link(2, "Is Camera Ray"), "Shader": Link(0, "Background"),
                                                 "Shader_001": Link(1, "Background")}))
    return Graph(nodes, surface=Link(3, "Shader"))


def test_a_strength_of_constants_is_a_constant():
    nodes = (Node("ShaderNodeMath", {"operation": "MULTIPLY"}, {"Value": 2.0, "Value_001": 0.25, "Value_002": 0.0}),
             background(Strength=Link(0, "Value")))
    world = settled(Scene(world=World(graph=Graph(nodes, surface=Link(1, "Background")), is_exact=False))).world
    assert world.is_exact
    np.testing.assert_allclose(world.radiance, (0.1, 0.2, 0.4), rtol=1e-6)


def test_what_the_camera_sees_lights_nothing():
    world = settled(Scene(world=World(graph=by_rays(), is_exact=False))).world
    assert not world.is_exact  # for the camera's sake
    np.testing.assert_allclose(world.radiance, (0.2, 0.4, 0.8), rtol=1e-6)


def test_a_scene_without_trees_stays_what_it_is():
    scene = Scene(world=World((1, 2, 3)))
    assert settled(scene) is scene


@pytest.mark.parametrize("output", ["Quadratic", "Linear", "Constant"])
def test_falloff_is_data_of_the_lamp(output):
    nodes = (Node("ShaderNodeLightFalloff", inputs={"Strength": 3.0, "Smooth": 0.5}),
             Node("ShaderNodeEmission", inputs={"Color": (1.0, 0.5, 0.25, 1.0), "Strength": Link(0, output)}))
    graph = Graph(nodes, surface=Link(1, "Emission"))
    lamp = Light("Lamp", "POINT", np.eye(4), (2.0, 2.0, 2.0), graph=graph, is_exact=False)
    found, = settled(Scene(lights=(lamp,))).lights
    assert found.is_exact and (found.falloff, found.smoothing) == (output.upper(), 0.5)
    np.testing.assert_allclose(found.emitted, (6.0, 3.0, 1.5))
    assert settled(Scene(lights=(Light("Sun", "SUN", np.eye(4), (1, 1, 1), graph=graph, is_exact=False),))
                   ).lights[0].falloff == "QUADRATIC"


def test_what_is_not_known_is_told_by_its_lamp():
    nodes = (Node("ShaderNodeNobody", name="Strange"), Node("ShaderNodeEmission", inputs={"Color": Link(0, "Color")}))
    lamp = Light("Lamp", "POINT", np.eye(4), (1, 1, 1), graph=Graph(nodes, surface=Link(1, "Emission")), is_exact=False)
    sentence, = told(Scene(lights=(lamp,)))
    assert sentence.startswith("Light 'Lamp': node 'Strange'")
    assert lamp_tree(lamp.graph).shine.color is not None


def photometry(across, strengths):
    return read_ies(TEXT.format(n=len(across.split()), across=across, strengths=strengths))


def test_a_photometric_file_of_one_plane_goes_all_around():
    found = photometry("0", "10 20 30")
    assert found
    np.testing.assert_allclose(found.across, (0, 2 * np.pi))
    np.testing.assert_allclose(found.strength, np.array([[10, 20, 30]] * 2) * 2 * WATTS)


def test_a_quarter_is_mirrored_twice():
    found = photometry("0 90", "1 2 3 4 5 6")
    assert found
    np.testing.assert_allclose(np.degrees(found.across), (0, 90, 180, 270, 360))
    np.testing.assert_allclose(found.strength[:, 0] / (2 * WATTS), (1, 4, 1, 4, 1))


def test_a_missing_last_angle_is_the_first_one():
    found = photometry("0 120 240", "1 1 1 2 2 2 3 3 3")
    assert found
    np.testing.assert_allclose(found.strength[:, 1] / (2 * WATTS), (1, 2, 3, 1))


def test_axes_of_type_b_are_the_other_way_round():
    text = ("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 3 2 2 0 0 0\n1 1 1\n0 90\n-90 0 90\n1 2 3 4 5 6\n")
    found = read_ies(text)
    assert found
    np.testing.assert_allclose(np.degrees(found.across), (0, 90, 180, 360))
    np.testing.assert_allclose(np.degrees(found.down), (0, 90, 180))
    np.testing.assert_allclose(found.strength / WATTS, ((2, 4, 6), (1, 3, 5), (2, 4, 6), (2, 4, 6)))


@pytest.mark.parametrize("text", ["", "nothing", "\nTILT=NONE\n1 2", TEXT.format(n=2, across="0 50",
                                                                                     strengths="1 " * 6)])
def test_broken_files(text):
    assert read_ies(text) is None
