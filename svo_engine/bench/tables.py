# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables that measuring writes and reporting reads: one dataclass a kind of row, one CSV file a table."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

from ..errors import SvoError

Row = TypeVar("Row")


@dataclass(frozen=True)
class Rendered:
    """One rung of a ladder. nan: not measured.

    kind      render: a whole bpy.ops.render.render; else scene to pixels on the host, with what is done anew: all,
              light, or camera, which is nothing but the picture
    seconds   median of n_runs, low to high; the first run is thrown away
    parts     milliseconds of stages, see `pack`
    n_bytes   of buffers and textures on the device, 0 where unknown
    error     relMSE less the reference's own noise, where that is known; see `references.py`
    noise     the reference's own relMSE; nan: not known
    """

    scene: str
    size: str
    device: str
    kind: str
    renderer: str
    rung: str
    n_samples: int
    seconds: float
    low: float
    high: float
    n_runs: int
    parts: str
    n_bytes: int
    nrmse: float
    rel_mse: float
    error: float
    noise: float
    bias: float
    flip: float


@dataclass(frozen=True)
class Edited:
    """A frame after an edit, one sample: seconds from scene to pixels, median of n_runs; what was done, see `pack`."""

    scene: str
    size: str
    device: str
    renderer: str
    edit: str
    seconds: float
    n_runs: int
    parts: str


@dataclass(frozen=True)
class Timed:
    """One entry of the thesis's tables: GPU and whole milliseconds of `what` at n voxels a side, medians of n_runs."""

    mesh: str
    n_triangles: int
    device: str
    what: str
    n: int
    n_voxels: int
    gpu_ms: float
    whole_ms: float
    n_runs: int
    parts: str


@dataclass(frozen=True)
class Scaled:
    """One frame of a series along `axis`: median seconds of n_runs, GPU and host milliseconds of stages, memory."""

    axis: str
    device: str
    x: float
    seconds: float
    n_runs: int
    parts: str
    n_bytes: int


FILES: dict[type, str] = {Rendered: "ladder.csv", Edited: "edits.csv", Timed: "thesis.csv", Scaled: "scaling.csv"}


def write(folder: Path, kind: type[Row], rows: Iterable[Row]) -> Path:
    """Write a table into `folder`, which is made if need be; SvoError if that cannot be done."""
    path = folder / FILES[kind]
    names = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(names)
            writer.writerows([_text(getattr(row, name)) for name in names] for row in rows)
    except OSError as error:
        raise SvoError(f"Cannot write '{path}': {error.strerror or error}") from error
    return path


def read(folder: Path, kind: type[Row]) -> list[Row]:
    """The rows of a table in `folder`, none if it has no such file; SvoError if a file holds something else.

    Files whose names go on after the table's, as ladder_peers.csv does, hold more of it: what others measured.
    """
    stem, ending = FILES[kind].split(".")
    return [row for path in sorted(folder.glob(f"{stem}*.{ending}")) for row in _read_file(path, kind)]


def _read_file(path: Path, kind: type[Row]) -> list[Row]:
    types = get_type_hints(kind)
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    try:
        return [kind(**{name: convert(row[name]) for name, convert in types.items()}) for row in rows]
    except (KeyError, TypeError, ValueError) as error:
        raise SvoError(f"'{path}' is no table of {kind.__name__.lower()} rows: {error}") from error


def pack(parts: Mapping[str, float]) -> str:
    """Milliseconds by name as one cell: 'upload 1.25; gather/rays 30.5'."""
    return "; ".join(f"{name} {ms:.4g}" for name, ms in parts.items())


def unpack(cell: str) -> dict[str, float]:
    """Back from `pack`."""
    pairs = (part.rpartition(" ") for part in cell.split("; ") if part)
    return {name: float(ms) for name, _, ms in pairs}


def stages(parts: Mapping[str, float]) -> dict[str, float]:
    """Milliseconds by stage: the passes 'gather/rays' and 'gather/sort' are both 'gather'."""
    sums: dict[str, float] = {}
    for name, ms in parts.items():
        stage = name.partition("/")[0]
        sums[stage] = sums.get(stage, 0.0) + ms
    return sums


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
