# SPDX-License-Identifier: GPL-3.0-or-later
"""Image Texture nodes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...scene.types import Texture
from .images import Images
from .mapping import lookup_from_native
from .nodes import Port
from .reader import Reader


class Textures:
    """Collects textures; `found` are those asked for so far, in the order of `Scene.textures`."""

    node_type = "ShaderNodeTexImage"

    def __init__(self, images: Images) -> None:
        self.found: list[Texture] = []
        self._images = images

    def index(self, reader: Reader, port: Port) -> int:
        """Where the texture that `port`, an output of an Image Texture node, gives stands in `found`."""
        node = port.node
        if node.image is None:
            reader.warn(f"node '{node.name}' has no image; it is drawn in magenta")
        if node.projection != "FLAT":
            reader.guess(f"node '{node.name}': {node.projection.lower()} projection is not supported; flat is used")
        if node.interpolation not in ("Linear", "Closest"):
            reader.guess(f"node '{node.name}': {node.interpolation} interpolation is not supported; Linear is used")
        matrix = lookup_from_native(reader, port, ("UV",))[:2, (0, 1, 3)]
        return self._place(Texture(
            self._images.index(node.image, node.image_user),
            uv_from_mesh=tuple(matrix.ravel().tolist()), extension=node.extension,
            interpolation="Closest" if node.interpolation == "Closest" else "Linear",
            channel=3 if port.socket.identifier == "Alpha" else -1, divides=node.outputs["Alpha"].is_linked))

    def one_channel(self, index: int, channel: int) -> int:
        """Where one channel (0, 1, 2) of texture `index` stands in `found`; that itself if it is one already."""
        texture = self.found[index]
        return self._place(replace(texture, channel=channel)) if texture.channel < 0 else index

    def is_grey(self, index: int) -> bool:
        """Whether red, green and blue of texture `index` are the same."""
        texture = self.found[index]
        r, g, b, _ = np.moveaxis(self._images.found[texture.image].pixels, -1, 0)
        return texture.channel >= 0 or bool((r == g).all() and (g == b).all())

    def _place(self, texture: Texture) -> int:
        if texture not in self.found:
            self.found.append(texture)
        return self.found.index(texture)
