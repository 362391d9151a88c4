# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command `bench` does: measure into a folder of tables, or report what such folders hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..errors import SvoError
from ..gpu.thread import GpuThread
from ..render import Session
from ..scene import store
from ..scene.types import Scene
from . import core, edits, host, references, scaling, skipping, tables, thesis, through_viewport
from .progress import Lines, progress
from .rungs import OURS, PEERS, TIME_LIMITS, Rung, ladder
from .verdicts import verdicts

SOFTWARE_TRIANGLES = 500_000  # the most that the thesis's tables ask of a software renderer


@dataclass(frozen=True)
class Plan:
    """What is asked for. samples, time_limits, size: empty for the usual ones.

    longest   seconds of a render beyond which rungs are left out
    settings  of ours that are not to be the defaults
    """

    scenes: Sequence[Path]
    references: Sequence[Path]
    out: Path
    renderers: Sequence[str]
    samples: Sequence[int]
    time_limits: Sequence[float]
    size: tuple[int, int] | None
    longest: float
    settings: Mapping[str, Any]

    def ladders(self) -> list[list[Rung]]:
        """The rungs of each renderer."""
        return [ladder(name, self.samples, self.time_limits or TIME_LIMITS, self.settings) for name in self.renderers]


def run_core(plan: Plan) -> None:
    """Ladders of scenes in .npz files; writes ladder.csv."""
    scenes = load_scenes(plan)
    truths = load_references(plan)
    ladders = plan.ladders()
    found: list[tables.Rendered] = []
    with (closing(Session()) as session,
          progress(len(scenes) * sum(rung.cost for rungs in ladders for rung in rungs)) as lines):
        for (name, scene), truth in zip(scenes.items(), truths, strict=True):
            size = size_of(plan, scene, truth)
            for rungs in ladders:
                found += core.ladder_rows(session, name, scene, truth, rungs, size, plan.longest, lines)
                tables.write(plan.out, tables.Rendered, found)
        host.write(plan.out, session.device_info()["renderer"])
    _print_verdicts(found)


def run_edits(plan: Plan) -> None:
    """What edits cost: of scenes in .npz files through the core, of .blend files through Blender's viewport; writes
    edits.csv and viewport.csv, those that there are scenes for."""
    whole = [path for path in plan.scenes if path.suffix == ".blend"]
    scenes = load_scenes(replace(plan, scenes=[path for path in plan.scenes if path.suffix != ".blend"]))
    edited: list[tables.Edited] = []
    watched: list[tables.Watched] = []
    with progress(len(scenes) * (1 + len(edits.EDITS)) + len(whole) * through_viewport.N_STEPS) as lines:
        for name, scene in scenes.items():
            with closing(Session()) as session:
                edited += core.edit_rows(session, name, scene, plan.settings, size_of(plan, scene, None), lines)
            tables.write(plan.out, tables.Edited, edited)
        for path in whole:
            watched += through_viewport.rows(path, plan.settings, plan.size, lines)
            tables.write(plan.out, tables.Watched, watched)
    _write_host(plan)


def run_skipping(plan: Plan) -> None:
    """What it saves to leave out what a scene does not need; writes skipping.csv."""
    with closing(Session()) as session, progress(skipping.n_cases()) as lines:
        tables.write(plan.out, tables.Skipped, skipping.rows(session, plan.size or skipping.SIZE, plan.settings, lines))
    _write_host(plan)


def run_thesis(plan: Plan) -> None:
    """The thesis's tables on the first scene of the plan, if any, and on balls of more and more triangles."""
    given = list(load_scenes(plan).items())[:1]
    with closing(Session()) as session:
        device = session.device_info()["renderer"]
    most = SOFTWARE_TRIANGLES if is_software(device) else max(thesis.TRIANGLES)
    balls = list(thesis.triangle_scenes(most))
    n_steps = len(given or balls[:1]) * (2 * len(thesis.SIZES) + 2) + len(balls) * 2 * len(thesis.TRIANGLES_SIZES)
    with progress(n_steps) as lines:
        found = list(_thesis_rows(given or balls[:1], balls, lines))
    host.write(plan.out, device)
    tables.write(plan.out, tables.Timed, found)


