# SPDX-License-Identifier: GPL-3.0-or-later
"""Several that render on one device: what one has made serves all, and stays while any of them needs it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from svo_engine.gpu.kept import Kept

SIZE = 64  # bytes of a result


@dataclass(eq=False)
class Result:
    scope: Any


def make(device, *_):
    scope = device.scope()
    scope.buffer("result", SIZE)
    return Result(scope)


def result_of(device, kept, *inputs, name="one", n_kept=1):
    with kept.frame(device) as stage:
        return stage(name, make, *inputs, n_kept=n_kept)


@pytest.fixture
def family(device):
    """Two of a family, which hold nothing when a test ends."""
    before, relatives = device.n_bytes, list[Kept]()
    yield Kept(relatives), Kept(relatives)
    for kept in list(relatives):
        kept.close()
    assert device.n_bytes == before


def test_equal_inputs_give_both_the_same_result(device, family):
    one, other = family
    assert result_of(device, one, 1) is result_of(device, other, 1)


def test_results_of_other_stages_or_inputs_are_not_shared(device, family):
    one, other = family
    first = result_of(device, one, 1)
    assert result_of(device, other, 2) is not first
    assert result_of(device, other, 1, name="two") is not first


def test_strangers_share_nothing(device, family):
    stranger = Kept()
    assert result_of(device, stranger, 1) is not result_of(device, family[0], 1)
    stranger.close()


@pytest.mark.parametrize("leave", [Kept.close, Kept.forget, lambda kept: kept.forget(["one"])])
def test_one_that_drops_a_result_does_not_release_what_the_other_uses(device, family, leave):
    one, other = family
    shared = result_of(device, one, 1)
    result_of(device, other, 1)
    leave(one)
    assert shared.scope.n_bytes == SIZE
    assert result_of(device, other, 1) is shared
    leave(other)
    assert shared.scope.n_bytes == 0


def test_one_that_goes_on_to_another_input_leaves_the_other_its_result(device, family):
    one, other = family
    shared = result_of(device, one, 1)
    result_of(device, other, 1)
    result_of(device, one, 2)
    assert result_of(device, other, 1) is shared
    assert result_of(device, one, 1) is shared  # and has it back from there


def test_who_has_closed_gives_nothing_to_the_others(device, family):
    one, other = family
    gone = result_of(device, one, 1)
    one.close()
    assert result_of(device, other, 1) is not gone


def test_a_result_of_a_frame_that_is_not_over_outlives_all_of_them(device, family):
    one, other = family
    with one.frame(device) as stage:
        used = stage("one", make, 1)
        result_of(device, other, 1)
        one.close()
        other.close()
        assert used.scope.n_bytes == SIZE
    assert used.scope.n_bytes == 0


def test_as_many_results_are_kept_as_asked_and_the_oldest_goes(device, family):
    one, _ = family
    first, second, third = (result_of(device, one, i, n_kept=3) for i in range(3))
    assert result_of(device, one, 0, n_kept=3) is first
    result_of(device, one, 3, n_kept=3)
    assert [result.scope.n_bytes for result in (first, second, third)] == [SIZE, 0, SIZE]


def test_what_was_given_again_is_the_newest(device, family):
    one, _ = family
    first, second = (result_of(device, one, i, n_kept=2) for i in range(2))
    result_of(device, one, 0, n_kept=2)
    result_of(device, one, 2, n_kept=2)
    assert (first.scope.n_bytes, second.scope.n_bytes) == (SIZE, 0)


def test_a_stage_that_keeps_several_shares_each(device, family):
    one, other = family
    made = [result_of(device, one, i, n_kept=3) for i in range(3)]
    assert [result_of(device, other, i) for i in range(3)] == made
    assert result_of(device, one, 0, n_kept=3) is made[0]
