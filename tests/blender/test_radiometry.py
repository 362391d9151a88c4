# SPDX-License-Identifier: GPL-3.0-or-later
"""Every lamp that is extracted, put into the closed form of its kind, must light a plane as Cycles lights it.

A diffuse plane of reflectance rho shows L = rho E / pi. The camera sees a centimetre around the origin, so that E is
that of one point.
"""

from __future__ import annotations

from math import cos, pi, radians, sin, tan

import bpy
import numpy as np
import pytest

from tests.blender import cycles
from tests.blender.build import extracted, lamp, material, plane, world

REFLECTANCE = 0.8
WATTS = 100.0

# 32-bit floats of a renderer, and a field of view of 1 cm at 2 m
EXACT = {"rtol": 1e-4}

# 16 pixels times 64 low-discrepancy samples of an extended lamp
SAMPLED = {"rtol": 2e-3}

since_45 = pytest.mark.skipif(bpy.app.version < (4, 5, 0), reason="came with Blender 4.5")


@pytest.fixture
def floor(empty):
    nodes = material()
    gray = (REFLECTANCE,) * 3
    plane(nodes.show(nodes.new("BsdfDiffuse", Color=(*gray, 1))), size=20)
    cycles.look_down()


def irradiance(folder):
    """E (3,) of the floor at the origin, by Cycles."""
    return cycles.render(folder)[..., :3].mean((0, 1)) * pi / REFLECTANCE


def only_light():
    light, = extracted().lights
    return light


def axis(light):
    """The direction in which the lamp shines."""
    return -light.world_from_light[:3, 2]


def from_point(light):
    """E at the origin of a floor that faces up, from a point lamp: I cos / d^2; a soft one is a disk of its radius."""
    at = light.world_from_light[:3, 3]
    d2 = at @ at
    return np.multiply(light.emitted, at[2] / np.sqrt(d2) / (d2 + light.soft_falloff * light.radius**2))


def from_small_area(light):
    """The same from an area lamp that is far away for its size: L A cos cos / d^2."""
    at = light.world_from_light[:3, 3]
    d2 = at @ at
    area = light.size[0] * light.size[1] * (pi / 4 if light.is_ellipse else 1)
    return np.multiply(light.emitted, area * at[2] * max(-at @ axis(light), 0) / d2**2)


@pytest.mark.parametrize("kind", ["POINT", "SPOT"])
@pytest.mark.parametrize("soft", [False, True])
@pytest.mark.parametrize("radius", [0.0, 0.5])
def test_point_and_inside_of_spot(floor, tmp_path, kind, soft, radius):
    """The irradiance of a sphere is that of a point, as long as all of it is above the horizon."""
    lamp(kind, at=(0, 0, 2), energy=WATTS, color=(1, 0.5, 0.25), shadow_soft_size=radius, use_soft_falloff=soft)
    light = only_light()
    assert (light.kind, light.radius, light.soft_falloff) == (kind, radius, soft)
    np.testing.assert_allclose(irradiance(tmp_path), from_point(light), **(SAMPLED if radius else EXACT))


def test_point_aside(floor, tmp_path):
    lamp("POINT", at=(1, 2, 2), energy=WATTS)
    np.testing.assert_allclose(irradiance(tmp_path), from_point(only_light()), **EXACT)


@since_45
@pytest.mark.parametrize("kind", ["POINT", "SPOT"])
@pytest.mark.parametrize("radius", [0.0, 0.25, 1.0])
def test_point_that_is_not_normalised(floor, tmp_path, kind, radius):
    wide = {"spot_size": pi} if kind == "SPOT" else {}  # so that all of the sphere lies inside
    lamp(kind, at=(0, 0, 2), energy=WATTS, shadow_soft_size=radius, use_soft_falloff=False, normalize=False, **wide)
    np.testing.assert_allclose(irradiance(tmp_path), from_point(only_light()), **(SAMPLED if radius else EXACT))


