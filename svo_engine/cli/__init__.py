# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: render, extract, compare, info. A .npz needs no Blender; what needs it is in `blender/cli.py`.

Exit code 0: all is done; 1: one line on stderr says why not; 2: the arguments make no sense; 130: interrupted.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from ..errors import SvoError
from .arguments import make_parser

_PACKAGES = {"bpy": "bpy", "PIL": "pillow", "OpenEXR": "OpenEXR"}  # module -> what pip calls it


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit code."""
    args = make_parser().parse_args(argv)
    try:
        args.run(args)
    except SvoError as error:
        return _fail(str(error))
    except ModuleNotFoundError as error:
        if error.name not in _PACKAGES:
            raise
        return _fail(_what_is_missing(error.name))
    except KeyboardInterrupt:
        _fail("interrupted")
        return 130
    return 0


def _fail(sentence: str) -> int:
    print(f"svo_engine: error: {sentence}", file=sys.stderr)
    return 1


def _what_is_missing(module: str) -> str:
    if module == "bpy":
        return "a .blend needs Blender as a Python module (pip install bpy); a .npz that extract wrote does not"
    return f"the module {module} is missing (pip install {_PACKAGES[module]})"
