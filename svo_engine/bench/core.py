# SPDX-License-Identifier: GPL-3.0-or-later
"""Ladders and edits through the core alone, from scenes in .npz files: no Blender, no other library than the core's.

A time is that of a whole frame: from a Scene to pixels on the host. Forgetting what was kept is not in it.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import count
from typing import Any

from ..errors import SceneError
from ..render import Session
from ..scene.camera import make_view
from ..scene.types import Camera, Scene
from ..settings import RenderSettings
from .edits import KINDS, Edit, Look, possible
from .progress import Lines
from .references import Reference
from .rungs import Rung, Shot, climb, median, repeat, row
from .tables import Edited, Rendered, pack, stages

COMPILED = "programs compiled"  # among the counts of a film
SOFTWARE = {"cache_resolution": "64", "resolution": "64"}  # of edits where there is no graphics card
EDIT_RUNS = 5  # of short frames
EDIT_SAMPLES = 1  # what an edit costs is not hidden behind many samples


def ladder_rows(session: Session, name: str, scene: Scene, reference: Reference | None, rungs: Sequence[Rung],
                size: tuple[int, int], longest: float, lines: Lines) -> Iterator[Rendered]:
    """Each rung in each of the three kinds of edits.KINDS; the picture is the same in all."""
    shooter = Shooter(session, size)
    circumstances = {"scene": name, "size": f"{size[0]}x{size[1]}", "device": session.device_info()["renderer"]}

    def shoot(rung: Rung) -> Shot:
        return shooter.shoot(scene, rung.values, anew=KINDS["all"])

    for rung, shots in climb(rungs, shoot, longest, lines, name):
        yield row(rung, shots, reference, kind="all", **circumstances)
        if rung.values.get("time_limit"):
            continue
        for kind in ("light", "camera"):
            again = repeat(partial(shooter.shoot, scene, rung.values, anew=KINDS[kind]))
            yield row(rung, again, reference, kind=kind, **circumstances)


def edit_rows(session: Session, name: str, scene: Scene, values: Mapping[str, Any], size: tuple[int, int],
              lines: Lines) -> Iterator[Edited]:
    """What each kind of edit costs after a frame of `scene` as it was, at the settings `values` but one sample."""
    if scene.camera is None:
        raise SceneError(f"The scene '{name}' has no camera")
    lines.step(f"{name}: all programs")
    session.compile_now()
    device = session.device_info()["renderer"]
    values = {**(SOFTWARE if "llvmpipe" in device else {}), **values, "samples": EDIT_SAMPLES}
    shooter, look = Shooter(session, size), Look(scene, scene.camera, values)
    circumstances = {"scene": name, "size": f"{size[0]}x{size[1]}", "device": device,
                     "renderer": values.get("method", "rays")}
    for edit_name, edit in possible(scene).items():
        lines.step(f"{name}: {edit_name}")
        first, shots, warm = _edit_shots(shooter, edit, edit.start(look))
        yield Edited(**circumstances, edit=edit_name, first=first.seconds, seconds=median(shots), warm=median(warm),
                     n_programs=max(shot.counts[COMPILED] for shot in (first, *shots)), n_runs=len(shots),
                     parts=pack(stages(shots[-1].parts)))


def _edit_shots(shooter: Shooter, edit: Edit, before: Look) -> tuple[Shot, list[Shot], list[Shot]]:
    """The edit's very first frame, its frames when it is made again and again, and frames with nothing more to do."""
    numbers = count(1)

    def shoot() -> Shot:
        after = edit.change(before, next(numbers))
        shooter.show(before)
        return shooter.show(after, KINDS["all" if edit.anew else "camera"])

    first, shots = shoot(), repeat(shoot, EDIT_RUNS)
    last = edit.change(before, next(numbers))
    shooter.show(last)
    return first, shots, repeat(partial(shooter.show, last), EDIT_RUNS)


class Shooter:
    """Renders through a Session, and takes the time."""

    def __init__(self, session: Session, size: tuple[int, int]) -> None:
        self._session, self._size = session, size

    def shoot(self, scene: Scene, values: Mapping[str, Any], through: Camera | None = None,
              anew: tuple[str, ...] | None = None) -> Shot:
        """One frame, through the scene's camera or another, with the settings `values` and defaults for all others.

        anew  stages to be forgotten before, as Session.forget takes them; None: none
        """
        if (eye := through or scene.camera) is None:
            raise SceneError("The scene has no camera")
        view, settings = make_view(eye, self._size), RenderSettings(**values)
        if anew is not None:
            self._session.forget(*anew)
        start = time.perf_counter()
        *_, film = self._session.films(scene, view, settings, interval=math.inf)
        seconds = time.perf_counter() - start
        return Shot(seconds, film.planes["Combined"][..., :3], film.n_samples, film.stats["times_ms"],
                    film.stats["counts"]["device bytes"], film.stats["limits"], film.stats["counts"])

    def show(self, look: Look, anew: tuple[str, ...] | None = None) -> Shot:
        """One frame of a look."""
        return self.shoot(look.scene, look.values, look.camera, anew)
