# SPDX-License-Identifier: GPL-3.0-or-later
"""The thread that owns the OpenGL context. Blender's threads post work to it and wait."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, wait
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, TypeVar

from ..errors import Cancelled
from .device import Device

T = TypeVar("T")
POLL_SECONDS = 0.02
IDLE_SECONDS = 0.2  # without work, after which there is time for other things


@dataclass(eq=False)
class _Job:
    """Work for the device. `stop` tells it, and no other, to end at its next dispatch."""

    work: Callable[[Device], Any]
    result: Future[Any] = field(default_factory=Future)
    stop: threading.Event = field(default_factory=threading.Event)


_AWAKE = _Job(lambda _: None)  # nothing to do but to look up


class GpuThread:
    """A daemon thread with one Device, made when the first work arrives. Work is done in the order of posting.

    idle  what `when_idle` was given, while there is more of it
    """

    def __init__(self) -> None:
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._device: Device | None = None
        self._lock = threading.Lock()
        self._is_closed = False
        self.idle: Callable[[Device], bool] | None = None
        self._thread = threading.Thread(target=self._serve, name="svo-gpu", daemon=True)
        self._thread.start()

    @property
    def status(self) -> str:
        """What takes long on the device just now, for a user to read; "" if nothing does. Does not wait for it."""
        return self._device.programs.status if self._device else ""

    def call(self, work: Callable[[Device], T], should_stop: Callable[[], bool] = lambda: False) -> T:
        """Run `work(device)` on the GPU's thread and return its result, or raise what it raised.

        should_stop is asked on the calling thread every 20 ms; once it says True the work is told to stop at its next
        dispatch, which raises Cancelled. Cancelled too if the thread was closed.
        """
        if threading.current_thread() is self._thread:  # a generator that nobody holds is closed wherever it is found
            return work(self._device)  # type: ignore[arg-type]
        job = _Job(work)
        with self._lock:
            if self._is_closed:
                raise Cancelled("The renderer was closed")
            self._jobs.put(job)
        try:
            while wait([job.result], POLL_SECONDS).not_done:
                if should_stop():
                    job.stop.set()
        except BaseException:  # the caller will not wait any longer
            job.stop.set()
            raise
        return job.result.result()

    def iterate(self, start: Callable[[Device], Iterator[T]], should_stop: Callable[[], bool]) -> Iterator[T]:
        """The items of a generator that lives on the GPU's thread; it is closed there too, however this one ends."""
        items: Any = self.call(start, should_stop)
        end = object()
        try:
            while (item := self.call(lambda device: next(items, end), should_stop)) is not end:
                yield item  # type: ignore[misc]
                if should_stop():
                    raise Cancelled("Cancelled")
        finally:
            with suppress(Cancelled):  # closed, and everything released with it
                self.call(lambda device: items.close())

    def when_idle(self, work: Callable[[Device], bool]) -> None:
        """From now on do `work(device)` while nothing else is to be done: a short part, and it says if there is more.

        It ends where it fails; nobody is told, since nobody waits for it.
        """
        self.idle = work
        self._jobs.put(_AWAKE)

    def close(self) -> None:
        """Release the device and end the thread; waits for the work in hand."""
        with self._lock:
            self._is_closed = True
            self._jobs.put(None)
        self._thread.join(timeout=10)

    def _next(self) -> _Job | None:
        """The next job; while there is none, what `idle` does."""
        while True:
            try:
                if (job := self._jobs.get(timeout=IDLE_SECONDS if self.idle else None)) is not _AWAKE:
                    return job
            except queue.Empty:
                if self.idle and self._device and not self._rest(self.idle, self._device):
                    self.idle = None

    def _rest(self, idle: Callable[[Device], bool], device: Device) -> bool:
        """One part of it. The last job may have been stopped: that is not meant for what comes after it."""
        device.stop = threading.Event()
        try:
            return idle(device)
        except Exception:  # noqa: BLE001 - whoever needs what failed is told then
            return False

    def _serve(self) -> None:
        while (job := self._next()) is not None:
            try:
                if self._device is None:
                    self._device = Device()
                self._device.stop = job.stop
                self._device.check()
                job.result.set_result(job.work(self._device))
            except BaseException as error:  # noqa: BLE001 - handed to the caller, who waits for it
                job.result.set_exception(error)
            del job  # a result is its caller's alone
        if self._device is not None:
            self._device.release()
