# SPDX-License-Identifier: GPL-3.0-or-later
"""What the function of a kind sees of its node: inputs as expressions, settings, and the means to make new ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..scene.graph import Node, Plain
from .closures import Closure, Leaf
from .expr import Expr, Heights, Named, Table, as_vector, call, constant, converted, literal

Fed = Expr | Closure | None


class Reader:
    """One node. What feeds it has been made already.

    feed     what feeds an input: an Expr, a Closure, or the constant
    is_used  whether anything that counts is fed by an output
    """

    def __init__(self, node: Node, feed: Callable[[str], Fed | Plain], is_linked: Callable[[str], bool],
                 is_used: Callable[[str], bool], warn: Callable[[str], object]) -> None:
        self.node = node
        self.is_linked, self.is_used = is_linked, is_used
        self._feed = feed
        self._warn = warn

    def number(self, identifier: str, unlinked: Callable[[], Expr] | float = 0.0) -> Expr:
        """The input as a float. unlinked: what it is without a link or a constant."""
        return converted(self._expr(identifier, unlinked), "float")

    def vector(self, identifier: str, unlinked: Callable[[], Expr] | Sequence[float] = (0.0, 0.0, 0.0)) -> Expr:
        """The input as a vec3, meant as a vector."""
        return as_vector(converted(self._expr(identifier, unlinked), "vec3"))

    def color(self, identifier: str, unlinked: Callable[[], Expr] | Sequence[float] = (0.0, 0.0, 0.0)) -> Expr:
        """The input as a vec3, meant as a colour."""
        return converted(self._expr(identifier, unlinked), "vec3")

    def shader(self, identifier: str) -> Closure | None:
        """The input as a closure. What is no shader is sent out as light, as Cycles does."""
        fed = self._feed(identifier)
        if isinstance(fed, Closure) or fed is None:
            return fed
        return Leaf("closure_emission", (converted(self._made(fed), "vec3"), constant(1.0))) if isinstance(fed, Expr) \
            else None

    def has(self, identifier: str) -> bool:
        """Whether the node has that input: versions of Blender differ."""
        return identifier in self.node.inputs

    def setting(self, name: str, default: Any = None) -> Any:
        """A setting of the node."""
        value = self.node.settings.get(name)
        return default if value is None else value

    def generated(self) -> Expr:
        """Coordinates from 0 to 1 in the object's box: where textures look that are told nothing else."""
        return as_vector(call("generated_of_point"))

    def call(self, function: str, *arguments: Expr) -> Expr:
        """A call of a function of shaders/nodes; `["field"]` takes one of several outputs."""
        return call(function, *arguments)

    def closure(self, function: str, *arguments: Expr) -> Closure:
        """A closure: a function of shaders/nodes that is given a weight as well."""
        return Leaf(function, arguments)

    def literal(self, value: float | tuple[float, ...]) -> Expr:
        """A number that belongs to the structure: another one is another program."""
        return literal(value)

    def value(self, value: Any) -> Expr:
        """A number, or three, that is a value: an edit of it compiles nothing."""
        return constant(value)

    def table(self, numbers: Sequence[float]) -> Expr:
        """Numbers among the values: a uint for `value_at`."""
        return Table("uint", tuple(map(float, numbers)))

    def image(self, name: Any) -> Expr:
        """A uint: the image of that name (any hashable that the scene's images are asked for)."""
        return Named("uint", "image", name)

    def attribute(self, name: Any) -> Expr:
        """A uint: the number of the attribute of that name, for `attribute_at`."""
        return Named("uint", "attribute", name)

    def heights(self, expr: Expr, width: float) -> Expr:
        """x: a number at the point; y, z: where it is seen `width` pixels away along x and y of the picture."""
        return Heights("vec3", expr, width)

    def warn(self, sentence: str) -> None:
        """Tell the user, once, what is not as in Blender, and what stands in."""
        self._warn(f"node '{self.node.name}': {sentence}")

    def _expr(self, identifier: str, unlinked: Any) -> Expr:
        fed = self._feed(identifier)
        if fed is None or isinstance(fed, Closure):
            return unlinked() if callable(unlinked) else constant(unlinked)
        return self._made(fed)

    def _made(self, fed: Any) -> Expr:
        """A socket's constant as an expression: of four numbers the first three, a colour; of two a flat vector."""
        if isinstance(fed, Expr):
            return fed
        if isinstance(fed, (tuple, list)):
            made = constant((*fed, 0.0)[:3])
            return made if len(fed) > 3 else as_vector(made)
        return constant(fed if isinstance(fed, (int, float)) else 0.0)
