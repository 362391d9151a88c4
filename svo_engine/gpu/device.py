# SPDX-License-Identifier: GPL-3.0-or-later
"""The device: programs, dispatches cut into slices so that a frame can be stopped, draws, counters."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import moderngl

from ..errors import Cancelled, GpuError, ShaderError
from . import glsl
from .context import create_context
from .cuda import Cuda
from .oidn import OidnDevice
from .passes import Pass
from .pool import Pool
from .profiler import Profiler
from .program import Program, Value
from .scope import GpuScope

Constants = Mapping[str, bool | int | float]

SLICE_SECONDS = 0.03  # aimed at: far enough below the 0.1 s in which a cancelled render has to stop
FIRST_SLICE = 4096  # invocations of a pass whose speed is not known yet


@dataclass(frozen=True)
class DrawCall:
    """One call of a pass that draws: `uniforms` are its own, beside those that all calls share."""

    n_vertices: int
    n_instances: int = 1
    uniforms: Mapping[str, Value] = field(default_factory=dict)


class Device:
    """One OpenGL context and all that runs on it. Every method is for the context's own thread."""

    def __init__(self) -> None:
        self.ctx, self.calls = create_context()
        self.limits = self.ctx.info
        self.stop = threading.Event()
        self.scopes: set[GpuScope] = set()
        self.pool = Pool()
        self.profiler = Profiler(self.ctx)
        self._programs: dict[tuple[Any, ...], Program] = {}
        self._vertex_arrays: dict[int, moderngl.VertexArray] = {}
        self._per_second: dict[str, float] = {}

    @property
    def info(self) -> dict[str, str]:
        """renderer, vendor and version, as the driver names itself."""
        return {key: str(self.ctx.info[f"GL_{key.upper()}"]) for key in ("renderer", "vendor", "version")}

    @cached_property
    def cuda(self) -> Cuda | None:
        """CUDA's side of this device, if it has one."""
        try:
            return Cuda()
        except GpuError:
            return None

    @cached_property
    def denoising(self) -> OidnDevice:
        """Where denoisers run. GpuError if there is no library for it."""
        try:
            return OidnDevice(self.cuda)
        except GpuError:
            if self.cuda is None:
                raise
            return OidnDevice(None)  # the card is too old for the library

    @property
    def n_bytes(self) -> int:
        """Bytes that all scopes hold."""
        return sum(scope.n_bytes for scope in self.scopes)

    def scope(self) -> GpuScope:
        """A new, empty scope."""
        return GpuScope(self)

    def check(self) -> None:
        """Raise Cancelled if the caller wants the frame to stop."""
        if self.stop.is_set():
            raise Cancelled("Cancelled")

    def dispatch(self, pass_: Pass, n: int, constants: Constants | None = None, **resources: Any) -> None:
        """Run a compute pass over `n` invocations, in slices, each told its range by `u_first` and `u_end`.

        resources: every name that the pass declares: buffers, textures (sampled), images (a 2D texture, or a Cube and
        its mip level; read and written) and uniform values. Slices change nothing but the time at which the device can
        be asked to stop.
        """
        begin = time.perf_counter()
        pass_.check(set(resources))
        program = self._bound(pass_, constants, resources)
        group, first = program.local_size, 0
        while first < n:
            self.check()
            wanted = self._per_second.get(pass_.name, FIRST_SLICE / SLICE_SECONDS) * SLICE_SECONDS
            n_groups = min(max(int(wanted) // group, 1), -(-(n - first) // group), 65535)
            end = min(first + n_groups * group, n)
            program.set({"u_first": first, "u_end": end})
            start = time.perf_counter()
            with self.profiler.gpu(pass_.name):
                program.handle.run(n_groups)
                self.ctx.memory_barrier()
            self.calls["glFlush"]()  # the card begins: NVIDIA's driver else waits for more, a sixth of a quick frame
            self.profiler.issued(time.perf_counter() - begin)
            if first > 0 or end < n:
                self.ctx.finish()
                rate = (end - first) / max(time.perf_counter() - start, 1e-6)
                self._per_second[pass_.name] = min(rate, 8 * wanted / SLICE_SECONDS)
            first, begin = end, time.perf_counter()
        self.profiler.counts[f"{pass_.name} invocations"] += n

    def clear(self, target: moderngl.Framebuffer) -> None:
        """Set all of `target` to zero and its depth to far; depth test on, no culling, no blending."""
        target.use()
        self.ctx.enable_only(moderngl.DEPTH_TEST)
        target.clear()

    def draw(self, pass_: Pass, target: moderngl.Framebuffer, calls: Iterable[DrawCall],
             constants: Constants | None = None, **resources: Any) -> None:
        """Draw triangles without vertex attributes into `target`; shaders fetch by gl_VertexID."""
        calls = list(calls)
        if not calls:
            return
        pass_.check({*resources, *(name for call in calls for name in call.uniforms)})
        self.check()
        program = self._bound(pass_, constants, resources)
        target.use()
        key = program.handle.glo
        if key not in self._vertex_arrays:
            self._vertex_arrays[key] = self.ctx.vertex_array(program.handle, [])
        with self.profiler.gpu(pass_.name):
            for call in calls:
                program.set(call.uniforms)
                self._vertex_arrays[key].render(moderngl.TRIANGLES, call.n_vertices, instances=call.n_instances)

    def release(self) -> None:
        """Release every scope, program and the context."""
        for scope in list(self.scopes):
            scope.close()
        self.pool.clear()
        for vertex_array in self._vertex_arrays.values():
            vertex_array.release()
        for program in self._programs.values():
            program.release()
        self.profiler.release()
        for name in ("denoising", "cuda"):
            if part := vars(self).get(name):  # which nobody may have asked for
                part.close()
        self.ctx.release()

    def _bound(self, pass_: Pass, constants: Constants | None, resources: Mapping[str, Any]) -> Program:
        """The program of this variant, compiled once, with all that it uses."""
        key = (pass_.shaders, tuple(sorted((constants or {}).items())))
        if key not in self._programs:
            with self.profiler.host("compile"):
                sources = [glsl.compose(path, constants) for path in pass_.shaders]
                if unset := frozenset.intersection(*(source.unset for source in sources)):
                    raise ShaderError(f"shaders/{sources[0].path}: no constant named {', '.join(sorted(unset))}")
                self._programs[key] = Program(self.ctx, self.calls, pass_, sources)
        program = self._programs[key]
        program.bind(resources)
        program.set({name: resources[name] for name in pass_.uniforms if name in resources})
        return program
