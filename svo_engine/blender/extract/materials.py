# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials: from their nodes, or from the values that they have without nodes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Protocol

import bpy

from ...scene.types import Material
from .graphs import read_graph
from .images import Images
from .nodes import Port, fed_output, tree_of
from .reader import Reader
from .surfaces import NOTHING, surface
from .textures import Textures


class Collector(Protocol):
    """What collects materials, as Materials does."""

    found: list[Material]
    uv_maps: list[set[str]]

    def index(self, material: Any) -> int:
        """Where `material` (an evaluated datablock, or None for an empty slot) stands in `found`."""

    def differ(self, index: int) -> None:
        """Note that a mesh shows material `index` with another active UV map than it asks for."""


class Materials:
    """Collects materials; `found` are those asked for so far, in the order of `Scene.materials`.

    uv_maps  the names of the UV maps that each of them asks for
    """

    def __init__(self, textures: Textures, images: Images, warn: Callable[[str], object]) -> None:
        self.found: list[Material] = []
        self.uv_maps: list[set[str]] = []
        self._textures, self._images = textures, images
        self._warn = warn
        self._index: dict[int, int] = {}

    def index(self, material: Any) -> int:
        """Where `material` (an evaluated datablock, or None for an empty slot) stands in `found`."""
        pointer = material.as_pointer() if material else 0
        if pointer not in self._index:
            self._index[pointer] = len(self.found)
            owner = f"Material '{material.name}'" if material else ""
            reader = Reader(owner, self._textures, self._warn, tells_guesses=False)
            self.found.append(_read(material, reader) if material else default_material())
            self._images.add_named(self.found[-1].graph)
            self.uv_maps.append(reader.uv_maps)
        return self._index[pointer]

    def differ(self, index: int) -> None:
        """As Collector has it."""
        self.found[index] = replace(self.found[index], is_exact=False)


def default_material() -> Material:
    """What Cycles gives to a face without material: a Diffuse BSDF, since Blender 5.0 a Principled BSDF, both grey."""
    if bpy.app.version >= (5, 0):
        return Material("Default")
    return replace(NOTHING, name="Default", base_color=(0.8, 0.8, 0.8))


def _read(material: Any, reader: Reader) -> Material:
    tree = tree_of(material)
    if tree is None:
        r, g, b, _ = material.diffuse_color
        return Material(material.name, (r, g, b), material.roughness, material.metallic,
                        specular_level=material.specular_intensity, pass_index=material.pass_index)
    material_of_nodes = surface(reader, shown := fed_output(tree, "Surface"))
    if _is_fed(fed_output(tree, "Volume")):
        reader.warn("volume is left out")
        if not _is_fed(shown):
            material_of_nodes = replace(material_of_nodes, alpha=0.0)
    if _is_fed(fed_output(tree, "Displacement")):
        reader.guess("displacement is left out")
    return replace(material_of_nodes, name=material.name, graph=read_graph(tree, material),
                   pass_index=material.pass_index, is_exact=reader.is_exact)


def _is_fed(port: Port | None) -> bool:
    return port is not None and not port.is_constant
