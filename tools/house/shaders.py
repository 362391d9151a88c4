# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules of shaders/README.md: headers, and one module, one folder and one test for each stage."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path

from . import tree
from .text import SPDX

ENTRY_SUFFIXES = (".comp.glsl", ".vert.glsl", ".frag.glsl")
LABELS = ("Purpose:", "In:", "Out:", "Invocation:")

# Folders of shaders/ that are no stage: functions, and declarations of buffers
INCLUDED_FOLDERS = {"lib", "bind", "nodes"}


# Modules of passes/ that are no stage but help several
HELPERS = {"parts", "pixel_filter", "programs", "tracer", "upload", "variants"}


def breaches(root: Path) -> list[str]:
    """Every shader under `root` without its header, and every stage that lacks its module, folder or test."""
    found = []
    for path in tree.files(root / "shaders", ".glsl"):
        is_entry = path.name.endswith(ENTRY_SUFFIXES)
        found += [tree.breach(root, path, 1, sentence) for sentence in of_shader(path.read_text(), is_entry)]
    return found + stage_breaches(root)


def of_shader(source: str, is_entry: bool) -> Iterator[str]:
    """Sentences on what the header of a shader lacks."""
    lines = source.splitlines()
    if not lines or lines[0] != f"// {SPDX}":
        yield f"the first line must be '// {SPDX}'"
    header = _header(lines[1:])
    if not header:
        yield "the second line must begin a comment that says what the file is for"
    for label in LABELS if is_entry else ():
        if not any(line.startswith(label) and line != label for line in header):
            yield f"the header has no line '{label} ...'"


def _header(lines: list[str]) -> list[str]:
    """The text of the comment lines at the start of `lines`, without their slashes."""
    header = []
    for line in lines:
        if not line.startswith("//"):
            break
        header.append(line.removeprefix("//").strip())
    return [line for line in header if line]


def stage_breaches(root: Path) -> list[str]:
    """passes/X.py <-> shaders/X/ <-> tests/passes/test_X.py: a sentence for every X that is not in all three."""
    passes = root / "svo_engine/passes"
    modules = {p.stem for p in passes.glob("*.py")} | {p.parent.name for p in passes.glob("*/__init__.py")}
    modules -= {"__init__", *HELPERS}
    folders = {p.parent.name for p in (root / "shaders").glob("*/*.glsl")} - INCLUDED_FOLDERS
    tests = {p.stem.removeprefix("test_") for p in (root / "tests/passes").glob("test_*.py")}
    return [
        *(f"svo_engine/passes/{x}.py: its stage has no shaders in shaders/{x}/" for x in sorted(modules - folders)),
        *(f"shaders/{x}/: its stage has no svo_engine/passes/{x}.py" for x in sorted(folders - modules)),
        *(f"svo_engine/passes/{x}.py: its stage has no tests/passes/test_{x}.py" for x in sorted(modules - tests)),
    ]


def layout_breaches(generated: str, committed: str) -> list[str]:
    """The first line in which shaders/lib/layouts.glsl differs from what svo_engine/scene/layouts.py makes."""
    if generated == committed:
        return []
    lines = zip_longest(generated.splitlines(), committed.splitlines())
    line = next((n for n, (wanted, there) in enumerate(lines, 1) if wanted != there), 1)
    return [f"shaders/lib/layouts.glsl:{line}: not what layouts.py makes: run `python -m svo_engine.scene.layouts`"]
