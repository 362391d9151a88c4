# SPDX-License-Identifier: GPL-3.0-or-later
"""The Sky Texture, and what is constant for one kind of ray."""

from __future__ import annotations

from typing import Any

from ..expr import Expr, constant
from ..rays import CONSTANTS
from ..reader import Reader
from ..skies.daylight import preetham
from ..skies.tables import Disc, disc_of, sun_of, table_of
from . import Outputs, kind
from .textures_space import mapped


@kind("ShaderNodeTexSky")
def sky(n: Reader) -> Outputs:
    """The sky in the direction of a vector."""
    direction = mapped(n, n.vector("Vector", n.generated))
    model, settings = n.setting("sky_type"), n.node.settings
    if model == "PREETHAM":
        parameters = preetham(n.setting("sun_direction"), n.setting("turbidity"))
        return {"Color": n.call("sky_preetham", direction, n.table(parameters.tolist()))}
    if model not in ("HOSEK_WILKIE", "NISHITA", "SINGLE_SCATTERING", "MULTIPLE_SCATTERING"):
        n.warn(f"the sky of type {model} is not known; it is black")
        return {"Color": n.value((0.0, 0.0, 0.0))}
    function = "sky_nishita" if model == "NISHITA" else "sky_scattering"
    table = n.table(table_of(settings).ravel().tolist())
    color = n.call(function, direction, table, n.value(sun_of(settings).rotation))
    disc = disc_of(settings)
    return {"Color": n.call("sky_disc", direction, color, n.table(_numbers(disc))) if disc else color}


def _numbers(disc: Disc) -> list[float]:
    """11, as shaders/nodes/sky.glsl reads a disc."""
    return [*disc.sun.direction.tolist(), disc.size / 2, *disc.ends[0], *disc.ends[1], disc.horizon]


@kind(CONSTANTS)
def constants(n: Reader) -> Outputs:
    """What `rays` has made of a Light Path."""
    return _Known({name: n.value(value) for name, value in n.node.settings.items()})


class _Known(dict[str, Expr]):
    """Outputs, of which those that are not named are 0."""

    def get(self, key: str, default: Any = None) -> Any:  # noqa: ARG002 - it has all
        return self[key] if key in self else self.setdefault(key, constant(0.0))
