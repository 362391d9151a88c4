# SPDX-License-Identifier: GPL-3.0-or-later
"""scaling.md: how time and memory grow along each axis, with slopes in log-log."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..curves import slope
from ..tables import Scaled, stages, unpack
from .markdown import number, power, size, table
from .plots import Series, growth
from .runs import Run

SHARE = 0.05  # of the last frame: stages below it are not shown
END = 3  # points of the slope at the end

_INTRO = """# How time and memory grow

Written by `python -m svo_engine bench --report`; [README](README.md) says how the numbers come about.

One series of frames along each axis, everything anew, one sample, all else small and fixed. A slope k means that time
grows as x to the power k: fitted in log-log over the whole series, and over its last three points, where what does not
grow weighs less. Stages below 5 % of the last frame are not shown.
"""

MEANINGS = {
    "triangles": "Triangles of the ball. At most n log n, a slope of little more than 1, for trees and uploads; "
                 "pictures of the same ball should take the same.",
    "octree": "Voxels along a side of the octree. Surfaces have n^2 voxels, so 2.",
    "voxel grid": "Voxels along a side of the grid of cones. Surfaces n^2, but clearing and filtering a grid is n^3.",
    "lamps": "Lamps that share the same power. Below 1.",
    "pixels": "Pixels of the picture. 1 for what is done for pixels, 0 for the rest.",
    "bounces": "The most bounces that are allowed. At most 1, and 0 once nothing changes any more.",
    "instances": "Placings of a ball of 500 triangles. At most n log n.",
}


def page(runs: Sequence[Run], folder: Path) -> str:
    """The page's text; writes a plot for each run into `folder`."""
    parts = [_INTRO]
    for run in runs:
        if not run.scaling:
            continue
        by_axis = {axis: [row for row in run.scaling if row.axis == axis]
                   for axis in dict.fromkeys(row.axis for row in run.scaling)}
        plot = f"{run.name}_scaling.png"
        growth(folder / plot, {axis: series(rows) for axis, rows in by_axis.items()})
        parts += [run.heading(), f"![Growth along each axis]({plot})\n"]
        parts += [f"### {axis.capitalize()}\n\n{MEANINGS[axis]}\n\n{_points(rows)}\n{slopes(rows)}"
                  for axis, rows in by_axis.items()]
    return "\n".join(parts)


def series(rows: Sequence[Scaled]) -> Series:
    """Milliseconds over x: of the whole frame, and of each stage that counts at the end and was there all along."""
    xs = [row.x for row in rows]
    parts = [stages(unpack(row.parts)) for row in rows]
    whole = [row.seconds * 1e3 for row in rows]
    shown = [name for name, ms in parts[-1].items() if ms > SHARE * whole[-1] and all(name in part for part in parts)]
    return {"whole": (xs, whole), **{name: (xs, [part[name] for part in parts]) for name in shown}}


def slopes(rows: Sequence[Scaled]) -> str:
    """A table of slopes: time of the whole and of stages, and memory."""
    xs = [row.x for row in rows]
    lines = {**{name: ys for name, (_, ys) in series(rows).items()}, "memory": [float(row.n_bytes) for row in rows]}
    return table(("Slope of", "whole series", "last three"),
                 ([name, power(slope(xs, ys)), power(slope(xs[-END:], ys[-END:]))]
                  for name, ys in lines.items()))


def _points(rows: Sequence[Scaled]) -> str:
    found = series(rows)
    headers = [rows[0].axis.capitalize(), *(f"{name}, ms" for name in found), "memory, MiB", "runs"]
    return table(headers, ([f"{row.x:,.0f}", *(number(ys[i]) for _, ys in found.values()), size(row.n_bytes),
                            str(row.n_runs)] for i, row in enumerate(rows)))
