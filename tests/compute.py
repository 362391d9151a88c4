# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of shaders/lib and shaders/bind, called for every row of arrays, as if they were functions of numpy."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from svo_engine.gpu import glsl
from svo_engine.gpu.buffer import Buffer
from svo_engine.gpu.compiler import Compiler
from svo_engine.gpu.device import Device
from svo_engine.gpu.program import Program
from svo_engine.scene import layouts

_VECTORS = {"f": ("float", "vec"), "u": ("uint", "uvec"), "i": ("int", "ivec")}
_FIELDS = {1: ".x", 2: ".xy", 3: ".xyz", 4: ""}
_BASES = {"v": "f4", "f": "f4", "u": "u4", "i": "i4", "b": "u4"}


def evaluate(device: Device, result: str, expression: str, includes: Sequence[str] = (), prelude: str = "",
             buffers: Mapping[str, Any] | None = None, uniforms: Mapping[str, Any] | None = None,
             textures: Mapping[str, Any] | None = None, constants: Mapping[str, bool | int | float] | None = None,
             **inputs: np.ndarray) -> np.ndarray:
    """`expression`, of the GLSL type `result`, for every row: (n, width) or (n,).

    inputs    (n, width) or (n,) f4, u4 or i4, or rows of a dtype of `layouts`: variables of the expression
    buffers   the storage blocks, uniforms, textures and constants that the included files declare, arrays or buffers
    """
    n = len(next(iter(inputs.values())))
    base, width = _BASES[result[0]], int(result[-1]) if result[-1].isdigit() else 1
    source = _source(result, base, expression, includes, prelude, inputs, constants)
    names, compiler = glsl.names_of([source]), Compiler(device.calls)
    program = Program(device.calls, compiler.finish(compiler.start([source])), [source])
    with device.scope() as scope:
        out = scope.buffer("result", 16 * n, clear=True)
        blocks = {**(buffers or {}), **{f"In_{name}": _padded(rows) for name, rows in inputs.items()}, "Result": out}
        made = {name: block if isinstance(block, Buffer) else scope.buffer(name, block)
                for name, block in blocks.items()}
        program.bind(device.bindings, {**dict.fromkeys((*names.buffers, *names.textures)), **made, **(textures or {})})
        program.set({**(uniforms or {}), "u_n": n})
        device.bindings.program(program.glo)
        device.calls["glDispatchCompute"](-(-n // 32), 1, 1)
        device.calls["glMemoryBarrier"](0xFFFFFFFF)
        values = np.frombuffer(out.read(), base).reshape(n, 4)[:, :width].copy()
    program.release()
    return values.ravel() if width == 1 else values


def _source(result: str, base: str, expression: str, includes: Sequence[str], prelude: str,
            inputs: Mapping[str, np.ndarray], constants: Mapping[str, bool | int | float] | None) -> glsl.Source:
    """A compute shader that evaluates `expression` once a row."""
    kind = _VECTORS[base[0]][1]
    declared, read = [], []
    for name, rows in inputs.items():
        type_, stored, fields = _types(rows)
        declared.append(f"layout(std430) readonly buffer In_{name} {{ {stored} in_{name}[]; }};")
        read.append(f"    {type_} {name} = in_{name}[i_row]{fields};")
    widened = {"bool": f"uvec4({expression}, 0, 0, 0)"}.get(result)
    width = int(result[-1]) if result[-1].isdigit() else 1
    widened = widened or f"{kind}4({expression}{', 0' * (4 - width)})"
    lines = [
        *(f'#include "{path}"' for path in includes), prelude, "layout(local_size_x = 32) in;", *declared,
        f"layout(std430) writeonly buffer Result {{ {kind}4 result[]; }};", "uniform uint u_n;", "void main()", "{",
        "    uint i_row = gl_GlobalInvocationID.x;", "    if (i_row >= u_n)", "        return;", *read,
        f"    result[i_row] = {widened};", "}"]
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for shared in ("lib", "bind", "nodes"):
            (root / shared).symlink_to(glsl.SHADER_DIR / shared)
        (root / "test.comp.glsl").write_text("\n".join(lines) + "\n")
        return glsl.compose("test.comp.glsl", constants, root)


def _types(rows: np.ndarray) -> tuple[str, str, str]:
    """GLSL type of one row, type that is stored, and the fields to take of it."""
    if rows.dtype.names:
        struct = next(name for name, fields in layouts.STRUCTS.items() if layouts.dtype(fields) == rows.dtype)
        return struct, struct, ""
    scalar, vector = _VECTORS[rows.dtype.kind]
    width = 1 if rows.ndim == 1 else rows.shape[1]
    return scalar if width == 1 else f"{vector}{width}", f"{vector}4", _FIELDS[width]


def _padded(rows: np.ndarray) -> np.ndarray:
    """Rows of numbers at the width of a vec4."""
    if rows.dtype.names:
        return rows
    padded = np.zeros((len(rows), 4), rows.dtype)
    padded[:, : 1 if rows.ndim == 1 else rows.shape[1]] = rows.reshape(len(rows), -1)
    return padded
