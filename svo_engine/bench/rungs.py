# SPDX-License-Identifier: GPL-3.0-or-later
"""The ladders: for each renderer its settings from quick to good, and how each rung is timed."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ..errors import GpuError
from .progress import Lines
from .references import NOTHING, Reference, measure
from .tables import Rendered, pack, stages

OURS = ("rays", "cones")
PEERS = ("cycles", "cycles-oidn", "eevee")
SAMPLES = {"rays": (1, 2, 4, 16, 64, 256), "cycles": (1, 4, 16, 64, 256), "cycles-oidn": (1, 4, 16, 64, 256),
           "eevee": (1, 16, 64)}
TIME_LIMITS = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0)  # s
CONES = ("64", "128", "256")  # voxels a side
CONE_SAMPLES = 4
DRAFT = {"samples": 1, "cache_resolution": "64", "denoising_quality": "fast"}  # as quick as rays can be
MANY_SAMPLES = 65536  # more than a time limit lets through

RUNS = 3
SHORT_RUNS = 11  # of what takes less than WARM_SECONDS: milliseconds jitter
WARM_SECONDS = 0.3
RUNS_SECONDS = 10.0  # once the runs of a rung have taken as long, no further one is begun


@dataclass(frozen=True, eq=False)
class Shot:
    """One render: how long it took, and the picture (h, w, 3) f4, scene-linear, row 0 at the bottom.

    parts  milliseconds: GPU passes as `stage/entry`, host steps as words; n_bytes  on the device, 0 where unknown
    limits  sentences on what was done otherwise than asked, because the device has too little room
    counts  as Film.stats has them
    """

    seconds: float
    picture: np.ndarray
    n_samples: int
    parts: Mapping[str, float] = field(default_factory=dict)
    n_bytes: int = 0
    limits: Sequence[str] = ()
    counts: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Rung:
    """One setting of one renderer. values: RenderSettings for ours, `samples` for a peer. cost: in samples."""

    renderer: str
    name: str
    values: Mapping[str, Any]
    cost: float


def ladder(renderer: str, samples: Sequence[int] = (), time_limits: Sequence[float] = TIME_LIMITS,
           settings: Mapping[str, Any] | None = None) -> list[Rung]:
    """The rungs of a renderer, the quick ones first; `samples` and `time_limits` instead of the usual ones.

    settings  of ours, below what a rung sets itself
    """
    ours = {"method": renderer, **(settings or {})} if renderer in OURS else {}
    if renderer == "cones":
        return [Rung("cones", f"{n} cubed", {**ours, "resolution": n, "samples": CONE_SAMPLES}, CONE_SAMPLES)
                for n in CONES]
    by_samples = [Rung(renderer, _plural(n, "sample"), {**ours, "samples": n}, n)
                  for n in samples or SAMPLES[renderer]]
    if renderer in PEERS:
        return by_samples
    drafts = [] if samples else [Rung("rays", "draft", {**ours, **DRAFT}, 1)]
    by_time = [Rung("rays", f"{t:g} s", {**ours, "samples": MANY_SAMPLES, "time_limit": t}, 4) for t in time_limits]
    return drafts + by_samples + by_time


def climb(rungs: Sequence[Rung], shoot: Callable[[Rung], Shot], longest: float, lines: Lines,
          scene: str) -> Iterator[tuple[Rung, list[Shot]]]:
    """Each rung with its timed shots; a first one is thrown away, so that all is compiled and loaded.

    Left out, with a sentence: rungs that would take more than `longest` seconds by what the two before them
    took; what does not fit the device; and, without one, time limits outside the times of the rungs with samples,
    which would show what those show.
    """
    known: list[tuple[float, float]] = []  # cost and seconds of the rungs with samples
    for i, rung in enumerate(rungs):
        what, limit = f"{scene}: {rung.renderer}, {rung.name}", rung.values.get("time_limit", 0.0)
        if limit and not min(known, default=(0, 0))[1] < limit < max(known, default=(0, 0))[1]:
            lines.skip(rung.cost)
            continue
        if not limit and (seconds := expected(known, rung.cost)) > longest:
            lines.skip(rung.cost, f"{what} is left out: it would take about {seconds:.0f} s")
            continue
        lines.step(what, rung.cost)
        try:
            if not i:
                shoot(rung)
            shots = repeat(partial(shoot, rung))
        except GpuError as error:
            lines.say(f"{what} is left out: {error}")
            continue
        for sentence in shots[-1].limits:
            lines.say(f"{what}: {sentence}")
        if not limit:
            known.append((rung.cost, median(shots)))
        yield rung, shots


def expected(known: Sequence[tuple[float, float]], cost: float) -> float:
    """Seconds of a rung by the line through the last two (cost, seconds); what the last one took if there is none."""
    if len(known) < 2 or known[-1][0] == known[-2][0]:
        return known[-1][1] if known else 0.0
    (cost_0, seconds_0), (cost_1, seconds_1) = known[-2:]
    return seconds_1 + max(seconds_1 - seconds_0, 0) / (cost_1 - cost_0) * (cost - cost_1)


def repeat(shoot: Callable[[], Shot], short_runs: int = SHORT_RUNS) -> list[Shot]:
    """RUNS shots, fewer where they take long.

    Short ones are short_runs, first shot for WARM_SECONDS without being counted: an idle graphics card has slowed down.
    """
    shots, n = [shoot()], RUNS
    if (seconds := shots[0].seconds) < WARM_SECONDS:
        while (seconds := seconds + shoot().seconds) < WARM_SECONDS:
            pass
        shots, n = [], short_runs
    while len(shots) < n and sum(shot.seconds for shot in shots) < RUNS_SECONDS:
        shots.append(shoot())
    return shots


def median(shots: Sequence[Shot]) -> float:
    """Of their seconds."""
    return statistics.median(shot.seconds for shot in shots)


def row(rung: Rung, shots: Sequence[Shot], reference: Reference | None, *, scene: str, size: str, device: str,
        kind: str) -> Rendered:
    """What was found of a rung: the times of all shots, the parts and the picture of the last one."""
    last, seconds = shots[-1], [shot.seconds for shot in shots]
    measures = measure(last.picture, reference) if reference else NOTHING
    return Rendered(scene, size, device, kind, renderer=rung.renderer, rung=rung.name, n_samples=last.n_samples,
                    seconds=median(shots), low=min(seconds), high=max(seconds), n_runs=len(shots),
                    parts=pack(stages(last.parts)), n_bytes=last.n_bytes, **asdict(measures))


def _plural(n: int, word: str) -> str:
    return f"{n} {word}" if n == 1 else f"{n} {word}s"
