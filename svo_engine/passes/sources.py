# SPDX-License-Identifier: GPL-3.0-or-later
"""Trees of the world and of lamps -> the light that they send out, as arrays: by a program for each tree, run once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resource
from ..nodes.compile import One
from ..nodes.skies.suns import limb, points_on, suns_of
from ..nodes.skies.tables import Disc
from ..nodes.sources import Shine, values_of, world_trees
from ..scene.camera import make_view
from ..scene.graph import Graph
from ..scene.layouts import CONSTANTS
from ..scene.types import Camera, Image, Light, View
from .upload.pictures import upload_pictures
from .upload.shading import view_uniforms
from .upload.sky import SeenSun, Sky, sky_texture, upload_sky
from .upload.trees import PLACE

TEMPLATE = "sources/evaluate.comp.glsl"

# Texels from left to right of a world's picture: of one without images, and the most of one with some; by whether the
# processor renders
SIZES = {False: (2048, 4096), True: (1024, 2048)}
SHARPEST = {False: (8192, 4096), True: (2048, 1024)}  # of one that is fixed to the camera's own picture

_CAMERA, _DISC = CONSTANTS["RAY_CAMERA"], CONSTANTS["RAY_DISC"]
_LIGHT = CONSTANTS["RAY_DIFFUSE"] | CONSTANTS["RAY_REFLECTION"]


def make_sky(device: Device, image: Image | None, graph: Graph | None, images: tuple[Image, ...],
             camera: Camera | None = None) -> Sky:
    """The world on the device: with its image, or, where its nodes say more than values can, those of its tree.

    camera  of worlds that look another way when it is turned
    """
    if graph is None:
        return upload_sky(device, image)
    trees, suns = world_trees(graph), suns_of(graph)
    pixels = _pixels(device, trees.light, images, _LIGHT, camera)
    sky = upload_sky(device, None if pixels is None else Image("world", pixels))
    lamps = tuple(lamp for sun in suns if (lamp := _sun_lamp(device, trees.light, images, sun)))
    if trees.seen is not trees.light:
        seen = _pixels(device, trees.seen, images, _CAMERA, camera)
        sky = replace(sky, seen=None if seen is None else sky_texture(sky.scope, seen),
                      seen_color=trees.seen.color)
    notes = ("World: several suns light the scene, but the camera sees only the first one",) if len(suns) > 1 else ()
    return replace(sky, suns=lamps, sun=_seen_sun(device, trees.seen, images, suns[0]) if suns else SeenSun(),
                   notes=notes)


def _pixels(device: Device, shine: Shine, images: tuple[Image, ...], rays: int,
            camera: Camera | None) -> np.ndarray | None:
    """RGBA (height, width, 4) f4 of a world; None where it is one colour."""
    if shine.color is not None:
        return None
    size = _size(device, shine, images) if camera is None else SHARPEST[device.profiler.is_software]
    light = light_of_image(device, shine.tree, images, size, rays, camera)
    return np.concatenate([light, np.ones_like(light[..., :1])], 2)


def _size(device: Device, shine: Shine, images: tuple[Image, ...]) -> tuple[int, int]:
    """(width, height): as large as the largest image that the tree reads, within limits."""
    small, large = SIZES[device.profiler.is_software]
    used = values_of(shine.tree, _finder(images))[1]
    widest = max((images[i].pixels.shape[1] for i in used if i < len(images)), default=0)
    width = min(max(widest, small), large)
    return width, width // 2


def _sun_lamp(device: Device, shine: Shine, images: tuple[Image, ...], sun: Disc) -> Light | None:
    """A lamp that gives as much light as the disc; None if that is none."""
    disc, _ = _disc(device, shine, images, sun, _LIGHT)
    r, g, b = (np.maximum(disc.mean(0), 0) * np.pi * np.sin(sun.size / 2) ** 2).tolist()
    if max(r, g, b) <= 0:
        return None
    place = np.eye(4)
    z = sun.sun.direction
    x = np.cross((0.0, 0.0, 1.0) if abs(z[2]) < 0.9 else (1.0, 0.0, 0.0), z)
    x /= np.linalg.norm(x)
    place[:3, 0], place[:3, 1], place[:3, 2] = x, np.cross(z, x), z
    return Light("sun of the world", "SUN", place, (r, g, b), angle=sun.size)


def _seen_sun(device: Device, shine: Shine, images: tuple[Image, ...], sun: Disc) -> SeenSun:
    """The disc's radiance as a straight line of its height, by least squares."""
    disc, share = _disc(device, shine, images, sun, _CAMERA)
    directions, _ = points_on(sun)
    height = (np.arcsin(directions[:, 2]) - sun.sun.elevation) / (sun.size / 2)
    is_there = np.flatnonzero(disc.any(1))
    if not len(is_there):
        return SeenSun()
    columns = limb(share)[:, None] * np.stack([np.ones_like(height), height], 1)
    middle, slope = np.linalg.lstsq(columns[is_there], disc[is_there], rcond=None)[0].tolist()
    x, y, z = sun.sun.direction.tolist()
    return SeenSun((x, y, z), sun.size / 2, float(np.sin(sun.horizon)), tuple(middle), tuple(slope))


