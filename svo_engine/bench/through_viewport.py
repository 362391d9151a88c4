# SPDX-License-Identifier: GPL-3.0-or-later
"""What edits cost through Blender: from the edit to the viewport's pictures, and who was held up meanwhile."""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..render import Session
from .core import SOFTWARE
from .progress import Lines
from .tables import Watched

RUNS = 3
N_STEPS = 20  # about, for a scene that has something for all acts
SIZE = (160, 120)
SAMPLES = 4  # of the viewport
FINAL_SAMPLES = 8, 9  # of F12, taken in turns


def rows(file: Path, values: Mapping[str, Any], size: tuple[int, int] | None, lines: Lines) -> Iterator[Watched]:
    """Every act on the scene of one .blend. values: settings other than the file's own."""
    from ..blender import edit_watch, peers, session

    size = size or SIZE
    with peers.opened(file, size) as scene:
        software = SOFTWARE if "llvmpipe" in _device(session.current) else {}
        for setting, value in {"viewport_samples": SAMPLES, **software, **values}.items():
            setattr(scene.svo, setting, value)
        lines.step(f"{file.stem}: all programs and the first picture")
        with edit_watch.watched(scene, size) as watch:
            circumstances = {"scene": file.stem, "size": f"{size[0]}x{size[1]}", "device": _device(session.current)}
            for name, act in watch.acts().items():
                lines.step(f"{file.stem}: {name}")
                yield _row(circumstances, name, [_see(watch, act, i) for i in range(1, RUNS + 1)])
                act.end()
            lines.step(f"{file.stem}: F12")
            seen = [watch.see_render(FINAL_SAMPLES[i % 2]) for i in range(RUNS)]
            yield _row(circumstances, "F12 after the viewport", seen)


def _see(watch: Any, act: Any, number: int) -> Any:
    """The act from where it starts."""
    watch.see(act.start)
    return watch.see(lambda: act.do(number))


def _row(circumstances: Mapping[str, str], name: str, seen: Sequence[Any]) -> Watched:
    """Medians of times, the longest of what held others up."""
    return Watched(**circumstances, edit=name, first=statistics.median(each.first for each in seen),
                   final=statistics.median(each.final for each in seen), main=max(each.main for each in seen),
                   held=max(each.held for each in seen), n_programs=max(each.n_programs for each in seen),
                   n_runs=len(seen))


def _device(session: Session) -> str:
    return session.device_info()["renderer"]
