# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of accuracy: a table of errors, a picture of each scene, and what causes the errors."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from svo_engine.bench.references import Reference, measure
from svo_engine.blender.montage import side_by_side
from svo_engine.film import encode_srgb

CAUSES = Path(__file__).with_name("causes.toml")
WORTH_A_CAUSE = 0.03  # NRMSE
AMPLIFIED = 8
MOST_BYTES = 250_000  # of a picture

HEAD = """# Accuracy

Every scene of `sample_blends` at {width}x{height}, by rays with all settings at their defaults but the samples, against
{n} samples of Cycles, which are two halves with different seeds. Their difference tells the noise of the reference.
**relMSE** has it in it; **clean** is relMSE without it: the mean of the product of our distances to either half, whose
noises have nothing to do with each other. All measures are of scene-linear light, but FLIP is of what the view
Standard shows.

`python -m tools.accuracy` writes this page. Ours: {device}.

| scene | samples | NRMSE | relMSE | clean | noise of Cycles | bias | FLIP |
|---|---|---|---|---|---|---|---|
"""


def write_page(folder: Path, pictures: Mapping[str, Mapping[int, np.ndarray]], truths: Mapping[str, Reference],
               circumstances: Mapping[str, Any], n_reference: int) -> None:
    """accuracy.md and images/accuracy_SCENE.png in `folder`; pictures: scene -> samples -> (h, w, 3) f4."""
    (folder / "images").mkdir(parents=True, exist_ok=True)
    causes = tomllib.loads(CAUSES.read_text(encoding="utf-8"))
    width, height = next(iter(truths.values())).size
    table: list[str] = []
    below: list[str] = []
    for name, by_samples in pictures.items():
        table += rows(name, by_samples, truths[name])
        below += ["", *section(name, by_samples, truths[name], causes.get(name, ""))]
        save_small(montage(by_samples[max(by_samples)], truths[name].picture), folder / image_of(name))
    head = HEAD.format(width=width, height=height, n=n_reference, device=circumstances.get("device", "unknown"))
    (folder / "accuracy.md").write_text(head + "\n".join([*table, *below]) + "\n", encoding="utf-8")


def rows(name: str, by_samples: Mapping[int, np.ndarray], truth: Reference) -> Iterator[str]:
    """A line of the table for each number of samples."""
    for n, picture in by_samples.items():
        m = measure(picture, truth)
        yield (f"| `{name}` | {n} | {m.nrmse:.2%} | {m.rel_mse:.2e} | {m.error:.2e} | {m.noise:.2e} | {m.bias:+.2%} | "
               f"{m.flip:.4f} |")


def section(name: str, by_samples: Mapping[int, np.ndarray], truth: Reference, cause: str) -> Iterator[str]:
    """The picture of a scene and, where its error is worth it, the cause."""
    n = max(by_samples)
    yield from (f"## {name}", "", f"![{name}: ours, Cycles, difference]({image_of(name)})", "",
                f"Ours at {n} samples, Cycles, and where they differ, {AMPLIFIED} times amplified.")
    if measure(by_samples[n], truth).nrmse > WORTH_A_CAUSE:
        yield from ("", cause or "The cause of the error is not known yet.")


def image_of(name: str) -> str:
    """Path of a scene's picture below the page's folder."""
    return f"images/accuracy_{name}.png"


def montage(ours: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Three pictures side by side, sRGB-encoded, row 0 at the bottom."""
    difference = AMPLIFIED * np.abs(ours - reference)
    return side_by_side({"SVO": encode_srgb(ours), "CYCLES": encode_srgb(reference), "ERROR": encode_srgb(difference)})


def save_small(picture: np.ndarray, path: Path) -> None:
    """Write a PNG of sRGB-encoded values, row 0 at the bottom; at half the size as often as it is too large a file."""
    from PIL import Image

    image = Image.fromarray(np.round(np.clip(picture[::-1], 0, 1) * 255).astype("u1"))
    image.save(path, optimize=True)
    while path.stat().st_size > MOST_BYTES:
        image = image.reduce(2)
        image.save(path, optimize=True)
