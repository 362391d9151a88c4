# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for programs, so that few of them serve all scenes and each is quick to compile.

A program that traces rays holds no material code, and one that holds material code never traces. None has more storage
blocks than graphics cards allow. The host sets no constant but those that svo_engine/passes/variants.py gives a reason
for.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from svo_engine.gpu import glsl

from . import tree
from .shaders import ENTRY_SUFFIXES

TRACE = "bind/trace.glsl"
MATERIALS = ("bind/materials.glsl", "bind/material_rows.glsl", "bind/principled.glsl", "nodes/closures.glsl",
             "nodes/tree.glsl")
NODE_TREE = "nodes/tree.glsl"  # stands for a compiled tree
TEMPLATE = "evaluate/tree.comp.glsl"  # of programs that hold one
MOST_BLOCKS = 16  # storage blocks that NVIDIA's cards have in a shader
VARIANTS = "svo_engine/passes/variants.py"
GENERATED = "lib/layouts.glsl"  # its constants are the host's too, but are never set

_CONSTANT = re.compile(r"^const (?:bool|int|uint|float) (\w+) = ", re.MULTILINE)


def breaches(root: Path) -> list[str]:
    """Every program under `root` that holds too much, and every constant that is set without a reason."""
    found = []
    for path in tree.files(root / "shaders", *ENTRY_SUFFIXES):
        source = glsl.compose(path.relative_to(root / "shaders").as_posix(), root=root / "shaders")
        found += [tree.breach(root, path, 1, sentence) for sentence in of_program(source)]
    if (root / "shaders" / TEMPLATE).exists():
        found += [f"all of shaders/nodes: {sentence}" for sentence in of_program(with_all_nodes(root / "shaders"))]
    return found + variant_breaches(root)


def with_all_nodes(shaders: Path) -> glsl.Source:
    """The program of a node tree that calls all functions of shaders/nodes."""
    names = [path.relative_to(shaders).as_posix() for path in tree.files(shaders / "nodes", ".glsl")]
    includes = "".join(f'#include "{name}"\n' for name in names if name != NODE_TREE)
    text = f"{includes}\nvoid surface(Geo g, inout Closures c)\n{{\n}}\n"
    return glsl.compose(TEMPLATE, root=shaders, texts={NODE_TREE: text})


def of_program(source: glsl.Source) -> Iterator[str]:
    """Sentences on what a composed shader holds that it must not."""
    files = {file for file, _ in source.lines}
    if TRACE in files and (materials := [file for file in MATERIALS if file in files]):
        yield f"traces rays ({TRACE}) and holds material code ({', '.join(materials)}): a program does one of the two"
    if (n := len(glsl.names_of([source]).buffers)) > MOST_BLOCKS:
        yield f"has {n} storage blocks; there may be {MOST_BLOCKS}"


def variant_breaches(root: Path) -> list[str]:
    """Constants that the host sets and does not list, and listed ones that no shader has or that have no reason."""
    settable, listed = constants(root / "shaders"), variants((root / VARIANTS).read_text())
    found = [f"{VARIANTS}:1: '{name}' is no constant of a shader" for name in sorted(listed.keys() - settable)]
    found += [f"{VARIANTS}:1: '{name}' needs a reason" for name, reason in listed.items() if not reason.strip()]
    for path in tree.files(root / "svo_engine", ".py"):
        for line, name in named(path.read_text(), settable - listed.keys()):
            found.append(tree.breach(root, path, line, f"sets the constant '{name}', which {VARIANTS} does not list"))
    return found


def constants(shaders: Path) -> set[str]:
    """Names of all constants that a host could set."""
    return {name for path in tree.files(shaders, ".glsl") if path.relative_to(shaders).as_posix() != GENERATED
            for name in _CONSTANT.findall(path.read_text())}


def variants(source: str) -> dict[str, str]:
    """VARIANTS, read from the text of its module."""
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign) and [ast.unparse(target) for target in node.targets] == ["VARIANTS"]:
            return dict(ast.literal_eval(node.value))
    return {}


def named(source: str, names: set[str]) -> Iterator[tuple[int, str]]:
    """(line, name) of every dict in a module's text that has one of these names as a key: so constants are passed."""
    for node in ast.walk(ast.parse(source)):
        keys = node.keys if isinstance(node, ast.Dict) else ()
        yield from ((key.lineno, key.value) for key in keys if isinstance(key, ast.Constant) and key.value in names)
