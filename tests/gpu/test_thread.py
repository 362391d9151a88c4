# SPDX-License-Identifier: GPL-3.0-or-later
"""The thread that owns the device: results, errors, cancelling, several callers, closing. No OpenGL is needed."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator

import pytest

from svo_engine.errors import Cancelled, GpuError
from svo_engine.gpu import thread as module
from svo_engine.gpu.thread import GpuThread


class FakeDevice:
    """What GpuThread needs of a device."""

    def __init__(self) -> None:
        self.stop = threading.Event()
        self.released_in = ""

    def check(self) -> None:
        if self.stop.is_set():
            raise Cancelled("Cancelled")

    def release(self) -> None:
        self.released_in = threading.current_thread().name


def work_until_stopped(device: FakeDevice) -> None:
    while True:
        device.check()
        time.sleep(0.001)


@pytest.fixture
def gpu(monkeypatch) -> Iterator[GpuThread]:
    monkeypatch.setattr(module, "Device", FakeDevice)
    made = GpuThread()
    yield made
    made.close()


def test_work_runs_in_one_thread_with_one_device(gpu):
    seen = [gpu.call(lambda device: (device, threading.current_thread().name)) for _ in range(3)]
    assert seen[0] == seen[1] == seen[2]
    assert seen[0][1] == "svo-gpu"


@pytest.mark.parametrize("error", [GpuError("too small"), ValueError("x"), TimeoutError("y"), KeyboardInterrupt()])
def test_what_the_work_raises_is_raised_to_the_caller(gpu, error):
    def work(_):
        raise error

    with pytest.raises(type(error)) as caught:
        gpu.call(work, lambda: False)
    assert caught.value is error
    assert gpu.call(lambda device: 7) == 7


def test_a_device_that_cannot_be_made_is_an_error_for_every_caller(monkeypatch):
    def fail():
        raise GpuError("none here")

    monkeypatch.setattr(module, "Device", fail)
    gpu = GpuThread()
    for _ in range(2):
        with pytest.raises(GpuError, match="none here"):
            gpu.call(lambda device: None)
    gpu.close()


def test_should_stop_is_asked_in_the_caller_while_the_work_goes_on(gpu):
    asked = []

    def should_stop():
        asked.append(threading.current_thread())
        return len(asked) == 3

    with pytest.raises(Cancelled):
        gpu.call(work_until_stopped, should_stop)
    assert set(asked) == {threading.current_thread()}
    assert gpu.call(lambda device: device.stop.is_set()) is False


def test_a_stop_concerns_the_work_of_its_caller_alone(gpu):
    began, may_end = threading.Event(), threading.Event()
    results = []

    def long_work(device):
        began.set()
        may_end.wait()
        device.check()
        return "whole"

    other = threading.Thread(target=lambda: results.append(gpu.call(long_work)))
    other.start()
    began.wait()
    asked = []

    def should_stop():
        asked.append(1)
        if len(asked) == 2:  # the request to stop has been made once by now
            may_end.set()
        return True

    with pytest.raises(Cancelled):
        gpu.call(lambda device: "never begun", should_stop)
    other.join()
    assert results == ["whole"]


def test_work_of_an_interrupted_caller_is_stopped(gpu):
    def interrupt():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        gpu.call(work_until_stopped, interrupt)
    assert gpu.call(lambda device: 1) == 1


def test_many_callers_each_get_their_own(gpu):
    results: dict[int, list[int]] = {}

    def count(start):
        results[start] = list(gpu.iterate(lambda device: (i for i in range(start, start + 20)), lambda: False))

    callers = [threading.Thread(target=count, args=(100 * i,)) for i in range(8)]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join()
    assert results == {100 * i: list(range(100 * i, 100 * i + 20)) for i in range(8)}


@pytest.fixture
def traced():
    """(a generator function for `iterate`, the names of the threads in which its generators were closed)"""
    closed = []

    def start(_):
        try:
            yield from range(5)
        finally:
            closed.append(threading.current_thread().name)

    return start, closed


def test_a_generator_is_closed_in_its_thread_when_exhausted(gpu, traced):
    start, closed = traced
    assert list(gpu.iterate(start, lambda: False)) == [0, 1, 2, 3, 4]
    assert closed == ["svo-gpu"]


def test_a_generator_is_closed_in_its_thread_when_the_caller_breaks(gpu, traced):
    start, closed = traced
    items = gpu.iterate(start, lambda: False)
    assert next(items) == 0
    items.close()
    assert closed == ["svo-gpu"]


def test_a_generator_is_closed_in_its_thread_when_cancelled(gpu, traced):
    start, closed = traced
    seen: list[int] = []
    items = gpu.iterate(start, lambda: bool(seen))
    seen.append(next(items))
    with pytest.raises(Cancelled):
        next(items)
    assert (seen, closed) == ([0], ["svo-gpu"])


def test_a_generator_that_fails_is_closed_and_its_error_raised(gpu):
    def start(_):
        yield 1
        raise ValueError("inside")

    with pytest.raises(ValueError, match="inside"):
        list(gpu.iterate(start, lambda: False))


def test_a_call_from_its_own_thread_does_not_wait_for_itself(gpu):
    assert gpu.call(lambda device: gpu.call(lambda inner: inner is device)) is True


def test_closing_releases_the_device_in_its_thread(gpu):
    device = gpu.call(lambda device: device)
    gpu.close()
    assert device.released_in == "svo-gpu"


def test_closing_ends_all_later_calls_and_iterations(gpu):
    items = gpu.iterate(lambda device: (i for i in range(5)), lambda: False)
    next(items)
    gpu.close()
    with pytest.raises(Cancelled, match="closed"):
        next(items)
    with pytest.raises(Cancelled, match="closed"):
        gpu.call(lambda device: 1)


def test_an_iteration_can_be_dropped_after_closing(gpu):
    items = gpu.iterate(lambda device: (i for i in range(5)), lambda: False)
    next(items)
    gpu.close()
    items.close()