def _disc(device: Device, shine: Shine, images: tuple[Image, ...], sun: Disc,
          rays: int) -> tuple[np.ndarray, np.ndarray]:
    """What the disc adds to the world's radiance at points of it, (n, 3) f8, and their shares of its radius, (n,)."""
    directions, share = points_on(sun)
    if shine.color is not None:
        return np.zeros((len(share), 3)), share
    points = points_of_world(directions)
    lit, dark = (light_of_points(device, shine.tree, images, points, bits) for bits in (rays | _DISC, rays))
    return lit.astype("f8") - dark, share


def light_of_image(device: Device, tree: One, images: tuple[Image, ...], size: tuple[int, int], rays: int,
                   camera: Camera | None = None) -> np.ndarray:
    """Radiance (height, width, 3) f4 of a world in all directions, as `environment.py` lays them out.

    size  (width, height); rays: bits RAY_*; camera: for coordinates of its view
    """
    view = make_view(replace(camera, world_from_camera=_turn(camera.world_from_camera))) if camera else None
    light = _light(device, tree, images, size[0] * size[1], np.zeros((1, 3, 4), "f4"), size, rays, view=view)
    return light.reshape(size[1], size[0], 3)


def light_of_points(device: Device, tree: One, images: tuple[Image, ...], points: np.ndarray, rays: int,
                    place: np.ndarray | None = None) -> np.ndarray:
    """What the tree gives at points, (n, 3) f4.

    points  (n, 3, 4) f4: position [m] and length of the ray [m], normal and u, unit vector to the viewer and v
    place   (4, 4) f8, world_from_object of a lamp
    """
    return _light(device, tree, images, len(points), points, (0, 0), rays, place)


def points_of_world(directions: np.ndarray) -> np.ndarray:
    """What `light_of_points` takes, of rays along unit directions (n, 3) that leave the scene."""
    points = np.zeros((len(directions), 3, 4), "f4")
    points[:, 0, :3], points[:, 1, :3], points[:, 2, :3] = directions, -directions, -directions
    points[:, 0, 3] = 1e30
    return points


def _light(device: Device, tree: One, images: tuple[Image, ...], n: int, points: np.ndarray, size: tuple[int, int],
           rays: int, place: np.ndarray | None = None, view: View | None = None) -> np.ndarray:
    values, used = values_of(tree, _finder(images))
    pass_ = source_pass(tree.text)
    device.prepare([(pass_, {})])
    with device.scope() as scope:
        pictures = upload_pictures(device, (), images, tuple(used))
        scope.adopt(pictures.scope)
        made = scope.buffer("light of a source", 16 * n)
        given: dict[str, Resource] = {
            **pictures.read, **view_uniforms(view, np.zeros(3)), "Radiance": made, "u_size": size,
            "Values": scope.buffer("values of a source", values),
            "Asked": scope.buffer("points of a source", points.astype("f4")), "u_rays": rays, "u_centre": (0, 0, 0),
            "u_place": np.eye(4) if place is None else place}
        resources: Any = {name: given.get(name) for name in pass_.wanted}
        device.dispatch(pass_, n, **resources)
        light = np.empty((n, 4), "f4")
        made.read_into(light)
    return light[:, :3]


def _turn(matrix: np.ndarray) -> np.ndarray:
    """A matrix (4, 4) without its translation: where the world is, the camera is in its middle."""
    turned = matrix.copy()
    turned[:3, 3] = 0
    return turned


def _finder(images: tuple[Image, ...]) -> Callable[[Any], int]:
    """The index of an image by its name; one past the last for one that is missing."""
    names = {image.name: i for i, image in reversed(list(enumerate(images)))}  # of tiles the first
    return lambda name: names.get(name, len(images))


@lru_cache(256)
def source_pass(text: str) -> Pass:
    """The program of a tree; one object for each text, so that what is known of it stays."""
    return Pass(TEMPLATE, texts={PLACE: text})
