# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots as small PNG files, by matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..tables import Rendered
from ..verdicts import NAMES

_DPI = 80
_STYLES = {"rays": ("tab:red", "o-"), "cones": ("tab:orange", "s--"), "cycles": ("tab:gray", "v:"),
           "cycles-oidn": ("tab:blue", "^-"), "eevee": ("tab:green", "d:")}

Series = Mapping[str, tuple[Sequence[float], Sequence[float]]]


def error_over_time(path: Path, title: str, rows: Sequence[Rendered]) -> None:
    """Every rung with a positive error, one line a renderer; rungs by time limits stand apart, without a line."""
    figure, axes = _figure(1, 1, (7, 4.6))
    for renderer, (color, style) in _STYLES.items():
        for is_limit in (False, True):
            found = sorted((row.seconds, row.error) for row in rows if row.renderer == renderer and row.error > 0
                           and row.rung.endswith(" s") == is_limit)
            if found:
                label = NAMES[renderer] + (", time limits" if is_limit else "")
                axes[0].plot(*zip(*found, strict=True), "x" if is_limit else style, color=color, label=label, ms=5)
    _dress(axes[0], title, "seconds", "relMSE")
    _save(figure, path)


def growth(path: Path, panels: Mapping[str, Series]) -> None:
    """One panel an axis of growth, one line a stage."""
    n_rows = -(-len(panels) // 2)
    figure, axes = _figure(n_rows, 2, (9, 2.9 * n_rows))
    for axis, (name, series) in zip(axes, panels.items(), strict=False):
        for label, (xs, ys) in series.items():
            axis.plot(xs, ys, "k.-" if label == "whole" else ".-", label=label, linewidth=2 if label == "whole" else 1)
            axis.set_xticks(xs, labels=[_short(x) for x in xs])
        _dress(axis, name, name, "milliseconds")
        axis.minorticks_off()
    for axis in axes[len(panels):]:
        axis.remove()
    _save(figure, path)


def _figure(n_rows: int, n_columns: int, size: tuple[float, float]) -> tuple[Any, list[Any]]:
    from matplotlib.figure import Figure

    figure = Figure(size, layout="constrained")
    axes = list(figure.subplots(n_rows, n_columns, squeeze=False).ravel())
    for axis in axes:
        axis.set(xscale="log", yscale="log")
    return figure, axes


def _short(x: float) -> str:
    """5000 as 5k."""
    for unit, name in ((1e6, "M"), (1e3, "k")):
        if x >= unit:
            return f"{x / unit:.3g}{name}"
    return f"{x:.3g}"


def _dress(axis: Any, title: str, x_label: str, y_label: str) -> None:
    axis.set(title=title, xlabel=x_label, ylabel=y_label)
    axis.grid(which="both", alpha=0.25)
    if axis.lines:
        axis.legend(fontsize=7)


def _save(figure: Any, path: Path) -> None:
    """The same picture gives the same file."""
    figure.savefig(path, dpi=_DPI, metadata={"Software": None})
