# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last picture left out or replaced, so that a material's panel can show what of it is its own."""

from __future__ import annotations

import bpy

from ..film import Film
from ..scene.types import Scene

_last: tuple[str, ...] = ()


def sentences_of(scene: Scene, film: Film) -> tuple[str, ...]:
    """All that was told of a picture, each once."""
    return tuple(dict.fromkeys((*scene.warnings, *film.stats.get("limits", ()))))


def keep(sentences: tuple[str, ...]) -> bool:
    """Make these the last ones; whether they are others than before."""
    global _last
    is_new, _last = sentences != _last, sentences
    return is_new


def of_material(name: str) -> list[str]:
    """Those on the material of that name, without it."""
    owner = f"Material '{name}': "
    return [sentence.removeprefix(owner) for sentence in _last if sentence.startswith(owner)]


def redraw_panels(screen: bpy.types.Screen | None) -> None:
    """Have the editors that show materials' panels drawn again."""
    for area in screen.areas if screen else ():
        if area.type == "PROPERTIES":
            area.tag_redraw()
