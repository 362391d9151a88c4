# SPDX-License-Identifier: GPL-3.0-or-later
"""Ladders through Blender: whole times of bpy.ops.render.render for ours and its peers, in one process."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import isnan
from pathlib import Path
from typing import Any

from . import references
from .progress import Lines
from .references import Reference
from .rungs import Rung, Shot, climb, row
from .tables import Rendered

SEEDS = 1, 2  # of a reference's halves; renders that are timed have 0
MADE_SAMPLES = 1024  # of a reference that Cycles makes
NOISE_SAMPLES = 32  # that tell the noise of a stored reference


def scene_rows(file: Path, stored: Path | None, out: Path, ladders: Sequence[Sequence[Rung]],
               size: tuple[int, int] | None, device: str, reference_samples: int, longest: float,
               lines: Lines) -> Iterator[Rendered]:
    """All ladders of one .blend against its stored reference, or one that Cycles makes first and `out` keeps.

    reference_samples: of the one to make, 0 for the usual number; or those that the stored one has, 0 if not known:
    with them its noise can be told.
    """
    from ..blender import peers

    truth = references.load(stored) if stored else None
    with peers.opened(file, size or (truth.size if truth else None)) as scene:
        cycles = partial(peers.renderer, scene, "cycles", device)
        if truth is None:
            path = out / "references" / f"{file.stem}_{_pixels(scene, size)}_{reference_samples or MADE_SAMPLES}.npz"
            truth = _reference(path, cycles, reference_samples or MADE_SAMPLES, lines)
        elif reference_samples and isnan(truth.noise):
            lines.step(f"{file.stem}: the noise of the stored reference", NOISE_SAMPLES)
            truth = replace(truth, noise=noise_of(cycles, reference_samples))
            references.save(truth, out / "references" / f"{file.stem}.npz")
        width, height = truth.size
        for rungs in ladders:
            with peers.renderer(scene, rungs[0].renderer, device) as render:
                for rung, shots in climb(rungs, partial(_shoot, render), longest, lines, file.stem):
                    yield row(rung, shots, truth, scene=file.stem, size=f"{width}x{height}", kind="render",
                              device=peers.device_name(device))


def _reference(path: Path, renderer: Callable[[], Any], n_samples: int, lines: Lines) -> Reference:
    """The one in `path`, which an earlier run made, or a new one."""
    lines.step(f"{path.stem}: the reference, by Cycles", n_samples)
    if path.is_file():
        lines.say(f"'{path}' is there and used; remove it if the scene has changed")
        return references.load(path)
    made = make_reference(renderer, n_samples)
    references.save(made, path)
    return made


def _pixels(scene: Any, size: tuple[int, int] | None) -> str:
    """WIDTHxHEIGHT of a render."""
    render = scene.render
    full, percentage = (render.resolution_x, render.resolution_y), render.resolution_percentage
    width, height = size or (n * percentage // 100 for n in full)
    return f"{width}x{height}"


def noise_of(renderer: Callable[[], Any], n_samples: int) -> float:
    """relMSE of the noise of a picture of n_samples: that of NOISE_SAMPLES, scaled as one over the samples."""
    return make_reference(renderer, NOISE_SAMPLES).noise * NOISE_SAMPLES / n_samples


def make_reference(renderer: Callable[[], Any], n_samples: int) -> Reference:
    """Two halves with different seeds."""
    with renderer() as render:
        halves = [render({"samples": max(n_samples // 2, 1), "seed": seed}).picture for seed in SEEDS]
    return references.from_halves(*halves)


def _shoot(render: Callable[[Mapping[str, Any]], Any], rung: Rung) -> Shot:
    done = render(rung.values)
    stats = done.stats
    return Shot(done.seconds, done.picture, stats.get("n_samples", rung.values.get("samples", 0)),
                stats.get("times_ms", {}), stats.get("counts", {}).get("device bytes", 0), stats.get("limits", ()))
