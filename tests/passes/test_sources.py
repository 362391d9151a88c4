# SPDX-License-Identifier: GPL-3.0-or-later
"""Trees of the world and of lamps, evaluated on the device; beside Cycles they are in tests/nodes."""

from __future__ import annotations

import numpy as np

from svo_engine.nodes.sources import lamp_tree, settled, world_trees
from svo_engine.passes.lights.lamps import make_lamps
from svo_engine.passes.sources import light_of_image, make_sky
from svo_engine.passes.upload.sky import linear_pixels
from svo_engine.scene.environment import direction_to_uv
from svo_engine.scene.graph import Graph, Link, Node
from svo_engine.scene.types import Light, Scene, World
from tests import scenes

SIZE = 32, 16
POSITION = Node("ShaderNodeNewGeometry")
COORDINATES = Node("ShaderNodeTexCoord")


def graph(source, output, kind="Background"):
    """What `output` of the node gives, sent out."""
    shown = Node(f"ShaderNode{kind}", inputs={"Color": Link(0, output), "Strength": 1.0})
    return Graph((source, shown), surface=Link(1, kind))


def test_a_texel_is_the_direction_that_it_shows(device):
    tree = world_trees(graph(POSITION, "Position")).light.tree
    found = light_of_image(device, tree, (), SIZE, 0)
    np.testing.assert_allclose(np.linalg.norm(found, axis=2), 1, atol=1e-5)
    uv = direction_to_uv(found.astype("f8"))
    u, v = np.meshgrid((np.arange(SIZE[0]) + 0.5) / SIZE[0], (np.arange(SIZE[1]) + 0.5) / SIZE[1])
    np.testing.assert_allclose(uv, np.stack([u, v], 2), atol=1e-5)


def test_a_plain_colour_needs_no_picture(device):
    plain = Graph((Node("ShaderNodeBackground", inputs={"Color": (1.0, 0.5, 0.2, 1.0), "Strength": 2.0}),),
                  surface=Link(0, "Background"))
    sky = make_sky(device, None, plain, ())
    assert sky.image is None and sky.seen is None and sky.seen_color is None and not sky.suns
    sky.scope.close()


def test_the_camera_has_a_picture_of_its_own_where_a_node_asks_for_it(device):
    nodes = (Node("ShaderNodeLightPath"), POSITION, Node("ShaderNodeBackground", inputs={
        "Color": Link(1, "Position"), "Strength": Link(0, "Is Camera Ray")}))
    tree = Graph(nodes, surface=Link(2, "Background"))
    sky = make_sky(device, None, tree, ())
    assert sky.seen and not linear_pixels(sky.image)[..., :3].any()
    assert settled(Scene(world=World(graph=tree, is_exact=False))).world.graph is tree
    sky.scope.close()


def lamp(kind, tree, **more):
    place = scenes.lamp(kind, (1, 2, 3)).world_from_light
    return Light("Lamp", kind, place, (2.0, 2.0, 2.0), graph=tree, is_exact=False, **more)


def test_a_lamp_is_as_strong_as_in_the_mean_of_its_table(device):
    """What the table says times what is left of the lamp's strength is what the tree says."""
    made = make_lamps(device, (lamp("AREA", graph(COORDINATES, "UV", "Emission"), size=(2.0, 1.0)),), (), np.zeros(3))
    first, size = made.places[id(made.lights[0])]
    width, height = size & 0xFFFF, size >> 16
    table = np.frombuffer(made.tables.buffer.read(), "f4").reshape(-1, 4)[first:first + width * height, :3]
    table = table.reshape(height, width, 3) * made.lights[0].emitted
    u = (np.arange(width) + 0.5) / width
    np.testing.assert_allclose(table[3, :, 0], 2 * u, atol=1e-5)
    np.testing.assert_allclose(table[:, 5, 1], 2 * u, atol=1e-5)
    assert not table[..., 2].any()
    made.scope.close()


def test_object_space_of_a_lamp_is_its_own(device):
    """Normals point where the light goes to: along -z in a spot's own space, along x in the world's if it is turned."""
    turned = np.array([[0.0, 0, -1, 5], [0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1]])
    for node, sign, expected in ((COORDINATES, -1.0, (0, 0, 1)), (POSITION, 1.0, (1, 0, 0))):
        scaled = Node("ShaderNodeVectorMath", {"operation": "SCALE"}, {"Vector": Link(0, "Normal"), "Scale": sign})
        shown = Node("ShaderNodeEmission", inputs={"Color": Link(1, "Vector"), "Strength": 1.0})
        tree = Graph((node, scaled, shown), surface=Link(2, "Emission"))
        light = Light("Lamp", "SPOT", turned, (1.0, 1.0, 1.0), graph=tree, is_exact=False, spot_angle=0.02)
        made = make_lamps(device, (light,), (), np.zeros(3))
        first, _ = made.places[id(made.lights[0])]
        table = np.frombuffer(made.tables.buffer.read(), "f4").reshape(-1, 4)[first:, :3] * made.lights[0].emitted
        np.testing.assert_allclose(table.mean(0), expected, atol=0.01)  # the cone is 0.01 wide
        made.scope.close()


def test_parametric_coordinates_of_a_lamp_are_its_uv():
    for node in (COORDINATES, Node("ShaderNodeUVMap")):
        assert "parametric_of_point" in lamp_tree(graph(node, "UV", "Emission")).shine.tree.text
