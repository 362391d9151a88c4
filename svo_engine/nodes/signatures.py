# SPDX-License-Identifier: GPL-3.0-or-later
"""What functions shaders/nodes has, read from the GLSL, so that they are declared once.

A function that trees call stands at the start of a line, its whole head on that line. The first parameter may be
`Geo g`, which every call is given by itself; those of closures are `inout Closures c, float weight` and then, if they
want it, `Geo g`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

SHADER_DIR = Path(__file__).resolve().parents[2] / "shaders"

_FUNCTION = re.compile(r"^(\w+) (\w+)\(([^;{]*)\)\s*$", re.MULTILINE)
_STRUCT = re.compile(r"^struct (\w+)\s*\{(.*?)\};", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^\s*(\w+) (\w+);", re.MULTILINE)
_COMMENT = re.compile(r"//[^\n]*")


@dataclass(frozen=True)
class Signature:
    """A function of GLSL.

    file       below shaders/
    type       of what it returns
    arguments  types of those that a call gives; names: theirs
    fields     of a struct that is returned: name -> type
    takes_geo  whether `Geo g` comes before them
    """

    name: str
    file: str
    type: str
    arguments: tuple[str, ...]
    names: tuple[str, ...]
    fields: tuple[tuple[str, str], ...]
    takes_geo: bool


@cache
def library() -> dict[str, Signature]:
    """All functions of shaders/nodes by name."""
    found: dict[str, Signature] = {}
    for path in sorted((SHADER_DIR / "nodes").rglob("*.glsl")):
        file = path.relative_to(SHADER_DIR).as_posix()
        for signature in _read(file, path.read_text(encoding="ascii")):
            found.setdefault(signature.name, signature)
    return found


def _read(file: str, text: str) -> list[Signature]:
    text = _COMMENT.sub("", text)
    structs = {name: tuple((n, t) for t, n in _FIELD.findall(body)) for name, body in _STRUCT.findall(text)}
    found = []
    for type_, name, declared in _FUNCTION.findall(text):
        parameters = [p.strip() for p in declared.split(",") if p.strip()]
        if parameters[:2] == ["inout Closures c", "float weight"]:
            parameters = parameters[2:]
        takes_geo = parameters[:1] == ["Geo g"]
        pairs = [p.split()[-2:] for p in parameters[takes_geo:]]
        types, names = tuple(t for t, _ in pairs), tuple(n for _, n in pairs)
        found.append(Signature(name, file, type_, types, names, structs.get(type_, ()), takes_geo))
    return found
