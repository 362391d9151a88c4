# SPDX-License-Identifier: GPL-3.0-or-later
"""Closures of many trees at once, as `trees` has their values."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

import numpy as np

from svo_engine.gpu.glsl import SHADER_DIR
from svo_engine.nodes.compile import compiled_tree
from svo_engine.passes.albedo import albedo
from svo_engine.render import Session
from svo_engine.scene.graph import Graph
from tests.compute import evaluate
from tests.nodes.trees import POINT, SIZE, coordinates_of_points

_COMMENT = re.compile(r"//[^\n]*")
_STRUCT = re.compile(r"^struct (\w+)\s*\{(.*?)\};", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^\s*(\w+) (\w+);", re.MULTILINE)
_HEAD = re.compile(r"^\w+ (\w+)\(", re.MULTILINE)

FINITE = """
bool is_finite(float x)
{
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}
"""


def of_closures(session: Session, trees: Sequence[Graph], uv: np.ndarray, code: str) -> np.ndarray:
    """What the function `vec3 seen(Closures c)` of `code` gives of each tree at texture coordinates (n, SIZE, SIZE, 2):
    (n, SIZE, SIZE, 3) f4. Every other tree is asked for means, without chance."""
    texts, words, lines = [], [np.zeros(1, "u4")], []
    with coordinates_of_points():
        for i, graph in enumerate(trees):
            one = compiled_tree(graph)
            texts.append(_numbered(one.text, i))
            lines += [f"    if (i == {i}u) {{", f"        g.first_value = {sum(map(len, words))}u;",
                      f"        surface_{i}(g, c);", "    }"]
            words += [datum.words(lambda what, name: 0) for datum in one.data]
    text = "\n".join([
        *texts, POINT, code, "vec3 seen_of(uint i, Geo g, float chance)", "{",
        "    Closures c = no_closures(g, chance, (i & 1u) == 0u);", *lines, "    keep_finite(g, c);",
        "    return seen(c);", "}"])
    number = np.repeat(np.arange(len(trees), dtype="u4"), SIZE * SIZE)
    chance = np.random.default_rng(0).random(len(number)).astype("f4")
    made = session.opened().thread.call(lambda device: evaluate(
        device, "vec3", "seen_of(number, point_of(uv), chance)", ("nodes/point.glsl", "nodes/closures.glsl"), text,
        buffers={"Values": np.concatenate(words)}, textures={"u_albedo": albedo(device, True).table}, number=number,
        chance=chance, uv=uv.reshape(-1, 2)))
    return made.reshape(*uv.shape[:-1], 3)


def all_finite() -> str:
    """`seen`: 1 where all numbers of the closures are finite."""
    return f"{FINITE}\nvec3 seen(Closures c)\n{{\n    return vec3({' && '.join(_finite('Closures', 'c'))});\n}}"


def _numbered(text: str, number: int) -> str:
    """GLSL whose own functions have a number behind their names."""
    for name in set(_HEAD.findall(text)):
        text = re.sub(rf"\b{name}\(", f"{name}_{number}(", text)
    return text


def _finite(type_: str, name: str) -> list[str]:
    """Conditions of GLSL that all floats of a variable are finite."""
    if type_ == "float":
        return [f"is_finite({name})"]
    if type_ in ("vec2", "vec3", "vec4"):
        return [f"is_finite({name}.{part})" for part in "xyzw"[:int(type_[-1])]]
    return [condition for of, part in _structs().get(type_, ()) for condition in _finite(of, f"{name}.{part}")]


@cache
def _structs() -> dict[str, list[tuple[str, str]]]:
    """Fields (type, name) of all structs of GLSL."""
    texts = (_COMMENT.sub("", path.read_text(encoding="ascii")) for path in SHADER_DIR.rglob("*.glsl"))
    return {name: _FIELD.findall(body) for text in texts for name, body in _STRUCT.findall(text)}
