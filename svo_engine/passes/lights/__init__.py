# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene -> Lights: what bind/lights.glsl draws light from: lamps, emissive triangles, the world's image.

A few lamps are drawn each by itself, which is exact but for the noise of their shadows. Many are drawn from a tree, and
so are emissive triangles. Suns are everywhere equally near, so each is drawn by itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.texels import Texels
from ...needs import Needs
from ...scene.types import Light
from ..upload.lamps import Lamps, light_rows
from .glow import Glow
from .tree import light_tree

FEW = 8  # lamps up to which each is drawn by itself
TREE_DRAWS = 4  # of many lamps, at what the eye sees; one at what rays meet



@dataclass(frozen=True, eq=False)
class Lights:
    """lamps: the buffer of all lamps that shine; of_lamps: what their nodes make of them; nodes: of their tree, which
    has n_leaves.

    n_own, n_in_tree  lamps that are drawn each by itself, and from the tree
    """

    scope: GpuScope
    lamps: Buffer
    nodes: Texels
    n_leaves: int
    n_own: int
    n_in_tree: int
    glow: Glow
    of_lamps: Resources

    def resources(self) -> Resources:
        """What bind/lights.glsl reads."""
        return {"Lights": self.lamps, **self.of_lamps, "u_light_nodes": self.nodes,
                "u_lamp_tree": (0, self.n_leaves), **self.draws(), **self.glow.sky()}

    def emitters(self) -> Resources:
        """What bind/emitters.glsl reads."""
        return {**self.draws(), **self.glow.emitters()}

    def draws(self) -> dict[str, int]:
        """The uniforms of bind/draws.glsl."""
        return {"u_n_lamps": self.n_own, "u_n_tree_draws": TREE_DRAWS * (self.n_in_tree > 0), **self.glow.draws()}

    def has_emitters(self, needs: Needs) -> bool:
        """Whether points on emissive triangles are to be drawn."""
        return self.glow.n_emitters > 0 or not needs.skips

    @property
    def n_draws(self) -> int:
        """Draws of each pixel and sample."""
        return sum(self.draws().values())

    def counts(self) -> dict[str, int]:
        """For the frame's statistics."""
        return {"lamps in tree": self.n_in_tree, "emitters": self.glow.n_emitters, "draws": self.n_draws}


def make_lights(device: Device, lamps: Lamps, glow: Glow) -> Lights:
    """The lamps that shine, on the device, beside all that glows. GpuError names the buffer that does not fit."""
    scope = device.scope()
    own, many = _split([light for light in lamps.lights if max(light.emitted) > 0])
    tree = light_tree(*_boxes(many, lamps.centre_ws), np.array([_intensity(light) for light in many]))
    tree["light"] += len(own)
    return Lights(scope, scope.buffer("drawn lamps", light_rows([*own, *many], lamps.centre_ws, lamps.places)),
                  scope.texels("lamp tree", tree), len(tree) // 2, len(own), len(many), glow, lamps.nodes())


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
