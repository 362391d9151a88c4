# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that belong to the project, and how a breach of a rule is told."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

# Made by tools, none of ours; all other folders that begin with a dot are skipped too
MADE_FOLDERS = {"__pycache__", "out", "dist", "wheels"}
MADE_FILES = {".git"}  # of a second working tree: where the first one is
DOT_FOLDERS = {".ci"}

TEXT_SUFFIXES = {".py", ".glsl", ".md", ".toml", ".txt", ".sh", ".json", ".yml", ""}


def files(root: Path, *suffixes: str) -> Iterator[Path]:
    """Every file of ours under `root` whose name ends in one of `suffixes` (default: all), in a fixed order."""
    for folder, names, file_names in os.walk(root):
        names[:] = sorted(n for n in names if n not in MADE_FOLDERS and (not n.startswith(".") or n in DOT_FOLDERS))
        yield from (Path(folder, name) for name in sorted(file_names)
                   if name not in MADE_FILES and (not suffixes or name.endswith(suffixes)))


def text_files(root: Path) -> Iterator[Path]:
    """Every file of ours that holds text."""
    return (path for path in files(root) if path.suffix in TEXT_SUFFIXES)


def breach(root: Path, path: Path, line: int, sentence: str) -> str:
    """One line that an editor can jump to."""
    return f"{path.relative_to(root).as_posix()}:{line}: {sentence}"
