# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene and its settings need: everything else is left out, as dispatches that are not made.

One look at the scene, before anything is uploaded. Programs do not differ by it: what is skipped costs nothing, what
is not skipped costs no compiling.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .nodes.compile import Compiled
from .scene.types import Material, Scene
from .settings import RenderSettings

ROUGH = 0.25  # alpha = roughness^2 from which paths end at what they meet, see shaders/evaluate/shaded.glsl
LONGEST_PATH = 24  # vertices, the eye's own included


@dataclass(frozen=True)
class Needs:
    """What there is to be done. A field that is False or 1 says what is skipped.

    light          anything shines at all: else there are no rays and no light cache
    lamps          any lamp
    emission       a used material sends out light: points on it are drawn, and rays that meet it are weighed
    world          the world shines
    principled     a used material is more than a diffuse colour: its program runs
    textures       a used material reads an image: texture coordinates are uploaded
    alpha          a used material lets rays through
    gloss          a used material mirrors or transmits: reflections are drawn and followed
    glass          a used material transmits: light is drawn from behind it as well
    path_vertices  the most vertices of a path, the eye's own included; 2 where no mirror shows another one
    skips          whether anything is skipped; a developer's setting, to show that pictures do not depend on it
    trees          a used material is a compiled tree of nodes
    passes         one of these lets rays pass as they came
    """

    light: bool
    lamps: bool
    emission: bool
    world: bool
    principled: bool
    textures: bool
    alpha: bool
    gloss: bool
    glass: bool
    path_vertices: int
    skips: bool
    trees: bool = False
    passes: bool = False

    def told(self) -> dict[str, str]:
        """What is skipped -> why."""
        left_out = {name: reason for name, reason in _REASONS.items() if not getattr(self, name)}
        if self.gloss and self.path_vertices < LONGEST_PATH:
            left_out["long paths"] = "no material is a mirror or glass"
        return left_out


_REASONS = {
    "light": "nothing shines", "lamps": "there is no lamp", "emission": "no used material sends out light",
    "world": "the world is black", "principled": "all used materials are plain diffuse colours",
    "textures": "no used material reads an image", "alpha": "no used material lets rays through",
    "gloss": "no used material mirrors or transmits", "glass": "no used material transmits",
}


def needs_of(scene: Scene, settings: RenderSettings, compiled: Compiled | None = None) -> Needs:
    """Look at the materials that instances name, by their compiled trees if they have some, the lamps and the world."""
    numbers = np.unique(scene.instances.slot_materials)
    trees = [t for i in numbers if compiled and (t := compiled.traits[i])]
    if not settings.skip_unneeded:
        return Needs(light=True, lamps=True, emission=True, world=True, principled=True, textures=True,
                     alpha=True, gloss=True, glass=True, path_vertices=LONGEST_PATH, skips=False, trees=bool(trees),
                     passes=any(t.passes for t in trees))
    used = [scene.materials[i] for i in numbers if not (compiled and compiled.traits[i])]
    lamps = any(max(light.emitted) > 0 for light in scene.lights)
    emission = any(max(m.emission) > 0 for m in used) or any(t.emits for t in trees)
    world = max(scene.world.radiance) > 0
    gloss = any(is_glossy(m) for m in used) or any(t.mirrors for t in trees)
    mirror = any(is_mirror(m) for m in used) or any(t.mirrors for t in trees)
    return Needs(
        light=lamps or emission or world, lamps=lamps, emission=emission, world=world,
        principled=any(not is_matte(m) for m in used), textures=bool(trees) or any(max(m.textures) >= 0 for m in used),
        alpha=any(has_alpha(m) for m in used) or any(t.passes for t in trees), gloss=gloss,
        glass=any(m.transmission > 0 for m in used) or any(t.transmits for t in trees),
        path_vertices=LONGEST_PATH if mirror else 2, skips=True, trees=bool(trees),
        passes=any(t.passes for t in trees))


def is_glossy(material: Material) -> bool:
    """Whether it does more than send out and reflect light diffusely."""
    return (material.metallic > 0 or material.metallic_texture >= 0 or material.specular_level > 0
            or material.transmission > 0)


def is_mirror(material: Material) -> bool:
    """Whether paths go on from it."""
    rough = max(material.roughness, 0) ** 2 >= ROUGH and material.roughness_texture < 0
    return is_glossy(material) and not (rough and material.transmission == 0)


def is_matte(material: Material) -> bool:
    """Whether it is a diffuse colour without images, which may send out light."""
    return not is_glossy(material) and max(material.textures) < 0


def has_alpha(material: Material) -> bool:
    """Whether a ray may pass through it."""
    return material.alpha < 1 or material.alpha_texture >= 0
