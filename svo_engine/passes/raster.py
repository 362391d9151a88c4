# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene and View -> GBuffer: which triangle each pixel sees."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..gpu.device import Device, DrawCall
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..scene.types import View
from ..settings import RenderSettings
from .bvh import TRACE, TRACE_UNIFORMS, Bvh
from .pixel_filter import jitter
from .upload import GpuScene
from .voxelize import GEOMETRY, MATERIALS

VISIBILITY = Pass(("raster/visibility.vert.glsl", "raster/visibility.frag.glsl"), (*GEOMETRY, *MATERIALS),
                  uniforms=("u_clip_from_world", "u_first_instance", "u_first_triangle", "u_sample", "u_seed"))
CAMERA = Pass(("raster/camera.comp.glsl",), (*GEOMETRY, *MATERIALS), textures=("u_tiles", *TRACE), images=("u_seen",),
              uniforms=("u_ray_origin", "u_ray_direction", "u_size", "u_depth", *TRACE_UNIFORMS))


@dataclass(frozen=True, eq=False)
class Targets:
    """What a picture of one size is drawn into; kept from sample to sample."""

    scope: GpuScope
    size: tuple[int, int]
    visibility: Any
    framebuffer: Any


@dataclass(frozen=True, eq=False)
class GBuffer:
    """visibility: instance + 1 (0: nothing), triangle, barycentrics. world_from_clip: (4, 4) f8, to the centre.

    tiles  texture u4: not 0 where a tile of 8 by 8 pixels needs no more light; None: all need it
    """

    targets: Targets
    world_from_clip: np.ndarray
    tiles: Any = None

    @property
    def n_invocations(self) -> int:
        """Invocations of a pass over all pixels in tiles of 8 by 8."""
        width, height = self.targets.size
        return -(-width // 8) * -(-height // 8) * 64

    def constants(self) -> dict[str, bool]:
        """The constants of bind/tiles.glsl."""
        return {"IS_ADAPTIVE": self.tiles is not None}

    def uniforms(self) -> dict[str, Any]:
        """The uniforms of bind/camera.glsl and bind/gbuffer.glsl."""
        return {"u_visibility": self.targets.visibility, **self.camera()}

    def camera(self) -> dict[str, Any]:
        """The uniforms of bind/camera.glsl."""
        origin, direction, _ = self.rays
        return {"u_ray_origin": origin, "u_ray_direction": direction, "u_size": self.targets.size}

    @cached_property
    def rays(self) -> tuple[np.ndarray, np.ndarray, float]:
        """See the function of that name."""
        return rays(self.world_from_clip)


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
    return Targets(scope, size, visibility, scope.framebuffer("visibility", [visibility], with_depth=True))


def raster(device: Device, gpu_scene: GpuScene, view: View, targets: Targets, settings: RenderSettings,
           sample: int, tiles: Any = None, bvh: Bvh | None = None) -> GBuffer:
    """What each pixel sees in one sample, its centre shifted by the pixel filter: by rays if there is a `bvh`."""
    clip_from_world = _clip_from_world(gpu_scene, view, settings, sample)
    gbuffer = GBuffer(targets, np.linalg.inv(clip_from_world), tiles)
    if bvh and can_trace(gpu_scene, bvh):
        device.dispatch(CAMERA, gbuffer.n_invocations, {**gbuffer.constants(), **bvh.constants()}, **gpu_scene.geometry,
                        **gpu_scene.materials, **bvh.resources(), **gbuffer.camera(), u_tiles=tiles,
                        u_seen=targets.visibility, u_depth=gbuffer.rays[2])
    else:
        _draw(device, gpu_scene, targets, clip_from_world, settings, sample)
    return gbuffer


def can_trace(gpu_scene: GpuScene, bvh: Bvh) -> bool:
    """Whether rays do better than the rasteriser, which a software renderer has at a tenth of their time.

    A graphics card takes .3 ms to change between drawing and dispatches. Alpha is for the rasteriser, which spreads the
    samples that it lets through evenly.
    """
    return not bvh.in_lockstep and not gpu_scene.has_alpha


def _clip_from_world(gpu_scene: GpuScene, view: View, settings: RenderSettings, sample: int) -> np.ndarray:
    """(4, 4) f8, from metres relative to the scene's centre, for the positions in the pixels of one sample."""
    clip_from_world = view.clip_from_view @ np.linalg.inv(view.world_from_view)
    clip_from_world[:, 3] += clip_from_world[:, :3] @ gpu_scene.centre_ws
    shift = np.eye(4, dtype="f8")
    x, y = jitter(sample, settings.seed, settings.filter_width)
    shift[0, 3], shift[1, 3] = -2 * x / view.size[0], -2 * y / view.size[1]
    return shift @ clip_from_world


def _draw(device: Device, gpu_scene: GpuScene, targets: Targets, clip_from_world: np.ndarray,
          settings: RenderSettings, sample: int) -> None:
    """Fill `targets` by drawing all triangles."""
    device.clear(targets.framebuffer)
    constants = {"HAS_ALPHA": gpu_scene.has_alpha, "HAS_TEXTURES": gpu_scene.has_textures}
    calls = (DrawCall(3 * part.n_triangles, part.n_instances,
                      {"u_first_instance": part.first_instance, "u_first_triangle": part.first_triangle})
             for part in gpu_scene.draws)
    device.draw(VISIBILITY, targets.framebuffer, calls, constants, **gpu_scene.geometry, **gpu_scene.materials,
                u_clip_from_world=clip_from_world, u_sample=sample, u_seed=settings.seed)
