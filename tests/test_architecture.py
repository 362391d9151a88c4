# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules of the house hold in this tree, and each of them catches a breach."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from svo_engine.scene import layouts
from tools.house import glslang, layers, references, shaders, text

SPDX = text.SPDX


@pytest.mark.parametrize("rule", [layers, shaders, text, references], ids=lambda rule: rule.__name__.rpartition(".")[2])
def test_the_tree_keeps_the_rules(rule, root):
    assert rule.breaches(root) == []


@pytest.mark.skipif(not glslang.is_here(), reason=glslang.MISSING)
@pytest.mark.parametrize(("path", "text", "sentence"), [
    ("a/x.comp.glsl", '#include "lib/y.glsl"\nvoid main() { int i = none; }\n', "shaders/a/x.comp.glsl:2: 'none'"),
    ("lib/y.glsl", "const bool IS_ON = false;\n\nfloat y = 1.0 +;\n", "shaders/lib/y.glsl:3: '' :  syntax error"),
    ("lib/y.glsl", "const bool IS_ON = false;\nfloat y[IS_ON ? 0 : 1];\n", "shaders/lib/y.glsl:2: "),
    ("a/z.frag.glsl", "in vec2 c;\nout vec4 d;\nvoid main() { d = c.xyxy; }\n", "shaders/a/z.vert.glsl: ERROR: "),
])
def test_what_other_compilers_would_not_take_is_caught_at_its_line(tmp_path, path, text, sentence):
    files = {"a/x.comp.glsl": '#include "lib/y.glsl"\nvoid main() { }\n', "lib/y.glsl": "const bool IS_ON = false;\n",
             "a/z.vert.glsl": "out vec3 c;\nvoid main() { c = vec3(0.0); }\n",
             "a/z.frag.glsl": "in vec3 c;\nout vec4 d;\nvoid main() { d = c.xyzz; }\n"}
    for name, content in {**files, path: text}.items():
        (tmp_path / "shaders" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "shaders" / name).write_text(content)
    found = glslang.breaches(tmp_path)
    assert found and found[0].startswith(sentence), found
    for name, content in files.items():
        (tmp_path / "shaders" / name).write_text(content)
    assert glslang.breaches(tmp_path) == []


@pytest.mark.skipif(not glslang.is_here(), reason=glslang.MISSING)
def test_other_compilers_take_all_programs(root):
    assert glslang.breaches(root) == []
    assert ["raster/visibility.vert.glsl", "raster/visibility.frag.glsl"] in glslang.programs(root / "shaders")


def test_layouts_of_shaders_are_those_of_the_host(root):
    assert shaders.layout_breaches(layouts.glsl(), (root / "shaders/lib/layouts.glsl").read_text()) == []


def test_core_imports_without_blender_and_without_file_formats():
    absent = ("bpy", "mathutils", "PIL", "OpenEXR")
    code = f"""
import importlib, pkgutil, sys
for name in {absent}:
    sys.modules[name] = None  # makes every import of it fail
import svo_engine
for module in pkgutil.walk_packages(svo_engine.__path__, "svo_engine."):
    if not module.name.startswith("svo_engine.blender") and module.name != "svo_engine.__main__":
        importlib.import_module(module.name)
"""
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(layers.__file__).parents[2])


@pytest.mark.parametrize(("module", "source", "blamed"), [
    ("scene.types", "import bpy", "bpy"),
    ("scene.types", "from ..gpu import device", "gpu.device"),
    ("scene.types", "def f():\n    from ..render import Session", "render.Session"),
    ("gpu.device", "from ..scene.types import Scene", "scene.types.Scene"),
    ("gpu.device", "from .. import settings", "settings"),
    ("passes.light", "import glcontext.egl", "glcontext"),
    ("passes.light", "from ..render import render", "render.render"),
    ("render", "import bpy", "bpy"),
    ("blender.engine", "import glcontext", "glcontext"),
    ("blender.engine", "from ..passes.light import light", "passes.light.light"),
    ("blender.engine", "if True:\n    from .. import passes", "passes"),
    ("film", "import OpenEXR", "outside a function"),
    ("film", "def f():\n    import imageio", "imageio"),
    ("settings", "from svo_engine.errors import SvoError", "full name"),
    ("scene.types", "from ...tools import package", "tools"),
    ("new_part", "", "no layer"),
])
def test_forbidden_import_is_caught(module, source, blamed):
    (_, sentence), = layers.of_module(module, is_package=False, source=source)
    assert blamed in sentence


