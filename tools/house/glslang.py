# SPDX-License-Identifier: GPL-3.0-or-later
"""The composed programs, read by Khronos's own compiler: what it takes, compilers other than ours will take too."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from svo_engine.gpu import glsl

from . import tree
from .programs import TEMPLATE, with_all_nodes
from .shaders import ENTRY_SUFFIXES

PROGRAM = "glslangValidator"
MISSING = f"{PROGRAM} is not here, so the composed shaders were not checked; as root: apt-get install glslang-tools"

_BOOL = re.compile(r"^const bool (\w+) = (true|false);", re.MULTILINE)


def is_here() -> bool:
    """Whether the compiler is installed."""
    return shutil.which(PROGRAM) is not None


def breaches(root: Path) -> list[str]:
    """What the compiler says of the programs under `root`, with the file and line that the author knows."""
    shaders = root / "shaders"
    found = [sentence for paths in programs(shaders) for sentence in of_program(shaders, paths)]
    if (shaders / TEMPLATE).exists():
        found += [source.explain(log) for source, log in _judged([with_all_nodes(shaders)])]
    return list(dict.fromkeys(found))


def programs(shaders: Path) -> list[list[str]]:
    """The entries below a folder of shaders, those of one program together."""
    entries = [path.relative_to(shaders).as_posix() for path in tree.files(shaders, *ENTRY_SUFFIXES)]
    stems = dict.fromkeys(entry.split(".")[0] for entry in entries)
    return [sorted((entry for entry in entries if entry.split(".")[0] == stem), reverse=True) for stem in stems]


def of_program(shaders: Path, paths: list[str]) -> Iterator[str]:
    """Sentences on one program, with the constants as they stand there, and with those that are yes or no turned round.

    Code that a constant switches off is read as any other, so values of numbers would change nothing.
    """
    defaults = [glsl.compose(path, root=shaders) for path in paths]
    turned = {name: value == "false" for source in defaults for name, value in _BOOL.findall(source.text)}
    for sources in (defaults, [glsl.compose(path, turned, shaders) for path in paths]):
        for source, log in _judged(sources):
            yield source.explain(log)


def _judged(sources: list[glsl.Source]) -> Iterator[tuple[glsl.Source, str]]:
    """The errors in each shader, or else of their link, told of the first."""
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for source in sources:
            files.append(Path(folder, f"program.{source.path.split('.')[-2]}"))
            files[-1].write_text(source.text)
        fine = True
        for source, file in zip(sources, files, strict=True):
            if log := _errors(str(file)):
                fine = False
                yield source, log
        if fine and len(files) > 1 and (log := _errors("-l", *map(str, files))):
            yield sources[0], log


def _errors(*arguments: str) -> str:
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    lines = [line for line in done.stdout.splitlines() if line.startswith("ERROR") and "compilation errors" not in line]
    return "\n".join(lines) if done.returncode else ""