def _print_verdicts(rows: Sequence[tables.Rendered]) -> None:
    for verdict in verdicts(rows):
        print(verdict.sentence())


def _thesis_rows(main: list[tuple[str, Scene]], balls: list[tuple[str, Scene]],
                 lines: Lines) -> Iterator[tables.Timed]:
    for name, scene in main:
        yield from thesis.frame_rows(name, scene, lines)
    with closing(GpuThread()) as thread:
        for name, scene in main:
            yield from thesis.voxelization_rows(thread, name, scene, thesis.SIZES, lines)
        for name, scene in balls:
            yield from thesis.voxelization_rows(thread, name, scene, thesis.TRIANGLES_SIZES, lines)


def run_scaling(plan: Plan) -> None:
    """All series of `scaling.py`; writes scaling.csv."""
    with closing(Session()) as session:
        device = session.device_info()["renderer"]
    todo = scaling.points(is_software(device))
    with progress(len(todo)) as lines:
        found = list(scaling.rows(todo, lines))
    host.write(plan.out, device)
    tables.write(plan.out, tables.Scaled, found)


def run_blender(plan: Plan, device: str, reference_samples: int) -> None:
    """Ladders of scenes in .blend files through Blender, peers included; writes ladder.csv, and the references that
    Cycles made as references/SCENE.npz."""
    from . import through_blender

    ladders = plan.ladders()
    cost = len(plan.scenes) * sum(rung.cost for rungs in ladders for rung in rungs)
    if not plan.references:
        cost += len(plan.scenes) * (reference_samples or through_blender.MADE_SAMPLES)
    stored: Sequence[Path | None] = check_references(plan) or [None] * len(plan.scenes)
    found: list[tables.Rendered] = []
    with progress(cost) as lines:
        for path, reference in zip(plan.scenes, stored, strict=True):
            found += through_blender.scene_rows(path, reference, plan.out, ladders, plan.size, device,
                                                reference_samples, plan.longest, lines)
            tables.write(plan.out, tables.Rendered, found)
    _write_host(plan)
    _print_verdicts(found)


def _write_host(plan: Plan) -> None:
    with closing(Session()) as session:
        host.write(plan.out, session.device_info()["renderer"])


def write_report(folder: Path) -> None:
    """Pages of the tables in folder/data/*/."""
    from . import report

    print(*report.write(folder), sep="\n")


def load_scenes(plan: Plan) -> dict[str, Scene]:
    """The plan's scenes by the names of their files; SvoError names a file that cannot be read."""
    return {path.stem: store.load(path) for path in plan.scenes}


def load_references(plan: Plan) -> list[references.Reference | None]:
    """One for each scene, or None for each."""
    return [references.load(path) for path in check_references(plan)] or [None] * len(plan.scenes)


def check_references(plan: Plan) -> Sequence[Path]:
    """The plan's references: one for each scene, or none at all; SvoError if there are others than that."""
    if plan.references and len(plan.references) != len(plan.scenes):
        raise SvoError(f"There are {len(plan.scenes)} scenes and {len(plan.references)} references: give one for each")
    return plan.references


def size_of(plan: Plan, scene: Scene, truth: references.Reference | None) -> tuple[int, int]:
    """What to render at: as asked, or as the reference is, or as the scene's camera says."""
    camera: Any = scene.camera
    return plan.size or (truth.size if truth else camera.size)


def is_software(device: str) -> bool:
    """Whether OpenGL runs on the processor."""
    return "llvmpipe" in device


def chosen_renderers(names: Sequence[str], is_core: bool, device: str) -> Sequence[str]:
    """Those that are named, or all that make sense; SvoError if one of them cannot be had."""
    known = OURS if is_core else (*OURS, *PEERS)
    if unknown := [name for name in names if name not in known]:
        raise SvoError(f"There is no renderer '{unknown[0]}' here; there are {', '.join(known)}")
    if names or is_core:
        return names or OURS
    if device == "gpu":
        return known
    Lines().say("EEVEE is left out: without a GPU it takes a minute, nearly all of it to compile shaders; name it in "
                "--renderers to have it")
    return tuple(name for name in known if name != "eevee")
