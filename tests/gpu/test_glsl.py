# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaders from files: includes, constants, and messages that name the file and line which the author knows."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest

from svo_engine.errors import ShaderError
from svo_engine.gpu import glsl
from svo_engine.gpu.device import DrawCall
from svo_engine.gpu.glsl import Source, compose
from svo_engine.gpu.passes import Pass


@pytest.fixture
def write(tmp_path):
    """write(path, text): a file below a shader folder of the test's own; its return value is that folder."""

    def write(path: str, text: str) -> Path:
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return tmp_path

    return write


def test_an_include_is_pasted_where_it_is_named_and_only_once(write):
    write("lib/a.glsl", "float a;\n")
    write("lib/b.glsl", '#include "lib/a.glsl"\nfloat b;\n')
    root = write("x.comp.glsl", 'first\n#include "lib/b.glsl"\n  #include "lib/a.glsl"\nlast\n')
    source = compose("x.comp.glsl", root=root)
    assert source.text == "#version 430\nfirst\nfloat a;\nfloat b;\nlast\n"
    assert source.lines[1:] == (("x.comp.glsl", 1), ("lib/a.glsl", 1), ("lib/b.glsl", 2), ("x.comp.glsl", 4))


def test_files_that_include_each_other_end(write):
    write("a.glsl", '#include "b.glsl"\nA\n')
    root = write("b.glsl", '#include "a.glsl"\nB\n')
    assert compose("a.glsl", root=root).text == "#version 430\nB\nA\n"


def test_a_missing_include_names_who_asks_for_it(write):
    root = write("x.comp.glsl", '\n#include "lib/none.glsl"\n')
    with pytest.raises(ShaderError, match=r"^shaders/x\.comp\.glsl:2: there is no shaders/lib/none\.glsl$"):
        compose("x.comp.glsl", root=root)


def test_a_missing_entry_is_named(tmp_path):
    with pytest.raises(ShaderError, match=r"there is no shaders/none\.comp\.glsl"):
        compose("none.comp.glsl", root=tmp_path)


@pytest.mark.parametrize(("declared", "value", "line"), [
    ("const int N = 0;", 7, "const int N = 7;"),
    ("const int N = 0;  // how many", True, "const int N = 1;"),
    ("const uint N = 1u;", 7, "const uint N = 7u;"),
    ("const bool N = false;", 1, "const bool N = true;"),
    ("const float N = 0.5;", 2, "const float N = 2.0;"),
    ("const float N = 0.5;", 1e-9, "const float N = 1e-09;"),
])
def test_a_constant_is_set_in_its_own_type(write, declared, value, line):
    root = write("x.comp.glsl", declared + "\n")
    source = compose("x.comp.glsl", {"N": value}, root)
    assert source.text.splitlines()[1] == line
    assert source.unset == frozenset()


def test_constants_that_are_not_given_keep_their_default_and_unknown_ones_are_told(write):
    root = write("x.comp.glsl", "const int N = 3;\n    const int LOCAL = 4;\n")
    source = compose("x.comp.glsl", {"M": 1, "LOCAL": 2}, root)
    assert "const int N = 3;" in source.text
    assert source.unset == {"M", "LOCAL"}  # only a line that begins with const is the host's to set


def test_the_workgroup_size_is_what_the_shader_declares(write):
    root = write("x.comp.glsl", "layout(local_size_x = 8, local_size_y=4) in;\n")
    assert compose("x.comp.glsl", root=root).local_size == (8, 4, 1)


DECLARED = """
// uniform int u_not;  buffer Not { };
layout(std430) readonly buffer Rows { vec4 rows[]; };  /* buffer
Neither { } */
layout(std430) buffer Sums {
    uint sums[];
};
layout(rgba32f) uniform writeonly image2DArray u_film;
layout(r32ui) uniform uimage2D u_done;
uniform usamplerBuffer u_nodes;
uniform sampler2D u_near, u_far;
uniform uint u_first;
uniform uint u_end;
uniform mat3 u_rays[2];
uniform bool u_is_on;   // uniform float u_neither;
float not_a_uniform(float buffer_like) { return buffer_like; }
"""


def test_names_are_read_from_the_text_in_the_order_of_declaration(write):
    write("lib/more.glsl", "uniform float u_more;\n")
    root = write("x.comp.glsl", DECLARED + '#include "lib/more.glsl"\n')
    assert glsl.names_of([compose("x.comp.glsl", root=root)]) == glsl.Names(
        ("Rows", "Sums"), ("u_nodes", "u_near", "u_far"), ("u_film", "u_done"),
        {"u_first": "uint", "u_end": "uint", "u_rays": "mat3", "u_is_on": "bool", "u_more": "float"})


