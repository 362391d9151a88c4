# SPDX-License-Identifier: GPL-3.0-or-later
"""What the numbers say: error over time as a curve, where two curves cross, ratios between them, slopes.

A curve is what a renderer reaches in a time: its rungs that are better than all quicker ones, joined by straight lines
in log-log. Before its first rung it has no picture, so its error is infinite; after its last one nothing improves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np


@dataclass(frozen=True, eq=False)
class Curve:
    """times  (n,) f8, s, ascending; errors  (n,) f8, relMSE, descending. At least one rung."""

    times: np.ndarray
    errors: np.ndarray

    def error_at(self, time: float) -> float:
        """What is reached within `time` seconds; inf before the first rung."""
        if time < self.times[0]:
            return float("inf")
        return float(np.exp(np.interp(np.log(time), np.log(self.times), np.log(self.errors))))

    def time_of(self, error: float) -> float:
        """Seconds until `error` is reached; inf if it never is."""
        if error < self.errors[-1]:
            return float("inf")
        return float(np.exp(np.interp(-np.log(error), -np.log(self.errors), np.log(self.times))))


def make_curve(times: Sequence[float], errors: Sequence[float]) -> Curve:
    """The curve through rungs in any order. Those without a positive, finite error are left out; ValueError if none is
    left."""
    kept: list[tuple[float, float]] = []
    for time, error in sorted(zip(times, errors, strict=True)):
        if 0 < error < (kept[-1][1] if kept else float("inf")):
            kept.append((time, error))
    if not kept:
        raise ValueError("a curve needs a rung with a positive error")
    return Curve(*np.array(kept).T)


def ahead(ours: Curve, theirs: Curve) -> list[tuple[float, float]]:
    """Spans of time (from, to), in seconds, within which our error is the lower one.

    They end at the last rung of both; a span that reaches this end says nothing of what comes after it.
    """
    spans: list[tuple[float, float]] = []
    knots = np.unique(np.concatenate([ours.times, theirs.times, *_crossings(ours, theirs)]))
    for start, end in pairwise(knots):
        middle = float(np.sqrt(start * end))
        if ours.error_at(middle) < theirs.error_at(middle):
            joins = spans and spans[-1][1] == start
            spans.append((spans.pop()[0] if joins else float(start), float(end)))
    return spans


def crossover(ours: Curve, theirs: Curve) -> float | None:
    """The time from which on their error is the lower one, to the end of both ladders; None if ours is."""
    end = max(ours.times[-1], theirs.times[-1])
    spans = ahead(ours, theirs)
    if not spans:
        return float(theirs.times[0])
    return None if spans[-1][1] == end else spans[-1][1]


def error_ratios(ours: Curve, theirs: Curve) -> np.ndarray:
    """Their error over ours at the time of each of their rungs, (n,) f8: above 1 ours is lower, 0 without a picture."""
    return np.array([e / ours.error_at(t) for t, e in zip(theirs.times, theirs.errors, strict=True)])


def time_ratios(ours: Curve, theirs: Curve) -> np.ndarray:
    """Their time over ours at the error of each of their rungs, (n,) f8: above 1 ours is quicker, 0 if not reached."""
    return np.array([t / ours.time_of(e) for t, e in zip(theirs.times, theirs.errors, strict=True)])


def geometric_mean(ratios: np.ndarray) -> float:
    """The mean of ratios; those that are 0, because there is nothing to compare with, are left out. nan without any."""
    known = ratios[ratios > 0]
    return float(np.exp(np.log(known).mean())) if len(known) else float("nan")


def slope(xs: Sequence[float], ys: Sequence[float]) -> float:
    """k of the y = c x^k that fits best in log-log; nan with fewer than two different x or a y that is not positive."""
    x, y = np.asarray(xs, "f8"), np.asarray(ys, "f8")
    if len(set(xs)) < 2 or not (y > 0).all():
        return float("nan")
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def _crossings(ours: Curve, theirs: Curve) -> list[np.ndarray]:
    """Times (1,) at which straight parts of both curves meet."""
    knots = np.unique(np.concatenate([ours.times, theirs.times]))
    knots = knots[knots >= max(ours.times[0], theirs.times[0])]
    gaps = [np.log(ours.error_at(t) / theirs.error_at(t)) for t in knots]
    found = []
    for i, (a, b) in enumerate(pairwise(gaps)):
        if a * b < 0:
            low, high = np.log(knots[i]), np.log(knots[i + 1])
            found.append(np.array([np.exp(low + (high - low) * a / (a - b))]))
    return found
