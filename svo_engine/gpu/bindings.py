# SPDX-License-Identifier: GPL-3.0-or-later
"""What is bound where, so that nothing is bound twice: most passes read what the one before them read."""

from __future__ import annotations

from typing import Protocol

from .buffer import Buffer
from .calls import Calls
from .cube import Cube
from .texture import Texture

_SHADER_STORAGE_BUFFER = 0x90D2
N_SLOTS = 32

Image = Texture | tuple[Cube, int]  # a picture with all its layers, or a cube's mip level


class Sampled(Protocol):
    """What can be bound for sampling."""

    def use(self, unit: int) -> None:
        """Bind it."""


class Bindings:
    """The slots of the context.

    Objects are told apart as Python does: one that OpenGL gave the name of another, released before, is another one.
    """

    def __init__(self, calls: Calls) -> None:
        self._calls = calls
        self._program = 0
        self.blocks: list[Buffer | None] = [None] * N_SLOTS
        self.textures: list[Sampled | None] = [None] * N_SLOTS
        self.images: list[Image | None] = [None] * N_SLOTS

    def program(self, glo: int) -> None:
        """Make this program the one that runs."""
        if self._program != glo:
            self._calls["glUseProgram"](glo)
            self._program = glo

    def block(self, slot: int, buffer: Buffer) -> None:
        """Bind a buffer as the storage block of that slot."""
        self._calls["glBindBufferBase"](_SHADER_STORAGE_BUFFER, slot, buffer.glo)
        self.blocks[slot] = buffer

    def texture(self, unit: int, texture: Sampled) -> None:
        """Bind for sampling."""
        texture.use(unit)
        self.textures[unit] = texture

    def image(self, unit: int, image: Image) -> None:
        """Bind for reading and writing."""
        if isinstance(image, tuple):
            image[0].bind_level(unit, image[1])
        else:
            image.bind_image(unit)
        self.images[unit] = image
