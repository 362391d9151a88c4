# SPDX-License-Identifier: GPL-3.0-or-later
"""The device: programs, dispatches cut into slices so that a frame can be stopped, draws, counters."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from typing import Any

import moderngl
import numpy as np

from ..errors import Cancelled, ShaderError
from . import glsl
from .context import create_context
from .passes import Pass
from .profiler import Profiler
from .scope import GpuScope

Constants = Mapping[str, bool | int | float]
Value = float | int | tuple[float, ...] | np.ndarray

SLICE_SECONDS = 0.03  # aimed at: far enough below the 0.1 s in which a cancelled render has to stop
FIRST_SLICE = 4096  # invocations of a pass whose speed is not known yet


class Device:
    """One OpenGL context and all that runs on it. Every method is for the context's own thread."""

    def __init__(self) -> None:
        self.ctx, self.calls = create_context()
        self.limits = self.ctx.info
        self.stop = threading.Event()
        self.scopes: set[GpuScope] = set()
        self.profiler = Profiler(self.ctx)
        self._programs: dict[tuple[Any, ...], tuple[Any, tuple[int, int, int]]] = {}
        self._vertex_arrays: dict[int, moderngl.VertexArray] = {}
        self._per_second: dict[str, float] = {}

    @property
    def info(self) -> dict[str, str]:
        """renderer, vendor and version, as the driver names itself."""
        return {key: str(self.ctx.info[f"GL_{key.upper()}"]) for key in ("renderer", "vendor", "version")}

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
        pass_.check(set(resources))
        program, local = self._program(pass_, constants)
        self._bind(pass_, program, resources)
        group, first = local[0] * local[1] * local[2], 0
        while first < n:
            self.check()
            wanted = self._per_second.get(pass_.name, FIRST_SLICE / SLICE_SECONDS) * SLICE_SECONDS
            n_groups = min(max(int(wanted) // group, 1), -(-(n - first) // group), 65535)
            end = min(first + n_groups * group, n)
            _set_uniforms(program, {"u_first": first, "u_end": end})
            start = time.perf_counter()
            with self.profiler.gpu(pass_.name):
                program.run(n_groups)
                self.ctx.memory_barrier()
            if first > 0 or end < n:
                self.ctx.finish()
                rate = (end - first) / max(time.perf_counter() - start, 1e-6)
                self._per_second[pass_.name] = min(rate, 8 * wanted / SLICE_SECONDS)
            first = end
        self.profiler.counts[f"{pass_.name} invocations"] += n

    def clear(self, target: moderngl.Framebuffer) -> None:
        """Set all of `target` to zero and its depth to far; depth test on, no culling, no blending."""
        target.use()
        self.ctx.enable_only(moderngl.DEPTH_TEST)
        target.clear()

    def draw(self, pass_: Pass, target: moderngl.Framebuffer, n_vertices: int, n_instances: int = 1,
             constants: Constants | None = None, **resources: Any) -> None:
        """Draw triangles without vertex attributes into `target`; shaders fetch by gl_VertexID."""
        pass_.check(set(resources))
        self.check()
        program, _ = self._program(pass_, constants)
        self._bind(pass_, program, resources)
        target.use()
        key = program.glo
        if key not in self._vertex_arrays:
            self._vertex_arrays[key] = self.ctx.vertex_array(program, [])
        with self.profiler.gpu(pass_.name):
            self._vertex_arrays[key].render(moderngl.TRIANGLES, vertices=n_vertices, instances=n_instances)

    def release(self) -> None:
        """Release every scope, program and the context."""
        for scope in list(self.scopes):
            scope.close()
        for vertex_array in self._vertex_arrays.values():
            vertex_array.release()
        for program, _ in self._programs.values():
            program.release()
        self.profiler.release()
        self.ctx.release()

    def _program(self, pass_: Pass, constants: Constants | None) -> tuple[Any, tuple[int, int, int]]:
        """The compiled program of this variant and its workgroup size; compiled once."""
        key = (pass_.shaders, tuple(sorted((constants or {}).items())))
        if key not in self._programs:
            with self.profiler.host("compile"):
                sources = [glsl.compose(path, constants) for path in pass_.shaders]
                if unset := frozenset.intersection(*(source.unset for source in sources)):
                    raise ShaderError(f"shaders/{sources[0].path}: no constant named {', '.join(sorted(unset))}")
                self._programs[key] = self._compile(sources), sources[0].local_size
        return self._programs[key]

    def _compile(self, sources: list[glsl.Source]) -> Any:
        try:
            if len(sources) == 1:
                return self.ctx.compute_shader(sources[0].text)
            return self.ctx.program(vertex_shader=sources[0].text, fragment_shader=sources[1].text)
        except moderngl.Error as error:
            log = str(error)
            blamed = sources[-1] if "fragment_shader" in log else sources[0]
            raise ShaderError(blamed.explain(log.rsplit("=\n", maxsplit=1)[-1])) from error

    def _bind(self, pass_: Pass, program: Any, resources: Mapping[str, Any]) -> None:
        """Bind what the compiled program still has: a compiler may remove what a variant does not use."""
        for kind in (pass_.buffers, pass_.textures, pass_.images):
            for slot, name in enumerate(kind):
                if name not in program:
                    continue
                resource = resources[name]
                if kind is pass_.buffers:
                    program[name].binding = slot
                    resource.bind_to_storage_buffer(slot)
                    continue
                # moderngl writes garbage into uniforms of type image3D and usamplerBuffer
                self.calls["glProgramUniform1i"](program.glo, program[name].location, slot)
                if kind is pass_.textures:
                    resource.use(slot)
                else:
                    _bind_image(resource, slot)
        _set_uniforms(program, {name: resources[name] for name in pass_.uniforms})


def _bind_image(image: Any, slot: int) -> None:
    """Bind a 2D texture, or (Cube, mip level)."""
    if isinstance(image, tuple):
        image[0].bind_level(slot, image[1])
    else:
        image.bind_to_image(slot, read=True, write=True)


def _set_uniforms(program: Any, values: Mapping[str, Value]) -> None:
    """Set those that the program has; matrices come as (rows, columns) arrays and go in column by column."""
    for name, value in values.items():
        if name in program:
            program[name].value = tuple(value.T.ravel().tolist()) if isinstance(value, np.ndarray) else value
