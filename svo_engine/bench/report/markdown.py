# SPDX-License-Identifier: GPL-3.0-or-later
"""Markdown, and numbers as people read them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ..tables import unpack


def table(headers: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table whose first column is text and whose others are numbers."""
    align = ["---", *["---:"] * (len(headers) - 1)]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [headers, align, *rows]) + "\n"


def number(value: float, digits: int = 3) -> str:
    """To some significant digits, never with an exponent; '-' for what was not measured."""
    if not math.isfinite(value):
        return "-"
    if value == 0:
        return "0"
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])  # of the rounded value
    places = max(digits - 1 - exponent, 0)
    return f"{value:,.{places}f}"


def factor(ratio: float) -> str:
    """A ratio, '-' where there is nothing to compare."""
    return number(ratio) if ratio > 0 else "-"


def power(slope: float) -> str:
    """An exponent."""
    return f"{slope:.2f}" if math.isfinite(slope) else "-"


def percent(value: float) -> str:
    """A part with its sign."""
    return f"{value:+.2%}" if math.isfinite(value) else "-"


def size(n_bytes: float) -> str:
    """Bytes in MiB."""
    return number(n_bytes / 2**20)


def largest(cell: str, n: int = 5) -> str:
    """Those of packed milliseconds that take longest."""
    parts = sorted(unpack(cell).items(), key=lambda part: -part[1])[:n]
    return ", ".join(f"{name} {number(ms)}" for name, ms in parts)
