# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers by which the rays' light is judged, each with the most that it may be. `test_figures.py` holds them
against that, `python -m tools.physics` writes them down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from svo_engine.render import Session
from svo_engine.scene.types import Camera, Material, Scene, World
from tests import scenes
from tests.rays import TURN, above, glow, shot

EYE = scenes.look((-0.8, -0.7, -0.3), (0.5, 0.9, 0.2))
STRAIGHT = np.eye(4)

# Where one stands in each room and what one looks at, by the wall's angle to the axes
LIT = {0: ((-0.15, -0.8, 0.8), (-1.6, 0.6, -0.8)), 45: ((-0.9, 0.9, 0.9), (0.2, 0.3, -0.7))}
DARK = {0: ((1.8, -0.8, 0.8), (0.2, 0.5, -0.8)), 45: ((0.9, -0.9, 0.9), (-0.2, -0.3, -0.7))}


@dataclass(frozen=True)
class Figure:
    """An error without unit: `measure` finds it, `most` bounds it. group: what is asked, name: where."""

    group: str
    name: str
    most: float
    measure: Callable[[Session], float]


def inside(place: np.ndarray) -> Camera:
    """A wide camera."""
    return Camera("Inside", place, (32, 24), lens=20.0, clip_start=0.001)


def furnace(rho: float, turn: np.ndarray = STRAIGHT) -> Scene:
    """Walls of a closed box that send out 1 and reflect rho, seen from inside."""
    box = scenes.Thing(scenes.box("Box", (-1, -1, -1), (1, 1, 1)), glow(1.0, rho), (turn,))
    return scenes.scene(box, camera=inside(turn @ EYE))


def furnace_error(session: Session, rho: float, turn: np.ndarray, resolution: str) -> float:
    """L = Le / (1 - rho) on every pixel, whatever the rays."""
    found = shot(session, furnace(rho, turn), cache_resolution=resolution, cache_rays=1, gather_rays=1, bounces=64)
    return float(np.abs(found * (1 - rho) - 1).max())


def runaway(session: Session, bounces: int) -> float:
    """Nothing absorbed: k bounces and those of lamp and pixel add up to k + 2; not more, and not for ever."""
    found = shot(session, furnace(1.0), cache_rays=1, gather_rays=1, bounces=bounces)
    return float(np.abs(found / (bounces + 2) - 1).max())


def white_room(session: Session) -> np.ndarray:
    """Albedo 1 everywhere and radiance 1 from outside: all light gets out again, and all that is seen is 1."""
    white = Material("White", (1, 1, 1), specular_level=0)
    things = [replace(thing, material=white) for thing in scenes.room()]
    return shot(session, scenes.scene(*things, camera=scenes.cornell().camera, world=World((1, 1, 1))), bounces=64)


def resolution_error(session: Session, resolution: str) -> float:
    """The mean of a room with a lamp, colours and a block against that at 256 cubed."""
    found, finest = (shot(session, scenes.cornell(), samples=4, cache_resolution=n).mean() for n in (resolution, "256"))
    return abs(float(found / finest) - 1)


def rooms(degrees: int, n: int = 1) -> Scene:
    """Two rooms of 2 m side by side, or one cut from edge to edge, by a wall of 2 n^2 triangles. All is white."""
    if degrees == 0:
        shell, wall = scenes.box("Shell", (-2, -1, -1), (2, 1, 1)), ((0, -1, -1), (0, 2, 0), (0, 0, 2))
        lamp = scenes.lamp("POINT", (-0.9, 0.1, 0.3), emitted=5.0)
    else:
        shell, wall = scenes.box("Shell", (-1, -1, -1), (1, 1, 1)), ((-1, -1, -1), (2, 2, 0), (0, 0, 2))
        lamp = scenes.lamp("POINT", (-0.5, 0.5, 0.3), emitted=5.0)
    return scenes.scene(scenes.Thing(shell), scenes.Thing(scenes.quad("Wall", *wall, n)), lights=(lamp,))


