# SPDX-License-Identifier: GPL-3.0-or-later
"""speed.md: run time against error for each scene, and what that says beside each peer."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from ..tables import Rendered
from ..verdicts import NAMES, Verdict, is_whole, seconds, verdicts
from .markdown import factor, largest, number, percent, table
from .plots import error_over_time
from .runs import Run

_INTRO = """# Run time against error

Written by `python -m svo_engine bench --report`; [README](README.md) says how the numbers come about.

*Error* is relMSE less the reference's own noise, where that is known. Times are medians of several runs after one that
is thrown away. The ratios compare with what ours, rays or cones, reaches at the same time or error; above 1, ours is
ahead; a dash, there is nothing to compare with. Crossover: the time from which on the peer's error is the lower one.
"""


def page(runs: Sequence[Run], folder: Path) -> str:
    """The page's text; writes a plot for each scene of each run into `folder`."""
    parts = [_INTRO]
    for run in runs:
        if run.ladder:
            parts += [run.heading(), *_scenes(run, folder)]
    return "\n".join(parts)


def _scenes(run: Run, folder: Path) -> Iterator[str]:
    found = list(verdicts(run.ladder))
    for scene, size in dict.fromkeys((row.scene, row.size) for row in run.ladder):
        rows = [row for row in run.ladder if (row.scene, row.size) == (scene, size)]
        plot = f"{run.name}_{scene}_{size}.png"
        error_over_time(folder / plot, f"{scene}, {size}, {run.name}", [row for row in rows if is_whole(row)])
        yield f"### {scene}, {size}\n\n![Error over time]({plot})\n"
        yield _noise(rows)
        yield _rungs([row for row in rows if is_whole(row)])
        for verdict in found:
            if (verdict.scene, verdict.size) == (scene, size):
                yield _verdict(verdict)
        yield _kinds(rows)


def _noise(rows: Sequence[Rendered]) -> str:
    noise = number(rows[0].noise)
    if noise == "-":
        return "The reference's own noise is not known; it is in every error.\n"
    return f"The reference's own noise: relMSE {noise}, told by two independent halves; it is not in *Error*.\n"


def _rungs(rows: Sequence[Rendered]) -> str:
    headers = "Renderer", "Rung", "Samples", "Time", "Runs", "NRMSE", "relMSE", "Error", "Bias", "FLIP"
    return table(headers, ([NAMES[r.renderer], r.rung, str(r.n_samples), seconds(r.seconds), str(r.n_runs),
                            number(r.nrmse), number(r.rel_mse), number(r.error), percent(r.bias), number(r.flip)]
                           for r in rows))


def _verdict(verdict: Verdict) -> str:
    headers = f"Beside {NAMES[verdict.peer]}", "Its time", "Its error", "Error at equal time", "Time at equal error"
    rows = ([r.rung, seconds(r.seconds), number(r.error), factor(by_error), factor(by_time)]
            for r, by_error, by_time in zip(verdict.rungs, verdict.by_error, verdict.by_time, strict=True))
    spans = ", ".join(f"{seconds(a)} to {seconds(b)}" for a, b in verdict.spans) or "nowhere"
    return f"{verdict.sentence()}. Ours has the lower error: {spans}.\n\n{table(headers, rows)}"


def _kinds(rows: Sequence[Rendered]) -> str:
    """Frames that redo less than everything, and where the time goes."""
    ours = [row for row in rows if row.parts]
    if not ours:
        return ""
    return table(("Frame", "Rung", "Anew", "Time", "Milliseconds of its parts"),
                 ([NAMES[r.renderer], r.rung, r.kind, seconds(r.seconds), largest(r.parts)] for r in ours))
