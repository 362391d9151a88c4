# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs: compiled once, many at a time, stopped between any two, and mistakes named by file and line."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.errors import Cancelled, ShaderError
from svo_engine.gpu import programs as module
from svo_engine.gpu.calls import integer
from tests.gpu.written import written

CURRENT_PROGRAM = 0x8B8D
BODY = """layout(std430) buffer Rows {{ uint rows[]; }};
const uint ADDED = {0}u;
void main()
{{
    if (u_first + gl_GlobalInvocationID.x < u_end)
        rows[u_first + gl_GlobalInvocationID.x] += ADDED;
}}
"""


@pytest.fixture
def write(device, tmp_path):
    with written(device, tmp_path) as write:
        yield write


@pytest.fixture
def three(write):
    """Three variants that are compiled nowhere yet."""
    return [(write(f"x{i}", BODY.format(i)), {}) for i in range(3)]


@pytest.fixture
def begun(device, monkeypatch):
    """Names of the shaders that the compiler began with."""
    begun, start = [], device.programs._compiler.start

    def starting(sources):
        begun.append(sources[0].path)
        return start(sources)

    monkeypatch.setattr(device.programs._compiler, "start", starting)
    return begun


def n_compiled(device) -> int:
    return device.profiler.counts["programs compiled"]


def test_what_is_prepared_is_not_compiled_again(device, three, begun):
    device.profiler.reset()
    device.prepare(three)
    assert n_compiled(device) == 3 and device.profiler.times_ms()["compile"] > 0
    device.prepare(three)
    with device.scope() as scope:
        rows = scope.buffer("rows", np.zeros(100, "u4"))
        for pass_, constants in (*three, *three):
            device.dispatch(pass_, 100, constants, Rows=rows)
        assert (np.frombuffer(rows.read(), "u4") == 6).all()
    assert n_compiled(device) == 3 == len(begun)


def test_each_value_of_a_constant_is_a_program(device, write):
    pass_ = write("x", BODY.format(0))
    device.profiler.reset()
    with device.scope() as scope:
        rows = scope.buffer("rows", np.zeros(4, "u4"))
        for added in (1, 10, 1):
            device.dispatch(pass_, 4, {"ADDED": added}, Rows=rows)
        assert (np.frombuffer(rows.read(), "u4") == 12).all()
    assert n_compiled(device) == 2


def test_a_stop_is_heard_between_programs(device, three, begun):
    """What was compiled until then stays."""
    device.profiler.reset()
    turns = device.programs.prepare(three)
    next(turns), next(turns)
    turns.close()
    assert begun == ["x0.comp.glsl"]
    device.stop.set()
    with pytest.raises(Cancelled):
        device.prepare(three)
    assert len(begun) == 1
    device.stop.clear()
    device.prepare(three)
    assert len(begun) == 3 == n_compiled(device)


def test_a_stop_is_heard_while_the_driver_compiles(device, three, begun, monkeypatch):
    """Here it never ends; what was begun is gone on with."""
    monkeypatch.setattr(module, "POLL_SECONDS", 0)
    compiler = device.programs._compiler
    is_done, n_looks = compiler.is_done, []

    def never(job):
        n_looks.append(job)
        if len(n_looks) == 50:
            device.stop.set()
        return False

    monkeypatch.setattr(compiler, "is_done", never)
    with pytest.raises(Cancelled):
        device.prepare(three)
    assert len(begun) == 3 and device.programs.status == ""
    device.stop.clear()
    monkeypatch.setattr(compiler, "is_done", is_done)
    device.prepare(three)
    assert len(begun) == 3


@pytest.mark.parametrize("is_parallel", [True, False])
def test_the_status_counts_programs(device, three, monkeypatch, is_parallel):
    monkeypatch.setattr(device.programs._compiler, "is_parallel", is_parallel)
    told = [device.programs.status for _ in device.programs.prepare(three)]
    assert {"Compiling shaders, 1 of 3"} <= set(told) <= {f"Compiling shaders, {i} of 3" for i in (1, 2, 3)}
    assert told == sorted(told) and device.programs.status == ""
    if not is_parallel:
        assert told == [f"Compiling shaders, {i} of 3" for i in (1, 2, 3)]


