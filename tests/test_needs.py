# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene needs, by its materials, lamps and world."""

from __future__ import annotations

from dataclasses import replace

import pytest

from svo_engine.needs import LONGEST_PATH, Needs, needs_of
from svo_engine.scene.types import Material, Scene, World
from svo_engine.settings import RenderSettings
from tests import scenes, variety

NOTHING = Needs(light=False, lamps=False, emission=False, world=False, principled=False, textures=False, alpha=False,
                gloss=False, glass=False, path_vertices=2, skips=True)
BASE = scenes.WHITE


def of(material: Material = BASE, **more) -> Needs:
    """What a floor of that material needs."""
    textures = {"textures": variety.alcove().textures, "images": (variety.CHECKS,)}
    return needs_of(scenes.scene(scenes.Thing(scenes.floor(), material), **{**textures, **more}), RenderSettings())



@pytest.mark.parametrize(("material", "needed"), [
    (BASE, set()),
    (replace(BASE, emission=(0, 1, 0)), {"light", "emission"}),
    (replace(BASE, alpha=0.5), {"alpha"}),
    (replace(BASE, alpha_texture=0), {"alpha", "textures", "principled"}),
    (replace(BASE, base_color_texture=0), {"textures", "principled"}),
    (replace(BASE, normal_texture=0), {"textures", "principled"}),
    (replace(BASE, roughness_texture=0), {"textures", "principled"}),
    (replace(BASE, metallic=1.0), {"gloss", "principled"}),
    (replace(BASE, metallic=0.0, metallic_texture=0), {"gloss", "principled", "textures"}),
    (replace(BASE, specular_level=0.5), {"gloss", "principled"}),
    (replace(BASE, transmission=0.1), {"gloss", "principled", "glass"}),
])
def test_a_material_needs_what_it_has(material, needed):
    rough = replace(material, roughness=1.0)
    vertices = LONGEST_PATH if "glass" in needed else 2
    assert of(rough) == replace(NOTHING, **dict.fromkeys(needed, True), path_vertices=vertices)


@pytest.mark.parametrize(("roughness", "texture", "vertices"), [
    (-1.0, -1, LONGEST_PATH), (0.0, -1, LONGEST_PATH), (0.49, -1, LONGEST_PATH), (0.5, -1, 2), (1.0, -1, 2),
    (1.0, 0, LONGEST_PATH)])
def test_paths_are_long_where_a_mirror_could_show_another(roughness, texture, vertices):
    assert of(replace(BASE, metallic=1.0, roughness=roughness, roughness_texture=texture)).path_vertices == vertices
    assert of(replace(BASE, roughness=roughness, roughness_texture=texture)).path_vertices == 2


def test_lamps_and_the_world_shine():
    assert of(lights=(variety.bulb(),)) == replace(NOTHING, light=True, lamps=True)
    assert of(world=World((0, 0, 0.1))) == replace(NOTHING, light=True, world=True)
    assert of(world=World((1, 1, 1), 0)) == replace(NOTHING, light=True, world=True)


def test_what_shines_with_no_power_is_not_there():
    assert of(lights=(variety.bulb(emitted=0.0),), world=World((0, 0, 0), 0)) == NOTHING


def test_materials_that_nothing_uses_need_nothing():
    scene = scenes.scene(scenes.Thing(scenes.floor()))
    assert needs_of(replace(scene, materials=(*scene.materials, variety.GLASS)), RenderSettings()) == NOTHING


def test_an_empty_scene_needs_nothing():
    assert needs_of(Scene(), RenderSettings()) == NOTHING


def test_without_skipping_everything_is_needed():
    all_of_it = needs_of(Scene(), RenderSettings(skip_unneeded=False))
    assert all_of_it == Needs(*[True] * 9, path_vertices=LONGEST_PATH, skips=False)
    assert all_of_it.told() == {}


def test_users_are_told_what_is_skipped_and_why():
    told = NOTHING.told()
    assert told.keys() == {"light", "lamps", "emission", "world", "principled", "textures", "alpha", "gloss", "glass"}
    assert told["lamps"] == "there is no lamp"
    assert "lamps" not in of(lights=(variety.bulb(),)).told()


def test_users_are_told_that_paths_are_short_only_where_there_are_paths():
    assert of(replace(BASE, metallic=1.0, roughness=1.0)).told()["long paths"] == "no material is a mirror or glass"
    assert "long paths" not in NOTHING.told()
    assert "long paths" not in of(replace(BASE, metallic=1.0, roughness=0.0)).told()
