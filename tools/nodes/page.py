# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/nodes.md: a table for each kind of node."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/nodes.md"
RIGHT = 1e-3

HEAD = """# Nodes

Every node of Blender's shader editor in every mode, beside Cycles. Each is shown by a flat card of 32 by 32 pixels
whose inputs vary over it, and sent out as light: *worst* is the largest difference of a pixel as a share of the range
of the values, at least 1; *off* is the share of pixels that differ by more than 1e-3 of that, which at jumps (edges of
a checker, `floor`) are a few. Shaders are seen from above below a white sky, and *worst* is the difference of the mean.

`python -m tools.nodes` writes this page. Ours: {device}. {n} modes of {kinds} nodes: {right} right ({worst:g} at most),
{jumps} right but at jumps (less than 5 % of the pixels off), {told} not supported and told, {wrong} neither; {missing}
not measured yet.

"""


def page(modes: Sequence[Any], known: dict[str, dict[str, Any]], device: str) -> str:
    """The page of those modes that were measured."""
    n_all, modes = len(modes), [m for m in modes if m.key in known]
    verdicts = [verdict(known[m.key], m.is_shader) for m in modes]
    text = HEAD.format(device=device, n=len(modes), kinds=len({m.kind for m in modes}), worst=RIGHT,
                       right=verdicts.count("right"), jumps=verdicts.count("at jumps"), told=verdicts.count("told"),
                       wrong=verdicts.count("wrong"), missing=n_all - len(modes))
    return text + "\n".join(_lines(modes, known)) + "\n"


def verdict(result: dict[str, Any], is_shader: bool) -> str:
    """In one word."""
    if result["worst"] <= (0.01 if is_shader else RIGHT):
        return "right"
    if result["notes"]:
        return "told"
    return "at jumps" if result["off"] < 0.05 and not is_shader else "wrong"


def _lines(modes: Sequence[Any], known: dict[str, dict[str, Any]]) -> Iterator[str]:
    for label, group in groupby(modes, key=lambda m: m.label):
        yield f"## {label}\n\n| settings | output | worst | off | |\n|---|---|---|---|---|"
        for mode in group:
            result = known[mode.key]
            settings = ", ".join(f"{_words(name)} {_words(str(value))}" for name, value in mode.settings.items())
            said = verdict(result, mode.is_shader)
            told = "; ".join(sorted({note.partition(": ")[2] or note for note in result["notes"]}))
            yield (f"| {settings or 'default'} | {mode.output} | {result['worst']:.2g} | {result['off']:.1%} | "
                   f"{'' if said == 'right' else said}{': ' + told if told else ''} |")
        yield ""


def _words(name: str) -> str:
    return name.replace("_", " ").lower()
