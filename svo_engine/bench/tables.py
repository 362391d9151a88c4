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
    """Frames after an edit through the core, seconds from scene to pixels; all programs were compiled before.

    first       of the edit's very first time in the process
    seconds     of the edit's frame, each time another value: median of n_runs
    warm        of the next frame, with nothing edited: median
    n_programs  compiled meanwhile, the most of any frame
    parts       milliseconds of stages after the edit, see `pack`
    """

    scene: str
    size: str
    device: str
    renderer: str
    edit: str
    first: float
    seconds: float
    warm: float
    n_programs: int
    n_runs: int
    parts: str


@dataclass(frozen=True)
class Watched:
    """An edit in Blender's viewport, 4 samples: seconds, medians of n_runs. nan: there is no such time.

    first, final  from the edit to the first picture that shows it, and to the last sample
    main          the longest time in one piece that the main thread was in our code
    held          the longest time that a thread of Python that does nothing was held up, beyond the 2 ms that it sleeps
    n_programs    compiled meanwhile, the most of any frame
    """

    scene: str
    size: str
    device: str
    edit: str
    first: float
    final: float
    main: float
    held: float
    n_programs: int
    n_runs: int


@dataclass(frozen=True)
class Skipped:
    """A scene with all that it does not need left out, or with nothing left out; one sample.

    need, has_it   what the scene has or lacks; skips: whether what it does not need is left out
    anew, seconds  of a frame with everything anew, and of one with nothing to do but the picture, a median of n_runs;
                   all counts are of the former
    is_same        whether the picture is the same to the bit as with all left out that is not needed
    n_dispatches   of programs, draws included
    cache_rays, diffuse_rays, draws
                   rays of the light cache, of pixels for diffuse light, and draws of light for pixels
    path_steps     invocations that light and trace paths of mirrors and glass
    principled, emitters
                   invocations of the programs of all but plain diffuse materials, and of those of emissive triangles
    cutouts, texels
                   instances at which rays ask how opaque a surface is, and texels of materials' images on the device
    """

    need: str
    has_it: bool
    skips: bool
    size: str
    device: str
    anew: float
    seconds: float
    n_runs: int
    is_same: bool
    n_bytes: int
    n_dispatches: int
    cache_rays: int
    diffuse_rays: int
    draws: int
    path_steps: int
    principled: int
    emitters: int
    cutouts: int
    texels: int


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


FILES: dict[type, str] = {Rendered: "ladder.csv", Edited: "edits.csv", Watched: "viewport.csv", Skipped: "skipping.csv",
                          Timed: "thesis.csv", Scaled: "scaling.csv"}


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
    types = {name: _CONVERT.get(convert, convert) for name, convert in get_type_hints(kind).items()}
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


_CONVERT: dict[type, Any] = {bool: {"True": True, "False": False}.__getitem__}


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
