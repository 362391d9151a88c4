# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `bench`: its arguments, and which part of `bench/` each of them asks for."""

from __future__ import annotations

import argparse
from functools import reduce
from pathlib import Path
from typing import Any

from ..errors import SvoError
from ..settings import RenderSettings, with_text
from .values import assignment, size

_TEXT = """Measure run time against error, and how times grow, into tables (CSV) in a folder; report such folders as
pages. Scenes are .blend files, rendered through Blender beside its other engines, or with --core .npz files, rendered
by the core alone."""


def add(subparsers: Any) -> None:
    """Add the command."""
    command = subparsers.add_parser("bench", help="Measure run time against error, or report what was measured.",
                                    description=_TEXT)
    command.set_defaults(run=bench)
    command.add_argument("--scenes", type=Path, nargs="+", default=[], metavar="FILE", help="scenes to measure")
    command.add_argument("--references", type=Path, nargs="+", default=[], metavar="FILE",
                         help="a .npz or .exr for each scene; without, --core measures no error, and else Cycles makes "
                              "them")
    command.add_argument("--out", type=Path, metavar="DIR", help="folder for the tables")
    for part, text in (("core", "the scenes are .npz; no Blender and no peers"),
                       ("edits", "what edits cost, no ladders: of a .npz by the core, of a .blend through Blender"),
                       ("skipping", "what it saves to leave out what a scene does not need"),
                       ("thesis", "the thesis's tables, on the first scene that is a .npz"),
                       ("scaling", "how time and memory grow")):
        command.add_argument(f"--{part}", action="store_true", help=text)
    command.add_argument("--report", type=Path, metavar="DIR",
                         help="write pages and plots into DIR from the tables in DIR/data/*/")
    command.add_argument("--renderers", nargs="+", metavar="NAME", default=[],
                         help="of rays cones cycles cycles-oidn eevee (default: all; eevee needs --device gpu)")
    command.add_argument("--device", choices=("cpu", "gpu"), default="cpu",
                         help="where Cycles renders (default: %(default)s); ours and EEVEE use the OpenGL device")
    command.add_argument("--samples", type=int, nargs="+", default=[], metavar="N", help="instead of the usual ones")
    command.add_argument("--time-limits", type=float, nargs="+", default=[], metavar="SECONDS",
                         help="of rays, instead of the usual ones")
    command.add_argument("--reference-samples", type=int, default=0, metavar="N",
                         help="of each reference that Cycles makes, in two halves (default: 1024); or, with "
                              "--references, how many those have, so that their noise can be told")
    command.add_argument("--longest", type=float, default=30.0, metavar="SECONDS",
                         help="rungs that would take longer are left out (default: %(default)g)")
    command.add_argument("--size", type=size, metavar="WxH", help="size in pixels (default: the reference's)")
    command.add_argument("--set", dest="values", action="append", default=[], type=assignment, metavar="NAME=VALUE",
                         help="one of our settings, as `render` takes it")


def bench(args: argparse.Namespace) -> None:
    """Do all that is asked for."""
    from ..bench import command

    has_work = args.scenes or args.thesis or args.scaling or args.skipping
    if not has_work and not args.report:
        raise SvoError("There is nothing to do: give --scenes, --thesis, --scaling, --skipping or --report")
    if has_work and not args.out:
        raise SvoError("--out is missing: the folder for the tables")
    is_core = args.core or args.thesis or args.edits
    plan = command.Plan(args.scenes, args.references, args.out,
                        command.chosen_renderers(args.renderers, is_core, args.device) if args.scenes else (),
                        args.samples, args.time_limits, args.size, args.longest, _settings(args.values))
    if args.edits:
        command.run_edits(plan)
    elif args.core:
        command.run_core(plan)
    elif args.scenes and not args.thesis:
        command.run_blender(plan, args.device, args.reference_samples)
    if args.thesis:
        command.run_thesis(plan)
    if args.scaling:
        command.run_scaling(plan)
    if args.skipping:
        command.run_skipping(plan)
    if args.report:
        command.write_report(args.report)


def _settings(texts: list[tuple[str, str]]) -> dict[str, Any]:
    """The values that were given, each of its setting's type."""
    changed = reduce(lambda settings, text: with_text(settings, *text), texts, RenderSettings())
    return {name: getattr(changed, name) for name, _ in texts}
