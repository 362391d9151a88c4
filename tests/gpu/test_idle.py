# SPDX-License-Identifier: GPL-3.0-or-later
"""What the device's thread does while nobody wants anything of it: compile what edits may need."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from svo_engine import render
from svo_engine.errors import Cancelled, ShaderError
from svo_engine.gpu import thread as module
from svo_engine.gpu.passes import Pass
from svo_engine.gpu.thread import GpuThread
from svo_engine.passes import evaluate, planes, raster
from svo_engine.passes.programs import Variant, all_programs
from svo_engine.render import Session
from tests import scenes, variety

PATIENCE = 60.0  # seconds after which something hangs


class FakeDevice:
    """What GpuThread needs of a device."""

    def __init__(self) -> None:
        self.stop = threading.Event()

    def check(self) -> None:
        if self.stop.is_set():
            raise Cancelled("Cancelled")

    def release(self) -> None:
        pass


@pytest.fixture
def gpu(monkeypatch) -> Iterator[GpuThread]:
    """With a device already, and in a hurry to be idle."""
    monkeypatch.setattr(module, "Device", FakeDevice)
    monkeypatch.setattr(module, "IDLE_SECONDS", 0.005)
    made = GpuThread()
    made.call(lambda device: None)
    yield made
    made.close()


def comes_true(condition: Callable[[], bool]) -> bool:
    """Wait for it, but not for ever. It must not ask the thread for anything, which would keep it from being idle."""
    end = time.monotonic() + PATIENCE
    while not condition() and time.monotonic() < end:
        time.sleep(0.005)
    return condition()


def test_idle_work_is_done_in_parts_until_there_is_no_more(gpu):
    """Also where the thread had fallen asleep before it was told."""
    done = list[int]()
    gpu.when_idle(lambda _: done.append(len(done)) is not None or len(done) < 3)
    assert comes_true(lambda: gpu.idle is None)
    assert done == [0, 1, 2]


def test_idle_work_waits_for_the_device(monkeypatch):
    monkeypatch.setattr(module, "Device", FakeDevice)
    monkeypatch.setattr(module, "IDLE_SECONDS", 0.005)
    gpu, done = GpuThread(), threading.Event()
    gpu.when_idle(lambda _: done.set() is not None)
    assert not done.is_set()
    gpu.call(lambda device: None)
    assert done.wait(PATIENCE)
    gpu.close()


def test_work_that_comes_meanwhile_is_next(gpu):
    """It waits for the part that is being done, and for no other."""
    is_in, may_go_on, done = threading.Event(), threading.Event(), list[str]()

    def part(_) -> bool:
        done.append("part")
        is_in.set()
        may_go_on.wait(PATIENCE)
        return len(done) < 10

    gpu.when_idle(part)
    assert is_in.wait(PATIENCE)
    asking = threading.Thread(target=lambda: gpu.call(lambda _: done.append("work")))
    asking.start()
    assert comes_true(lambda: not gpu._jobs.empty())
    may_go_on.set()
    asking.join(PATIENCE)
    assert done[:2] == ["part", "work"]
    assert comes_true(lambda: gpu.idle is None)


def test_idle_work_that_fails_is_not_tried_again_and_ends_nothing(gpu):
    tried = list[int]()

    def fail(_) -> bool:
        tried.append(1)
        raise ShaderError("of no frame")

    gpu.when_idle(fail)
    assert comes_true(lambda: gpu.idle is None)
    assert gpu.call(lambda device: 7) == 7
    assert tried == [1]


def test_idle_work_is_not_stopped_for_what_was_cancelled_before(gpu):
    def work(device: FakeDevice) -> None:
        while True:
            device.check()
            time.sleep(0.001)

    stops, was_told = list[bool](), threading.Event()
    with pytest.raises(Cancelled):
        gpu.call(work, lambda: True)

    def part(device: FakeDevice) -> bool:
        stops.append(device.stop.is_set())
        was_told.set()
        return False

    gpu.when_idle(part)
    assert was_told.wait(PATIENCE)
    assert stops == [False]


# Of a real session

FEW: tuple[Variant, ...] = ((raster.VISIBILITY, {}), (evaluate.MATTE, {}), (planes.MEAN, {}))


@pytest.fixture
def fresh(monkeypatch) -> Iterator[Session]:
    """With a device that has compiled nothing, and few programs to compile."""
    monkeypatch.setattr(module, "IDLE_SECONDS", 0.005)
    monkeypatch.setattr(render, "all_programs", lambda is_software: FEW)
    made = Session()
    made.device_info()
    yield made
    made.close()


def are_there(session: Session, variants: tuple[Variant, ...]) -> bool:
    return session.opened().thread.call(lambda device: all(device.has_rehearsed(*variant) for variant in variants))


def is_resting(session: Session) -> bool:
    return session.opened().thread.idle is None


def test_all_programs_are_compiled_when_nothing_else_is_to_be_done(fresh):
    assert not are_there(fresh, FEW)
    fresh.compile_all()
    assert comes_true(lambda: is_resting(fresh))
    assert are_there(fresh, FEW)


def test_they_are_compiled_after_a_cancelled_render_too(fresh):
    scene = variety.alcove()
    with pytest.raises(Cancelled):
        list(fresh.films(scene, scenes.view(scene), scenes.SMALL, lambda: True))
    fresh.compile_all()
    assert comes_true(lambda: is_resting(fresh))
    assert are_there(fresh, FEW)


def test_a_program_that_does_not_compile_is_told_to_who_needs_it_alone(fresh, monkeypatch):
    monkeypatch.setattr(render, "all_programs", lambda is_software: ((Pass("lib/none.comp.glsl"), {}),))
    fresh.compile_all()
    assert comes_true(lambda: is_resting(fresh))
    assert fresh.device_info()


def test_a_frame_that_waits_for_its_caller_does_not_count_what_is_compiled_meanwhile(fresh):
    scene = variety.alcove()
    films = fresh.films(scene, scenes.view(scene), replace(scenes.SMALL, samples=2))
    first = next(films)
    fresh.compile_all()
    assert comes_true(lambda: is_resting(fresh))
    compiled = [film.stats["counts"]["programs compiled"] for film in (first, *films)]
    assert compiled[0] == compiled[1] > 0


def test_every_program_can_be_rehearsed(session):
    """All that there are, on the device of all tests, for which no scene was made ready."""
    def rehearse(device) -> list[str]:
        variants = all_programs(device.profiler.is_software)
        for variant in variants:
            device.rehearse(*variant)
        return [pass_.name for pass_, constants in variants if not device.has_rehearsed(pass_, constants)]

    assert session.opened().thread.call(rehearse) == []
