# SPDX-License-Identifier: GPL-3.0-or-later
"""edits.md: what an edit costs, through the core and through Blender's viewport."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..tables import Edited, Watched
from .markdown import factor, largest, number, table
from .runs import Run

_INTRO = """# What an edit costs

Written by `python -m svo_engine bench --report`; [README](README.md) says how the numbers come about.

*Programs* counts those that were compiled while the edit was made: 0 is asked of every row. All of the engine's
programs were compiled before the first edit, as the engine does by itself whenever nothing else is to be done.
"""

_CORE = """### Through the core, {scene}, {size}, {renderer}

Milliseconds from the edited scene to pixels on the host, one sample. *Very first*: when the edit was made for the first
time in the process, so that memory is taken and the driver is done with its programs; *edit's frame*: when it is made
again, each time with another value, the median; *warm frame*: the next one, of the edited scene with nothing more to
do; *ratio*: of the two medians. The scene before each edit is the same but for what the edit adds or switches on.
On a software renderer the light cache and the voxels are 64 cubed instead of 128, here as in Blender.
"""

_BLENDER = """### Through Blender, {scene}, {size}

From the property that is set to the viewport's *first* picture, a draft, and its *final* one after 4 samples, redraws
by a timer at 60 Hz included; medians. *Main thread*: the longest time in one piece that it was in the engine's code;
*bystander*: the longest that a thread of Python which does nothing was held up, as Blender's panels would be, by the
engine or by Blender itself; both the longest of {n_runs} edits. A window's texture is not made. All in milliseconds.
"""


def page(runs: Sequence[Run]) -> str:
    """The page's text."""
    parts = [_INTRO]
    for run in runs:
        if run.edits or run.watched:
            parts += [run.heading(), *_core(run.edits), *_blender(run.watched)]
    return "\n".join(parts)


def _core(rows: Sequence[Edited]) -> Iterator[str]:
    headers = ("Edit", "Very first", "Edit's frame", "Warm frame", "Ratio", "Programs", "Runs", "Its largest parts")
    for key in dict.fromkeys((row.scene, row.size, row.renderer) for row in rows):
        scene, size, renderer = key
        yield _CORE.format(scene=scene, size=size, renderer=renderer)
        yield table(headers, ([e.edit, *(_ms(s) for s in (e.first, e.seconds, e.warm)), factor(e.seconds / e.warm),
                               str(e.n_programs), str(e.n_runs), largest(e.parts)]
                              for e in rows if (e.scene, e.size, e.renderer) == key))


def _blender(rows: Sequence[Watched]) -> Iterator[str]:
    headers = "Edit", "First picture", "Final picture", "Main thread", "Bystander", "Programs"
    for scene, size in dict.fromkeys((row.scene, row.size) for row in rows):
        found = [row for row in rows if (row.scene, row.size) == (scene, size)]
        yield _BLENDER.format(scene=scene, size=size, n_runs=found[0].n_runs)
        yield table(headers, ([w.edit, *(_ms(s) for s in (w.first, w.final, w.main, w.held)), str(w.n_programs)]
                              for w in found))


def _ms(seconds: float) -> str:
    return number(seconds * 1e3)
