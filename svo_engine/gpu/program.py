# SPDX-License-Identifier: GPL-3.0-or-later
"""A compiled variant of a pass. What OpenGL need be told only once is told once: slots, and uniforms that stay."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl
import numpy as np

from ..errors import ShaderError
from .calls import Calls
from .glsl import Source
from .passes import Pass

Value = float | int | tuple[float, ...] | np.ndarray


class Program:
    """`handle` is moderngl's; local_size counts the invocations of a workgroup. ShaderError if it does not compile."""

    def __init__(self, ctx: moderngl.Context, calls: Calls, pass_: Pass, sources: list[Source]) -> None:
        self.handle = _compile(ctx, sources)
        x, y, z = sources[0].local_size
        self.local_size = x * y * z
        self._members = {name: self.handle[name] for name in self.handle}  # a compiler removes what nobody uses
        self._values: dict[str, Any] = {}
        self._buffers = self._slots(pass_.buffers)
        self._textures, self._images = self._slots(pass_.textures), self._slots(pass_.images)
        for name, slot in self._buffers.items():
            self._members[name].binding = slot
        for name, slot in (self._textures | self._images).items():
            # moderngl writes garbage into uniforms of type image3D and usamplerBuffer
            calls["glProgramUniform1i"](self.handle.glo, self._members[name].location, slot)

    def bind(self, resources: Mapping[str, Any]) -> None:
        """Bind the buffers, textures and images that the program still has."""
        for name, slot in self._buffers.items():
            resources[name].bind_to_storage_buffer(slot)
        for name, slot in self._textures.items():
            resources[name].use(slot)
        for name, slot in self._images.items():
            _bind_image(resources[name], slot)

    def set(self, values: Mapping[str, Value]) -> None:
        """Set the uniforms that the program still has; matrices come as (rows, columns) and go in column by column."""
        for name, value in values.items():
            if name not in self._members:
                continue
            plain = tuple(value.T.ravel().tolist()) if isinstance(value, np.ndarray) else value
            if self._values.get(name) != plain:
                self._members[name].value = self._values[name] = plain

    def release(self) -> None:
        """Give it back."""
        self.handle.release()

    def _slots(self, names: tuple[str, ...]) -> dict[str, int]:
        return {name: slot for slot, name in enumerate(names) if name in self._members}


def _compile(ctx: moderngl.Context, sources: list[Source]) -> Any:
    try:
        if len(sources) == 1:
            return ctx.compute_shader(sources[0].text)
        return ctx.program(vertex_shader=sources[0].text, fragment_shader=sources[1].text)
    except moderngl.Error as error:
        log = str(error)
        blamed = sources[-1] if "fragment_shader" in log else sources[0]
        raise ShaderError(blamed.explain(log.rsplit("=\n", maxsplit=1)[-1])) from error


def _bind_image(image: Any, slot: int) -> None:
    """Bind a 2D texture, or (Cube, mip level)."""
    if isinstance(image, tuple):
        image[0].bind_level(slot, image[1])
    else:
        image.bind_to_image(slot, read=True, write=True)
