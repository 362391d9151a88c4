# SPDX-License-Identifier: GPL-3.0-or-later
"""All programs of a device, each compiled once: when it is first needed, or before that and many at a time."""

from __future__ import annotations

import time
from collections.abc import Generator, Iterable, Mapping

from ..errors import ShaderError
from . import glsl
from .calls import Calls
from .compiler import Compiler, Job
from .passes import Pass
from .profiler import COMPILED, Profiler
from .program import Program

Constants = Mapping[str, bool | int | float]
Variant = tuple[Pass, Constants]
_Key = tuple[tuple[str, ...], frozenset[tuple[str, bool | int | float]]]

POLL_SECONDS = 0.005


class Programs:
    """status: what a user may be told while programs are compiled, for any thread to read; "" while none are."""

    def __init__(self, calls: Calls, profiler: Profiler) -> None:
        self.status = ""
        self._calls, self._profiler = calls, profiler
        self._compiler = Compiler(calls)
        self._ready: dict[_Key, Program] = {}
        self._jobs: dict[_Key, Job] = {}  # begun, and not finished

    def find(self, pass_: Pass, constants: Constants) -> Program | None:
        """The program of this variant, if it is compiled."""
        return self._ready.get(_key(pass_, constants))

    def prepare(self, variants: Iterable[Variant]) -> Generator[None]:
        """Compile what is not there, at once where the driver can and else one after the other.

        Gives the caller a turn between programs, and while the driver is at them. If it does not come back, what was
        begun is gone on with when it is next wanted. ShaderError names the file and the line of the first mistake.
        """
        missing = {key: variant for variant in variants if (key := _key(*variant)) not in self._ready}
        if not missing:
            return
        try:
            with self._profiler.host("compile"):
                for key, variant in missing.items():
                    self._tell(missing)
                    yield
                    if key not in self._jobs and key not in self._ready:
                        self._jobs[key] = self._compiler.start(_sources(*variant))
                    self._finish(missing)
                while self._finish(missing):
                    self._tell(missing)
                    yield
                    time.sleep(POLL_SECONDS)
        finally:
            self.status = ""

    def begin(self, variants: Iterable[Variant]) -> None:
        """Have the driver compile what is not there, in threads of its own if it has such; nobody waits for it."""
        if self._compiler.is_parallel:
            for variant in variants:
                if (key := _key(*variant)) not in self._ready and key not in self._jobs:
                    self._jobs[key] = self._compiler.start(_sources(*variant))

    def release(self) -> None:
        """Give all back."""
        for job in self._jobs.values():
            self._compiler.drop(job)
        for program in self._ready.values():
            program.release()
        self._jobs.clear()
        self._ready.clear()

    def _finish(self, keys: Iterable[_Key]) -> bool:
        """Take over those that are done; whether any of those that were begun are not."""
        begun = [key for key in keys if key in self._jobs]
        done = [key for key in begun if self._compiler.is_done(self._jobs[key])]
        for key in done:
            job = self._jobs.pop(key)
            self._ready[key] = Program(self._calls, self._compiler.finish(job), job.sources)
            self._profiler.counts[COMPILED] += 1
        return len(done) < len(begun)

    def _tell(self, missing: Iterable[_Key]) -> None:
        """Say which of them is the next one, counted from 1."""
        are_ready = [key in self._ready for key in missing]
        self.status = f"Compiling shaders, {sum(are_ready) + 1} of {len(are_ready)}"


def _key(pass_: Pass, constants: Constants) -> _Key:
    return pass_.key, frozenset(constants.items())


def _sources(pass_: Pass, constants: Constants) -> list[glsl.Source]:
    """The shaders of this variant. ShaderError if none of them has a constant that was given."""
    sources = [glsl.compose(path, constants, texts=pass_.texts) for path in pass_.shaders]
    if unset := frozenset.intersection(*(source.unset for source in sources)):
        raise ShaderError(f"shaders/{sources[0].path}: no constant named {', '.join(sorted(unset))}")
    return sources
