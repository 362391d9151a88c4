# SPDX-License-Identifier: GPL-3.0-or-later
"""The world: a colour, or an equirectangular image that Mapping nodes may turn; its nodes, where they say more."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...scene.types import World
from .graphs import read_graph
from .images import Images
from .mapping import lookup_from_native
from .nodes import Port, fed_output, tree_of
from .reader import Reader
from .surfaces import surface


class _Environments:
    """Collects the Environment Texture nodes that are asked for: (index of the image, its matrix from the world)."""

    node_type = "ShaderNodeTexEnvironment"

    def __init__(self, images: Images) -> None:
        self.found: list[tuple[int, np.ndarray]] = []
        self._images = images

    def index(self, reader: Reader, port: Port) -> int:
        node = port.node
        if node.image is None:
            reader.warn(f"node '{node.name}' has no image; it is drawn in magenta")
        if node.projection != "EQUIRECTANGULAR":
            reader.guess(f"node '{node.name}': mirror ball projection is not supported; equirectangular is used")
        matrix = lookup_from_native(reader, port, ("Generated", "Object"))
        if matrix[:, 3].any():
            reader.guess(f"node '{node.name}': the image of a world can be turned, but not moved; Location is left out")
        self.found.append((self._images.index(node.image, node.image_user), _as_rotation(matrix[:, :3])))
        return len(self.found) - 1

    def one_channel(self, index: int, channel: int) -> int:
        return index

    def is_grey(self, index: int) -> bool:
        return False


def read_world(world: Any, images: Images, warn: Callable[[str], object]) -> World:
    """What `world` (an evaluated datablock, or None: black) shows to rays that leave the scene."""
    if world is None:
        return World()
    tree = tree_of(world)
    if tree is None:
        r, g, b = world.color
        return World((r, g, b))
    volume = fed_output(tree, "Volume")
    if volume is not None and not volume.is_constant:
        warn(f"World '{world.name}': volume is left out")
    environments = _Environments(images)
    reader = Reader(f"World '{world.name}'", environments, warn, tells_guesses=False)
    background, graph = surface(reader, fed_output(tree, "Surface")), read_graph(tree, world)
    images.add_named(graph)
    if not reader.is_exact:
        return World(background.emission, graph=graph, is_exact=False)
    if background.emission_texture < 0:
        return World(background.emission, graph=graph)
    return World(background.emission, *environments.found[background.emission_texture], graph=graph)


def _as_rotation(matrix: np.ndarray) -> np.ndarray:
    """`matrix` (3, 3) without its scale, as far as that is the same along all axes: directions have no length."""
    volume = abs(np.linalg.det(matrix))
    return matrix / np.cbrt(volume) if volume > 0 else matrix
