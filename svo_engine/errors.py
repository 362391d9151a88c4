# SPDX-License-Identifier: GPL-3.0-or-later
"""The errors that a user can cause. Each carries one sentence that says what is wrong and where.

Raised anywhere; caught only where a user is told: `blender/engine.py`, `blender/compare.py` and the command line.
"""


class SvoError(Exception):
    """Base of all errors that a user is told about, in one sentence without a traceback."""


class SceneError(SvoError):
    """Scene data that cannot be rendered; the sentence names the datablock or the file."""


class ShaderError(SvoError):
    """GLSL that does not compile or link; the sentence names the shader file and the line."""


class GpuError(SvoError):
    """The device cannot do what is needed; the sentence names the limit, what is needed and what there is."""


class Cancelled(SvoError):
    """The caller asked the running frame to stop; not a fault."""
