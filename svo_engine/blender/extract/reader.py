# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of shader sockets: a constant, an image texture, or the best guess with a warning."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from ...scene.types import Color
from .nodes import Port, constant_color, origin

# Nodes in nodes: what lies deeper counts for nothing in the values
DEEPEST = 64

_N_STEPS = 16  # at which a ramp is looked at

WHITE: Color = (1.0, 1.0, 1.0)
_SEPARATE = ("ShaderNodeSeparateColor", "ShaderNodeSeparateRGB", "ShaderNodeSeparateXYZ")
_CONSTANT = ("ShaderNodeRGB", "ShaderNodeValue")


@dataclass(frozen=True)
class Value:
    """A constant, numbers as grey, times the texture of that index if it is not -1."""

    color: Color
    texture: int = -1

    @property
    def number(self) -> float:
        """The constant's Rec. 709 luminance, which is how Cycles makes a number of a colour."""
        r, g, b = self.color
        return r if r == g == b else 0.2126 * r + 0.7152 * g + 0.0722 * b


class Sampler(Protocol):
    """Collects what one kind of texture node reads."""

    node_type: str

    def index(self, reader: Reader, port: Port) -> int:
        """The index of the texture that `port`, an output of such a node, gives."""

    def one_channel(self, index: int, channel: int) -> int:
        """The index of a texture that is one channel (0, 1, 2) of texture `index`; that itself if it is one already."""

    def is_grey(self, index: int) -> bool:
        """Whether red, green and blue of texture `index` are the same."""


class Reader:
    """Reads the sockets of one material, world or lamp, called `owner` in warnings.

    uv_maps   names of the UV maps that its nodes ask for
    is_exact  whether the values read so far say all that the nodes do
    depth     how many nodes wait for the one that is being read
    surfaces  by socket and groups: shaders that have been read, for many may show one
    """

    def __init__(self, owner: str, sampler: Sampler | None, warn: Callable[[str], object], *,
                 tells_guesses: bool = True) -> None:
        self.uv_maps: set[str] = set()
        self.is_exact = True
        self.depth = 0
        self.surfaces: dict[tuple[int, ...], Any] = {}
        self._owner = owner
        self._tells_guesses = tells_guesses
        self._sampler = sampler
        self._warn = warn

    def warn(self, sentence: str) -> None:
        """Tell the user, once, what is not drawn as Blender would."""
        self._warn(f"{self._owner}: {sentence}")

    def guess(self, sentence: str) -> None:
        """Note that a value only stands in for what the nodes say; of a material its compiled tree tells the rest."""
        self.is_exact = False
        if self._tells_guesses:
            self.warn(sentence)

    def value(self, port: Port, identifier: str, default: float = 0.0) -> Value:
        """The input `identifier` of the node of `port`; `default` if this version's node has none."""
        return self._input(port, identifier, default, self._sampler)

    def constant(self, port: Port, identifier: str, default: float = 0.0) -> Color:
        """As `value`, for what a texture cannot vary."""
        return self._input(port, identifier, default, None).color

    def of(self, port: Port) -> Value:
        """What the output `port` itself gives."""
        return self._value(port, port.socket, self._sampler)

    def product(self, color: Value, strength: Value) -> Value:
        """Both multiplied. Only one can have a texture: that of the strength is left out if there are two."""
        r, g, b = (c * strength.number for c in color.color)
        texture = color.texture
        if texture >= 0 and strength.texture >= 0:
            self.guess("two textures that multiply are not supported; only that of the colour is used")
        elif strength.texture >= 0 and self._sampler:
            texture = self._sampler.one_channel(strength.texture, 0)
            if not self._sampler.is_grey(strength.texture):
                self.guess("a colour as strength is not supported; only its red is used")
        return Value((r, g, b), texture)

    def _input(self, port: Port, identifier: str, default: float, sampler: Sampler | None) -> Value:
        at = port.input(identifier)
        return Value((default, default, default)) if at is None else self._value(origin(at), at.socket, sampler)

    def _value(self, port: Port, asked: Any, sampler: Sampler | None) -> Value:
        """What `port` gives to the socket `asked`."""
        if port.is_constant:
            return Value(constant_color(port.socket))
        kind = port.node.bl_idname
        if sampler and kind == sampler.node_type:
            return Value(WHITE, sampler.index(self, port))
        if kind in _SEPARATE and getattr(port.node, "mode", "RGB") == "RGB":
            return self._channel(port, asked, sampler)
        if kind in _CONSTANT:
            return Value(constant_color(port.socket))
        return self._guess(port, asked, sampler)

    def _channel(self, port: Port, asked: Any, sampler: Sampler | None) -> Value:
        """One of the outputs of a node that takes a colour apart."""
        channel = list(port.node.outputs).index(port.socket)
        whole = self._value(origin(Port(port.node.inputs[0], port.groups)), asked, sampler)
        if whole.texture < 0 or sampler is None:
            return Value((whole.color[channel],) * 3)
        return Value(WHITE, sampler.one_channel(whole.texture, channel))

    def _guess(self, port: Port, asked: Any, sampler: Sampler | None) -> Value:
        """For a node that only its compiled tree knows.

        A colour is taken from what feeds the node's first linked colour input, else from the mean of its colours;
        what is left takes the constant of `asked`.
        """
        self.guess(f"node '{port.node.name}' ({port.node.bl_label}) is not supported for {asked.name}; "
                  "its effect is left out")
        colors = [s for s in port.node.inputs if s.type == "RGBA" and s.enabled] if asked.type == "RGBA" else []
        linked = next((s for s in colors if s.is_linked), None)
        if linked is not None and self.depth < DEEPEST:
            self.depth += 1
            found = self._value(origin(Port(linked, port.groups)), asked, sampler)
            self.depth -= 1
            return found
        values = _of_ramp(port.node) or [constant_color(s) for s in colors] or [constant_color(asked)]
        r, g, b = (sum(v[i] for v in values) / len(values) for i in range(3))
        return Value((r, g, b))


def _of_ramp(node: Any) -> list[Color]:
    """Colours of a Color Ramp at even steps; none for other nodes."""
    ramp = getattr(node, "color_ramp", None)
    if ramp is None:
        return []
    return [(c[0], c[1], c[2]) for c in (ramp.evaluate((i + 0.5) / _N_STEPS) for i in range(_N_STEPS))]
