# SPDX-License-Identifier: GPL-3.0-or-later
"""What each command does. Raises SvoError; warnings go to stderr, one line each."""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import reduce
from importlib import metadata
from pathlib import Path
from typing import Any

from .. import __version__
from ..errors import SceneError, SvoError
from ..render import Session
from ..scene import store
from ..scene.camera import make_view
from ..settings import RenderSettings, with_text

_PICTURE_ENDINGS = (".png", ".exr")


def render(args: argparse.Namespace) -> None:
    """Render args.file to args.out."""
    render_kind = {".blend": _render_blend, ".npz": _render_npz}[_kind(args.file)]
    pictures = _pictures(args.out, args.file.stem)
    for path in [*pictures, args.stats] if args.stats else pictures:
        _prepare(path)
    started = time.perf_counter()
    stats = render_kind(args, pictures)
    stats |= {"scene": args.file.name, "seconds": time.perf_counter() - started, "versions": _versions()}
    _warn(stats["warnings"])
    _print_render(pictures, stats)
    if args.stats:
        _write(args.stats, json.dumps(stats, indent=2) + "\n")
        _print_rows({f"skipped: {name}": reason for name, reason in stats["skipped"].items()} or {"skipped": "nothing"})


def _render_blend(args: argparse.Namespace, pictures: list[Path]) -> dict[str, Any]:
    return _blender().render(args.file, pictures, args.values, args.size, args.frame)


def _render_npz(args: argparse.Namespace, pictures: list[Path]) -> dict[str, Any]:
    """Through the core alone."""
    if args.frame is not None:
        raise SvoError(f"--frame is for a .blend; '{args.file}' holds one frame")
    scene = store.load(args.file)
    settings = reduce(lambda settings, value: with_text(settings, *value), args.values, RenderSettings())
    if scene.camera is None:
        raise SceneError(f"The scene in '{args.file}' has no camera")
    session = Session()
    try:
        *_, film = session.films(scene, make_view(scene.camera, args.size), settings, interval=math.inf)
    finally:
        session.close()
    for path in pictures:
        film.save(path)
    return {"settings": asdict(settings), "size": film.size, "n_samples": film.n_samples, **film.stats,
            "warnings": (*scene.warnings, *film.stats["limits"])}


def extract(args: argparse.Namespace) -> None:
    """Write the scene of args.file to args.scene."""
    if args.scene.suffix != ".npz":
        raise SvoError(f"Cannot write '{args.scene}': its ending must be .npz")
    _expect_blend(args.file)
    _prepare(args.scene)
    scene = _blender().extract_scene(args.file, args.frame)
    store.save(scene, args.scene)
    _warn(scene.warnings)
    print(args.scene)
    _print_rows({"triangles": scene.n_triangles, "instances": len(scene.instances), "materials": len(scene.materials),
                 "lights": len(scene.lights), "images": len(scene.images)})


def compare(args: argparse.Namespace) -> None:
    """Compare with Cycles into args.out."""
    _expect_blend(args.file)
    found, warnings = _blender().compare(args.file, args.out, args.values, args.samples, args.bounces, args.size,
                                         args.frame)
    _warn(warnings)
    print(found.picture, found.sentence(), sep="\n")


def info(_args: argparse.Namespace) -> None:
    """Show what there is; GpuError after the versions if there is no device."""
    _print_rows(_versions())
    session = Session()
    try:
        _print_rows({f"OpenGL {key}": value for key, value in session.device_info().items()})
    finally:
        session.close()


def _blender() -> Any:
    """`blender/cli.py`. From now on only Python's stdout reaches the user; Blender writes to the file descriptor."""
    if sys.stdout.fileno() == 1:
        sys.stdout.flush()
        sys.stdout = os.fdopen(os.dup(1), "w")
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    from ..blender import cli

    return cli


def _kind(path: Path) -> str:
    """'.blend' or '.npz'; SvoError for a file that is neither, or not there."""
    if path.suffix not in (".blend", ".npz"):
        raise SvoError(f"'{path}' is neither a .blend nor a .npz")
    if not path.is_file():
        raise SvoError(f"There is no file '{path}'")
    return path.suffix


def _expect_blend(path: Path) -> None:
    if _kind(path) != ".blend":
        raise SvoError(f"'{path}' is no .blend")


def _pictures(out: str, name: str) -> list[Path]:
    """The files to write: `out` itself, or one of each kind in the folder `out`."""
    path = Path(out)
    if path.is_dir() or not path.suffix or out.endswith(("/", os.sep)):
        return [path / f"{name}{ending}" for ending in _PICTURE_ENDINGS]
    if path.suffix not in _PICTURE_ENDINGS:
        endings = " or ".join(_PICTURE_ENDINGS)
        raise SvoError(f"Cannot write '{out}': its ending must be {endings}, or / for a folder")
    return [path]


def _prepare(path: Path) -> None:
    """Make the folders above `path` and see that it can be written, before anything takes long; SvoError if not."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        is_new = not path.exists()
        with path.open("ab"):
            pass
        if is_new:
            path.unlink()
    except OSError as error:
        raise SvoError(f"Cannot write '{path}': {error.strerror or error}") from error


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise SvoError(f"Cannot write '{path}': {error.strerror or error}") from error


def _versions() -> dict[str, str]:
    """Of all that a picture depends on; '-' for what is not installed."""
    versions = {"svo_engine": __version__, "python": platform.python_version()}
    for package in ("numpy", "moderngl", "bpy"):
        try:
            versions[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            versions[package] = "-"
    return versions


def _warn(sentences: Sequence[str]) -> None:
    for sentence in sentences:
        print(f"svo_engine: warning: {sentence}", file=sys.stderr)


def _print_render(pictures: list[Path], stats: dict[str, Any]) -> None:
    print(*pictures, sep="\n")
    times = {stage: f"{ms:10.1f} ms" for stage, ms in stats["times_ms"].items()}
    sizes = {name.replace("bytes", "size"): f"{n / 2**20:10.1f} MiB" for name, n in stats["counts"].items()
             if name.endswith(" bytes")}
    _print_rows({"device": stats["device"], **times, "all": f"{stats['seconds'] * 1000:10.1f} ms", **sizes})


def _print_rows(rows: Mapping[str, object]) -> None:
    width = max(map(len, rows))
    for name, value in rows.items():
        print(f"  {name:{width}}  {value}")
