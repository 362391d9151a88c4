# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes that between them use all that there is: an alcove with a plate in it, as one material or another."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from svo_engine.scene.types import Camera, Image, Light, Material, Scene, Texture, World
from tests import scenes

SIZE = (24, 16)

PLAIN = Material("Plate", (0.6, 0.5, 0.4), specular_level=0)
GLOWING = replace(PLAIN, emission=(3.0, 2.0, 1.0))
THIN = replace(PLAIN, alpha=0.5)
METAL = Material("Plate", (0.9, 0.7, 0.5), roughness=0.1, metallic=1.0)
COATED = Material("Plate", (0.6, 0.5, 0.4), roughness=0.7, specular_level=0.5)
GLASS = Material("Plate", (0.9, 1.0, 0.9), roughness=0.3, transmission=1.0)

CHECKS = Image("Checks", np.indices((8, 8, 4)).sum(0)[..., :1].repeat(4, 2).astype("f4") % 2 * 0.75 + 0.25)
SKY = Image("Sky", np.linspace(0.1, 1, 8 * 16 * 4, dtype="f4").reshape(8, 16, 4))


def alcove(material: Material = PLAIN, *lights: Light, **more: Any) -> Scene:
    """A floor, a back wall and an upright plate with texture coordinates; one lamp by default; texture 0: CHECKS."""
    camera = Camera("Camera", scenes.look((0.4, -3.5, 1.4), (0, 0, 0.6)), SIZE, lens=40)
    plate = scenes.quad("Plate", (-0.5, -0.3, 0.2), (0.9, 0.3, 0), (0, 0, 0.9), uvs=True)
    back = scenes.quad("Back", (-1, 1, 0), (2, 0, 0), (0, 0, 1.6))
    things = (scenes.Thing(scenes.floor()), scenes.Thing(back, scenes.RED), scenes.Thing(plate, material))
    images = {"textures": (Texture(0),), "images": (CHECKS, SKY)}
    return scenes.scene(*things, **{"camera": camera, "lights": lights or (bulb(),), **images, **more})


def bulb(x: float = 0.2, emitted: float = 5.0) -> Light:
    """A small lamp above the floor."""
    return scenes.lamp("POINT", (x, -0.8, 1.5), emitted=emitted, radius=0.05)


def bulbs(n: int) -> tuple[Light, ...]:
    """So many lamps in a row."""
    return tuple(bulb(-0.8 + 1.6 * i / n, 8.0 / n) for i in range(n))


SCENES: dict[str, Callable[[], Scene]] = {
    "plain": alcove,
    "dark": lambda: alcove(lights=()),
    "emissive": lambda: alcove(GLOWING),
    "emissive image": lambda: alcove(replace(GLOWING, emission_texture=0)),
    "alpha": lambda: alcove(THIN),
    "alpha image": lambda: alcove(replace(PLAIN, alpha_texture=0)),
    "image": lambda: alcove(replace(PLAIN, base_color_texture=0)),
    "metal": lambda: alcove(METAL),
    "coat": lambda: alcove(COATED),
    "glass": lambda: alcove(GLASS),
    "many lamps": lambda: alcove(PLAIN, *bulbs(11)),
    "many lamps on metal": lambda: alcove(METAL, *bulbs(11)),
    "glowing metal": lambda: alcove(replace(METAL, emission=(1.0, 1.0, 1.0)), world=World((0.1, 0.1, 0.2))),
    "world": lambda: alcove(world=World((0.2, 0.4, 0.8))),
    "world image": lambda: alcove(world=World((1.0, 1.0, 1.0), 1)),
    "normal map": lambda: alcove(replace(COATED, normal_texture=0)),
    "rough and smooth metal": lambda: alcove(replace(METAL, roughness=1.0, roughness_texture=0)),
    "some metal": lambda: alcove(replace(PLAIN, metallic=1.0, metallic_texture=0)),
    "rough metal": lambda: alcove(replace(METAL, roughness=0.9)),
    "thin glass on nothing": lambda: alcove(replace(GLASS, alpha=0.5), film_transparent=True),
    "everything": lambda: alcove(replace(GLASS, emission=(1, 1, 1), alpha=0.9, base_color_texture=0), *bulbs(10),
                                 world=World((1, 1, 1), 1)),
}
