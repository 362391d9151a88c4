# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of error over time: what is reached when, where two of them cross, by what factors they differ; slopes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from svo_engine.bench.curves import (
    ahead,
    crossover,
    error_ratios,
    geometric_mean,
    make_curve,
    slope,
    time_ratios,
)

OURS = make_curve([0.1, 1], [1e-2, 1e-3])  # error 1e-3 / t
STEEP = make_curve([0.1, 1, 10], [1e-1, 1e-3, 1e-5])  # error 1e-3 / t^2: meets OURS at 1 s
NEVER, NONE_YET = math.inf, 0


def test_a_curve_keeps_what_is_better_than_all_that_is_quicker():
    curve = make_curve([3, 1, 2, 4, 5, 6], [0.2, 0.5, 0.6, float("nan"), -0.1, 0.1])
    assert curve.times.tolist() == [1, 3, 6]
    assert curve.errors.tolist() == [0.5, 0.2, 0.1]


def test_a_curve_without_errors_is_none():
    with pytest.raises(ValueError, match="positive"):
        make_curve([1, 2], [float("nan"), 0])


@pytest.mark.parametrize(("time", "error"), [(0.09, NEVER), (0.1, 1e-2), (10**-0.5, 10**-2.5), (1, 1e-3), (100, 1e-3)])
def test_error_within_a_time(time, error):
    assert OURS.error_at(time) == pytest.approx(error)


@pytest.mark.parametrize(("error", "time"), [(1, 0.1), (1e-2, 0.1), (10**-2.5, 10**-0.5), (1e-3, 1), (9e-4, NEVER)])
def test_time_until_an_error(error, time):
    assert OURS.time_of(error) == pytest.approx(time)


def test_curves_cross_where_their_lines_do():
    ours = make_curve([0.1, 10], [1e-2, 1e-4])
    assert crossover(ours, make_curve([0.1, 10], [1e-1, 1e-5])) == pytest.approx(1)
    ((start, end),) = ahead(ours, make_curve([0.1, 10], [1e-1, 1e-5]))
    assert (start, end) == pytest.approx((0.1, 1))


def test_a_ladder_that_ends_is_passed_where_the_other_one_gets_below_its_end():
    assert crossover(make_curve([0.1], [1e-4]), STEEP) == pytest.approx(10**0.5)


def test_no_crossover_where_ours_is_lower_to_the_end():
    assert crossover(make_curve([0.01, 10], [1e-2, 1e-6]), STEEP) is None


def test_who_is_never_ahead_is_crossed_at_the_first_picture():
    assert crossover(make_curve([0.2, 1], [1, 0.5]), STEEP) == 0.1


def test_spans_tell_of_a_slow_start():
    spans = ahead(make_curve([1, 20], [1e-4, 1e-7]), make_curve([0.5, 20], [1e-2, 1e-6]))
    assert spans == [(1, 20)]


def test_ratios_at_the_peers_rungs():
    theirs = make_curve([0.05, 0.2, 1, 4], [1e-1, 1e-2, 2e-3, 5e-4])
    assert error_ratios(OURS, theirs) == pytest.approx([NONE_YET, 2, 2, 0.5])
    assert time_ratios(OURS, theirs) == pytest.approx([0.5, 2, 2, NONE_YET])


def test_a_mean_of_factors_leaves_out_what_cannot_be_compared():
    assert geometric_mean(np.array([0.5, 8, 0])) == pytest.approx(2)
    assert math.isnan(geometric_mean(np.array([0.0])))


@pytest.mark.parametrize("k", [-0.5, 0, 1, 2])
def test_slope_of_a_power(k):
    xs = [1, 3, 10, 50]
    assert slope(xs, [7 * x**k for x in xs]) == pytest.approx(k, abs=1e-12)


@pytest.mark.parametrize(("xs", "ys"), [([1], [1]), ([2, 2], [1, 3]), ([1, 2], [0, 1]), ([1, 2], [float("nan"), 1])])
def test_slope_of_nothing(xs, ys):
    assert math.isnan(slope(xs, ys))
