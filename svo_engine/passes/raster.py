# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene and View -> Hits: which triangle each pixel sees."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..gpu.device import Device, DrawCall
from ..gpu.framebuffer import Framebuffer
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..gpu.texture import Texture
from ..scene.types import View
from ..settings import RenderSettings
from .parts import EYE, Part, Parts
from .pixel_filter import jitter
from .tracer import Tracer
from .upload import GpuScene

VISIBILITY = Pass("raster/visibility.vert.glsl", "raster/visibility.frag.glsl")
HITS = Pass("raster/hits.comp.glsl")
CAMERA = Pass("raster/camera.comp.glsl")
BEYOND = Pass("raster/beyond.comp.glsl")

MOST = 1024  # samples that get numbers of a pixel's own; past them it goes on with its neighbours'


@dataclass(frozen=True, eq=False)
class Targets:
    """What a picture of one size is drawn into; kept from sample to sample."""

    scope: GpuScope
    size: tuple[int, int]
    visibility: Texture
    framebuffer: Framebuffer


@dataclass(frozen=True, eq=False)
class Eye:
    """What one sample looks through. world_from_clip: (4, 4) f8, to the centre.

    view      without the shift of the filter
    tiles     texture u4: not 0 where a tile of 8 by 8 pixels needs no more light
    is_drawn  whether the rasteriser has found what the pixels see
    """

    view: View
    world_from_clip: np.ndarray
    tiles: Texture
    sample: int
    is_drawn: bool

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.view.size

    def camera(self) -> Resources:
        """The uniforms of bind/camera.glsl."""
        origin, direction, _ = self.rays
        return {"u_ray_origin": origin, "u_ray_direction": direction, "u_size": self.size}

    def pixels(self, part: Part) -> Resources:
        """The uniforms of bind/pixels.glsl."""
        return {**self.camera(), "u_start": part.start}

    @cached_property
    def rays(self) -> tuple[np.ndarray, np.ndarray, float]:
        """See the function of that name."""
        return rays(self.world_from_clip)

    @cached_property
    def footprint(self) -> tuple[float, float]:
        """The width of a pixel in the middle of the picture: in metres, and in metres for each metre of the ray."""
        origin, direction, _ = self.rays
        ahead, beside = direction[:, 2], direction @ [2 / self.size[0], 0, 1]
        angle = beside / np.linalg.norm(beside) - ahead / np.linalg.norm(ahead)
        return float(np.linalg.norm(origin[:, 0]) * 2 / self.size[0]), float(np.linalg.norm(angle))


def rays(world_from_clip: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Matrices (3, 3) f8 that turn (x, y, 1) in clip space into a ray's origin on the near plane and its direction.

    And how many lengths of the direction it is to the far plane. In doubles: where far is 1e8 times near, f4 has
    nothing left of the far plane.
    """

    def corners(z: float) -> np.ndarray:
        points = world_from_clip @ np.array([[0.0, 1, 0], [0, 0, 1], [z, z, z], [1, 1, 1]])
        middle, right, top = (points[:3] / points[3]).T
        return np.stack([right - middle, top - middle, middle], 1)

    near, far = corners(-1), corners(1)
    direction = far - near
    depth = float(np.linalg.norm(direction[:, 2]))
    return near, direction / depth, depth


def make_targets(device: Device, size: tuple[int, int]) -> Targets:
    """Textures for pictures of `size` pixels."""
    scope = device.scope()
    visibility = scope.texture("visibility", size, 4, "u4")
    return Targets(scope, size, visibility, scope.framebuffer("visibility", visibility))


def look(device: Device, gpu_scene: GpuScene, view: View, targets: Targets, settings: RenderSettings, sample: int,
         tiles: Texture, tracer: Tracer | None = None) -> Eye:
    """One sample's eye, its pixels shifted by the filter. Draws the picture, unless rays will find what they see."""
    clip_from_world = _clip_from_world(gpu_scene, view, settings, sample)
    is_drawn = tracer is None or not can_trace(gpu_scene, tracer)
    if is_drawn:
        _draw(device, gpu_scene, targets, clip_from_world, settings, sample, sees_trees=tracer is not None)
    return Eye(view, np.linalg.inv(clip_from_world), tiles, sample, is_drawn)


def raster(device: Device, gpu_scene: GpuScene, eye: Eye, targets: Targets, tracer: Tracer | None,
           settings: RenderSettings, parts: Parts, part: Part) -> None:
    """Fill the hits of one part with what its pixels see."""
    common = {**eye.pixels(part), **parts.of(part, EYE), "u_tiles": eye.tiles, "u_sample": eye.sample,
              "u_n_samples": 1 << min(settings.samples - 1, MOST - 1).bit_length(), "u_seed": settings.seed}
    if eye.is_drawn:
        device.dispatch(HITS, part.n, **gpu_scene.geometry, **common, u_visibility=targets.visibility)
    else:
        assert tracer is not None
        device.dispatch(CAMERA, part.n, tracer.constants(), **{**tracer.resources(), "u_sees_trees": True}, **common,
                        u_depth=eye.rays[2])


def can_trace(gpu_scene: GpuScene, tracer: Tracer) -> bool:
    """Whether rays do better than the rasteriser, which a software renderer has at a tenth of their time.

    A graphics card takes .3 ms to change between drawing and dispatches. Alpha is for the rasteriser, which spreads the
    samples that it lets through evenly.
    """
    return not tracer.bvh.in_lockstep and gpu_scene.opacity.is_whole


def _clip_from_world(gpu_scene: GpuScene, view: View, settings: RenderSettings, sample: int) -> np.ndarray:
    """(4, 4) f8, from metres relative to the scene's centre, for the positions in the pixels of one sample."""
    clip_from_world = view.clip_from_view @ np.linalg.inv(view.world_from_view)
    clip_from_world[:, 3] += clip_from_world[:, :3] @ gpu_scene.centre_ws
    shift = np.eye(4, dtype="f8")
    x, y = jitter(sample, settings.seed, settings.filter_width)
    shift[0, 3], shift[1, 3] = -2 * x / view.size[0], -2 * y / view.size[1]
    return shift @ clip_from_world


def _draw(device: Device, gpu_scene: GpuScene, targets: Targets, clip_from_world: np.ndarray,
          settings: RenderSettings, sample: int, sees_trees: bool) -> None:
    """Fill `targets` by drawing all triangles."""
    targets.framebuffer.clear()
    calls = (DrawCall(3 * part.n_triangles, part.n_instances,
                      {"u_first_instance": part.first_instance, "u_first_triangle": part.first_triangle})
             for part in gpu_scene.placing.draws)
    read = {**gpu_scene.geometry, **gpu_scene.opacity.read, "u_sees_trees": sees_trees}
    device.draw(VISIBILITY, targets.framebuffer, calls, **read, u_clip_from_world=clip_from_world, u_sample=sample,
                u_seed=settings.seed)
