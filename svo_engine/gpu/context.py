# SPDX-License-Identifier: GPL-3.0-or-later
"""A standalone OpenGL 4.3 context, apart from whatever Blender draws with."""

from __future__ import annotations

import sys
from typing import Any

import glcontext
import moderngl

from ..errors import GpuError
from .calls import Calls, load_calls

REQUIRED = 430
_HELP = {
    "linux": "install the graphics driver, or Mesa's software renderer: "
             "apt-get install libegl1 libgl1 libgl1-mesa-dri",
    "win32": "install the graphics card's driver",
}


def create_context() -> tuple[moderngl.Context, Calls]:
    """A new context, current on the calling thread, and the calls that moderngl lacks.

    GpuError says what was found and what to install.
    """
    try:
        return _create(REQUIRED)
    except Exception as error:  # glcontext raises bare Exception for every reason there is
        advice = _HELP.get(sys.platform, "this system is not supported")
        raise GpuError(f"OpenGL 4.3 is needed, {_found(error)}; {advice}") from error


def _create(require: int) -> tuple[moderngl.Context, Calls]:
    options: dict[str, Any] = {"mode": "standalone", "glversion": require}
    backend = "wgl"
    if sys.platform.startswith("linux"):
        # Named in full: the search for libraries needs a compiler or ldconfig, which a small system lacks
        backend, options = "egl", options | {"libgl": "libGL.so.1", "libegl": "libEGL.so.1"}
    loader = glcontext.get_backend_by_name(backend)(**options)
    return moderngl.create_context(require=require, context=loader), load_calls(loader)


def _found(error: Exception) -> str:
    """What there is instead of OpenGL 4.3."""
    try:
        context, _ = _create(330)
    except Exception:  # noqa: BLE001  as above
        return f"but no OpenGL context could be made ({error})"
    renderer, version = context.info["GL_RENDERER"], context.info["GL_VERSION"]
    context.release()
    return f"but {renderer} offers only {version}"
