# SPDX-License-Identifier: GPL-3.0-or-later
"""Lifetimes: every OpenGL object belongs to the GpuScope that made it; nothing waits for a garbage collector."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any, Protocol, Self, TypeVar

import numpy as np

from ..errors import GpuError
from .buffer import Buffer
from .calls import Calls
from .cube import Cube
from .framebuffer import Framebuffer
from .pool import Pool
from .texels import TEXEL, Texels
from .texture import Layers, Texture
from .words import Words, size_of


class Closing(Protocol):
    """Whatever can be closed."""

    def close(self) -> None:
        """Give back what it holds."""


class Released(Protocol):
    """Whatever OpenGL made."""

    def release(self) -> None:
        """Give it back."""


Made = TypeVar("Made", bound=Released)


class GpuScope:
    """Owns OpenGL objects; `close()` releases them, latest first. Used on the device's own thread alone.

    limits       sizes, as in `Context`
    pool         where buffers and pictures come from and go to
    open_scopes  to which it belongs until it is closed
    """

    def __init__(self, calls: Calls, limits: Mapping[str, int], pool: Pool, open_scopes: set[GpuScope]) -> None:
        self._calls, self._limits, self._pool, self._open_scopes = calls, limits, pool, open_scopes
        self.n_bytes = 0
        self.n_objects = 0
        self._stack = ExitStack()
        open_scopes.add(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Release all that was made here; a second call does nothing."""
        self._stack.close()
        self.n_bytes = self.n_objects = 0
        self._open_scopes.discard(self)

    def adopt(self, other: Closing) -> None:
        """Close `other` when this one closes."""
        self._stack.callback(other.close)

    def buffer(self, label: str, data: np.ndarray | int, clear: bool = False) -> Buffer:
        """A storage buffer that holds `data`, or that many bytes, zeros if `clear`. GpuError past the limit."""
        n_bytes = data if isinstance(data, int) else data.nbytes
        self._check(f"Buffer '{label}'", n_bytes, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE", _mib)
        size = max(n_bytes, 16)  # a storage block without a byte cannot be bound
        made = self._make(label, n_bytes, lambda: Buffer(self._calls, size), ("buffer", size))
        if isinstance(data, np.ndarray):
            made.write(data)
        if clear:
            made.clear()
        return made

    def pixels(self, label: str, size: tuple[int, int], for_host: bool = False) -> Buffer:
        """A buffer for what a texture RGBA f4 holds; `for_host`: which an H100 gives the host twice as fast."""
        n_bytes = 16 * size[0] * size[1]
        return self._make(label, n_bytes, lambda: Buffer(self._calls, n_bytes, for_host),
                          ("pixels", n_bytes, for_host))

    def texture(self, label: str, size: tuple[int, int], channels: int, dtype: str,
                pixels: np.ndarray | None = None) -> Texture:
        """A picture, see `Texture`, that holds `pixels`."""
        self._check_size(label, size)
        made = self._make(label, 4 * channels * size[0] * size[1],
                          lambda: Texture(self._calls, size, channels, dtype),
                          ("texture", size, channels, dtype))
        if pixels is not None:
            made.write(pixels)
        return made

    def layers(self, label: str, size: tuple[int, int], n: int, is_smooth: bool = False,
               is_black: bool = True) -> Layers:
        """n pictures of `size` pixels RGBA f4, bound as one image or sampled, between texels if `is_smooth`.

        Zeros if `is_black`; an H100 takes .7 ms to clear those of a film.
        """
        self._check_size(label, size)
        made = self._make(label, size[0] * size[1] * n * 16, lambda: Layers(self._calls, size, n),
                          ("layers", size, n))
        made.set_filter(is_smooth)
        if is_black:
            made.clear()
        return made

    def cube(self, label: str, n: int) -> Cube:
        """A 3D texture RGBA f2 of n^3 texels, with mip levels; see `Cube`."""
        self._check(f"Texture '{label}'", n, "GL_MAX_3D_TEXTURE_SIZE", _texels_a_side)
        return self._make(label, 8 * n**3 * 8 // 7, lambda: Cube(self._calls, n))

    def texels(self, label: str, data: np.ndarray | int) -> Texels:
        """A storage buffer, as `buffer` makes it, that shaders can read as texels too."""
        n_bytes = data if isinstance(data, int) else data.nbytes
        self._check(f"Buffer '{label}'", n_bytes, "GL_MAX_TEXTURE_BUFFER_SIZE", _mib, TEXEL)
        buffer = self.buffer(label, data)
        return self._make(label, 0, lambda: Texels(self._calls, buffer))

    def words(self, label: str, n_words: int) -> Words:
        """Room for words that shaders read as a usampler2DArray, see `Words`."""
        shape = size_of(n_words)
        self._check(f"Texture '{label}'", shape[2], "GL_MAX_ARRAY_TEXTURE_LAYERS", _layers)
        return self._make(label, 4 * shape[0] * shape[1] * shape[2], lambda: Words(self._calls, n_words),
                          ("words", shape))

    def framebuffer(self, label: str, picture: Texture) -> Framebuffer:
        """What draws into `picture`."""
        return self._make(label, 4 * picture.size[0] * picture.size[1],
                          lambda: Framebuffer(self._calls, picture))

    def _check(self, what: str, needed: int, limit: str, unit: Callable[[int], str], each: int = 1) -> None:
        """GpuError if `needed` is more than the limit of that name, which counts things of `each`."""
        most = self._limits[limit] * each
        if needed > most:
            raise GpuError(f"{what} needs {unit(needed)}, the device allows {unit(most)} ({limit})")

    def _check_size(self, label: str, size: tuple[int, int]) -> None:
        largest = self._limits["GL_MAX_TEXTURE_SIZE"]
        if max(size) > largest:
            raise GpuError(f"Texture '{label}' needs {size[0]}x{size[1]} pixels, the device allows {largest} a side "
                           "(GL_MAX_TEXTURE_SIZE)")

    def _make(self, label: str, n_bytes: int, create: Callable[[], Made], key: Any = None) -> Made:
        """An object that goes back to the pool under `key` when the scope closes, or is released if there is no key."""
        made: Made | None = self._pool.take(key) if key else None
        try:
            made = made or _made(create, self._pool)
        except (GpuError, MemoryError) as error:
            raise GpuError(f"The device could not make '{label}' of {_mib(n_bytes)}: {error}") from error
        if key:
            self._stack.callback(self._pool.give, key, n_bytes, made)
        else:
            self._stack.callback(made.release)
        self.n_bytes += n_bytes
        self.n_objects += 1
        return made


def _made(create: Callable[[], Made], pool: Pool) -> Made:
    """What `create` makes; if there is no memory left, once more without what the pool holds."""
    try:
        return create()
    except (GpuError, MemoryError):
        pool.clear()
        return create()


def _texels_a_side(n: int) -> str:
    return f"{n} texels a side"


def _layers(n: int) -> str:
    return f"{n} layers"


def _mib(n_bytes: int) -> str:
    return f"{n_bytes / 2**20:.1f} MiB"
