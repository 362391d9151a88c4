# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.physics`: the figures that the tests bound, measured and written to docs/benchmarks/physics.md.

Without Blender's module the column of Cycles stays out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from itertools import groupby
from pathlib import Path

from svo_engine.render import Session
from tests.physics.figures import DARK, FIGURES, LIT, rooms, seen_from
from tests.rays import shot

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/benchmarks/physics.md"
SAMPLE, SAMPLE_SIZE = ROOT / "sample_blends/two_rooms.blend", (160, 120)

HEAD = """# Physics

Errors of the light by rays against closed forms and against itself, beside the most that the tests allow
(`tests/physics/figures.py`). All are parts of 1. Rays are few, so that what is measured is not hidden: 4 rays of each
surfel in the light cache, 4 gather rays, 1 to 4 samples, no noise filter.

`python -m tools.physics` writes this page. Ours: {device}.
"""
ROOMS = """
## Two rooms beside Cycles

Light behind the wall over light before it, and the lit room's mean over Cycles'. The first two are the scenes above at
64 cubed, with Cycles at {samples} samples and 64 bounces; the third is `sample_blends/two_rooms.blend` with its own
settings, at {width}x{height} pixels.

| rooms | dark over lit, ours | dark over lit, Cycles | lit room, ours over Cycles |
|---|---|---|---|
"""


def main() -> int:
    """Measure everything and write the page."""
    parser = argparse.ArgumentParser("tools.physics", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--only", default="", metavar="TEXT", help="figures with this in their name; prints them alone")
    parser.add_argument("--cycles-samples", type=int, default=256, metavar="N")
    options = parser.parse_args()
    session = Session()
    lines = list(tables(session, options.only))
    if not options.only:
        text = HEAD.format(device=session.device_info()["renderer"]) + "\n".join(lines) + "\n"
        if find_spec("bpy"):
            width, height = SAMPLE_SIZE
            text += ROOMS.format(samples=options.cycles_samples, width=width, height=height)
            text += "\n".join(beside_cycles(session, options.cycles_samples)) + "\n"
        PAGE.parent.mkdir(parents=True, exist_ok=True)
        PAGE.write_text(text, encoding="utf-8")
        print(PAGE.relative_to(ROOT))
    session.close()
    return 0


def tables(session: Session, only: str) -> Iterator[str]:
    """Lines of a table for each group of figures."""
    chosen = [figure for figure in FIGURES if only in f"{figure.group}, {figure.name}"]
    for group, figures in groupby(chosen, lambda figure: figure.group):
        yield from ("", f"## {group}", "", "| | measured | at most |", "|---|---|---|")
        for figure in figures:
            line = f"| {figure.name} | {max(figure.measure(session), 0.0):.1e} | {figure.most:.0e} |"
            print(line, flush=True)
            yield line


def beside_cycles(session: Session, samples: int) -> Iterator[str]:
    """Rows of the table of two rooms."""
    from .in_blender import cycles_mean, half_and_half

    for degrees in (0, 45):
        seen = [seen_from(rooms(degrees), eyes[degrees]) for eyes in (LIT, DARK)]
        ours = [float(shot(session, scene, samples=16, cache_resolution="64", cache_rays=16, bounces=64).mean())
                for scene in seen]
        yield row(f"wall at {degrees} degrees", ours, [cycles_mean(scene, samples) for scene in seen])
    left_right = (half_and_half(SAMPLE, name, {"samples": n}, SAMPLE_SIZE)
                    for name, n in (("rays", 16), ("cycles", samples)))
    yield row("`two_rooms.blend`", *left_right)


def row(name: str, ours: Sequence[float], theirs: Sequence[float]) -> str:
    """Of (lit, dark) means."""
    line = f"| {name} | {ours[1] / ours[0]:.1e} | {theirs[1] / theirs[0]:.1e} | {ours[0] / theirs[0]:.4f} |"
    print(line, flush=True)
    return line


if __name__ == "__main__":
    sys.exit(main())
