# SPDX-License-Identifier: GPL-3.0-or-later
"""No edit compiles anything once all is compiled; what a frame runs was told beforehand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import pytest

from svo_engine.film import Film
from svo_engine.needs import needs_of
from svo_engine.passes.denoise.choice import wanted
from svo_engine.passes.programs import all_programs, programs_for
from svo_engine.render import Session
from svo_engine.scene.types import Scene, World
from svo_engine.settings import PASSES, RenderSettings
from tests import scenes, variety

SETTINGS = replace(scenes.SMALL, method="rays", cache_resolution="32", cache_rays=2, gather_rays=1,
                   adaptive_sampling=False)
ALL_PASSES = {"passes": tuple(PASSES)}
NOISY = {"samples": 16, "adaptive_sampling": True, "noise_threshold": 0.5, "min_samples": 8}

WARM_UP: list[tuple[Scene, dict[str, Any]]] = [
    (variety.alcove(), {}),
    (variety.alcove(variety.METAL), ALL_PASSES),
    (variety.SCENES["everything"](), NOISY),
    (variety.alcove(), {"method": "cones"}),
    (variety.alcove(), {"denoise": True, "denoiser": "atrous"}),
    (variety.alcove(), {"view": "cache"}),
    (variety.alcove(), {"view": "voxel_albedo"}),
]


def edited(*lights: Any, **of_plate: Any) -> Scene:
    """The alcove with other lamps, or with a plate of another material."""
    return variety.alcove(replace(variety.PLAIN, **of_plate), *lights)


def moved(**fields: Any) -> Scene:
    """The alcove with other fields of its instances."""
    scene = variety.alcove()
    return replace(scene, instances=replace(scene.instances, **fields))


def seen_from(x: float) -> Scene:
    scene = variety.alcove()
    assert scene.camera is not None
    return replace(scene, camera=replace(scene.camera, world_from_camera=scenes.look((x, -3.0, 1.0), (0, 0, 0.6))))


def with_thing(*things: scenes.Thing) -> Scene:
    back = scenes.Thing(scenes.quad("Back", (-1, 1, 0), (2, 0, 0), (0, 0, 1.6)), scenes.RED)
    camera = variety.alcove().camera
    return scenes.scene(scenes.Thing(scenes.floor()), back, *things, camera=camera, lights=(variety.bulb(),))


PLACES = variety.alcove().instances.world_from_object
BALL = scenes.Thing(scenes.sphere("Ball", 0.3, 6), variety.COATED, (scenes.moved(0.5, 0, 0.4),))

EDITS: dict[str, tuple[Scene, dict[str, Any]]] = {
    "lamp power": (edited(variety.bulb(emitted=2.0)), {}),
    "lamp moved": (edited(variety.bulb(-0.5)), {}),
    "a sun": (edited(scenes.lamp("SUN", (1, -3, 2), emitted=0.5, angle=0.01)), {}),
    "a spot": (edited(scenes.lamp("SPOT", (0.5, -1, 1.5), emitted=3.0, spot_angle=1.0)), {}),
    "an area": (edited(scenes.lamp("AREA", (0, -0.5, 1.6), emitted=4.0, size=(0.5, 0.3))), {}),
    "two lamps": (edited(*variety.bulbs(2)), {}),
    "three lamps": (edited(*variety.bulbs(3)), {}),
    "ten lamps": (edited(*variety.bulbs(10)), {}),
    "no lamp": (variety.alcove(lights=()), {}),
    "colour": (edited(base_color=(0.2, 0.3, 0.9)), {}),
    "roughness": (edited(roughness=0.1), {}),
    "specular": (edited(specular_level=0.5), {}),
    "specular, rough": (edited(specular_level=0.5, roughness=1.0), {}),
    "metallic": (edited(metallic=1.0), {}),
    "transmission": (edited(transmission=1.0), {}),
    "alpha": (edited(alpha=0.5), {}),
    "alpha image": (edited(alpha_texture=0), {}),
    "emission": (edited(emission=(1.0, 2.0, 3.0)), {}),
    "emission of a metal": (edited(emission=(1.0, 2.0, 3.0), metallic=1.0, roughness=0.1), {}),
    "texture": (edited(base_color_texture=0), {}),
    "normal map": (edited(normal_texture=0), {}),
    "object moved": (moved(world_from_object=PLACES @ scenes.moved(0.1, 0, 0)), {}),
    "object added": (with_thing(BALL), {}),
    "object deleted": (with_thing(), {}),
    "mesh edited": (with_thing(scenes.Thing(scenes.sphere("Ball", 0.3, 7), variety.COATED, BALL.places)), {}),
    "everything deleted": (scenes.scene(camera=variety.alcove().camera), {}),
    "camera": (seen_from(0.8), {}),
    "world": (variety.alcove(world=World((0.2, 0.3, 0.4))), {}),
    "world image": (variety.alcove(world=World((1.0, 1.0, 1.0), 1)), {}),
    "passes": (variety.alcove(), ALL_PASSES),
    "more samples": (variety.alcove(), {"samples": 3}),
    "adaptive": (variety.alcove(), NOISY),
    "denoiser": (variety.alcove(variety.METAL), {"denoise": True, "denoiser": "atrous"}),
    "another cache": (variety.alcove(), {"cache_resolution": "64", "bounces": 2}),
    "cones": (variety.alcove(variety.METAL), {"method": "cones"}),
    "and back": (variety.alcove(variety.METAL), {}),
    "the cache's colours": (variety.alcove(variety.METAL), {"view": "cache_albedo"}),
    "voxel normals": (variety.alcove(variety.METAL), {"view": "voxel_normal"}),
    "voxel radiance": (variety.alcove(variety.METAL), {"view": "voxel_radiance"}),
    "without skipping": (variety.alcove(), {"skip_unneeded": False}),
}


@dataclass(frozen=True)
class Warm:
    """A session of its own that has rendered a little of everything, as `films`."""

    session: Session
    films: list[Film]


@pytest.fixture(scope="module")
def warm() -> Iterator[Warm]:
    session = Session()
    yield Warm(session, [film(session, scene, settings) for scene, settings in WARM_UP])
    session.close()


def film(session: Session, scene: Scene, settings: dict[str, Any], size: tuple[int, int] = variety.SIZE) -> Film:
    return list(session.films(scene, scenes.view(scene, size=size), replace(SETTINGS, **settings)))[-1]


def told(scene: Scene, settings: RenderSettings) -> set[str]:
    """Names of the passes that are said to be run by a frame."""
    return {pass_.name for pass_, _ in programs_for(needs_of(scene, settings), settings, wanted(settings), True)}


def ran(of: Film) -> set[str]:
    """Names of the passes that a frame did run."""
    return {name for name in of.stats["counts"] if "/" in name and " " not in name}


@pytest.mark.parametrize("name", EDITS)
def test_no_edit_compiles_anything_and_all_that_it_runs_was_told(warm, name):
    scene, settings = EDITS[name]
    edited_film = film(warm.session, scene, settings)
    assert edited_film.stats["counts"]["programs compiled"] == 0
    assert ran(edited_film) - told(scene, replace(SETTINGS, **settings)) == set()


COLORS = {"octree/paint", "octree/blend", "cache/start", "cache/bounce", "cache/finish"}
DIRECT = {"cache/direct", "cache/start", "cache/bounce", "cache/finish"}
GLOW = {"cache/found", "cache/draw"}

# What is redone of what frames keep: links are traced anew by what stops rays or is elsewhere, and by that alone
REDONE: dict[str, tuple[Scene, set[str]]] = {
    "nothing": (variety.alcove(), set()),
    "camera": (seen_from(0.8), set()),
    "lamp": (edited(variety.bulb(emitted=2.0)), DIRECT),
    "world": (variety.alcove(world=World((0.2, 0.3, 0.4))), DIRECT | {"cache/sky"}),
    "colour": (edited(base_color=(0.2, 0.3, 0.9)), COLORS),
    "roughness": (edited(roughness=0.1), COLORS),
    "specular": (edited(specular_level=0.5), COLORS),
    "metallic": (edited(metallic=1.0), COLORS),
    "transmission": (edited(transmission=1.0), COLORS),
    "emission": (edited(emission=(1.0, 2.0, 3.0)), COLORS | DIRECT | GLOW),
    "alpha": (edited(alpha=0.5), COLORS | DIRECT | {"cache/link"}),
}


@pytest.mark.parametrize("name", REDONE)
def test_an_edit_redoes_what_it_changes(warm, name):
    film(warm.session, variety.alcove(), {})
    scene, redone = REDONE[name]
    after = film(warm.session, scene, {})
    assert {name for name in ran(after) if name.split("/")[0] in ("bvh", "cache", "octree", "voxelize")} == redone


def test_the_colour_of_what_shines_traces_nothing(warm):
    film(warm.session, edited(emission=(1.0, 2.0, 3.0)), {})
    after = film(warm.session, edited(emission=(1.0, 2.0, 3.0), base_color=(0.2, 0.3, 0.9)), {})
    assert {name for name in ran(after) if name.startswith(("cache/", "octree/"))} == COLORS


def test_another_size_compiles_nothing(warm):
    assert film(warm.session, variety.alcove(), {}, (17, 30)).stats["counts"]["programs compiled"] == 0


@pytest.mark.parametrize("number", range(len(WARM_UP)))
def test_first_frames_run_what_was_told(warm, number):
    scene, settings = WARM_UP[number]
    assert ran(warm.films[number]) - told(scene, replace(SETTINGS, **settings)) == set()


@pytest.mark.parametrize("is_software", [False, True])
@pytest.mark.parametrize("name", EDITS)
def test_all_programs_are_all_that_any_frame_is_told_to_run(name, is_software):
    scene, settings = EDITS[name][0], replace(SETTINGS, **EDITS[name][1])
    of_frame = programs_for(needs_of(scene, settings), settings, wanted(settings), is_software)
    assert [variant for variant in of_frame if variant not in all_programs(is_software)] == []


def test_all_that_was_ever_compiled_is_among_all_programs(warm):
    """So that what is compiled ahead is what edits need."""
    compiled = warm.session.opened().thread.call(lambda device: set(device.programs._ready))
    known = {(pass_.key, frozenset(constants.items())) for pass_, constants in all_programs(True)}
    assert compiled - known == set()
