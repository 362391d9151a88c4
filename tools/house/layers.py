# SPDX-License-Identifier: GPL-3.0-or-later
"""Who may import whom: the table of docs/architecture.md, held against the syntax tree of every module."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from . import tree

PACKAGE = "svo_engine"
DATA = ("errors", "scene", "settings", "film", "metrics")
BLENDER = ("bpy", "bmesh", "bpy_extras", "bl_ui", "mathutils", "gpu", "gpu_extras", "addon_utils")


@dataclass(frozen=True)
class Layer:
    """What a part of the package may import: modules of `ours` (with all below them), and packages of `others`.

    deferred  may be imported inside functions only, so that it can be missing
    """

    ours: tuple[str, ...] = ()
    others: tuple[str, ...] = ()
    deferred: tuple[str, ...] = ()


LAYERS = {
    "": Layer(),
    "errors": Layer(),
    "scene": Layer(DATA, ("numpy",)),
    "settings": Layer(DATA, ("numpy",)),
    "metrics": Layer(DATA, ("numpy",)),
    "nodes": Layer((*DATA, "nodes"), ("numpy",)),
    "needs": Layer((*DATA, "nodes"), ("numpy",)),
    "film": Layer(DATA, ("numpy",), deferred=("PIL", "OpenEXR")),
    "gpu": Layer(("errors", "gpu"), ("numpy", "moderngl", "glcontext")),
    "passes": Layer((*DATA, "nodes", "needs", "gpu", "passes"), ("numpy",)),
    "render": Layer((*DATA, "nodes", "needs", "gpu", "passes"), ("numpy",)),
    "blender": Layer((*DATA, "render", "blender"), ("numpy", *BLENDER)),
    "bench": Layer((*DATA, "gpu", "passes", "render", "bench"), ("numpy",),
                   deferred=("blender", "OpenEXR", "flip_evaluator", "matplotlib", "rich")),
    "cli": Layer((*DATA, "render", "cli"), ("numpy",), deferred=("blender", "bpy", "bench")),
    "__main__": Layer(("cli",)),
}


@dataclass(frozen=True)
class Import:
    """One name that an import statement brings in.

    module  what it comes from: relative to the package for ours ("scene.types", "" for the package itself)
    name    what is taken out of it, "" for all of it
    """

    line: int
    module: str
    name: str
    is_ours: bool
    is_deferred: bool


def breaches(root: Path) -> list[str]:
    """Every import under `root` that the table forbids."""
    found = []
    for path in tree.files(root / PACKAGE, ".py"):
        parts = path.relative_to(root / PACKAGE).with_suffix("").parts
        is_package = parts[-1] == "__init__"
        module = ".".join(parts[:-1] if is_package else parts)
        for line, sentence in of_module(module, is_package, path.read_text()):
            found.append(tree.breach(root, path, line, sentence))
    entry = root / "__init__.py"
    found += [tree.breach(root, entry, line, sentence) for line, sentence in of_entry(entry.read_text())]
    return found


def of_module(module: str, is_package: bool, source: str) -> Iterator[tuple[int, str]]:
    """(line, sentence) of every breach in the source of `module`, named without the package: "scene.types"."""
    layer = LAYERS.get(module.partition(".")[0])
    if layer is None:
        yield 1, f"'{module}' is in no layer: give it one in tools/house/layers.py and docs/architecture.md"
        return
    package = module.split(".") if is_package else module.split(".")[:-1]
    for found in imports([p for p in package if p], source):
        if sentence := _fault(found, layer):
            yield found.line, sentence


def of_entry(source: str) -> Iterator[tuple[int, str]]:
    """Breaches in the extension's own `__init__.py`, which tools import where there is no bpy."""
    for found in imports([], source):
        if not found.is_deferred and found.module != "__future__":
            yield found.line, "the extension's __init__.py may import inside its functions only"


def imports(package: list[str], source: str) -> Iterator[Import]:
    """Every import in `source`, a module inside `package` (the parts of its name below svo_engine)."""
    syntax = ast.parse(source)
    in_functions = {id(inner) for node in ast.walk(syntax) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
                    for inner in ast.walk(node)}
    for node in ast.walk(syntax):
        is_deferred = id(node) in in_functions
        if isinstance(node, ast.Import):
            yield from (Import(node.lineno, alias.name, "", False, is_deferred) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = _absolute(package, node)
            yield from (Import(node.lineno, module, alias.name, node.level > 0, is_deferred) for alias in node.names)


def _absolute(package: list[str], node: ast.ImportFrom) -> str:
    """What `node` imports from, below svo_engine if it is relative; begins with ".." if that lies outside it."""
    named = [node.module] if node.module else []
    n_kept = len(package) - node.level + 1
    if node.level == 0:
        return named[0]
    return ".".join(["..", *named] if n_kept < 0 else [*package[:n_kept], *named])


def _fault(found: Import, layer: Layer) -> str:
    """A sentence if `layer` forbids the import, else ''."""
    top = found.module.partition(".")[0]
    if found.is_ours:
        whole = f"{found.module}.{found.name}".strip(".")
        allowed = layer.ours + (layer.deferred if found.is_deferred else ())
        if _within(found.module, allowed) or _within(whole, allowed) or whole == "__version__":
            return ""
        return f"imports '{whole}'; this layer may import {', '.join(allowed) or 'nothing'} of ours"
    if top == PACKAGE:
        return f"imports '{found.module}' by its full name; inside the package imports are relative"
    if top in sys.stdlib_module_names or top in layer.others or (found.is_deferred and top in layer.deferred):
        return ""
    when = " outside a function" if top in layer.deferred else ""
    packages = ", ".join(("the standard library", *layer.others))
    return f"imports '{top}'{when}; this layer may import {packages}"


def _within(module: str, allowed: tuple[str, ...]) -> bool:
    return any(module == a or module.startswith(a + ".") for a in allowed)