@pytest.mark.parametrize("scale", [(3, 3, 3), (1, 1, -1), (0, 0, 0)])
def test_scale_changes_no_point(floor, tmp_path, scale):
    lamp("POINT", at=(0, 0, 2), scale=scale, energy=WATTS, shadow_soft_size=0.5)
    np.testing.assert_allclose(irradiance(tmp_path), from_point(only_light()), **SAMPLED)


@pytest.mark.parametrize("off_axis", [0, 10, 18, 22, 28, 35])
def test_edge_of_a_spot(floor, tmp_path, off_axis):
    """smoothstep over the blend, in the cosine of the angle to the axis."""
    angle = radians(off_axis)
    lamp("SPOT", at=(0, 0, 2), turn=(angle, 0, 0), energy=WATTS, spot_size=radians(60), spot_blend=0.7)
    light = only_light()
    edge = cos(light.spot_angle / 2)
    t = np.clip((cos(angle) - edge) / (light.spot_blend * (1 - edge)), 0, 1)
    np.testing.assert_allclose(irradiance(tmp_path), from_point(light) * t * t * (3 - 2 * t), rtol=1e-3, atol=1e-6)


@pytest.mark.parametrize("scale", [(1, 1, 0.5), (0.5, 0.5, 1), (2, 2, 2)])
def test_scale_widens_a_spot(floor, tmp_path, scale):
    angle = radians(20)
    lamp("SPOT", at=(0, 0, 2), turn=(angle, 0, 0), scale=scale, energy=WATTS, spot_size=radians(60), spot_blend=0.0)
    light = only_light()
    inside = angle < light.spot_angle / 2
    np.testing.assert_allclose(irradiance(tmp_path), from_point(light) * inside, rtol=1e-3)
    assert tan(light.spot_angle / 2) == pytest.approx(tan(radians(30)) * scale[0] / scale[2], rel=1e-5)


@pytest.mark.parametrize("angle", [0.0, 1.0])
def test_sun(floor, tmp_path, angle):
    lamp("SUN", turn=(radians(30), 0, 0), scale=(3, 3, 3), energy=3, color=(1, 0.5, 0.25), angle=angle)
    light = only_light()
    assert light.angle == pytest.approx(angle)
    np.testing.assert_allclose(irradiance(tmp_path), np.multiply(light.emitted, cos(radians(30))), **SAMPLED)


@since_45
@pytest.mark.parametrize("angle", [0.0, 0.5, 2.0])
def test_sun_that_is_not_normalised(floor, tmp_path, angle):
    lamp("SUN", energy=3, angle=angle, normalize=False)
    np.testing.assert_allclose(irradiance(tmp_path), only_light().emitted, **SAMPLED)


# Far away for its size: what the closed form leaves out is (0.1 / 4)^2
@pytest.mark.parametrize(("shape", "sides"), [("SQUARE", (0.1, 0.1)), ("RECTANGLE", (0.1, 0.04)), ("DISK", (0.1, 0.1)),
                                              ("ELLIPSE", (0.1, 0.04))])
@pytest.mark.parametrize("normalize", [True, pytest.param(False, marks=since_45)])
def test_area(floor, tmp_path, shape, sides, normalize):
    settings = {} if normalize else {"normalize": False}
    lamp("AREA", at=(0, 0, 4), energy=WATTS, shape=shape, size=0.1, size_y=0.04, **settings)
    light = only_light()
    np.testing.assert_allclose(light.size, sides)
    np.testing.assert_allclose(irradiance(tmp_path), from_small_area(light), **SAMPLED)


@pytest.mark.parametrize("scale", [(2, 3, 1), (-1, 2, 1), (1, 1, -1), (-1, -1, -1)])
@pytest.mark.parametrize("normalize", [True, pytest.param(False, marks=since_45)])
def test_scale_of_an_area(floor, tmp_path, scale, normalize):
    """It changes the size, not the watts; a negative one along Z turns the front away."""
    settings = {} if normalize else {"normalize": False}
    lamp("AREA", at=(0, 0, 4), scale=scale, energy=WATTS, shape="RECTANGLE", size=0.05, size_y=0.04, **settings)
    light = only_light()
    np.testing.assert_allclose(light.size, np.abs((0.05 * scale[0], 0.04 * scale[1])), rtol=1e-6)
    expected = from_small_area(light)
    assert (expected[0] > 0) == (scale[2] > 0)
    np.testing.assert_allclose(irradiance(tmp_path), expected, **SAMPLED)


