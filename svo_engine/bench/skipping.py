# SPDX-License-Identifier: GPL-3.0-or-later
"""What it saves to leave out what a scene does not need: for each need a small scene with it and one without.

Counters say what was done and what was not. Each scene is rendered twice, once with all done that any scene could need;
its picture must be the same to the bit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from ..passes import cache, evaluate, gather, path
from ..render import Session
from ..scene.types import Image, Material, Scene, Texture, World
from ..settings import RenderSettings
from .core import Shooter
from .edits import KINDS
from .progress import Lines
from .rungs import RUNS, Shot, median, repeat
from .shapes import WHITE, cornell
from .tables import Skipped

SIZE = (160, 120)
SETTINGS = {"samples": 1, "cache_resolution": "32", "denoiser": "atrous"}

ROUGH = Material("Rough", (0.8, 0.8, 0.8), roughness=0.8)
MIRROR = Material("Mirror", (0.8, 0.8, 0.8), roughness=0.1, metallic=1.0)
GLASS = Material("Glass", (0.8, 0.8, 0.8), roughness=0.1, transmission=1.0)
GREY = World((0.2, 0.2, 0.2))
CHECKER = Image("Checker", np.tile(np.array([[[64], [192]], [[192], [64]]], "u1"), (32, 32, 4)))


@dataclass(frozen=True, eq=False)
class Case:
    """A scene, and settings of its own."""

    scene: Scene
    values: Mapping[str, Any] = field(default_factory=dict)


def cases() -> dict[str, tuple[Case, Case]]:
    """Of each need the scene that has it and the one that lacks it, alike otherwise."""
    box = Case(cornell())
    rough = Case(cornell(ROUGH))
    mirror = Case(cornell(MIRROR))
    return {
        "light": (box, Case(cornell(lights=()))),
        "lamps": (lit_sky := Case(cornell(world=GREY)), Case(cornell(lights=(), world=GREY))),
        "emission": (Case(cornell(replace(WHITE, emission=(1.0, 1.0, 1.0)))), box),
        "world": (lit_sky, box),
        "principled": (_textured(WHITE), box),
        "textures": (_textured(ROUGH), rough),
        "alpha": (Case(cornell(replace(WHITE, alpha=0.5))), box),
        "gloss": (rough, box),
        "glass": (Case(cornell(GLASS)), mirror),
        "long paths": (mirror, Case(cornell(replace(MIRROR, roughness=0.8)))),
        "passes": (Case(box.scene, {"passes": ("Normal", "Diffuse Direct", "Glossy Direct", "Emission")}), box)}


def n_cases() -> int:
    """Scenes that are measured."""
    return len({case for pair in cases().values() for case in pair})


def rows(session: Session, size: tuple[int, int], values: Mapping[str, Any], lines: Lines) -> Iterator[Skipped]:
    """Measure all cases, each once though several needs name it."""
    session.compile_now()
    shooter, device = Shooter(session, size), session.device_info()["renderer"]
    known: dict[Case, list[dict[str, Any]]] = {}
    for need, pair in cases().items():
        for has_it, case in zip((True, False), pair, strict=True):
            if case not in known:
                lines.step(f"{need}: {'with' if has_it else 'without'} it")
                known[case] = _measure(shooter, case, values)
            for found in known[case]:
                yield Skipped(need=need, has_it=has_it, size=f"{size[0]}x{size[1]}", device=device, **found)


def _measure(shooter: Shooter, case: Case, values: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Of a scene with all that it does not need left out, and with nothing left out."""
    found, pictures = [], []
    for skips in (True, False):
        settings = {**SETTINGS, **values, **case.values, "skip_unneeded": skips}
        shoot = partial(shooter.shoot, case.scene, settings)
        counted = shoot(anew=KINDS["all"])
        anew, shots = [shoot(anew=KINDS["all"]) for _ in range(RUNS)], repeat(shoot)
        pictures.append(counted.picture)
        found.append({"skips": skips, "anew": median(anew), "seconds": median(shots), "n_runs": len(shots),
                      "n_bytes": counted.n_bytes, "is_same": np.array_equal(*(pictures[0], pictures[-1])),
                      **counters(counted, RenderSettings(**settings))})
    return found


def counters(shot: Shot, settings: RenderSettings) -> dict[str, int]:
    """What a frame did, as the columns of its row."""
    counts = shot.counts

    def invocations(*passes: Any) -> int:
        return sum(counts.get(f"{name} invocations", 0) for name in {each.name for each in passes})

    return {
        "n_dispatches": sum(n for name, n in counts.items() if "/" in name and not name.endswith(" invocations")),
        "cache_rays": invocations(cache.LINK) // cache.SPLIT * settings.cache_rays,
        "diffuse_rays": counts.get("diffuse rays", 0), "draws": counts.get("light draws", 0),
        "path_steps": invocations(path.STEP), "principled": invocations(evaluate.PRINCIPLED),
        "emitters": invocations(cache.FOUND, cache.DRAW, gather.FOUND, gather.DRAW, path.WEIGH),
        "cutouts": counts.get("cutouts", 0), "texels": counts.get("texture words", 0)}


def _textured(material: Material) -> Case:
    return Case(cornell(replace(material, base_color_texture=0), textures=(Texture(0),), images=(CHECKER,)))
