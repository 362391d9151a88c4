# SPDX-License-Identifier: GPL-3.0-or-later
"""The arguments of each command."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

from ..settings import PASSES, RenderSettings, specs
from . import bench, commands
from .values import FRAME_LIMITS, assignment, integer, named, size


def make_parser() -> argparse.ArgumentParser:
    """The parser; `run` of what it returns is the command's function."""
    parser = argparse.ArgumentParser("svo_engine", description="Voxel global illumination for Blender.")
    subparsers = parser.add_subparsers(required=True, metavar="COMMAND")
    for add in (_add_render, _add_extract, _add_compare, bench.add, _add_info):
        add(subparsers)
    return parser


def _add_render(subparsers: Any) -> None:
    command = _add(subparsers, commands.render, "Render a scene to a picture.")
    command.add_argument("file", type=Path, metavar="FILE", help="a .blend, or a .npz that extract wrote")
    command.add_argument("--out", default="./", metavar="PATH",
                         help="a .png or .exr, or a folder for both (default: %(default)s)")
    for name, metavar in (("method", "NAME"), ("samples", "N"), ("time_limit", "SECONDS")):
        command.add_argument("--" + name.replace("_", "-"), dest="values", action="append", default=[], metavar=metavar,
                             type=named(name), help=specs()[name].description)
    command.add_argument("--passes", dest="values", action="append", metavar="NAME,...", type=named("passes"),
                         help=f"render passes that the .exr holds too: {', '.join(PASSES)}")
    _add_settings(command)
    command.add_argument("--stats", type=Path, metavar="FILE.json",
                         help="write times, counts and versions there, and say what was skipped and why")


def _add_extract(subparsers: Any) -> None:
    command = _add(subparsers, commands.extract, "Write what a .blend shows to a .npz, which renders without Blender.")
    command.add_argument("file", type=Path, metavar="FILE.blend")
    command.add_argument("scene", type=Path, metavar="SCENE.npz")
    _add_frame(command)


def _add_compare(subparsers: Any) -> None:
    command = _add(subparsers, commands.compare, "Render with SVO and with Cycles at equal settings, and measure.")
    command.add_argument("file", type=Path, metavar="FILE.blend")
    command.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for pictures and numbers")
    command.add_argument("--samples", type=integer(1, 2**24), default=256, metavar="N",
                         help="samples of Cycles (default: %(default)s)")
    command.add_argument("--bounces", type=integer(0, 1024), metavar="N",
                         help="bounces of every kind in Cycles (default: the file's own)")
    _add_settings(command)


def _add_info(subparsers: Any) -> None:
    _add(subparsers, commands.info, "Show the versions and the OpenGL device.")


def _add(subparsers: Any, run: Callable[[argparse.Namespace], None], text: str) -> argparse.ArgumentParser:
    command: argparse.ArgumentParser = subparsers.add_parser(run.__name__, help=text, description=text)
    command.set_defaults(run=run)
    return command


def _add_settings(command: argparse.ArgumentParser) -> None:
    command.add_argument("--set", dest="values", action="append", default=[], type=assignment, metavar="NAME=VALUE",
                         help="one of the settings below; may be given several times")
    command.add_argument("--size", type=size, metavar="WxH", help="size in pixels (default: the scene's own)")
    _add_frame(command)
    command.epilog = "settings:\n" + "\n".join(
        f"  {f'{f.name}={f.default:g}' if isinstance(f.default, float) else f'{f.name}={f.default}':26}"
        f"{specs()[f.name].description}" for f in fields(RenderSettings) if f.name in specs())
    command.formatter_class = argparse.RawDescriptionHelpFormatter


def _add_frame(command: argparse.ArgumentParser) -> None:
    command.add_argument("--frame", type=integer(*FRAME_LIMITS), metavar="N",
                         help="frame of a .blend (default: the one it was saved at)")
