# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the extension: one zip for each platform, made and validated by Blender's own tool.

The wheels that it ships are fetched into wheels/, pinned by requirements/wheels.txt. Run from anywhere:
`python -m tools.package --out dist`.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
PINS = ROOT / "requirements/wheels.txt"
PYTHONS = ("3.11", "3.13", "3.14")
WHEEL_PLATFORMS = ("manylinux_2_28_x86_64", "win_amd64")

# All that a zip holds at its top; a stray file in the tree must not travel with it
CONTENTS = {"blender_manifest.toml", "__init__.py", "LICENSE", "svo_engine", "shaders", "wheels"}


class PackageError(Exception):
    """The extension cannot be built; one sentence."""


def manifest() -> dict[str, Any]:
    """blender_manifest.toml as it is."""
    return tomllib.loads((ROOT / "blender_manifest.toml").read_text())


def fetch_wheels() -> None:
    """Download the wheels that the manifest lists and wheels/ lacks; PackageError if one cannot be had."""
    wheels = [ROOT / name for name in manifest()["wheels"]]
    if all(is_pinned(wheel) for wheel in wheels):
        return
    for python in PYTHONS:
        for platform in WHEEL_PLATFORMS:
            _run("-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes", "--only-binary=:all:",
                 "--implementation=cp", f"--python-version={python}", f"--platform={platform}",
                 f"--dest={ROOT / 'wheels'}", f"--requirement={PINS}")
    if bad := [wheel.name for wheel in wheels if not is_pinned(wheel)]:
        raise PackageError(f"The manifest lists wheels that {PINS.name} does not pin: {', '.join(bad)}")


def is_pinned(wheel: Path) -> bool:
    """True if the file is there and its content is what requirements/wheels.txt pins."""
    pins = re.findall(r"sha256:(\w+)", PINS.read_text())
    return wheel.is_file() and hashlib.sha256(wheel.read_bytes()).hexdigest() in pins


def blender_tool() -> Path:
    """Blender's command line for extensions inside its Python module; plain Python, so bpy is not imported."""
    spec = importlib.util.find_spec("bpy")
    if spec is None or spec.origin is None:
        raise PackageError("bpy is not installed; its module holds the tool that builds extensions")
    return next(Path(spec.origin).parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))


def build(out: Path) -> list[Path]:
    """Write the zip of each platform to the folder `out`, validated; PackageError if Blender's tool or we refuse it."""
    out.mkdir(parents=True, exist_ok=True)
    data = manifest()
    tool = str(blender_tool())
    _run(tool, "build", f"--source-dir={ROOT}", f"--output-dir={out}", "--split-platforms", "--valid-tags=")
    zips = [out / f"{data['id']}-{data['version']}-{platform.replace('-', '_')}.zip" for platform in data["platforms"]]
    for path in zips:
        _run(tool, "validate", "--valid-tags=", str(path))
        if stray := contents(path) - CONTENTS:
            path.unlink()
            raise PackageError(f"{path.name} holds what is no part of the extension: {', '.join(sorted(stray))}")
    return zips


def contents(path: Path) -> set[str]:
    """The names at the top of a zip."""
    with zipfile.ZipFile(path) as file:
        return {name.partition("/")[0] for name in file.namelist()}


def _run(*arguments: str) -> None:
    """Run Python with `arguments`; PackageError with what it printed if it fails."""
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise PackageError(f"'{' '.join(arguments)}' failed:\n{done.stdout}{done.stderr}")


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Build the extension's zip files")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder for the zip files (default: dist)")
    out = parser.parse_args().out
    try:
        fetch_wheels()
        zips = build(out)
    except PackageError as error:
        print(f"package: {error}", file=sys.stderr)
        return 1
    for path in zips:
        print(f"{path} ({path.stat().st_size / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
