# SPDX-License-Identifier: GPL-3.0-or-later
"""GLSL from files: includes, constants set by the host, and the true file and line in every compiler message.

    #include "lib/math.glsl"      pasted once, however often it is named; paths start at shaders/
    const int N_LIGHTS = 0;       a constant at the top of a file, replaced when the host gives a value of that name
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..errors import ShaderError

SHADER_DIR = Path(__file__).resolve().parents[2] / "shaders"

_INCLUDE = re.compile(r'^\s*#include\s+"([^"]+)"\s*$')
_CONSTANT = re.compile(r"^const (bool|int|uint|float) (\w+) = [^;]+;")
_LOCAL_SIZE = re.compile(r"local_size_([xyz])\s*=\s*(\d+)")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_BLOCK = re.compile(r"\bbuffer\s+(\w+)\s*\{")
_UNIFORM = re.compile(r"\buniform\s+(?:(?:readonly|writeonly|coherent|restrict|highp)\s+)*(\w+)\s+([^;{]+);")
_DECLARED = re.compile(r"(\w+)\s*(?:\[[^]]*\]\s*)*(?:,|$)")
# Mesa: "0:12(5): error: ..."; NVIDIA: "0(12) : error C1234: ..."; AMD and Intel on Windows: "ERROR: 0:12: ..."
_MESSAGE = re.compile(r"^(?:ERROR: )?\d+[:(](\d+)(?:\(\d+\))?\)?\s*:?\s*(.*)$", re.MULTILINE)


@dataclass(frozen=True)
class Names:
    """What shaders declare, in the order of declaration: a call gives a value for each of these names.

    buffers   storage blocks
    textures  uniforms that are sampled; images are read and written
    uniforms  all others, with their types
    """

    buffers: tuple[str, ...]
    textures: tuple[str, ...]
    images: tuple[str, ...]
    uniforms: Mapping[str, str]


@dataclass(frozen=True)
class Source:
    """GLSL ready to compile.

    lines  the (file below shaders/, line number) that each line of `text` came from
    unset  constants that the host gave and no line declares
    """

    path: str
    text: str
    lines: tuple[tuple[str, int], ...]
    unset: frozenset[str]

    @property
    def local_size(self) -> tuple[int, int, int]:
        """The workgroup size that a compute shader declares."""
        found = {axis: int(n) for axis, n in _LOCAL_SIZE.findall(self.text)}
        return found.get("x", 1), found.get("y", 1), found.get("z", 1)

    def explain(self, log: str) -> str:
        """The compiler's messages with the file and line that the author knows: `shaders/x/y.comp.glsl:12: ...`."""

        def located(match: re.Match[str]) -> str:
            path, line = self.lines[min(max(int(match[1]), 1), len(self.lines)) - 1]
            return f"shaders/{path}:{line}: {match[2]}"

        messages = [located(m) for m in _MESSAGE.finditer(log)]
        return "; ".join(dict.fromkeys(messages)) if messages else f"shaders/{self.path}: {' '.join(log.split())}"


def compose(path: str, constants: Mapping[str, bool | int | float] | None = None,
            root: Path = SHADER_DIR, texts: Mapping[str, str] | None = None) -> Source:
    """The shader at `path` below `root` with its includes pasted and `constants` set.

    texts: what stands for the files of those names. ShaderError if a file is missing.
    """
    lines: list[str] = ["#version 430"]
    origin: list[tuple[str, int]] = [(path, 1)]
    unset = dict(constants or {})
    seen: set[str] = set()

    def paste(name: str, asked: str) -> None:
        seen.add(name)
        text = texts.get(name) if texts else None
        if text is None:
            try:
                text = (root / name).read_text(encoding="ascii")
            except OSError:
                raise ShaderError(f"{asked}: there is no shaders/{name}") from None
        for number, line in enumerate(text.splitlines(), 1):
            if include := _INCLUDE.match(line):
                if include[1] not in seen:
                    paste(include[1], f"shaders/{name}:{number}")
                continue
            constant = _CONSTANT.match(line)
            if constant and constant[2] in unset:
                line = f"const {constant[1]} {constant[2]} = {_literal(constant[1], unset.pop(constant[2]))};"
            lines.append(line)
            origin.append((name, number))

    paste(path, f"shaders/{path}")
    return Source(path, "\n".join(lines) + "\n", tuple(origin), frozenset(unset))


def names_of(sources: Iterable[Source]) -> Names:
    """The names that the shaders of one program declare, each once."""
    text = _COMMENT.sub(" ", "\n".join(source.text for source in sources))
    types = {name: type_ for type_, declared in _UNIFORM.findall(text) for name in _DECLARED.findall(declared)}
    textures, images = (tuple(name for name, type_ in types.items() if re.match(f"[iu]?{kind}", type_))
                        for kind in ("sampler", "image"))
    uniforms = {name: type_ for name, type_ in types.items() if name not in (*textures, *images)}
    return Names(tuple(dict.fromkeys(_BLOCK.findall(text))), textures, images, uniforms)


def _literal(kind: str, value: float) -> str:
    if kind == "bool":
        return "true" if value else "false"
    if kind == "float":
        return repr(float(value))
    return f"{int(value)}{'u' if kind == 'uint' else ''}"