def test_area_aside(floor, tmp_path):
    lamp("AREA", at=(0, 3, 3), turn=(radians(-60), 0, 0), energy=WATTS, shape="SQUARE", size=0.1)
    np.testing.assert_allclose(irradiance(tmp_path), from_small_area(only_light()), **SAMPLED)


@pytest.mark.parametrize("off_axis", [0, 20, 40])
@pytest.mark.parametrize("spread", [170, 90, 30])
def test_spread(floor, tmp_path, spread, off_axis):
    """The lobe max(tan h - tan a, 0) / (tan h - h), whose flux is that of the full lobe."""
    angle, h = radians(off_axis), radians(spread) / 2
    lamp("AREA", at=(0, 4 * sin(angle), 4 * cos(angle)), turn=(0, 0, 0), energy=WATTS, shape="SQUARE", size=0.01,
         spread=2 * h)
    light = only_light()
    assert light.spread == pytest.approx(2 * h)
    lobe = max(tan(h) - tan(angle), 0) / (tan(h) - h)
    # A centimetre of floor and one of lamp, 4 m apart, see each other under up to 2.5 mrad more
    np.testing.assert_allclose(irradiance(tmp_path), from_small_area(light) * lobe, rtol=2e-3 + 2.5e-3 / tan(h))


@pytest.mark.parametrize("settings", [{"size": 0.0}, {"size_y": 0.0}])
def test_area_without_area_gives_no_light(floor, tmp_path, settings):
    lamp("AREA", at=(0, 0, 4), energy=WATTS, shape="RECTANGLE", **{"size": 0.1, "size_y": 0.1} | settings)
    assert extracted().lights == ()
    assert not irradiance(tmp_path).any()


def test_portal_gives_no_light(floor, tmp_path):
    lamp("AREA", at=(0, 0, 4), energy=WATTS).data.cycles.is_portal = True
    assert extracted().lights == ()
    assert not irradiance(tmp_path).any()


@since_45
@pytest.mark.parametrize("kelvin", [1500, 4000, 12000])
def test_temperature_and_exposure(floor, tmp_path, kelvin):
    lamp("SUN", energy=1, angle=0, color=(1, 0.5, 0.25), use_temperature=True, temperature=kelvin, exposure=1.5)
    light = only_light()
    np.testing.assert_allclose(irradiance(tmp_path), light.emitted, **EXACT)
    assert light.emitted[0] != pytest.approx(4 * light.emitted[2])


def test_emission_node_of_a_lamp(floor, tmp_path):
    owner = lamp("POINT", at=(0, 0, 2), energy=WATTS, color=(1, 0.5, 1))
    owner.data.use_nodes = True
    node = owner.data.node_tree.nodes["Emission"]
    node.inputs["Color"].default_value, node.inputs["Strength"].default_value = (0.2, 0.4, 0.6, 1), 3
    np.testing.assert_allclose(irradiance(tmp_path), from_point(only_light()), **EXACT)


def test_world(floor, tmp_path):
    """A uniform world of radiance L gives E = pi L."""
    nodes = world()
    nodes.show(nodes.new("Background", Color=(0.2, 0.4, 0.6, 1), Strength=2))
    np.testing.assert_allclose(irradiance(tmp_path), np.multiply(extracted().world.radiance, pi), **SAMPLED)


def test_emission_of_a_surface(empty, tmp_path):
    nodes = material()
    plane(nodes.show(nodes.new("BsdfPrincipled", Emission_Color=(0.2, 0.4, 0.6, 1), Emission_Strength=2,
                               Base_Color=(0, 0, 0, 1), Specular_IOR_Level=0.0)))
    cycles.look_down()
    seen = cycles.render(tmp_path)[..., :3].mean((0, 1))
    np.testing.assert_allclose(seen, extracted().materials[0].emission, **EXACT)
