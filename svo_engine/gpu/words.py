# SPDX-License-Identifier: GPL-3.0-or-later
"""Words for shaders to read at random places, more than a storage buffer may hold: they lie in layers of a texture.

Mesa's software renderer allows 128 MiB a buffer and reads texels twice as fast as storage blocks.
"""

from __future__ import annotations

import numpy as np

from .calls import Calls, integer
from .texture import Texture

WIDTH, HEIGHT = 4096, 1024  # texels of a whole layer

_TEXTURE_2D_ARRAY, _UNPACK_ALIGNMENT = 0x8C1A, 0x0CF5
_TOTAL_MEMORY = 0x9048  # KiB, of GL_NVX_gpu_memory_info


def room_for(calls: Calls, is_software: bool) -> int:
    """Bytes that all words of a scene may take: Mesa refuses textures beyond 1 GiB; of a card's own memory a half."""
    known = 0 if is_software else integer(calls, _TOTAL_MEMORY) << 10
    return 1 << 30 if is_software else min(known // 2, 15 << 30) or 2 << 30


def size_of(n_words: int) -> tuple[int, int, int]:
    """(width, height, layers) that hold them: no more than a row is wasted by few, no more than a layer by many."""
    if n_words <= WIDTH:
        return max(n_words, 1), 1, 1
    rows = -(-n_words // WIDTH)
    return (WIDTH, rows, 1) if rows <= HEIGHT else (WIDTH, HEIGHT, -(-rows // HEIGHT))


class Words(Texture):
    """A usampler2DArray of u4: word i is texel (i mod WIDTH, i / WIDTH mod HEIGHT) of layer i / (WIDTH HEIGHT)."""

    target = _TEXTURE_2D_ARRAY

    def __init__(self, calls: Calls, n_words: int) -> None:
        *size, self._n_layers = size_of(n_words)
        super().__init__(calls, (size[0], size[1]), 1, "u4")

    def put(self, first: int, words: np.ndarray) -> None:
        """Copy words (n,) u4 to number `first` and after it, which begins a row."""
        assert first % WIDTH == 0 and words.dtype == np.uint32 and words.flags.c_contiguous
        self._select()
        self._calls["glPixelStorei"](_UNPACK_ALIGNMENT, 4)
        row, done = first // WIDTH, 0
        while done < len(words):
            n_left = len(words) - done
            n_rows = min(n_left // WIDTH, HEIGHT - row % HEIGHT)
            width, height = (WIDTH, n_rows) if n_rows else (n_left, 1)
            part = words[done:done + width * height]
            self._calls["glTexSubImage3D"](self.target, 0, 0, row % HEIGHT, row // HEIGHT, width, height, 1,
                                           self._channels, self._type, part.ctypes.data)
            row, done = row + height, done + len(part)

    def _shape_of(self, channels: int) -> tuple[int, ...]:
        return self._n_layers, *super()._shape_of(channels)

    def _reserve(self) -> None:
        self._calls["glTexImage3D"](self.target, 0, self.format, *self.size, self._n_layers, 0, self._channels,
                                    self._type, None)

    def _fill(self, pixels: np.ndarray) -> None:
        self.put(0, pixels.ravel())
