# SPDX-License-Identifier: GPL-3.0-or-later
"""The device: programs, dispatches cut into slices so that a frame can be stopped, draws, counters."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from functools import cached_property

from ..errors import Cancelled, GpuError
from .bindings import Bindings
from .calls import generate
from .context import create_context
from .cuda import Cuda
from .framebuffer import Framebuffer
from .oidn import OidnDevice
from .passes import Pass
from .pool import Pool
from .profiler import Profiler
from .program import Program, Resource, Resources, Value
from .programs import Constants, Programs, Variant
from .scope import GpuScope

SLICE_SECONDS = 0.03  # aimed at: far enough below the 0.1 s in which a cancelled render has to stop
MOST_RAYS = 1 << 19  # invocations of one slice
FIRST_SLICE = 4096  # invocations of a pass whose speed is not known yet
_ALL_BARRIERS, _TRIANGLES, _DEPTH_TEST = 0xFFFFFFFF, 0x0004, 0x0B71


@dataclass(frozen=True)
class DrawCall:
    """One call of a pass that draws: `uniforms` are its own, beside those that all calls share."""

    n_vertices: int
    n_instances: int = 1
    uniforms: Mapping[str, Value] = field(default_factory=dict)


class Device:
    """One OpenGL context and all that runs on it. Every method is for the context's own thread."""

    def __init__(self) -> None:
        self.context = create_context()
        self.calls, self.limits, self.info = self.context.calls, self.context.limits, self.context.info
        self.stop = threading.Event()
        self.scopes: set[GpuScope] = set()
        self.pool = Pool()
        self.profiler = Profiler(self.calls, self.context.is_software)
        self.programs = Programs(self.calls, self.profiler)
        self.bindings = Bindings(self.calls)
        self._per_second: dict[str, float] = {}
        self._run_once: set[tuple[object, ...]] = set()
        self._prepared: list[tuple[Variant, ...]] = []
        self._batch = ""
        self.calls["glEnable"](_DEPTH_TEST)
        self.calls["glBindVertexArray"](generate(self.calls, "VertexArrays"))  # without attributes, for all draws

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
        return GpuScope(self.calls, self.limits, self.pool, self.scopes)

    def check(self) -> None:
        """Raise Cancelled if the caller wants the frame to stop."""
        if self.stop.is_set():
            raise Cancelled("Cancelled")

    def dispatch(self, pass_: Pass, n: int, constants: Constants | None = None, /,
                 **resources: Resource) -> None:
        """Run a compute pass over `n` invocations, in slices, each told its range by `u_first` and `u_end`.

        resources: every name that the pass declares: buffers, textures (sampled), images (a 2D texture, or a Cube and
        its mip level; read and written) and uniform values; None for what an included file declares and this pass does
        not read. Slices change nothing but the time at which the device can be asked to stop.
        """
        begin = time.perf_counter()
        pass_.check(resources.keys())
        program = self._bound(pass_, constants, resources)
        group, first = program.local_size, 0
        while first < n:
            self.check()
            wanted = self._per_second.get(pass_.name, FIRST_SLICE / SLICE_SECONDS) * SLICE_SECONDS
            n_groups = min(max(int(wanted) // group, 1), -(-(n - first) // group), MOST_RAYS // group)
            end = min(first + n_groups * group, n)
            start = time.perf_counter()
            self._run(pass_, program, first, end, n_groups)
            self.profiler.issued(time.perf_counter() - begin)
            if first > 0 or end < n:
                self.finish()
                rate = (end - first) / max(time.perf_counter() - start, 1e-6)
                self._per_second[pass_.name] = min(rate, 8 * wanted / SLICE_SECONDS)
            first, begin = end, time.perf_counter()
        self.profiler.counts[f"{pass_.name} invocations"] += n

    def _run(self, pass_: Pass, program: Program, first: int, end: int, groups: int) -> None:
        """One dispatch of so many workgroups."""
        calls = self.calls
        program.set_range(first, end)
        if self._batch:
            self.profiler.counts[pass_.name] += 1
            calls["glDispatchCompute"](groups, 1, 1)
            calls["glMemoryBarrier"](_ALL_BARRIERS)
            return
        with self.profiler.gpu(pass_.name):
            calls["glDispatchCompute"](groups, 1, 1)
            calls["glMemoryBarrier"](_ALL_BARRIERS)
        calls["glFlush"]()  # the card begins: NVIDIA's driver else waits for more, a sixth of a quick frame

    @contextmanager
    def batch(self, name: str) -> Iterator[None]:
        """Many small dispatches inside are timed together under `name`, and given to the card together.

        To time one, or to have the card begin with it, takes the host longer than the card takes for it. Where the
        processor renders, nothing is different.
        """
        if self.profiler.is_software:
            yield
            return
        with self.profiler.gpu(name):
            self._batch = name
            try:
                yield
            finally:
                self._batch = ""
        self.calls["glFlush"]()

    def finish(self) -> None:
        """Wait until the device has done all that it was told."""
        self.calls["glFinish"]()

    def draw(self, pass_: Pass, target: Framebuffer, calls: Iterable[DrawCall],
             constants: Constants | None = None, /, **resources: Resource) -> None:
        """Draw triangles without vertex attributes into `target`; shaders fetch by gl_VertexID."""
        calls = list(calls)
        if not calls:
            return
        pass_.check(resources.keys() | calls[0].uniforms.keys())
        self.check()
        program = self._bound(pass_, constants, resources)
        target.use()
        with self.profiler.gpu(pass_.name):
            for call in calls:
                program.set(call.uniforms)
                self.calls["glDrawArraysInstanced"](_TRIANGLES, 0, call.n_vertices, call.n_instances)

    def prepare_frame(self, variants: tuple[Variant, ...], others: tuple[Variant, ...]) -> None:
        """`prepare` for a frame, which asks with the same tuple again and again; begin the others, if it is new."""
        if not any(known is variants for known in self._prepared):
            self.prepare(variants)
            self.programs.begin(others)
            self._prepared.append(variants)

    def prepare(self, variants: Iterable[Variant]) -> None:
        """Compile all that these passes need with these constants, many at a time where the driver can.

        What a frame does not prepare is compiled when it is first dispatched. `programs.status` says how far it is.
        ShaderError names the file and the line; Cancelled if the caller wants the frame to stop.
        """
        with closing(self.programs.prepare(variants)) as turns:
            for _ in turns:
                self.check()

    def has_rehearsed(self, pass_: Pass, constants: Constants) -> bool:
        """Whether nothing is left to be compiled for a pass."""
        key = pass_.key, frozenset(constants.items())
        return key in self._run_once if self.profiler.is_software else self.programs.find(pass_, constants) is not None

    def rehearse(self, pass_: Pass, constants: Constants) -> None:
        """Compile a compute pass and run it for no invocation at all: a software renderer compiles it once more then.

        All its storage blocks are one of 16 bytes, in case that a workgroup writes beside what its invocations do.
        """
        self.prepare([(pass_, constants)])
        program = self.programs.find(pass_, constants)
        if not self.profiler.is_software or program is None:
            return
        self._run_once.add((pass_.key, frozenset(constants.items())))
        if len(pass_.shaders) > 1:  # which draws
            return
        with self.scope() as scope:
            spare = scope.buffer("spare", 16)
            self.bindings.program(program.glo)
            program.bind(self.bindings, {**dict.fromkeys(pass_.names.buffers, spare), **dict.fromkeys(
                (*pass_.names.textures, *pass_.names.images))})
            self._run(pass_, program, 0, 0, 1)

    def release(self) -> None:
        """Release every scope, program and the context."""
        for scope in list(self.scopes):
            scope.close()
        self.pool.clear()
        self.programs.release()
        self.profiler.release()
        for name in ("denoising", "cuda"):
            if part := vars(self).get(name):  # which nobody may have asked for
                part.close()
        self.context.release()

    def _bound(self, pass_: Pass, constants: Constants | None, resources: Resources) -> Program:
        """The program of this variant, compiled if it is not there, with all that it uses."""
        program = self.programs.find(pass_, constants or {})
        self._run_once.add((pass_.key, frozenset((constants or {}).items())))
        if program is None:
            self.prepare([(pass_, constants or {})])
            program = self.programs.find(pass_, constants or {})
            assert program
        self.bindings.program(program.glo)
        program.bind(self.bindings, resources)
        program.set(resources)
        return program
