# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension builds, Blender's own tool accepts it, and Blender installs, enables and disables it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import svo_engine
from tools import package

# What Blender's tool does not check: https://docs.blender.org/manual/en/latest/advanced/extensions/
PLATFORMS = {"linux-x64", "linux-arm64", "macos-x64", "macos-arm64", "windows-x64", "windows-arm64"}
TAGS = {"3D View", "Add Curve", "Add Mesh", "Animation", "Bake", "Camera", "Compositing", "Development",
        "Game Engine", "Geometry Nodes", "Grease Pencil", "Import-Export", "Lighting", "Material", "Mesh",
        "Modeling", "Node", "Object", "Paint", "Physics", "Pipeline", "Render", "Rigging", "Scene", "Sculpt",
        "Sequencer", "System", "Text Editor", "Tracking", "User Interface", "UV"}

@pytest.fixture(scope="module")
def zips(tmp_path_factory) -> list[Path]:
    """The extension's zips, one a platform."""
    try:
        package.fetch_wheels()
    except package.PackageError as error:
        if os.environ.get("SVO_OFFLINE"):
            pytest.skip(f"SVO_OFFLINE is set and wheels are missing: {error}")
        raise
    return package.build(tmp_path_factory.mktemp("dist"))


def test_one_zip_for_each_platform(zips):
    assert [re.search(r"-(\w+)\.zip$", path.name)[1] for path in zips] == ["linux_x64", "windows_x64"]


def test_zip_holds_the_engine_and_its_platforms_wheels(zips):
    for path, tag in zip(zips, ("manylinux", "win_amd64"), strict=True):
        names = zipfile.ZipFile(path).namelist()
        assert package.contents(path) == package.CONTENTS
        assert {"svo_engine/render.py", "svo_engine/blender/engine.py", "shaders/lib/layouts.glsl"} <= set(names)
        assert not [name for name in names if "__pycache__" in name or name.endswith((".pyc", ".blend"))]
        wheels = [name for name in names if name.endswith(".whl")]
        assert len(wheels) == 2 * len(package.PYTHONS)
        assert all(tag in wheel for wheel in wheels)


def test_manifest_says_what_blender_knows(root):
    manifest = package.manifest()
    assert set(manifest["platforms"]) <= PLATFORMS
    assert set(manifest["tags"]) <= TAGS
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"]
    assert "GNU GENERAL PUBLIC LICENSE\n                       Version 3" in (root / "LICENSE").read_text()
    assert manifest["version"] == svo_engine.__version__


def test_manifest_lists_a_wheel_for_every_python_and_platform():
    wheels = package.manifest()["wheels"]
    for name in ("moderngl", "glcontext"):
        for python in package.PYTHONS:
            for platform in package.WHEEL_PLATFORMS:
                tag = f"-cp{python.replace('.', '')}-"
                assert len([w for w in wheels if name in w and tag in w and platform in w]) == 1


@pytest.mark.usefixtures("zips")
def test_stray_file_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(package, "CONTENTS", package.CONTENTS - {"shaders"})
    with pytest.raises(package.PackageError, match="no part of the extension: shaders"):
        package.build(tmp_path)


@pytest.mark.usefixtures("zips")
def test_changed_wheel_is_noticed(tmp_path):
    wheel = package.ROOT / package.manifest()["wheels"][0]
    changed = tmp_path / wheel.name
    changed.write_bytes(wheel.read_bytes() + b" ")
    assert package.is_pinned(wheel)
    assert not package.is_pinned(changed)


def test_blender_installs_it_and_renders(zips, tmp_path, root):
    """Ends while the engine is enabled: that must not hang, crash or print a traceback either."""
    zip_of_this_system = zips[1 if sys.platform == "win32" else 0]
    command = [sys.executable, root / "tests/install_extension.py", zip_of_this_system, tmp_path / "picture.png"]
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path / "blender")}
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300, env=environment,
                          cwd=tmp_path)
    said = done.stdout + done.stderr
    assert "INSTALLED" in done.stdout, said
    assert done.returncode == 0, said
    assert "Traceback" not in said
