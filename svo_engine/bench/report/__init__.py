# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV files in, pages and plots out: DIR/data/*/ become DIR/speed.md, edits.md and so on, and plots."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...errors import SvoError
from . import edits, runs, scaling, skipping, speed, thesis


def write(folder: Path) -> list[Path]:
    """Write the pages that there are numbers for; SvoError if there are none, or a file cannot be read or written."""
    found = [runs.read(path) for path in sorted((folder / "data").glob("*")) if path.is_dir()]
    pages: dict[str, Callable[[], str]] = {}
    if any(run.ladder for run in found):
        pages["speed.md"] = lambda: speed.page(found, folder)
    if any(run.edits or run.watched for run in found):
        pages["edits.md"] = lambda: edits.page(found)
    if any(run.skipping for run in found):
        pages["skipping.md"] = lambda: skipping.page(found)
    if any(run.thesis for run in found):
        pages["thesis.md"] = lambda: thesis.page(found)
    if any(run.scaling for run in found):
        pages["scaling.md"] = lambda: scaling.page(found, folder)
    if not pages:
        raise SvoError(f"There are no tables in folders in '{folder / 'data'}'")
    try:
        for name, make in pages.items():
            (folder / name).write_text(make(), encoding="utf-8")
    except OSError as error:
        raise SvoError(f"Cannot write into '{folder}': {error.strerror or error}") from error
    return [folder / name for name in pages]
