# SPDX-License-Identifier: GPL-3.0-or-later
"""Expressions as GLSL. Values stand in a buffer, so that the text depends on the structure alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .closures import Weighted
from .expr import Call, Constant, Expr, Field, Heights, Literal, Meant, Named, Table, children
from .signatures import library

_READ = {"float": "value_at(g, {})", "vec3": "value3_at(g, {})", "uint": "index_at(g, {})",
         "int": "int(value_at(g, {}))", "bool": "(value_at(g, {}) != 0.0)"}

_HEIGHTS = """vec3 heights_{k}(Geo g)
{{
    vec3 h = vec3(0.0);
    for (int i = 0, n = u_footprint.y < 0.0 ? 1 : 3; i < n; i++) {{
        Geo at = g;
        if (i > 0)
            at = shifted(g, i - 1, {width});
        h[i] = height_{k}(at);
    }}
    return h;
}}
"""


@dataclass(frozen=True, eq=False)
class Datum:
    """A place among the values of a material: what belongs there."""

    first: int
    expr: Constant | Named | Table

    def words(self, index: Any) -> np.ndarray:
        """u4. index(what, name): the number of an image or an attribute."""
        if isinstance(self.expr, Named):
            return np.array([index(self.expr.what, self.expr.name)], "u4")
        numbers = self.expr.numbers if isinstance(self.expr, Table) else self.expr.value
        if self.expr.type == "uint" and isinstance(self.expr, Constant):
            return np.array(numbers, "u4")
        with np.errstate(over="ignore"):
            return np.array(numbers, "f4").view("u4")


class Writer:
    """Collects the text of one tree, and its values."""

    def __init__(self) -> None:
        self.data: list[Datum] = []
        self.n_values = 0
        self._files: dict[str, None] = {}
        self._functions: list[str] = []
        self._placed: dict[int, int] = {}  # of a datum, by the expression
        self._heights_of: dict[int, str] = {}

    def function(self, head: str, roots: Sequence[Expr], end: Any, begin: Sequence[str] = ()) -> None:
        """Add a function whose last lines are end(codes of the roots, as a function of an expression)."""
        lines, code = self._body(roots)
        text = "\n".join(f"    {line}" for line in [*begin, *lines, *end(code)])
        self._functions.append(f"{head}\n{{\n{text}\n}}\n")

    def displaced_normal(self, normal: Expr, at_rest: bool) -> None:
        """Add what takes the place of the point's normal. at_rest: computed where that lay before vertices moved."""
        self.value("vec3 displaced_normal(Geo g)", normal, ["g = at_rest(g);"] if at_rest else [])

    def closures(self, found: Sequence[Weighted], is_bumped: bool = False, name: str = "surface") -> None:
        """Add a function which fills in the closures of a point. is_bumped: whether there is a displaced normal."""
        begin = []
        if is_bumped:
            begin = ["g.normal = displaced_normal(g);", "c = no_closures(g, c.chance, c.wants_mean);"]
        roots = [expr for w in found for expr in (w.weight, *w.leaf.arguments)]

        def end(code: Any) -> list[str]:
            return [self._closure(w, code) for w in found]

        self.function(f"void {name}(Geo g, inout Closures c)", roots, end, begin)

    def add(self, text: str) -> None:
        """Add a function as it stands."""
        self._functions.append(text)

    def value(self, head: str, expr: Expr, begin: Sequence[str] = ()) -> None:
        """Add a function that returns the expression."""
        self.function(head, [expr], lambda code: [f"return {code(expr)};"], begin)

    def text(self) -> str:
        """All of it, with the files that it calls."""
        includes = "".join(f'#include "{file}"\n' for file in sorted(self._files))
        return includes + "\n" + "\n".join(self._functions)

    def use(self, file: str) -> None:
        """Have the text include a file."""
        self._files[file] = None

    def _closure(self, weighted: Weighted, code: Any) -> str:
        signature = library()[weighted.leaf.name]
        self.use(signature.file)
        given = [*(["g"] if signature.takes_geo else []), *map(code, weighted.leaf.arguments)]
        return f"{signature.name}({', '.join(['c', code(weighted.weight), *given])});"

    def _body(self, roots: Sequence[Expr]) -> tuple[list[str], Any]:
        """Lines that compute what the roots need, each expression once, and a function from one to its code."""
        lines: list[str] = []
        codes: dict[int, str] = {}
        for expr in in_order(roots):
            codes[id(expr)] = self._code(expr, codes, lines)
        return lines, lambda expr: codes[id(expr)]

    def _code(self, expr: Expr, codes: dict[int, str], lines: list[str]) -> str:
        if isinstance(expr, Call):
            self.use(expr.signature.file)
            given = [*(["g"] if expr.signature.takes_geo else []), *(codes[id(a)] for a in expr.arguments)]
            lines.append(f"{expr.type} v{len(lines)} = {expr.signature.name}({', '.join(given)});")
            return f"v{len(lines) - 1}"
        if isinstance(expr, (Field, Meant)):
            return codes[id(expr.of)] + (f".{expr.name}" if isinstance(expr, Field) else "")
        if isinstance(expr, (Literal, Table)):
            return expr.text if isinstance(expr, Literal) else f"{self._place(expr)}u"
        if isinstance(expr, Heights):
            lines.append(f"vec3 v{len(lines)} = {self._heights(expr)}(g);")
            return f"v{len(lines) - 1}"
        assert isinstance(expr, (Constant, Named))
        return _READ[expr.type].format(f"{self._place(expr)}u")

    def _heights(self, expr: Heights) -> str:
        """The name of a function of g that gives the heights. Compilers do not know where its loop ends: they would
        write out three times what feeds the height.
        """
        name = self._heights_of.get(id(expr))
        if name is None:
            k = len(self._heights_of)
            name = self._heights_of[id(expr)] = f"heights_{k}"
            self.value(f"float height_{k}(Geo g)", expr.of)
            self._functions.append(_HEIGHTS.format(k=k, width=repr(expr.width)))
        return name

    def _place(self, expr: Constant | Named | Table) -> int:
        if id(expr) not in self._placed:
            self._placed[id(expr)] = self.n_values
            self.data.append(Datum(self.n_values, expr))
            self.n_values += len(expr.numbers) if isinstance(expr, Table) else \
                len(expr.value) if isinstance(expr, Constant) else 1
        return self._placed[id(expr)]


def in_order(roots: Sequence[Expr]) -> list[Expr]:
    """All expressions that the roots need at the same point, each after its parts."""
    done: dict[int, Expr] = {}
    for root in roots:
        waiting = [root]
        while waiting:
            expr = waiting[-1]
            before = () if isinstance(expr, Heights) else children(expr)
            missing = [part for part in reversed(before) if id(part) not in done]
            if missing:
                waiting += missing
            else:
                done[id(expr)] = expr
                waiting.pop()
    return list(done.values())