@pytest.mark.parametrize(("module", "source"), [
    ("scene.types", "import json\nimport numpy as np\nfrom . import units\nfrom ..errors import SceneError"),
    ("film", "def f():\n    import OpenEXR"),
    ("gpu.device", "import glcontext\nfrom .scope import GpuScope"),
    ("passes.light", "from ..gpu.device import Device\nfrom .voxelize import Voxels"),
    ("render", "from .passes import light, voxelize\nfrom .gpu import device"),
    ("blender.engine", "import bpy\nfrom ..render import Session\nfrom .. import __version__, film"),
])
def test_permitted_import_passes(module, source):
    assert list(layers.of_module(module, is_package=False, source=source)) == []


def test_relative_imports_start_at_the_package_itself():
    found = layers.of_module("gpu", is_package=True, source="from .scope import GpuScope\nfrom ..film import Film")
    assert [line for line, _ in found] == [2]


def test_entry_of_the_extension_imports_in_functions_only():
    assert list(layers.of_entry("def register():\n    from .svo_engine import blender")) == []
    assert [line for line, _ in layers.of_entry("import os\nfrom .svo_engine import blender")] == [1, 2]


HEADER = f"// {SPDX}\n// Purpose:    a thing\n// In:         x\n// Out:        y\n// Invocation: one pixel\n"


@pytest.mark.parametrize(("source", "is_entry", "n_faults"), [
    (HEADER, True, 0),
    (HEADER.replace("// In:         x\n", ""), True, 1),
    (HEADER.replace("// Out:        y", "// Out:"), True, 1),
    (HEADER.replace(SPDX, "MIT"), True, 1),
    ("#version 430\n" + HEADER, True, 1),
    (f"// {SPDX}\n\n" + HEADER.partition("\n")[2], True, 5),
    (f"// {SPDX}\n// Purpose: a thing\n", False, 0),
    (f"// {SPDX}\nfloat one() {{ return 1.0; }}\n", False, 1),
    ("", False, 2),
])
def test_header_of_a_shader(source, is_entry, n_faults):
    assert len(list(shaders.of_shader(source, is_entry))) == n_faults


@pytest.mark.parametrize("lacking", ["svo_engine/passes/light.py", "shaders/light/inject.comp.glsl",
                                     "tests/passes/test_light.py"])
def test_stage_without_module_folder_or_test_is_caught(tmp_path, lacking):
    for name in ("svo_engine/passes/light.py", "shaders/light/inject.comp.glsl", "tests/passes/test_light.py",
                 "shaders/lib/math.glsl", "svo_engine/passes/__init__.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert shaders.stage_breaches(tmp_path) == []
    (tmp_path / lacking).unlink()
    assert any("light" in sentence for sentence in shaders.stage_breaches(tmp_path))


def test_changed_layout_is_caught_at_its_line():
    generated = layouts.glsl()
    lines = generated.splitlines()
    lines[10] += " "
    (sentence,) = shaders.layout_breaches(generated, "\n".join(lines) + "\n")
    assert sentence.startswith("shaders/lib/layouts.glsl:11:")


@pytest.mark.parametrize(("name", "line"), [
    ("a.py", "pi = '\u03c0'"),
    ("a.comp.glsl", "// \u03c0"),
    ("README.md", "see /" + "tmp/picture.png"),
    ("Makefile", "cd /" + "root/x"),
    ("dev.txt", "--index-url https://pypi." + "org/simple"),
])
def test_foreign_text_is_caught(name, line):
    (found,) = text.of_text(name, f"# {SPDX}\n{line}\n")
    assert found[0] == 2


def test_text_without_faults_passes():
    assert list(text.of_text("a.py", f"# {SPDX}\nhalf = area/work/2  # /usr/bin/env\n")) == []
    assert list(text.of_text("a.md", "caf\u00e9 https://www.gnu.org/licenses/\n")) == []
    assert list(text.of_text("__init__.py", "")) == []


def test_source_without_licence_line_is_caught():
    assert [line for line, _ in text.of_text("a.py", '"""Docstring first."""\n')] == [1]


def test_unresolved_and_uncited_keys_are_caught(tmp_path):
    (tmp_path / "docs").mkdir()
    known, missing, forgotten = (f"[{name}]" for name in ("Known01", "Missing02", "Forgotten03"))
    (tmp_path / "docs/references.md").write_text(f"- **{known}** A paper.\n- **{forgotten}** Another.\n")
    (tmp_path / "a.py").write_text(f"# as in {known}\n# and in {missing}\n")
    unresolved, uncited = references.breaches(tmp_path)
    assert unresolved.startswith("a.py:2:")
    assert forgotten in uncited
