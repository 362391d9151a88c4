# SPDX-License-Identifier: GPL-3.0-or-later
"""Expressions: what a tree computes, as a graph of calls. Nothing is compared by value: a node that is used twice is
one expression, and two constants that happen to be equal stay two, so that no edit of a value changes a structure.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from .signatures import Signature, library
from .twins import TWINS, number_type

COLOR, VECTOR = "color", "vector"


@dataclass(frozen=True, eq=False)
class Expr:
    """type: of GLSL. role: what a vec3 means where a number is made of it, COLOR or VECTOR."""

    type: str
    role: str = field(default=COLOR, kw_only=True)

    def __getitem__(self, name: str) -> Expr:
        """A field of a struct."""
        types = dict(self.signature.fields) if isinstance(self, Call) else {}
        return Field(types[name], self, name)


@dataclass(frozen=True, eq=False)
class Constant(Expr):
    """A value of the material: of float one number, of vec3 three, of uint one."""

    value: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Named(Expr):
    """A uint that is known when all materials are: the index of the image or the attribute of that name."""

    what: str
    name: Any


@dataclass(frozen=True, eq=False)
class Table(Expr):
    """A uint: where in the material's values these numbers begin."""

    numbers: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Literal(Expr):
    """Numbers that belong to the structure."""

    value: tuple[float, ...]

    @property
    def text(self) -> str:
        """As GLSL has it."""
        if self.type == "bool":
            return "true" if self.value[0] else "false"
        if self.type in ("int", "uint"):
            return f"{int(self.value[0])}{'u' if self.type == 'uint' else ''}"
        numbers = ", ".join(repr(float(v)) for v in self.value)
        return numbers if len(self.value) == 1 else f"{self.type}({numbers})"


@dataclass(frozen=True, eq=False)
class Call(Expr):
    """signature: the function; arguments: one for each of those that it names."""

    signature: Signature
    arguments: tuple[Expr, ...]


@dataclass(frozen=True, eq=False)
class Field(Expr):
    """A field of a struct that a call returned."""

    of: Expr
    name: str


@dataclass(frozen=True, eq=False)
class Meant(Expr):
    """The same in another role."""

    of: Expr


@dataclass(frozen=True, eq=False)
class Heights(Expr):
    """`of`, a float, at the point, and where it is seen `width` pixels away along x and y of the picture."""

    of: Expr
    width: float

    def __getitem__(self, name: str) -> Expr:
        """x, y or z."""
        return Field("float", self, name)


def call(name: str, *arguments: Expr) -> Expr:
    """A call of a function of shaders/nodes; at once what its twin gives, if all arguments are constants."""
    signature = library()[name]
    assert len(arguments) == len(signature.arguments), f"{name} takes {signature.arguments}"
    given = tuple(converted(a, type_) for a, type_ in zip(arguments, signature.arguments, strict=True))
    twin = TWINS.get(name)
    if twin and all(isinstance(a, (Constant, Literal)) for a in given):
        return constant(twin(*map(_number_of, given)), signature.type)
    return Call(signature.type, signature, given)


def constant(value: Any, type_: str = "") -> Constant:
    """A constant of a number or of three."""
    numbers = tuple(map(float, value)) if hasattr(value, "__len__") else (float(value),)
    return Constant(type_ or number_type(len(numbers)), numbers)


def literal(value: float | tuple[float, ...]) -> Literal:
    """A number, or three, as part of the structure."""
    if isinstance(value, tuple):
        return Literal(number_type(len(value)), value)
    return Literal({bool: "bool", int: "int"}.get(type(value), "float"), (value,))


def converted(expr: Expr, type_: str) -> Expr:
    """As that type: numbers of colours are their luminance, of vectors their mean, as in Cycles."""
    if expr.type == type_:
        return expr
    if isinstance(expr, Literal) and (expr.type, type_) in (("int", "uint"), ("int", "float")):
        return Literal(type_, expr.value)
    known = {("vec3", "float"): f"number_of_{expr.role}", ("float", "vec3"): "splat", ("vec2", "vec3"): "widened",
             ("vec4", "vec3"): "narrowed", ("float", "int"): "number_as_int", ("int", "float"): "int_as_number",
             ("float", "bool"): "number_as_bool", ("bool", "float"): "bool_as_number"}
    name = known.get((expr.type, type_))
    assert name, f"there is no {type_} of a {expr.type}"
    return call(name, expr)


def as_color(expr: Expr) -> Expr:
    """The same, meant as a colour."""
    return _meant(expr, COLOR)


def as_vector(expr: Expr) -> Expr:
    """The same, meant as a vector."""
    return _meant(expr, VECTOR)


def _meant(expr: Expr, role: str) -> Expr:
    if expr.role == role:
        return expr
    return replace(expr, role=role) if isinstance(expr, Constant) else Meant(expr.type, expr, role=role)


def children(expr: Expr) -> tuple[Expr, ...]:
    """What it is computed from."""
    if isinstance(expr, Call):
        return expr.arguments
    return (expr.of,) if isinstance(expr, (Field, Meant, Heights)) else ()


def _number_of(expr: Expr) -> Any:
    """The number or tuple that a constant or a literal is."""
    numbers = expr.value if isinstance(expr, (Constant, Literal)) else ()
    return numbers[0] if len(numbers) == 1 else numbers
