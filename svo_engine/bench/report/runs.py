# SPDX-License-Identifier: GPL-3.0-or-later
"""One folder of tables: what one machine measured, and in which circumstances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import host, tables


@dataclass(frozen=True)
class Run:
    """name: of its folder. The tables that it does not have are empty."""

    name: str
    circumstances: Mapping[str, Any]
    ladder: list[tables.Rendered]
    edits: list[tables.Edited]
    watched: list[tables.Watched]
    skipping: list[tables.Skipped]
    thesis: list[tables.Timed]
    scaling: list[tables.Scaled]

    def heading(self) -> str:
        """Its title, where the numbers come from, and what whoever measured has noted by hand."""
        found = self.circumstances
        if not found:
            return f"## {self.name}\n"
        versions = ", ".join(f"{name} {version}" for name, version in found["versions"].items())
        return (f"## {self.name}\n\nOpenGL device: {found['device']}. Processor: {found['processor']}, "
                f"{found['cores']} cores. {versions}.\n" + (f"\n{found['note']}\n" if "note" in found else ""))


def read(folder: Path) -> Run:
    """The run in `folder`; SvoError names a file that is none of ours."""
    return Run(folder.name, host.read(folder), tables.read(folder, tables.Rendered),
               tables.read(folder, tables.Edited), tables.read(folder, tables.Watched),
               tables.read(folder, tables.Skipped), tables.read(folder, tables.Timed),
               tables.read(folder, tables.Scaled))
