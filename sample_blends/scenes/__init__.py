# SPDX-License-Identifier: GPL-3.0-or-later
"""The sample scenes by name. Each function builds its scene into an empty file."""

from __future__ import annotations

from collections.abc import Callable

from . import colonnade, cornell, emissive_only, glass, glossy_steps, outdoor_world, shader_balls, two_rooms

SCENES: dict[str, Callable[[], None]] = {
    "cornell_suzanne_point": cornell.with_point_lamp,
    "cornell_suzanne_area": cornell.with_area_lamp,
    "two_rooms": two_rooms.build,
    "colonnade": colonnade.build,
    "glossy_steps": glossy_steps.build,
    "glass": glass.build,
    "emissive_only": emissive_only.build,
    "outdoor_world": outdoor_world.build,
    "shader_balls": shader_balls.build,
}
