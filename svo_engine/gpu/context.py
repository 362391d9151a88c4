# SPDX-License-Identifier: GPL-3.0-or-later
"""A standalone OpenGL 4.3 context, apart from whatever Blender draws with."""

from __future__ import annotations

import ctypes
import sys
from contextlib import suppress
from typing import Any

import glcontext
import moderngl

from ..errors import GpuError
from .calls import Calls, is_software, load_calls

REQUIRED = 430
_HELP = {
    "linux": "install the graphics driver, or Mesa's software renderer: "
             "apt-get install libegl1 libgl1 libgl1-mesa-dri",
    "win32": "install the graphics card's driver",
}
_PLATFORM_DEVICE = 0x313F


class Context:
    """A moderngl context, current on the thread that made it.

    moderngl makes it, checks it and knows its limits. What runs on it is called by ctypes (calls.py): moderngl holds
    Python's lock while a call waits, and with it all of Blender's panels.

    info    renderer, vendor and version, as the driver names itself
    limits  sizes, by the names that OpenGL has for them
    """

    def __init__(self, loader: Any, require: int) -> None:
        self.moderngl = moderngl.create_context(require=require, context=loader)
        self.calls: Calls = load_calls(loader)
        self.info = {key: str(self.moderngl.info[f"GL_{key.upper()}"]) for key in ("renderer", "vendor", "version")}
        self.limits: dict[str, int] = self.moderngl.info
        self.is_software = is_software(self.calls)
        self.version = self.moderngl.version_code

    def release(self) -> None:
        """Give the context and all that is in it back."""
        self.moderngl.release()


def create_context() -> Context:
    """A new context, current on the calling thread. GpuError says what was found and what to install."""
    try:
        context = _create(REQUIRED)
    except Exception as error:  # glcontext raises bare Exception for every reason there is
        raise GpuError(f"OpenGL 4.3 is needed, {_found(error)}; {_advice()}") from error
    if context.version < REQUIRED:
        raise GpuError(f"OpenGL 4.3 is needed, {_offers(context)}; {_advice()}")
    return context


def _create(version: int) -> Context:
    options: dict[str, Any] = {"mode": "standalone", "glversion": version}
    if not sys.platform.startswith("linux"):
        return Context(glcontext.default_backend()(**options), version)
    _start_driver()
    # Named in full: the search for libraries needs a compiler or ldconfig, which a small system lacks
    return Context(glcontext.get_backend_by_name("egl")(**options, libgl="libGL.so.1", libegl="libEGL.so.1"), version)


def _start_driver() -> None:
    """Have EGL load and start the driver of its first device with Python's lock free: that takes a tenth of a second.

    glcontext, which holds the lock, finds it started then. If anything is missing here, it is left to tell so.
    """
    pointer = ctypes.c_void_p
    with suppress(OSError, AttributeError):
        egl, device = ctypes.CDLL("libEGL.so.1"), pointer()
        egl.eglGetProcAddress.restype, egl.eglGetProcAddress.argtypes = pointer, [ctypes.c_char_p]
        egl.eglInitialize.argtypes = [pointer] * 3
        devices_at = egl.eglGetProcAddress(b"eglQueryDevicesEXT")
        display_at = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
        if devices_at and display_at:
            devices = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, pointer, pointer)(devices_at)
            display = ctypes.CFUNCTYPE(pointer, ctypes.c_uint, pointer, pointer)(display_at)
            if devices(1, ctypes.byref(device), ctypes.byref(ctypes.c_int())):
                egl.eglInitialize(display(_PLATFORM_DEVICE, device, None), None, None)


def _advice() -> str:
    return _HELP.get(sys.platform, "this system is not supported")


def _found(error: Exception) -> str:
    """What there is instead of OpenGL 4.3."""
    try:
        return _offers(_create(330))
    except Exception:  # noqa: BLE001  as above
        return f"but no OpenGL context could be made ({error})"


def _offers(context: Context) -> str:
    """What a context that is too old has; it is given back."""
    context.release()
    return f"but {context.info['renderer']} offers only {context.info['version']}"
