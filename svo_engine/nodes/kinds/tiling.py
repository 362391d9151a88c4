# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane in segments."""

from __future__ import annotations

from ..expr import as_vector
from ..reader import Reader
from . import Outputs, kind


@kind("ShaderNodeRadialTiling")
def radial_tiling(n: Reader) -> Outputs:
    """Segments around a polygon."""
    made = n.call("radial_tiling", n.vector("Vector"), n.number("Sides", 5.0), n.number("Roundness"),
                  n.literal(bool(n.setting("normalize", False))))
    return {"Segment Coordinates": as_vector(made["coordinates"]), "Segment ID": made["id"],
            "Segment Width": made["width"], "Segment Rotation": made["rotation"]}