@pytest.mark.parametrize("is_parallel", [True, False])
def test_a_mistake_among_many_names_its_file_and_line(device, write, three, monkeypatch, is_parallel):
    monkeypatch.setattr(device.programs._compiler, "is_parallel", is_parallel)
    wrong = write("wrong", "void main()\n{\n    undeclared = 1;\n}\n")
    device.profiler.reset()
    for _ in range(2):  # it is not taken for compiled the second time
        with pytest.raises(ShaderError, match=r"^shaders/wrong\.comp\.glsl:6: .*undeclared"):
            device.prepare([three[0], (wrong, {}), *three[1:]])
    device.prepare(three)
    assert n_compiled(device) == 3


def test_what_is_not_read_is_not_bound_and_what_changes_is(device, write):
    """Buffers, uniforms and textures take turns; a new texture made in between is in nobody's place."""
    pass_ = write("sum", "layout(std430) buffer Rows { uint rows[]; };\n"
                  "layout(std430) buffer Unread { uint unread[]; };\nuniform usamplerBuffer u_texels;\n"
                  "uniform sampler3D u_unread;\nuniform uvec2 u_pair;\nuniform mat3 u_m;\n"
                  "void main() { rows[0] = texelFetch(u_texels, 0).y + u_pair.y + uint(u_m[1][0]); }\n")
    with device.scope() as scope:
        first, second = (scope.buffer(name, 16, clear=True) for name in "ab")
        texels = [scope.texels(name, np.full(4, n, "u4")) for name, n in (("c", 100), ("d", 200))]
        m = np.zeros((3, 3))
        for rows, source, pair in ((first, 0, 1), (second, 0, 1), (first, 1, 1), (first, 1, 2), (second, 0, 3)):
            scope.cube("clears what it can", 8)
            m[0, 1] += 1000  # row 0, column 1
            device.dispatch(pass_, 1, Rows=rows, Unread=None, u_texels=texels[source], u_unread=None, u_pair=(7, pair),
                            u_m=m)
            assert int(np.frombuffer(rows.read(4), "u4")[0]) == 100 * (source + 1) + pair + int(m[0, 1])
    assert integer(device.calls, CURRENT_PROGRAM)


@pytest.mark.parametrize(("type_", "value", "expression", "result"), [
    ("float", 2.5, "uint(u_x * 2.0)", 5), ("int", -3, "uint(-u_x)", 3), ("uint", 0xFFFFFFFF, "u_x", 0xFFFFFFFF),
    ("bool", True, "u_x ? 1u : 0u", 1), ("bool", np.bool_(False), "u_x ? 1u : 2u", 2),
    ("vec3", (1.0, 2.0, 3.5), "uint(u_x.z * 2.0)", 7), ("ivec2", (1, -2), "uint(-u_x.y)", 2),
    ("vec3", np.array([1, 2, 4]), "uint(u_x.z)", 4), ("uvec4", (1, 2, 3, 4), "u_x.w", 4),
    ("mat4", np.arange(16.0).reshape(4, 4), "uint(u_x[3][1])", 7), ("uint", np.int64(9), "u_x", 9)])
def test_uniforms_of_every_type_arrive(device, write, type_, value, expression, result):
    pass_ = write("x", f"layout(std430) buffer Out {{ uint o[]; }};\nuniform {type_} u_x;\n"
                  f"void main() {{ o[0] = {expression}; }}\n")
    with device.scope() as scope:
        out = scope.buffer("out", 16, clear=True)
        device.dispatch(pass_, 1, Out=out, u_x=value)
        assert int(np.frombuffer(out.read(4), "u4")[0]) == result
