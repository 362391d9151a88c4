# SPDX-License-Identifier: GPL-3.0-or-later
"""Dispatches in slices: the same numbers, and a request to stop is heard between any two."""

from __future__ import annotations

from contextlib import contextmanager
from functools import partial

import numpy as np
import pytest

from svo_engine.errors import Cancelled
from svo_engine.gpu import device as module
from svo_engine.gpu import glsl
from svo_engine.gpu.passes import Pass
from svo_engine.passes.voxelize import BLOCK_SUMS, SCAN, scan

COUNTS = np.random.default_rng(1).integers(0, 9, 100_000).astype("u4")


def scanned(device) -> np.ndarray:
    with device.scope() as scope:
        counts = scope.buffer("counts", COUNTS)
        assert scan(device, scope, counts, len(COUNTS)) == COUNTS.sum()
        return np.frombuffer(counts.read(), "u4")


def n_slices(device, pass_: Pass) -> int:
    return device.profiler.counts[pass_.name]


@pytest.fixture
def small_slices(device, monkeypatch):
    """Slices of one or two workgroups, however quick the device is."""
    monkeypatch.setattr(module, "FIRST_SLICE", 256)
    monkeypatch.setattr(module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(device, "_per_second", {})


@pytest.mark.usefixtures("small_slices")
def test_small_slices_give_what_one_dispatch_gives(device):
    device.profiler.reset()
    result = scanned(device)
    assert np.array_equal(result, np.cumsum(COUNTS) - COUNTS)
    assert n_slices(device, SCAN) > 25  # of 49 blocks
    assert n_slices(device, BLOCK_SUMS) > 25
    assert device.profiler.counts["voxelize/scan invocations"] == 49 * 256


def test_one_dispatch_gives_the_same(device, monkeypatch):
    monkeypatch.setattr(module, "FIRST_SLICE", 10**9)
    monkeypatch.setattr(device, "_per_second", {})
    device.profiler.reset()
    assert np.array_equal(scanned(device), np.cumsum(COUNTS) - COUNTS)
    assert (n_slices(device, SCAN), n_slices(device, BLOCK_SUMS)) == (1, 1)


@pytest.mark.usefixtures("small_slices")
def test_a_stop_is_heard_before_the_next_slice(device, monkeypatch):
    gpu = device.profiler.gpu

    @contextmanager
    def gpu_then_stop(name):
        with gpu(name):
            yield
        if device.profiler.counts[name] == 3:
            device.stop.set()

    monkeypatch.setattr(device.profiler, "gpu", gpu_then_stop)
    device.profiler.reset()
    with pytest.raises(Cancelled):
        scanned(device)
    assert n_slices(device, BLOCK_SUMS) == 3
    assert n_slices(device, SCAN) == 0


def test_nothing_to_do_runs_nothing(device):
    device.profiler.reset()
    with device.scope() as scope:
        nothing = scope.buffer("nothing", 0)
        device.dispatch(BLOCK_SUMS, 0, Values=nothing, BlockSums=nothing, u_n_values=0, u_are_bits=False)
    assert n_slices(device, BLOCK_SUMS) == 0


@pytest.mark.parametrize(("given", "said"), [
    ({"Values": None}, r"voxelize/block_sums: missing \['BlockSums'\], unknown \[\]"),
    ({"Values": None, "BlockSums": None, "u_x": 1}, r"missing \[\], unknown \['u_x'\]"),
])
def test_a_call_must_give_just_what_the_pass_declares(device, given, said):
    with pytest.raises(AssertionError, match=said):
        device.dispatch(BLOCK_SUMS, 1, **given, u_n_values=1, u_are_bits=False)


TWICE = """layout(local_size_x = 64) in;
layout(std430) readonly buffer Number { uint number[]; };
layout(std430) buffer Rows { uint rows[]; };
uniform uint u_first;
uniform uint u_end;
void main()
{
    uint i = u_first + gl_GlobalInvocationID.x;
    if (i < min(u_end, number[5]))
        rows[i] += 2u * i + 1u;
}
"""


@pytest.fixture
def twice(device, tmp_path, monkeypatch):
    """A pass of the test's own: rows[i] += 2 i + 1 for as many as `Number` says at word 5."""
    (tmp_path / "twice.comp.glsl").write_text(TWICE)
    monkeypatch.setattr(glsl, "compose", partial(glsl.compose, root=tmp_path))
    monkeypatch.setattr(device.programs, "_ready", {})
    return Pass("twice.comp.glsl")


def test_a_program_is_counted_when_it_is_compiled_and_only_then(device, twice):
    with device.scope() as scope:
        number, rows = scope.buffer("number", 32, clear=True), scope.buffer("rows", 4)
        for n_compiled in (1, 0):
            device.profiler.reset()
            device.dispatch(twice, 1, Number=number, Rows=rows)
            assert device.profiler.counts["programs compiled"] == n_compiled
            assert (device.profiler.times_ms()["compile"] > 0) == (n_compiled > 0)


def test_a_pass_is_named_after_its_stage_and_entry():
    assert Pass("raster/visibility.vert.glsl", "raster/visibility.frag.glsl").name == "raster/visibility"


def test_the_device_names_itself(device):
    assert set(device.info) == {"renderer", "vendor", "version"}
    assert all(device.info.values())
