# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pass needs that traces exact rays."""

from __future__ import annotations

from dataclasses import dataclass

from ..gpu.buffer import Buffer
from ..gpu.device import MOST_RAYS, Device
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from .bvh import Bvh
from .upload import GpuScene
from .upload.opacity import Opacity
from .upload.placing import Placing

QUICK = 24  # entries of a ray's stack that lie in shared memory, see bind/trace.glsl


@dataclass(frozen=True, eq=False)
class Tracer:
    """The trees of boxes, and all that rays know of materials. rest: room for what their stacks hold beyond QUICK."""

    placing: Placing
    opacity: Opacity
    bvh: Bvh
    rest: Rest

    def resources(self) -> Resources:
        """What bind/trace.glsl reads."""
        return {**self.opacity.read, **self.bvh.resources(),
                "TraceRest": self.rest.words, "u_trace_stride": MOST_RAYS}

    def constants(self) -> dict[str, bool]:
        """The constants of bind/trace.glsl."""
        return self.bvh.constants()


@dataclass(frozen=True, eq=False)
class Rest:
    """words: a buffer u4, for MOST_RAYS rays at once."""

    scope: GpuScope
    words: Buffer


def make_rest(device: Device, height: int) -> Rest:
    """For trees of that height, of both levels together."""
    scope = device.scope()
    n = 0 if device.profiler.is_software else max(height + 2 - QUICK, 0)
    return Rest(scope, scope.buffer("rest of stacks", 4 * n * MOST_RAYS))


def tracer_of(gpu_scene: GpuScene, bvh: Bvh, rest: Rest) -> Tracer:
    """The rays of a scene."""
    return Tracer(gpu_scene.placing, gpu_scene.opacity, bvh, rest)
