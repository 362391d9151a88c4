# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays of bind/trace.glsl through a Scene, called from numpy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from svo_engine.gpu.buffer import Buffer
from svo_engine.gpu.device import Device
from svo_engine.gpu.texels import Texels
from svo_engine.gpu.texture import Texture
from svo_engine.passes.bvh import build_bvh, build_meshes
from svo_engine.passes.tracer import Tracer, make_rest, tracer_of
from svo_engine.passes.upload import GpuScene, upload
from svo_engine.scene.types import Scene
from tests.compute import evaluate

NOTHING = 0xFFFFFFFF
PRELUDE = """
uvec4 closest(vec3 o, vec3 d, float t_max, uint seed)
{
    Crossing hit;
    bool is_hit = trace_closest(o, d, t_max, seed, hit);
    return uvec4(floatBitsToUint(hit.t), is_hit ? hit.instance : BVH_NONE, hit.triangle, packUnorm2x16(hit.bary));
}

bool meets_any(vec3 o, vec3 d, float t_max, uint seed)
{
    Crossing hit;
    return trace(o, d, t_max, seed, true, hit);
}
"""


@dataclass(frozen=True)
class Hits:
    """Of n rays: their distances, in lengths of d, and what they hit.

    t (n,) f4; instance (n,) u4 in the device's order, NOTHING for a miss; triangle (n,) u4 of the scene's; bary (n, 2)
    in steps of 1/65535
    """

    t: np.ndarray
    instance: np.ndarray
    triangle: np.ndarray
    bary: np.ndarray

    @property
    def is_hit(self) -> np.ndarray:
        return self.instance != NOTHING


@dataclass(frozen=True)
class Traced:
    """A scene on the device with its trees. Rays are in metres relative to the scene's centre."""

    device: Device
    gpu_scene: GpuScene
    tracer: Tracer

    def call(self, result: str, expression: str, prelude: str = "", **inputs: np.ndarray) -> np.ndarray:
        """An expression with bind/trace.glsl and bind/geometry.glsl for every row of `inputs`."""
        resources = {**self.tracer.resources(), **self.gpu_scene.geometry}
        buffers = {name: value for name, value in resources.items() if isinstance(value, Buffer)}
        textures = {name: value for name, value in resources.items() if isinstance(value, (Texels, Texture))}
        uniforms = {name: value for name, value in resources.items() if name not in {**buffers, **textures}}
        rows: dict[str, Any] = {name: _f4(values) for name, values in inputs.items()}
        return evaluate(self.device, result, expression, ("bind/trace.glsl", "bind/geometry.glsl"), PRELUDE + prelude,
                        buffers, uniforms, textures, self.tracer.constants(), **rows)

    def closest(self, o: np.ndarray, d: np.ndarray, t_max: Any = 1e30, seed: int = 0) -> Hits:
        """The nearest hits."""
        words = self.call("uvec4", f"closest(o, d, t_max, {seed}u)", o=o, d=d, t_max=np.broadcast_to(t_max, len(o)))
        bary = np.stack([words[:, 3] & 0xFFFF, words[:, 3] >> 16], 1) / 65535
        return Hits(words[:, 0].copy().view("f4"), words[:, 1], words[:, 2], bary)

    def any(self, o: np.ndarray, d: np.ndarray, t_max: Any = 1e30, seed: int = 0) -> np.ndarray:
        """Whether there is a hit before t_max."""
        t_max = np.broadcast_to(t_max, len(o))
        return self.call("bool", f"meets_any(o, d, t_max, {seed}u)", o=o, d=d, t_max=t_max) != 0


def _f4(rows: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(rows, "f4") if rows.dtype.kind == "f" else rows


def make_tracer(device: Device, gpu_scene: GpuScene) -> Tracer:
    """The rays of a scene that is on the device; nobody but the device's own list of scopes holds the trees."""
    bvh = build_bvh(device, gpu_scene.placing, build_meshes(device, gpu_scene.scene.meshes))
    return tracer_of(gpu_scene, bvh, make_rest(device, bvh.height))


@contextmanager
def traced(device: Device, scene: Scene) -> Iterator[Traced]:
    """`scene` ready to be traced."""
    before = set(device.scopes)
    try:
        gpu_scene = upload(device, scene)
        yield Traced(device, gpu_scene, make_tracer(device, gpu_scene))
    finally:
        for scope in set(device.scopes) - before:
            scope.close()
