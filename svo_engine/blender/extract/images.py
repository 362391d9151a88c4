# SPDX-License-Identifier: GPL-3.0-or-later
"""Images that materials, lamps and the world use: by their nodes, or by name in their graphs. Each is read once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Protocol

import bpy

from ...scene.graph import Graph
from ...scene.types import Image
from .pixels import MAGENTA, read_image
from .tiles import read_frame, read_tiles

_MOVING = ("SEQUENCE", "MOVIE")

Warn = Callable[[str], object]


class Source(Protocol):
    """Where Images takes pixels from."""

    def get(self, image: Any, frame: int, warn: Warn) -> tuple[Image, ...]:
        """The same objects whenever `image` (a datablock, or None) is asked for: one, or one a tile.

        frame  of a sequence or a movie; 0 for all others
        """


class Pixels:
    """Reads each image when it is first asked for."""

    def __init__(self) -> None:
        self._made: dict[tuple[int, int], tuple[Image, ...]] = {}

    def get(self, image: Any, frame: int, warn: Warn) -> tuple[Image, ...]:
        key = image.original.as_pointer() if image else 0, frame
        if key not in self._made:
            self._made[key] = read_images(image, frame, warn)
        return self._made[key]


class Images:
    """Collects images; `found` are those asked for so far, in the order of `Scene.images`."""

    def __init__(self, warn: Warn, source: Source | None = None) -> None:
        self.found: list[Image] = []
        self._warn = warn
        self._source = source or Pixels()

    def index(self, image: Any, user: Any = None) -> int:
        """Where `image` (a datablock, or None) stands in `found`, or its first tile. user: the node's ImageUser."""
        return self._index(image, user.frame_current if user and image and image.source in _MOVING else 0)

    def add_named(self, graph: Graph | None) -> None:
        """Add all that nodes of `graph` name."""
        for name, frame in dict.fromkeys(_named(graph)):
            if (image := _by_name(name)) is not None:
                self._index(image, frame)

    def _index(self, image: Any, frame: int) -> int:
        return place(self._source.get(image, frame, self._warn), self.found)


def place(made: tuple[Image, ...], found: list[Image]) -> int:
    """The index of the first of `made` in `found`, where they may stand already."""
    known = next((i for i, image in enumerate(found) if image is made[0]), None)
    if known is not None:
        return known
    found += made
    return len(found) - len(made)


def read_images(image: Any, frame: int, warn: Warn) -> tuple[Image, ...]:
    """`image` (a datablock, or None) as `Source.get` gives it."""
    if image is None:
        return (Image("none", MAGENTA, True),)
    if image.source == "TILED" and len(image.tiles) > 1:
        return read_tiles(image, warn)
    return (read_frame(image, frame, warn) if image.source in _MOVING else read_image(image, warn),)


def _named(graph: Graph | None) -> Iterator[tuple[str, int]]:
    """(name, frame) of each image that a node names."""
    if graph is not None:
        for nodes in (graph.nodes, *(group.nodes for group in graph.groups.values())):
            for settings in (node.settings for node in nodes if node.settings.get("image")):
                is_moving = settings.get("image.source") in _MOVING
                yield settings["image"], settings.get("image_user.frame_current", 0) if is_moving else 0


def _by_name(name: str) -> Any:
    """The image of that full name."""
    image = bpy.data.images.get(name)
    if image is not None and image.name_full == name:
        return image
    return next((image for image in bpy.data.images if image.name_full == name), None)
