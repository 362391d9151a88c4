# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of stages: given again, made again, released when nobody needs them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from svo_engine.gpu.kept import Kept


@dataclass(eq=False)
class Result:
    scope: Any


def make(device, *_):
    scope = device.scope()
    scope.buffer("result", 64)
    return Result(scope)


def frame_of(device, kept, *inputs):
    with kept.frame(device) as stage:
        return stage("one", make, *inputs)


@pytest.mark.parametrize(("before", "after", "is_same"), [
    ((1, "a", (2.0, 3)), (1, "a", (2.0, 3)), True),
    ((1,), (2,), False),
    ((1,), (1, 1), False),
    (((1, 2),), ((1, 3),), False),
])
def test_equal_values_give_the_last_result(device, before, after, is_same):
    kept = Kept()
    assert (frame_of(device, kept, *before) is frame_of(device, kept, *after)) is is_same
    frame_of(device, kept).scope.close()


def test_objects_are_compared_by_identity(device):
    kept, one, same = Kept(), [1], [1]
    first = frame_of(device, kept, one)
    assert frame_of(device, kept, one) is first
    assert frame_of(device, kept, same) is not first
    frame_of(device, kept).scope.close()


def test_a_replaced_result_is_released(device):
    before = device.n_bytes
    kept = Kept()
    for i in range(5):
        frame_of(device, kept, i)
        assert device.n_bytes == before + 64
    frame_of(device, kept, 9).scope.close()


def test_a_frame_keeps_what_it_uses_while_others_replace_it(device):
    before, kept = device.n_bytes, Kept()
    with kept.frame(device) as stage:
        mine = stage("one", make, 1)
        frame_of(device, kept, 2)
        latest = frame_of(device, kept, 3)
        assert mine.scope.n_bytes == 64  # the other frame's own result of input 2 is gone
        assert device.n_bytes == before + 2 * 64
    assert mine.scope.n_bytes == 0
    latest.scope.close()


def test_what_a_failing_stage_has_made_is_released(device):
    before, kept = device.n_bytes, Kept()

    def fail(device):
        make(device)
        raise ValueError("made half")

    with pytest.raises(ValueError, match="half"), kept.frame(device) as stage:
        stage("one", fail)
    assert device.n_bytes == before
    frame_of(device, kept, 1).scope.close()
