# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for the text of files: licence line, ASCII, and nothing that holds on one machine only."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from . import tree

SPDX = "SPDX-License-Identifier: GPL-3.0-or-later"
ASCII_SUFFIXES = (".py", ".glsl", ".sh", ".toml", "Makefile")
FOREIGN = re.compile(r"(?<![\w.~])/(?:work|root|tmp|home|Users|var/tmp|mnt|opt)/"
                     r"|\b(?:pypi|pythonhosted|anaconda|debian)\.org\b")


def breaches(root: Path) -> list[str]:
    """Every file of text under `root` that breaks a rule."""
    found = []
    for path in tree.text_files(root):
        found += [tree.breach(root, path, line, sentence) for line, sentence in of_text(path.name, path.read_text())]
    return found


def of_text(name: str, text: str) -> Iterator[tuple[int, str]]:
    """(line, sentence) of every breach in the text of a file called `name`."""
    lines = text.splitlines()
    if name.endswith(".py") and lines and lines[0] != f"# {SPDX}":
        yield 1, f"the first line must be '# {SPDX}'"
    for number, line in enumerate(lines, 1):
        if name.endswith(ASCII_SUFFIXES) and not line.isascii():
            yield number, f"'{next(c for c in line if not c.isascii())}' is not ASCII"
        if match := FOREIGN.search(line):
            yield number, f"'{match[0]}' is of one machine or of one registry"
