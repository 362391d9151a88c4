# SPDX-License-Identifier: GPL-3.0-or-later
"""Python's lock is free while the device works: another thread goes on meanwhile."""

from __future__ import annotations

import threading
import time
from contextlib import contextmanager

import pytest

from svo_engine.gpu import device as device_module
from tests.gpu.written import written

ENOUGH = 20  # turns of the other thread, which between two of ours gets one
LONG = """layout(std430) buffer Rows { uint rows[]; };
uniform uint u_turns;
void main()
{
    uint x = gl_GlobalInvocationID.x;
    for (uint i = 0u; i < u_turns; i++)
        x = x * 1664525u + 1013904223u ^ x >> 3;
    rows[gl_GlobalInvocationID.x & 63u] = x;
}
"""
LARGE = "void main()\n{{\n    float x = float(u_end);\n{0}    rows[0] = uint(x);\n}}\n"


@contextmanager
def bystander():
    """A list that another thread adds to every millisecond."""
    turns: list[None] = []
    end = threading.Event()

    def go() -> None:
        while not end.wait(0.001):
            turns.append(None)

    thread = threading.Thread(target=go)
    thread.start()
    try:
        yield turns
    finally:
        end.set()
        thread.join()


@pytest.fixture
def write(device, tmp_path):
    with written(device, tmp_path) as write:
        yield write


@pytest.fixture
def in_one_piece(device, monkeypatch):
    """Dispatches that are not cut."""
    monkeypatch.setattr(device_module, "FIRST_SLICE", 10**9)
    monkeypatch.setattr(device, "_per_second", {})


@pytest.mark.usefixtures("in_one_piece")
def test_while_a_dispatch_runs_and_is_waited_for(device, write):
    pass_, seconds, n = write("long", LONG), 0.0, 2**12
    with device.scope() as scope, bystander() as turns:
        rows = scope.buffer("rows", 256)
        while seconds < 0.2:  # long enough for many turns, on whatever device
            n *= 2
            before, start = len(turns), time.monotonic()
            device.dispatch(pass_, n, Rows=rows, u_turns=1000)
            rows.read()
            seconds = time.monotonic() - start
        assert len(turns) - before > ENOUGH


def test_while_a_program_is_compiled(device, write):
    lines, seconds, number = 50, 0.0, 0
    with bystander() as turns:
        while seconds < 0.2:
            lines, number = 2 * lines, number + 1
            text = "".join(f"    x = sin(x * {i}.25 + x) + {number}.0;\n" for i in range(lines))
            pass_ = write(f"large{number}", "layout(std430) buffer Rows { uint rows[]; };\n" + LARGE.format(text))
            before, start = len(turns), time.monotonic()
            device.prepare([(pass_, {})])
            seconds = time.monotonic() - start
        assert len(turns) - before > ENOUGH
