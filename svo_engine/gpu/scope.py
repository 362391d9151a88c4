# SPDX-License-Identifier: GPL-3.0-or-later
"""Lifetimes: every OpenGL object belongs to the GpuScope that made it; nothing waits for a garbage collector."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, Protocol, Self

import moderngl
import numpy as np

from ..errors import GpuError
from .calls import clear_buffer, clear_texture
from .cube import Cube
from .pool import Pool
from .texels import TEXEL, Texels

if TYPE_CHECKING:
    from .device import Device

_BYTES = {"f1": 1, "f2": 2, "f4": 4, "u1": 1, "i1": 1, "u4": 4, "i4": 4}


class Closing(Protocol):
    """Whatever can be closed."""

    def close(self) -> None:
        """Give back what it holds."""


class GpuScope:
    """Owns OpenGL objects; `close()` releases them, latest first. Used on the device's own thread alone."""

    def __init__(self, device: Device) -> None:
        self.device = device
        self.n_bytes = 0
        self.n_objects = 0
        self._stack = ExitStack()
        device.scopes.add(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Release all that was made here; a second call does nothing."""
        self._stack.close()
        self.n_bytes = self.n_objects = 0
        self.device.scopes.discard(self)

    def adopt(self, other: Closing) -> None:
        """Close `other` when this one closes."""
        self._stack.callback(other.close)

    def buffer(self, label: str, data: np.ndarray | int, clear: bool = False) -> moderngl.Buffer:
        """A storage buffer that holds `data`, or that many bytes, zeros if `clear`. GpuError past the limit."""
        n_bytes = data if isinstance(data, int) else data.nbytes
        limit = self.device.limits["GL_MAX_SHADER_STORAGE_BLOCK_SIZE"]
        if n_bytes > limit:
            raise GpuError(f"Buffer '{label}' needs {_mib(n_bytes)}, the device allows {_mib(limit)} "
                           "(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)")
        ctx = self.device.ctx
        size = max(n_bytes, 16)  # a storage block without a byte cannot be bound
        made = self._make(label, n_bytes, lambda: ctx.buffer(reserve=size), ("buffer", size))
        if isinstance(data, np.ndarray) and n_bytes:
            made.write(np.ascontiguousarray(data).view("u1"))
        if clear:
            clear_buffer(self.device.calls, made.glo)
        return made

    def pixels(self, label: str, size: tuple[int, int], for_host: bool = False) -> moderngl.Buffer:
        """A buffer for what a texture RGBA f4 holds; `for_host`: which an H100 gives the host twice as fast."""
        n_bytes = 16 * size[0] * size[1]
        return self._make(label, n_bytes, lambda: self.device.ctx.buffer(reserve=n_bytes, dynamic=for_host),
                          ("pixels", n_bytes, for_host))

    def texture(self, label: str, size: tuple[int, int], components: int, dtype: str,
                data: np.ndarray | None = None) -> moderngl.Texture:
        """A 2D texture, nearest filter, clamped. dtype as in moderngl: f1 f2 f4 u1 u4 i4 ..."""
        self._check_size(label, size)
        made = self._make(label, size[0] * size[1] * components * _BYTES[dtype],
                          lambda: self.device.ctx.texture(size, components, dtype=dtype, alignment=1),
                          ("texture", size, components, dtype))
        if data is not None:
            made.write(np.ascontiguousarray(data).tobytes(), alignment=1)
        made.filter = moderngl.NEAREST, moderngl.NEAREST
        made.repeat_x = made.repeat_y = False
        return made

    def layers(self, label: str, size: tuple[int, int], n: int, is_smooth: bool = False,
               is_black: bool = True) -> moderngl.TextureArray:
        """n pictures of `size` pixels RGBA f4, bound as one image or sampled, between texels if `is_smooth`.

        Zeros if `is_black`; an H100 takes .7 ms to clear those of a film.
        """
        self._check_size(label, size)
        n_bytes = size[0] * size[1] * n * 16
        made = self._make(label, n_bytes, lambda: self.device.ctx.texture_array((*size, n), 4, dtype="f4"),
                          ("layers", size, n))
        made.filter = (moderngl.LINEAR if is_smooth else moderngl.NEAREST,) * 2
        made.repeat_x = made.repeat_y = False
        if is_black and not clear_texture(self.device.calls, made.glo):
            made.write(bytes(n_bytes))
        return made

    def cube(self, label: str, n: int) -> Cube:
        """A 3D texture RGBA f2 of n^3 texels, with mip levels; see `Cube`."""
        largest = self.device.limits["GL_MAX_3D_TEXTURE_SIZE"]
        if n > largest:
            raise GpuError(f"Texture '{label}' needs {n} texels a side, the device allows {largest} "
                           "(GL_MAX_3D_TEXTURE_SIZE)")
        return self._make(label, 8 * n**3 * 8 // 7, lambda: Cube(self.device.calls, n))

    def texels(self, label: str, data: np.ndarray | int) -> Texels:
        """A storage buffer, as `buffer` makes it, that shaders can read as texels too."""
        n_bytes, most = data if isinstance(data, int) else data.nbytes, self.device.limits["GL_MAX_TEXTURE_BUFFER_SIZE"]
        if n_bytes > TEXEL * most:
            raise GpuError(f"Buffer '{label}' needs {_mib(n_bytes)}, the device reads {_mib(TEXEL * most)} as texels "
                           "(GL_MAX_TEXTURE_BUFFER_SIZE)")
        buffer = self.buffer(label, data)
        return self._make(label, 0, lambda: Texels(self.device.calls, buffer))

    def framebuffer(self, label: str, colors: list[moderngl.Texture], with_depth: bool) -> moderngl.Framebuffer:
        """A framebuffer over `colors`, with a 32-bit depth buffer of its own if `with_depth`."""
        depth = None
        if with_depth:
            size = colors[0].size
            depth = self._make(f"{label} depth", size[0] * size[1] * 4,
                               lambda: self.device.ctx.depth_renderbuffer(size))
        return self._make(label, 0, lambda: self.device.ctx.framebuffer(colors, depth))

    def _check_size(self, label: str, size: tuple[int, int]) -> None:
        largest = self.device.limits["GL_MAX_TEXTURE_SIZE"]
        if max(size) > largest:
            raise GpuError(f"Texture '{label}' needs {size[0]}x{size[1]} pixels, the device allows {largest} a side "
                           "(GL_MAX_TEXTURE_SIZE)")

    def _make(self, label: str, n_bytes: int, create: Callable[[], Any], key: Any = None) -> Any:
        """An object that goes back to the pool under `key` when the scope closes, or is released if there is no key."""
        pool = self.device.pool
        made = pool.take(key) if key else None
        try:
            made = made or _made(create, pool)
        except (moderngl.Error, MemoryError) as error:
            raise GpuError(f"The device could not make '{label}' of {_mib(n_bytes)}: {error}") from error
        if key:
            self._stack.callback(pool.give, key, n_bytes, made)
        else:
            self._stack.callback(made.release)
        self.n_bytes += n_bytes
        self.n_objects += 1
        return made


def _made(create: Callable[[], Any], pool: Pool) -> Any:
    """What `create` makes; if there is no memory left, once more without what the pool holds."""
    try:
        return create()
    except (moderngl.Error, MemoryError):
        pool.clear()
        return create()


def _mib(n_bytes: int) -> str:
    return f"{n_bytes / 2**20:.1f} MiB"
