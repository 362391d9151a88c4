# SPDX-License-Identifier: GPL-3.0-or-later
"""All modes of all nodes: which settings are varied, and what their inputs are fed with."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import bpy

from . import feeds

# Of kinds with so many combinations: the settings that are varied together; all other enumerations one by one
TOGETHER = {
    "ShaderNodeTexNoise": ("noise_dimensions", "noise_type"), "ShaderNodeTexVoronoi": ("voronoi_dimensions", "feature"),
    "ShaderNodeTexWave": ("wave_type", "wave_profile"), "ShaderNodeMix": ("data_type", "blend_type"),
    "ShaderNodeMapRange": ("data_type", "interpolation_type"), "ShaderNodeVectorTransform": (
        "vector_type", "convert_from", "convert_to"),
    "ShaderNodeTexImage": ("projection", "interpolation"),
}

# Settings that change no output
LEFT_OUT = {"is_active_output", "target", "samples"}


@dataclass(frozen=True)
class Mode:
    """One card. kind: `bl_idname`; settings: those that are not the default; output: identifier of the socket shown."""

    kind: str
    label: str
    output: str
    is_shader: bool = False
    settings: Mapping[str, Any] = field(default_factory=dict, hash=False)

    @property
    def key(self) -> str:
        """What results are kept by."""
        settings = ", ".join(f"{name}={value}" for name, value in self.settings.items())
        return f"{self.kind} {self.output} [{settings}]"

    def make(self, nodes: Any) -> Any:
        """The socket to look at, of a node with all inputs fed."""
        node = made(nodes, self.kind, self.settings)
        feeds.feed(nodes, node)
        return next(s for s in node.outputs if s.identifier == self.output)


def made(nodes: Any, kind: str, settings: Mapping[str, Any]) -> Any:
    """A node of that kind with these settings."""
    node = nodes.tree.nodes.new(kind)
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def all_modes(nodes: Any) -> Iterator[Mode]:
    """Of every kind that the tree of `nodes`, a material's, can hold."""
    for kind in sorted(name for name in dir(bpy.types) if name.startswith("ShaderNode")):
        try:
            node = nodes.tree.nodes.new(kind)
        except RuntimeError:  # abstract, or of other trees
            continue
        if node.outputs and kind not in feeds.NOT_SHOWN:
            yield from _modes_of(nodes, node)


def _modes_of(nodes: Any, node: Any) -> Iterator[Mode]:
    seen = set()
    for found in _settings_of(node):
        settings = {name: value for name, value in found.items() if value != getattr(node, name)}
        try:
            shown = made(nodes, node.bl_idname, settings)
        except TypeError:  # a choice that is for other trees
            continue
        for socket in shown.outputs:
            if not socket.is_unavailable:
                mode = Mode(node.bl_idname, node.bl_label, socket.identifier, socket.type == "SHADER", settings)
                if mode.key not in seen:
                    seen.add(mode.key)
                    yield mode


def _settings_of(node: Any) -> Iterator[dict[str, Any]]:
    """The default, then each combination of TOGETHER, then each other choice by itself."""
    choices = dict(_choices(node))
    yield {}
    together = [name for name in TOGETHER.get(node.bl_idname, ()) if name in choices]
    if together:
        for values in itertools.product(*(choices[name] for name in together)):
            settings = dict(zip(together, values, strict=True))
            if not (settings.get("data_type", "RGBA") != "RGBA" and settings.get("blend_type", "MIX") != "MIX"):
                yield settings
    for name, choice in choices.items():
        if name not in together:
            base = feeds.BASE.get((node.bl_idname, name), {})
            yield from ({**base, name: value} for value in choice)


def _choices(node: Any) -> Iterator[tuple[str, list[Any]]]:
    """Enumerations and switches of the node's own, and what they can be."""
    known = bpy.types.ShaderNode.bl_rna.properties.keys()
    for prop in node.bl_rna.properties:
        name = prop.identifier
        if name in known or name in LEFT_OUT or name.startswith("texture_mapping"):
            continue
        if prop.type == "ENUM":
            yield name, [item.identifier for item in prop.enum_items]
        elif prop.type == "BOOLEAN":
            yield name, [False, True]
