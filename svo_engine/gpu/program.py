# SPDX-License-Identifier: GPL-3.0-or-later
"""A compiled variant of a pass. What OpenGL need be told only once is told once: slots, and uniforms that stay."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from .bindings import Bindings, Image, Sampled
from .buffer import Buffer
from .calls import Calls
from .glsl import Source, names_of
from .passes import RANGE

Value = float | int | Sequence[float] | np.ndarray  # of a uniform
Resource = Buffer | Sampled | Image | Value | None  # of any name that a shader declares
Resources = Mapping[str, Resource]

_STORAGE_BLOCK, _NOWHERE = 0x92E6, 0xFFFFFFFF
_KINDS = {"float": "f", "vec": "f", "mat": "f", "int": "i", "ivec": "i", "bool": "i", "uint": "ui", "uvec": "ui"}
_CODES = {"f": "f", "i": "i", "ui": "I"}  # of struct


class Program:
    """`glo`, a linked program made of `sources`; local_size counts the invocations of a workgroup."""

    def __init__(self, calls: Calls, glo: int, sources: Sequence[Source]) -> None:
        self.glo, self._calls = glo, calls
        x, y, z = sources[0].local_size
        self.local_size = x * y * z
        names = names_of(sources)
        setters = {name: self._setter(name, type_) for name, type_ in names.uniforms.items()}
        self._range: tuple[int, int] | None = None
        self._range_setters = [setters.pop(name, None) for name in RANGE]
        self._setters = {name: setter for name, setter in setters.items() if setter}
        self._values: dict[str, Any] = dict.fromkeys(self._setters)
        self._blocks = [(name, slot) for slot, name in enumerate(names.buffers) if self._put_block(name, slot)]
        self._textures, self._images = (
            [(name, slot) for slot, name in enumerate(kind) if self._put_texture(name, slot)]
            for kind in (names.textures, names.images))

    def bind(self, bindings: Bindings, resources: Mapping[str, Any]) -> None:
        """Bind what the compiler has left of buffers, textures and images; None stands for what is not read."""
        for name, slot in self._blocks:
            if (buffer := resources[name]) is not bindings.blocks[slot] and buffer is not None:
                bindings.block(slot, buffer)
        for name, unit in self._textures:
            if (texture := resources[name]) is not bindings.textures[unit] and texture is not None:
                bindings.texture(unit, texture)
        for name, unit in self._images:
            if (image := resources[name]) != bindings.images[unit] and image is not None:
                bindings.image(unit, image)

    def set(self, values: Resources) -> None:
        """Set the uniforms that the compiler has left, of all that `values` names."""
        last = self._values
        for name, setter in self._setters.items():
            if (value := values.get(name)) is not None:
                known = value.tobytes() if isinstance(value, np.ndarray) else value
                if last[name] != known:
                    setter(value)
                    last[name] = known

    def set_range(self, first: int, end: int) -> None:
        """Set u_first and u_end, which the device gives every pass."""
        if self._range != (first, end):
            self._range = first, end
            for setter, value in zip(self._range_setters, self._range, strict=True):
                if setter:
                    setter(value)

    def release(self) -> None:
        """Give it back."""
        self._calls["glDeleteProgram"](self.glo)

    def _put_block(self, name: str, slot: int) -> bool:
        """Give a storage block its slot; False where the compiler has removed it."""
        index = self._calls["glGetProgramResourceIndex"](self.glo, _STORAGE_BLOCK, name.encode())
        if index == _NOWHERE:
            return False
        self._calls["glShaderStorageBlockBinding"](self.glo, index, slot)
        return True

    def _put_texture(self, name: str, unit: int) -> bool:
        """Give a sampler or an image its unit; False where the compiler has removed it."""
        location = self._calls["glGetUniformLocation"](self.glo, name.encode())
        if location >= 0:
            self._calls["glProgramUniform1iv"](self.glo, location, 1, struct.pack("i", unit))
        return location >= 0

    def _setter(self, name: str, type_: str) -> Callable[[Any], None] | None:
        """What sets a uniform of that type, or of an array of it; None where the compiler has removed it."""
        glo, location = self.glo, self._calls["glGetUniformLocation"](self.glo, name.encode())
        if location < 0:
            return None
        kind, width = _KINDS[type_.rstrip("234")], int(type_[-1]) if type_[-1] in "234" else 1
        if type_.startswith("mat"):
            call, n = self._calls[f"glProgramUniformMatrix{width}fv"], width * width

            def set_matrices(value: np.ndarray) -> None:
                """Rows and columns as numpy has them, and as OpenGL does not."""
                call(glo, location, value.size // n, True, value.astype("f4").tobytes())

            return set_matrices
        call, code, plain = self._calls[f"glProgramUniform{width}{kind}v"], _CODES[kind], float if kind == "f" else int

        def set_numbers(value: Any) -> None:
            flat = np.ravel(value).tolist() if isinstance(value, np.ndarray) else value
            flat = flat if isinstance(flat, (tuple, list)) else (flat,)
            call(glo, location, len(flat) // width, struct.pack(f"{len(flat)}{code}", *map(plain, flat)))

        return set_numbers