def test_names_that_both_shaders_of_a_program_declare_count_once(write):
    write("x.vert.glsl", "buffer Rows { int rows[]; };\nuniform int u_a;\n")
    root = write("x.frag.glsl", "uniform int u_b;\nbuffer Rows { int rows[]; };\nuniform int u_a;\n")
    sources = [compose(path, root=root) for path in ("x.vert.glsl", "x.frag.glsl")]
    assert glsl.names_of(sources) == glsl.Names(("Rows",), (), (), {"u_a": "int", "u_b": "int"})


LINES = (("light/x.comp.glsl", 1), *(("light/x.comp.glsl", i) for i in range(1, 9)),
         ("lib/a.glsl", 1), ("lib/a.glsl", 2))


@pytest.mark.parametrize(("log", "sentence"), [
    ("0:5(9): error: `x' undeclared\n", "shaders/light/x.comp.glsl:4: error: `x' undeclared"),
    ("0(5) : error C1503: undefined variable 'x'\n",
     "shaders/light/x.comp.glsl:4: error C1503: undefined variable 'x'"),
    ("ERROR: 0:5: error(#143) Undeclared identifier: x\nERROR: error(#273) 1 compilation errors.  No code generated\n",
     "shaders/light/x.comp.glsl:4: error(#143) Undeclared identifier: x"),
    ("ERROR: 0:11: 'x' : undeclared identifier \n", "shaders/lib/a.glsl:2: 'x' : undeclared identifier "),
    ("0:5(1): error: a\n0:11(1): error: b\n0:5(1): error: a\n",
     "shaders/light/x.comp.glsl:4: error: a; shaders/lib/a.glsl:2: error: b"),
    ("error: linking\n  failed", "shaders/light/x.comp.glsl: error: linking failed"),
    ("0:900(1): error: unexpected end", "shaders/lib/a.glsl:2: error: unexpected end"),
], ids=["Mesa", "NVIDIA", "AMD", "Intel", "several", "no line", "past the end"])
def test_messages_of_every_driver_name_the_true_line(log, sentence):
    assert Source("light/x.comp.glsl", "", LINES, frozenset()).explain(log) == sentence


BODY = "layout(local_size_x = 1) in;\nvoid main()\n{\n}\n"


@pytest.fixture
def run_from(device, monkeypatch):
    """run_from(root, constants): compile light/x.comp.glsl below `root` as the device does, and run it."""

    def run_from(root, constants=None):
        monkeypatch.setattr(glsl, "compose", partial(compose, root=root))
        monkeypatch.setattr(device.programs, "_ready", {})
        device.dispatch(Pass("light/x.comp.glsl"), 1, constants)

    return run_from


def test_the_real_compiler_blames_the_line_of_the_entry(write, run_from):
    write("lib/a.glsl", "float a = 1.0;\nfloat b = 2.0;\n")
    root = write("light/x.comp.glsl", '#include "lib/a.glsl"\n' + BODY.replace("{\n", "{\n    a = undeclared;\n"))
    with pytest.raises(ShaderError, match=r"shaders/light/x\.comp\.glsl:5: .*undeclared"):
        run_from(root)


def test_the_real_compiler_blames_the_line_of_the_include(write, run_from):
    write("lib/a.glsl", "float a = 1.0;\nfloat b = 1.0 +;\n")
    root = write("light/x.comp.glsl", '// one\n\n#include "lib/a.glsl"\n' + BODY)
    with pytest.raises(ShaderError, match=r"shaders/lib/a\.glsl:2: .*syntax error"):
        run_from(root)


def test_the_real_compiler_blames_the_fragment_shader(device, write, monkeypatch):
    write("x.vert.glsl", "void main()\n{\n    gl_Position = vec4(0.0);\n}\n")
    root = write("x.frag.glsl", "out vec4 o;\nvoid main()\n{\n    o = undeclared;\n}\n")
    monkeypatch.setattr(glsl, "compose", partial(compose, root=root))
    with device.scope() as scope:
        target = scope.framebuffer("target", scope.texture("color", (4, 4), 4, "f4"))
        with pytest.raises(ShaderError, match=r"shaders/x\.frag\.glsl:4: .*undeclared"):
            device.draw(Pass("x.vert.glsl", "x.frag.glsl"), target, [DrawCall(3)])


def test_a_constant_that_no_line_declares_is_an_error(write, run_from):
    root = write("light/x.comp.glsl", BODY)
    with pytest.raises(ShaderError, match=r"shaders/light/x\.comp\.glsl: no constant named N_LIGHTS"):
        run_from(root, {"N_LIGHTS": 1})
