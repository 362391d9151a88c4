# SPDX-License-Identifier: GPL-3.0-or-later
"""The circumstances of a measurement: what machine, what versions."""

from __future__ import annotations

import json
import os
import platform
from importlib import metadata
from pathlib import Path
from typing import Any

from .. import __version__
from ..errors import SvoError

FILE = "circumstances.json"


def circumstances(device: str) -> dict[str, Any]:
    """Device, processor and its cores, system, versions of all that numbers depend on."""
    versions = {"svo_engine": __version__, "python": platform.python_version()}
    for package in ("numpy", "moderngl", "bpy"):
        try:
            versions[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    return {"device": device, "processor": processor(), "cores": os.cpu_count(), "system": platform.platform(),
            "versions": versions}


def processor() -> str:
    """The processor's name, as Linux has it, or what Python knows."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.machine())


def write(folder: Path, device: str) -> None:
    """Put the circumstances beside the tables; SvoError if that cannot be done."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / FILE).write_text(json.dumps(circumstances(device), indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise SvoError(f"Cannot write '{folder / FILE}': {error.strerror or error}") from error


def read(folder: Path) -> dict[str, Any]:
    """What `write` wrote; empty without."""
    path = folder / FILE
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
