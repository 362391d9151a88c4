# SPDX-License-Identifier: GPL-3.0-or-later
"""The Script node, which no graphics card runs."""

from __future__ import annotations

from ..reader import Reader
from . import Outputs, kind


@kind("ShaderNodeScript")
def script(n: Reader) -> Outputs:
    """Nothing, as in Cycles without Open Shading Language: what the node feeds is as if it were not linked."""
    n.warn("scripts in Open Shading Language are not run; what the node feeds is as if it had no link")
    return {}
