# SPDX-License-Identifier: GPL-3.0-or-later
"""What triangles are drawn into: a picture, and a depth buffer of its own."""

from __future__ import annotations

import ctypes

from .calls import Calls, check_memory, delete, generate
from .texture import Texture

_FRAMEBUFFER, _RENDERBUFFER, _COLOR_ATTACHMENT0, _DEPTH_ATTACHMENT = 0x8D40, 0x8D41, 0x8CE0, 0x8D00
_DEPTH_COMPONENT24, _COLOR, _DEPTH = 0x81A6, 0x1800, 0x1801


class Framebuffer:
    """Draws into `picture`, what is nearer over what is farther."""

    def __init__(self, calls: Calls, picture: Texture) -> None:
        self._calls, self._size, self._is_whole = calls, picture.size, picture.dtype.kind == "u"
        self._depth, self._glo = generate(calls, "Renderbuffers"), generate(calls, "Framebuffers")
        calls["glBindRenderbuffer"](_RENDERBUFFER, self._depth)
        calls["glRenderbufferStorage"](_RENDERBUFFER, _DEPTH_COMPONENT24, *picture.size)
        calls["glBindFramebuffer"](_FRAMEBUFFER, self._glo)
        calls["glFramebufferTexture2D"](_FRAMEBUFFER, _COLOR_ATTACHMENT0, picture.target, picture.glo, 0)
        calls["glFramebufferRenderbuffer"](_FRAMEBUFFER, _DEPTH_ATTACHMENT, _RENDERBUFFER, self._depth)
        check_memory(calls)

    @property
    def n_bytes(self) -> int:
        """Size of the depth buffer."""
        return 4 * self._size[0] * self._size[1]

    def use(self) -> None:
        """Draw into this from now on."""
        self._calls["glBindFramebuffer"](_FRAMEBUFFER, self._glo)
        self._calls["glViewport"](0, 0, *self._size)

    def clear(self) -> None:
        """Set the picture to zero and the depth to far."""
        self.use()
        self._calls[f"glClearBuffer{'ui' if self._is_whole else 'f'}v"](_COLOR, 0, bytes(16))
        self._calls["glClearBufferfv"](_DEPTH, 0, ctypes.byref(ctypes.c_float(1)))

    def release(self) -> None:
        """Give it back, not the picture."""
        delete(self._calls, "Framebuffers", self._glo)
        delete(self._calls, "Renderbuffers", self._depth)
