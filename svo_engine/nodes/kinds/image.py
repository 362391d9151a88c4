# SPDX-License-Identifier: GPL-3.0-or-later
"""Images on surfaces and around scenes."""

from __future__ import annotations

from typing import Any

from ...scene.layouts import CONSTANTS
from ...scene.types import frame_name
from ..expr import Expr, Literal
from ..reader import Reader
from . import Outputs, kind
from .inputs import uv_of
from .textures_space import mapped

_FILTERS = {"Closest": 0, "Linear": 1, "Cubic": 2, "Smart": 2}
_PROJECTIONS = {"FLAT": "image_flat", "SPHERE": "image_sphere", "TUBE": "image_tube"}


@kind("ShaderNodeTexImage")
def image_texture(n: Reader) -> Outputs:
    """An image by coordinates, or from all sides."""
    if not (name := _name(n)):
        made = n.call("image_missing")
        return {"Color": made["color"], "Alpha": made["alpha"]}
    extension = Literal("uint", (CONSTANTS[f"EXTENSION_{n.setting('extension', 'REPEAT')}"],))
    given = (mapped(n, n.vector("Vector", lambda: uv_of(n))), n.image(name), extension, _filter(n),
             n.literal(n.is_used("Alpha")))
    projection = n.setting("projection", "FLAT")
    if projection == "BOX":
        made = n.call("image_box", *given, n.value(n.setting("projection_blend", 0.0)))
    else:
        made = n.call(_PROJECTIONS.get(projection, "image_flat"), *given)
    return {"Color": made["color"], "Alpha": made["alpha"]}


@kind("ShaderNodeTexEnvironment")
def environment_texture(n: Reader) -> Outputs:
    """An image by directions."""
    if not (name := _name(n)):
        return {"Color": n.call("image_missing")["color"]}
    function = "image_mirror_ball" if n.setting("projection") == "MIRROR_BALL" else "image_equirectangular"
    direction = mapped(n, n.vector("Vector", lambda: n.call("position_of_point")))
    return {"Color": n.call(function, direction, n.image(name), _filter(n))}


def _name(n: Reader) -> Any:
    """What the scene's images are asked for; None without an image."""
    name = n.setting("image")
    if name and n.setting("image.source") in ("SEQUENCE", "MOVIE"):
        return frame_name(name, n.setting("image_user.frame_current", 0))
    return name


def _filter(n: Reader) -> Expr:
    return n.literal(_FILTERS.get(n.setting("interpolation", "Linear"), 1))