def seen_from(scene: Scene, eye: tuple) -> Scene:
    """`scene` with a wide camera at eye[0] that looks at eye[1]."""
    return replace(scene, camera=Camera("Camera", scenes.look(*eye), (32, 24), lens=15.0, clip_start=0.001))


def leak(session: Session, degrees: int, resolution: str, n: int = 1) -> float:
    """Light in the room behind the wall over that in the room with the lamp."""
    scene = rooms(degrees, n)
    lit, dark = (shot(session, seen_from(scene, eyes[degrees]), samples=4, cache_resolution=resolution).mean()
                 for eyes in (LIT, DARK))
    return float(dark / lit)


def tessellation_in_rooms(session: Session, degrees: int) -> float:
    """The lit room, its wall of 20,000 triangles and of 2."""
    coarse, fine = (shot(session, seen_from(rooms(degrees, n), LIT[degrees]), samples=4).mean() for n in (1, 100))
    return abs(float(fine / coarse) - 1)


def tessellation_of_a_wall(session: Session) -> float:
    """What a sunlit wall of 20,000 triangles sends to a floor, and one of 2; the worst channel."""
    sun, means = scenes.lamp("SUN", (1, 0, 0.5), emitted=3.0), []
    for n in (1, 100):
        wall = scenes.Thing(scenes.quad("Wall", (-0.5, -1, 0), (0, 2, 0), (0.1, 0, 1.5), n), scenes.RED)
        scene = scenes.scene(scenes.Thing(scenes.floor()), wall, lights=(sun,), camera=above())
        means.append(shot(session, scene, samples=4).mean((0, 1)))
    return float(np.abs(means[1] / means[0] - 1).max())


def placed_anew(scene: Scene, change: np.ndarray, gain: float = 1.0) -> Scene:
    """The whole scene under a similarity, its grey lamps `gain` times as bright."""
    scale, camera = np.cbrt(np.linalg.det(change[:3, :3])), scene.camera
    assert camera

    def rigid(m: np.ndarray) -> np.ndarray:
        return change @ m @ np.diag([1 / scale] * 3 + [1])

    lights = tuple(replace(light, world_from_light=rigid(light.world_from_light), radius=light.radius * scale,
                           emitted=(gain * light.emitted[0],) * 3) for light in scene.lights)
    camera = replace(camera, world_from_camera=rigid(camera.world_from_camera), clip_start=camera.clip_start * scale,
                     clip_end=camera.clip_end * scale)
    placed = replace(scene.instances, world_from_object=change @ scene.instances.world_from_object)
    return replace(scene, instances=placed, lights=lights, camera=camera)


def here_and_far_away(session: Session) -> Iterator[np.ndarray]:
    """The room at the origin and two thousand kilometres away: doubles keep 1e-10 m there, and all f4 numbers are
    relative to the scene's centre. A ray that passes an edge may pass it on the other side.
    """
    scene = scenes.cornell(world=World((0.1, 0.2, 0.3)))
    return (shot(session, s) for s in (scene, placed_anew(scene, scenes.moved(1e6, -2e6, 5e5))))


def moved_mean(session: Session) -> float:
    here, there = (found.mean() for found in here_and_far_away(session))
    return abs(float(there / here) - 1)


def moved_pixels(session: Session) -> float:
    here, there = here_and_far_away(session)
    return 1 - float(np.isclose(here, there, rtol=2e-3, atol=2e-4).all(2).mean())


def scaled(session: Session, scale: float) -> float:
    """A room of 2 km with a lamp of 10^6 times the power is the room of 2 m, and so is one of 2 mm; worst pixel. Powers
    of two leave no room for rounding: what differs would be a length that somebody wrote down.
    """
    scene = scenes.cornell()
    usual, other = (shot(session, s) for s in (scene, placed_anew(scene, np.diag([scale] * 3 + [1]), scale**2)))
    return float((np.abs(other - usual) / np.maximum(usual, 1e-6 * usual.mean())).max())


