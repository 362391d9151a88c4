# SPDX-License-Identifier: GPL-3.0-or-later
"""Worlds of node trees beside Cycles, and the suns that skies put into them."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from svo_engine.nodes.skies import multiple, single
from svo_engine.nodes.skies.tables import disc_of
from svo_engine.nodes.sources import world_trees
from svo_engine.passes.sources import light_of_points, make_sky, points_of_world
from svo_engine.scene.graph import Graph, Link, Node
from tests.blender.build import Nodes, image, world
from tests.nodes import domes


@pytest.fixture
def empty():
    """A new file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)


# Cycles computes tables in single precision, with heights above a radius of 6371 km, and looks up between texels
SHARE_OF_BRIGHTEST = 1e-3

needs_five = pytest.mark.skipif(bpy.app.version < (5, 0), reason="these models came with Blender 5")

SKIES = {
    "low": {"sun_elevation": 0.26, "sun_rotation": 0.5, "altitude": 100.0},
    "thick": {"sun_elevation": 1.2, "sun_rotation": 2.5, "altitude": 3000.0, "air_density": 2.0, "aerosol_density": 5.0,
              "ozone_density": 3.0},
    "beyond": {"sun_elevation": 2.0, "sun_rotation": -1.0, "altitude": 20000.0},
    "large": {"sun_elevation": 0.1, "sun_rotation": 4.0, "altitude": 500.0, "sun_disc": True, "sun_size": 0.4},
}


def sky(nodes: Nodes, **settings):
    """A Sky Texture, without its sun's disc unless asked for."""
    made = nodes.new("TexSky")
    for name, value in {"sun_disc": False, **settings}.items():
        setattr(made, name, value)
    return made


def assert_as_cycles_has_it(device, folder):
    ours, theirs = domes.by_us(device), domes.by_cycles(folder)
    assert np.abs(ours - theirs).max() <= SHARE_OF_BRIGHTEST * max(theirs.max(), 1.0)


@needs_five
@pytest.mark.parametrize("settings", SKIES.values(), ids=SKIES)
@pytest.mark.parametrize("model", ["SINGLE_SCATTERING", "MULTIPLE_SCATTERING"])
def test_skies_by_scattering(empty, device, tmp_path, model, settings):
    nodes = world()
    nodes.show(nodes.new("Background", Color=sky(nodes, sky_type=model, **settings)))
    assert_as_cycles_has_it(device, tmp_path)


@pytest.mark.parametrize(("sun", "turbidity"), [((0.3, 0.5, 0.8), 2.2), ((0.0, 0.9, 0.1), 7.3), ((0.0, 0.0, 1.0), 4.0)])
def test_sky_by_preetham(empty, device, tmp_path, sun, turbidity):
    nodes = world()
    made = sky(nodes, sky_type="PREETHAM", sun_direction=sun, turbidity=turbidity)
    nodes.show(nodes.new("Background", Color=made, Strength=0.3))
    assert_as_cycles_has_it(device, tmp_path)


@pytest.mark.parametrize(("height", "turbidity", "albedo"), [(0.15, 2.5, 0.5), (0.7, 2.2, 0.3), (1.0, 6.7, 0.8)])
def test_sky_by_hosek_and_wilkie(empty, device, tmp_path, height, turbidity, albedo):
    """To 2 % of the brightest, half a percent in the mean: what interpolating between fitted skies leaves."""
    nodes = world()
    made = sky(nodes, sky_type="HOSEK_WILKIE", turbidity=turbidity, ground_albedo=albedo,
               sun_direction=(np.cos(height) * 0.6, np.cos(height) * 0.8, np.sin(height)))
    nodes.show(nodes.new("Background", Color=made))
    ours, theirs = domes.by_us(device), domes.by_cycles(tmp_path)
    np.testing.assert_allclose(ours, theirs, atol=0.02 * theirs.max())
    assert ours.mean() == pytest.approx(theirs.mean(), rel=0.005)


# Of a panoramic picture by Blender 4.2.23: directions and what is seen there
BLENDER_4 = (
    ((-0.772377, -0.489076, 0.405263), (1.558647, 2.470566, 3.730336)),
    ((0.956519, -0.264729, 0.122434), (2.983610, 3.880559, 3.984601)),
    ((0.053624, 0.162309, 0.985282), (0.614085, 0.964192, 1.595015)),
    ((0.015113, 0.615027, 0.788361), (1.212281, 1.717630, 2.614848)),
    ((0.956537, 0.264685, -0.122387), (2.187292, 1.580985, 0.782619)),
    ((-0.468044, -0.826167, -0.313659), (0.037192, 0.034633, 0.022313)))


def test_sky_of_blender_4(device):
    """To 1e-3 of the brightest: that version's own table, of 512 by 128 texels, which lie at other heights."""
    settings = {"sky_type": "NISHITA", "sun_elevation": 0.26, "sun_rotation": 0.5, "altitude": 100.0,
                "air_density": 1.0, "dust_density": 1.0, "ozone_density": 1.0, "sun_disc": False}
    nodes = (Node("ShaderNodeTexSky", settings), Node("ShaderNodeBackground", inputs={"Color": Link(0, "Color"),
                                                                                     "Strength": 1.0}))
    tree = world_trees(Graph(nodes, surface=Link(1, "Background"))).light.tree
    directions, seen = (np.array(column) for column in zip(*BLENDER_4, strict=True))
    found = light_of_points(device, tree, (), points_of_world(directions), 0)
    np.testing.assert_allclose(found, seen, atol=1e-3 * seen.max())


