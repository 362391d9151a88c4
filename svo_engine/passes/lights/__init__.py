# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene -> Lights: what bind/lights.glsl draws light from: lamps, emissive triangles, the world's image.

A few lamps are drawn each by itself, which is exact but for the noise of their shadows. Many are drawn from a tree, and
so are emissive triangles. Suns are everywhere equally near, so each is drawn by itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...gpu.device import Device
from ...gpu.scope import GpuScope
from ...scene.types import Light
from ..upload import GpuScene, light_rows
from .glow import Glow
from .tree import light_tree

FEW = 8  # lamps up to which each is drawn by itself
TREE_DRAWS = 4  # of many lamps, at what the eye sees; one at what rays meet

LIGHTS = ("Lights",)
LIGHT_TEXTURES = ("u_light_nodes", "u_emitters", "u_sky")
LIGHT_UNIFORMS = ("u_lamp_tree", "u_emitter_tree", "u_n_emitters", "u_sky_size", "u_world_from_env")


@dataclass(frozen=True, eq=False)
class Lights:
    """bound: what the shaders read, by name. The counts say how many lamps there are to draw from."""

    scope: GpuScope
    bound: dict[str, Any]
    n_own: int
    n_in_tree: int
    glow: Glow

    def resources(self) -> dict[str, Any]:
        """The buffers, textures and uniforms of bind/lights.glsl."""
        return self.bound

    def constants(self) -> dict[str, bool | int | float]:
        """What is not there is not compiled."""
        return {"N_LIGHTS": self.n_own, "HAS_TREE": self.n_in_tree > 0, "N_TREE_DRAWS": TREE_DRAWS,
                **self.glow.constants()}

    @property
    def n_draws(self) -> int:
        """Draws of each pixel and sample."""
        return self.n_own + TREE_DRAWS * (self.n_in_tree > 0) + self.glow.n_draws

    def counts(self) -> dict[str, int]:
        """For the frame's statistics."""
        return {"lamps in tree": self.n_in_tree, "emitters": self.glow.n_emitters, "draws": self.n_draws}


def make_lights(device: Device, gpu_scene: GpuScene, glow: Glow) -> Lights:
    """The lamps of `gpu_scene` on the device, beside all that glows. GpuError names the buffer that does not fit."""
    scope = device.scope()
    own, many = _split([light for light in gpu_scene.scene.lights if max(light.emitted) > 0])
    tree = light_tree(*_boxes(many, gpu_scene.centre_ws), np.array([_intensity(light) for light in many]))
    tree["light"] += len(own)
    bound = {
        **glow.bound,
        "Lights": scope.buffer("drawn lamps", light_rows([*own, *many], gpu_scene.centre_ws)),
        "u_light_nodes": scope.texels("light tree", np.concatenate([glow.tree, tree])),
        "u_emitter_tree": (0, len(glow.tree) // 2), "u_lamp_tree": (len(glow.tree), len(tree) // 2)}
    return Lights(scope, bound, len(own), len(many), glow)


def _split(lamps: list[Light]) -> tuple[list[Light], list[Light]]:
    """The lamps that are drawn each by itself, and those that a tree holds."""
    near = [lamp for lamp in lamps if lamp.kind != "SUN"]
    if len(near) <= FEW:
        return lamps, []
    return [lamp for lamp in lamps if lamp.kind == "SUN"], near


def _boxes(lamps: list[Light], centre: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) f8 each, metres, relative to `centre`."""
    places = np.array([lamp.world_from_light[:3] for lamp in lamps]).reshape(-1, 3, 4)
    axes = places[..., :2] / np.maximum(np.linalg.norm(places[..., :2], axis=1, keepdims=True), 1e-30)
    flat = np.array([lamp.size if lamp.kind == "AREA" else (0, 0) for lamp in lamps]).reshape(-1, 1, 2) / 2
    round_ = np.array([0 if lamp.kind == "AREA" else lamp.radius for lamp in lamps]).reshape(-1, 1)
    half = (np.abs(axes) * flat).sum(2) + round_
    middle = places[..., 3] - centre
    return middle - half, middle + half


def _intensity(lamp: Light) -> float:
    """Mean over the colours of the radiant intensity [W sr^-1] along the axis."""
    mean = float(np.mean(lamp.emitted))
    if lamp.kind != "AREA":
        return mean
    h = max(lamp.spread / 2, 1e-4)
    lobe = np.tan(h) / (np.tan(h) - h) if h < 0.4999 * np.pi else 1.0
    return mean * lamp.size[0] * lamp.size[1] * (np.pi / 4 if lamp.is_ellipse else 1.0) * lobe