def unrepeatable(session: Session) -> float:
    """Share of numbers that another session finds otherwise."""
    other = Session()
    try:
        return float((shot(session, scenes.rich(), samples=2) != shot(other, scenes.rich(), samples=2)).mean())
    finally:
        other.close()


def _furnaces() -> Iterator[Figure]:
    """The tolerance that ends bounces leaves out rho^3 of it. Askew, every face cuts voxels at an angle."""
    group = "White furnace: worst pixel against Le / (1 - rho)"
    for turn, how in ((STRAIGHT, "straight"), (TURN, "askew")):
        for n in ("32", "64", "128", "256"):
            yield Figure(group, f"rho 0.5, {how}, {n} cubed", 2e-3,
                         lambda session, turn=turn, n=n: furnace_error(session, 0.5, turn, n))  # type: ignore[misc]
    yield Figure(group, "rho 0.8, askew, 32 cubed", 5e-3, lambda session: furnace_error(session, 0.8, TURN, "32"))


def _bounces() -> Iterator[Figure]:
    """The tolerance ends bounces at 0.5 % of what the first brought; with 1 / (1 - 0.85) bounces in a room with one
    side open, up to 3 % of that is missing, in the corners of most. Albedo ends at 0.9999: 64 bounces lose 0.3 %.
    """
    for k in (8, 16, 64):
        yield Figure("Albedo 1 in a closed box: worst pixel against the sum of k bounces", f"{k} bounces", 5e-3,
                     lambda session, k=k: runaway(session, k))  # type: ignore[misc]
    group = "Albedo 1 in an open room under a white sky: against 1"
    yield Figure(group, "worst pixel too bright by", 1e-5, lambda session: float(white_room(session).max()) - 1)
    yield Figure(group, "mean too dark by", 0.01, lambda session: 1 - float(white_room(session).mean()))


def _rooms() -> Iterator[Figure]:
    """The voxels at the wall's foot hold floor of both rooms. At 45 degrees the wall and the side walls that it meets
    share surfels along two edges, from the floor to the ceiling.
    """
    group = "Two rooms, a wall without thickness: light behind it over light before it"
    for degrees, most in ((0, 1e-3), (45, 0.01)):
        for n in ("32", "64", "128"):
            yield Figure(group, f"{degrees} degrees, {n} cubed", most,
                         lambda session, degrees=degrees, n=n: leak(session, degrees, n))  # type: ignore[misc]
        yield Figure(group, f"{degrees} degrees, 32 cubed, 20,000 triangles", 0.01,
                     lambda session, degrees=degrees: leak(session, degrees, "32", 100))  # type: ignore[misc]


def _changes() -> Iterator[Figure]:
    for n in ("32", "64", "128"):
        yield Figure("Resolution of the light cache: mean against 256 cubed", f"{n} cubed", 0.02,
                     lambda session, n=n: resolution_error(session, n))  # type: ignore[misc]
    group = "The same wall as 2 and as 20,000 triangles: mean"
    yield Figure(group, "sunlit, seen by its light on a floor", 0.01, tessellation_of_a_wall)
    for degrees in (0, 45):
        yield Figure(group, f"between two rooms, {degrees} degrees", 0.01,
                     lambda session, degrees=degrees: tessellation_in_rooms(session, degrees))  # type: ignore[misc]


def _extremes() -> Iterator[Figure]:
    group = "Far from the origin, 2.3e6 m: against the same room there"
    yield Figure(group, "mean", 2e-3, moved_mean)
    yield Figure(group, "share of pixels that differ by 0.2 %", 0.02, moved_pixels)
    for scale, size in ((2.0**10, "2 km, 10^6 times the power"), (2.0**-10, "2 mm, a millionth of the power")):
        yield Figure("Size: worst pixel against the room of 2 m", size, 1e-4,
                     lambda session, scale=scale: scaled(session, scale))  # type: ignore[misc]
    yield Figure("Repeated in another session: share of numbers that differ", "all kinds of lamps", 0.0, unrepeatable)


FIGURES = (*_furnaces(), *_bounces(), *_changes(), *_rooms(), *_extremes())