def checked(nodes: Nodes):
    """An image of all directions, without two equal texels."""
    made = nodes.new("TexEnvironment")
    y, x = np.mgrid[0:16, 0:32]
    made.image = image(np.stack([x / 31, y / 15, (x * y) % 7 / 6, np.ones_like(x)], 2), is_float=True)
    return made


def moved(nodes: Nodes, **mapping):
    return nodes.new("Mapping", Vector=nodes.new("TexCoord").outputs["Generated"], **mapping)


def _looked_up(nodes: Nodes, **mapping):
    made = checked(nodes)
    nodes.set(made, "Vector", moved(nodes, **mapping))
    return nodes.new("Background", Color=made)


def _mirror_ball(nodes: Nodes):
    made = checked(nodes)
    made.projection = "MIRROR_BALL"
    return nodes.new("Background", Color=made)


MAKERS = {
    "direction": lambda n: n.new("Background", Color=n.new("TexCoord").outputs["Generated"]),
    "normal": lambda n: n.new("Background", Color=n.new("TexCoord").outputs["Normal"]),
    "incoming": lambda n: n.new("Background", Color=n.new("NewGeometry").outputs["Incoming"]),
    "object": lambda n: n.new("Background", Color=n.new("TexCoord").outputs["Object"]),
    "reflection": lambda n: n.new("Background", Color=n.new("TexCoord").outputs["Reflection"]),
    "gradient": lambda n: n.new("Background", Color=n.new("TexGradient", Vector=moved(n, Rotation=(0, 1.57, 0)))),
    "noise": lambda n: n.new("Background", Color=n.new("TexNoise", Scale=2.0)),
    "image, moved": lambda n: _looked_up(n, Location=(0.3, 0.2, -0.4)),
    "image, stretched": lambda n: _looked_up(n, Scale=(1.0, 2.0, 0.5), Rotation=(0.3, 0.2, 1.0)),
    "mirror ball": _mirror_ball,
    "added": lambda n: n.new("AddShader", Shader=n.new("Background", Color=checked(n), Strength=0.5),
                             Shader_001=n.new("Background", Color=(0.1, 0.2, 0.3, 1))),
    "mixed": lambda n: n.new("MixShader", Fac=n.new("TexNoise").outputs[0],
                             Shader=n.new("Background", Color=checked(n)),
                             Shader_001=n.new("Background", Color=(0.1, 0.2, 0.3, 1))),
    "by rays": lambda n: n.new("MixShader", Fac=n.new("LightPath").outputs["Is Camera Ray"],
                               Shader=n.new("Background", Color=checked(n)),
                               Shader_001=n.new("Background", Color=(0.1, 0.2, 0.3, 1))),
    "by depth": lambda n: n.new("Background", Strength=n.new("LightPath").outputs["Ray Depth"]),
    "a colour alone": lambda n: n.new("RGB"),
}


@pytest.mark.parametrize("maker", MAKERS.values(), ids=MAKERS)
def test_trees(empty, device, tmp_path, maker):
    nodes = world()
    nodes.show(maker(nodes))
    assert_as_cycles_has_it(device, tmp_path)


@needs_five
@pytest.mark.parametrize("strength", [1.0, 0.1])
def test_the_sun_is_a_lamp_of_its_disc(empty, device, strength):
    """The mean of the limb's darkening, 1 - 0.6 (1 - sqrt(1 - r^2)), over a disc is 0.8; its rings leave 1 %."""
    nodes = world()
    made = sky(nodes, sun_disc=True, sun_elevation=0.5, sun_rotation=0.7, sky_type="MULTIPLE_SCATTERING")
    nodes.show(nodes.new("Background", Color=made, Strength=strength))
    scene = domes.extracted()
    found = make_sky(device, None, scene.world.graph, scene.images)
    lamp, = found.suns
    disc = disc_of({"sky_type": "MULTIPLE_SCATTERING", **{name: getattr(made, name) for name in (
        "sun_elevation", "sun_rotation", "sun_size", "sun_intensity", "altitude", "air_density", "aerosol_density",
        "ozone_density")}})
    assert disc
    xyz = np.mean(disc.ends, axis=0) * 0.8 * np.pi * np.sin(disc.size / 2) ** 2 * strength
    assert np.dot(lamp.emitted, (0.2126, 0.7152, 0.0722)) == pytest.approx(xyz[1], rel=0.01)
    np.testing.assert_allclose(lamp.world_from_light[:3, 2], disc.sun.direction, atol=1e-6)
    assert lamp.angle == pytest.approx(disc.size)
    found.scope.close()


@pytest.mark.parametrize("model", [single, multiple], ids=["single", "multiple"])
def test_light_of_the_sky_adds_up(model):
    """Twice the air scatters more, and no sky is brighter than the sun whose light it scatters."""
    up = np.linspace(0.05, 1.5, 16)
    skies = [model.sky(up, np.linspace(-3, 3, 9), 0.8, 100.0, (air, 1.0, 1.0)) for air in (1.0, 2.0)]
    assert (skies[0] > 0).all() and skies[1].mean() > skies[0].mean()
    sun = model.sun(0.8, 0.01, 100.0, (1.0, 1.0, 1.0)) * np.pi * 0.005**2
    assert skies[0].mean((0, 1))[1] * np.pi < sun.mean(0)[1]
