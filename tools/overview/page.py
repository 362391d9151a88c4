# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of docs/gi-overview.md that are made: pictures and times of the stages, and where errors are largest."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from svo_engine.bench.references import Reference, load
from svo_engine.film import encode_srgb
from svo_engine.metrics import RELATIVE_FLOOR
from tools.accuracy.page import AMPLIFIED, montage, save_small
from tools.accuracy.plan import Plan

from .stages import STAGES, milliseconds

BLOCK = 48, 36  # pixels of a cut-out
ZOOM = 4
MARKED = r"(<!-- {name} -->\n).*?(\n<!-- end -->)"


def write_page(plan: Plan, scene: str, rendered: Path) -> None:
    """Put the pictures into docs/images/overview and replace the marked parts of docs/gi-overview.md."""
    path, images = plan.docs / "gi-overview.md", plan.docs / "images/overview"
    images.mkdir(parents=True, exist_ok=True)
    with np.load(rendered) as data:
        pictures, stats = {stage.name: data[stage.name] for stage in STAGES}, json.loads(str(data["stats"]))
    for name, picture in pictures.items():
        save_small(encode_srgb(picture) if name != "visibility" else picture, images / f"{name}.png")
    save_small(encode_srgb(load(plan.reference(scene)).picture), images / "cycles.png")
    text = path.read_text(encoding="utf-8")
    text = put(text, "stages", stage_lines(scene, stats, plan.n_reference))
    text = put(text, "errors", error_lines(plan, images))
    path.write_text(text, encoding="utf-8")


def put(text: str, name: str, lines: Iterator[str]) -> str:
    """`text` with other lines between `<!-- name -->` and `<!-- end -->`."""
    inside = "\n".join(lines)
    found, n = re.subn(MARKED.format(name=name), lambda m: m[1] + inside + m[2], text, flags=re.DOTALL)
    assert n == 1, f"the page has no part '{name}'"
    return found


def stage_lines(scene: str, stats: Mapping[str, Any], n_reference: int) -> Iterator[str]:
    """Pictures two in a row, with captions and milliseconds."""
    times, counts = stats["times_ms"], stats["counts"]
    how = "from nothing" if "cache/link" in times else "with trees and light kept from the frame before"
    yield (f"`{scene}` on {stats['device']}: {counts['triangles']:,} triangles, {counts['surfels']:,} surfels; "
           f"{sum(times.values()):.1f} ms for one sample {how}, the host's part included.")
    cells = [(stage.name, stage.caption, milliseconds(stage, times)) for stage in STAGES]
    cells += [("cycles", f"Cycles, {n_reference} samples", 0.0)]
    yield from ("", "| | |", "|---|---|")
    for i in range(0, len(cells), 2):
        yield "| " + " | ".join(f"![{name}](images/overview/{name}.png)<br>{caption}" + (f": {ms:.2f} ms" if ms else "")
                                for name, caption, ms in cells[i:i + 2]) + " |"


def error_lines(plan: Plan, images: Path) -> Iterator[str]:
    """For each scene the cut-out in which its picture of most samples is farthest from Cycles."""
    yield f"| scene | ours, Cycles, difference x {AMPLIFIED} | error there | in the whole picture |"
    yield "|---|---|---|---|"
    for name in plan.scenes:
        reference = load(plan.reference(name))
        with np.load(plan.ours(name)) as data:
            ours = data[str(max(plan.samples))]
        error = error_map(ours, reference)
        (x, y), worst = worst_block(error)
        cut = (slice(y, y + BLOCK[1]), slice(x, x + BLOCK[0]))
        shown = montage(*(image[cut].repeat(ZOOM, 0).repeat(ZOOM, 1) for image in (ours, reference.picture)))
        save_small(shown, images / f"error_{name}.png")
        yield (f"| `{name}` | ![{name}](images/overview/error_{name}.png) | {share(worst)} | {share(error.mean())} |")


def error_map(ours: np.ndarray, reference: Reference) -> np.ndarray:
    """Expected relMSE of each pixel (h, w) f8, free of the reference's noise: it may be below 0 by chance."""
    a, b = (np.subtract(ours, half, dtype="f8") for half in reference.halves)
    return (a * b / (np.square(reference.picture, dtype="f8") + RELATIVE_FLOOR)).mean(2)


def worst_block(error: np.ndarray) -> tuple[tuple[int, int], float]:
    """Left and lower pixel of the block of the largest mean error, in steps of a quarter block; and that mean."""
    width, height = BLOCK
    corners = [(x, y) for y in range(0, error.shape[0] - height + 1, height // 4)
               for x in range(0, error.shape[1] - width + 1, width // 4)]
    means = [error[y:y + height, x:x + width].mean() for x, y in corners]
    worst = int(np.argmax(means))
    return corners[worst], float(means[worst])


def share(mean_square: float) -> str:
    """A relMSE as root, which is a share of the light."""
    return f"{max(mean_square, 0.0) ** 0.5:.1%}"
