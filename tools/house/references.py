# SPDX-License-Identifier: GPL-3.0-or-later
"""Papers: every key, a name and two digits in square brackets, is an entry of docs/references.md and the reverse."""

from __future__ import annotations

import re
from pathlib import Path

from . import tree

KEY = re.compile(r"\[([A-Z][A-Za-z]+\d\d)\]")
ENTRY = re.compile(r"^- \*\*\[([A-Z][A-Za-z]+\d\d)\]\*\*", re.MULTILINE)


def breaches(root: Path) -> list[str]:
    """Every key under `root` that resolves to nothing, and every entry that nothing cites."""
    list_path = root / "docs/references.md"
    known = set(ENTRY.findall(list_path.read_text()))
    found, cited = [], set()
    for path in tree.text_files(root):
        if path == list_path or path.suffix == "":
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            keys = set(KEY.findall(line))
            cited |= keys
            found += [tree.breach(root, path, number, f"[{key}] is not in docs/references.md")
                      for key in sorted(keys - known)]
    return found + [f"docs/references.md:1: [{key}] is cited nowhere" for key in sorted(known - cited)]
