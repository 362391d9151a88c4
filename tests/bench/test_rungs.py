# SPDX-License-Identifier: GPL-3.0-or-later
"""Ladders: their rungs, how each is timed, and which are left out."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest

from svo_engine.bench import rungs
from svo_engine.bench.progress import Lines
from svo_engine.bench.rungs import Shot, climb, expected, ladder, repeat
from svo_engine.errors import GpuError
from svo_engine.settings import RenderSettings

PICTURE = np.zeros((2, 2, 3), "f4")


class Recorder(Lines):
    """Keeps what is said."""

    def __init__(self):
        self.steps, self.sentences, self.cost = [], [], 0.0

    def step(self, text, cost=1.0):
        self.steps.append(text)
        self.cost += cost

    def skip(self, cost, sentence=""):
        self.cost += cost
        if sentence:
            self.say(sentence)

    def say(self, sentence):
        self.sentences.append(sentence)


def climbed(of, seconds_of, longest=100.0):
    """Names of the rungs that were timed, how often each was rendered, and what was said."""
    lines, counts = Recorder(), {}

    def shoot(rung):
        counts[rung.name] = counts.get(rung.name, 0) + 1
        return Shot(seconds_of(rung), PICTURE, 1)

    found = [rung.name for rung, _ in climb(of, shoot, longest, lines, "scene")]
    assert lines.cost == sum(rung.cost for rung in of)  # the bar ends where it should
    return found, counts, lines.sentences


@pytest.mark.parametrize("renderer", rungs.OURS)
def test_our_rungs_are_settings(renderer):
    for rung in ladder(renderer, settings={"bounces": 3}):
        made = RenderSettings(**rung.values)
        assert (made.method, made.bounces) == (renderer, 3)


@pytest.mark.parametrize("renderer", rungs.PEERS)
def test_peers_are_told_samples_alone(renderer):
    assert [rung.values for rung in ladder(renderer)] == [{"samples": n} for n in rungs.SAMPLES[renderer]]


def test_samples_can_be_chosen():
    assert [rung.name for rung in ladder("rays", (1, 8), (0.5,))] == ["1 sample", "8 samples", "0.5 s"]


def test_every_rung_is_timed_three_times_after_one_run_for_nothing():
    found, counts, said = climbed(ladder("cycles", (1, 4)), lambda rung: 0.5)
    assert found == ["1 sample", "4 samples"]
    assert counts == {"1 sample": 1 + rungs.RUNS, "4 samples": rungs.RUNS}
    assert said == []


def test_short_rungs_warm_the_device_up_first():
    _, counts, _ = climbed(ladder("cycles", (1, 4)), lambda rung: 0.6 * rungs.WARM_SECONDS)
    assert counts == {"1 sample": 3 + rungs.SHORT_RUNS, "4 samples": 2 + rungs.SHORT_RUNS}


def test_long_runs_are_repeated_less():
    assert [len(repeat(lambda s=s: Shot(s, PICTURE, 1))) for s in (1, 6, 60)] == [3, 2, 1]


def test_rungs_that_would_take_too_long_are_left_out_with_a_sentence():
    found, _, (sentence,) = climbed(ladder("cycles", (1, 4, 16, 64)), lambda rung: rung.cost, longest=20)
    assert found == ["1 sample", "4 samples", "16 samples"]
    assert sentence == "scene: cycles, 64 samples is left out: it would take about 64 s"


def test_what_a_frame_costs_before_its_samples_is_not_multiplied():
    found, _, said = climbed(ladder("cycles", (1, 4, 16, 64)), lambda rung: 10 + 0.1 * rung.cost, longest=20)
    assert len(found) == 4 and not said


def test_time_limits_between_the_quickest_and_the_slowest_rung():
    found, _, _ = climbed(ladder("rays", (1, 16), (0.1, 0.5, 2, 50)),
                          lambda rung: rung.values.get("time_limit") or 0.3 * rung.cost)
    assert found == ["1 sample", "16 samples", "0.5 s", "2 s"]


def test_what_does_not_fit_the_device_is_left_out():
    def refuse(rung):
        if rung.name == "1 sample":
            raise GpuError("Too large")
        return 0.1

    found, _, said = climbed(ladder("cycles", (1, 4)), refuse)
    assert (found, said) == (["4 samples"], ["scene: cycles, 1 sample is left out: Too large"])


def test_expected_times():
    assert expected([], 4) == 0
    assert expected([(1, 3.0)], 4) == 3
    assert expected([(1, 3.0), (2, 4.0)], 4) == pytest.approx(6)
    assert expected([(16, 3.0), (16, 4.0)], 16) == 4


def test_row_of_a_rung():
    (rung,) = ladder("cycles", (4,))
    parts = {"gather/rays": 1.0, "gather/sort": 2.0, "read back": 0.5}
    shots = [Shot(s, PICTURE, 4, parts, 99) for s in (3.0, 1.0, 2.0)]
    found = asdict(rungs.row(rung, shots, None, scene="box", size="2x2", device="card", kind="all"))
    assert (found["seconds"], found["low"], found["high"], found["n_runs"], found["n_bytes"]) == (2, 1, 3, 3, 99)
    assert found["parts"] == "gather 3; read back 0.5"
    assert np.isnan(found["error"])
