# SPDX-License-Identifier: GPL-3.0-or-later
"""The thread that owns the OpenGL context. Blender's threads post work to it and wait."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeout
from typing import Any, TypeVar

from ..errors import Cancelled
from .device import Device

T = TypeVar("T")
POLL_SECONDS = 0.02


class GpuThread:
    """A daemon thread with one Device, made when the first work arrives."""

    def __init__(self) -> None:
        self._work: queue.SimpleQueue[tuple[Callable[[Device], Any], Future[Any]] | None] = queue.SimpleQueue()
        self._device: Device | None = None
        self._turn = threading.Lock()
        self._thread = threading.Thread(target=self._serve, name="svo-gpu", daemon=True)
        self._thread.start()

    def call(self, work: Callable[[Device], T], should_stop: Callable[[], bool] | None = None) -> T:
        """Run `work(device)` on the GPU's thread and return its result, or raise what it raised.

        should_stop is asked on the calling thread every 20 ms; once it says True the work is told to stop at its next
        dispatch, and Cancelled is raised here.
        """
        future: Future[T] = Future()
        self._work.put((work, future))
        while True:
            try:
                return future.result(POLL_SECONDS if should_stop else None)
            except FutureTimeout:
                if should_stop and should_stop() and self._device is not None:
                    self._device.stop.set()

    def iterate(self, start: Callable[[Device], Iterator[T]], should_stop: Callable[[], bool]) -> Iterator[T]:
        """The items of a generator that lives on the GPU's thread; it is closed there too, however this one ends."""
        items = self.call(lambda device: _begin(device, start), should_stop)
        end = object()
        try:
            while (item := self.call(lambda device: next(items, end), should_stop)) is not end:
                yield item  # type: ignore[misc]
                if should_stop():
                    raise Cancelled("Cancelled")
        finally:
            self.call(lambda device: _close(items))

    def close(self) -> None:
        """Release the device and end the thread; waits for the work in hand."""
        self._work.put(None)
        self._thread.join(timeout=10)

    def _serve(self) -> None:
        while (job := self._work.get()) is not None:
            work, future = job
            try:
                if self._device is None:
                    self._device = Device()
                future.set_result(work(self._device))
            except BaseException as error:  # handed to the caller, who waits for it
                future.set_exception(error)
        if self._device is not None:
            self._device.release()


def _begin(device: Device, start: Callable[[Device], Iterator[T]]) -> Iterator[T]:
    device.stop.clear()
    return start(device)


def _close(items: Any) -> None:
    items.close()
