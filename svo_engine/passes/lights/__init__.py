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
from ...scene import layouts
from ...scene.types import Light
from ..upload import GpuScene, light_rows
from .emitters import emitters_of
from .sky import sky_table
from .tree import leaf_of_light, light_tree

FEW = 8  # lamps up to which each is drawn by itself
TREE_DRAWS = 4  # of many lamps, at what the eye sees; one at what rays meet
EMITTER_DRAWS = 2

LIGHTS = ("Lights",)
LIGHT_TEXTURES = ("u_light_nodes", "u_emitters", "u_sky")
LIGHT_UNIFORMS = ("u_lamp_tree", "u_emitter_tree", "u_n_emitters", "u_sky_size", "u_world_from_env")


@dataclass(frozen=True, eq=False)
class Lights:
    """bound: what the shaders read, by name. The counts say what there is to draw from."""

    scope: GpuScope
    bound: dict[str, Any]
    n_own: int
    n_in_tree: int
    n_emitters: int
    has_sky: bool

    def resources(self) -> dict[str, Any]:
        """The buffers, textures and uniforms of bind/lights.glsl."""
        return self.bound

    def constants(self) -> dict[str, bool | int | float]:
        """What is not there is not compiled."""
        return {"N_LIGHTS": self.n_own, "HAS_TREE": self.n_in_tree > 0, "HAS_EMITTERS": self.n_emitters > 0,
                "HAS_WORLD_DRAWS": self.has_sky, "N_TREE_DRAWS": TREE_DRAWS, "N_EMITTER_DRAWS": EMITTER_DRAWS}

    @property
    def n_draws(self) -> int:
        """Draws of each pixel and sample."""
        return (self.n_own + TREE_DRAWS * (self.n_in_tree > 0) + EMITTER_DRAWS * (self.n_emitters > 0) + self.has_sky)

    def counts(self) -> dict[str, int]:
        """For the frame's statistics."""
        return {"lamps in tree": self.n_in_tree, "emitters": self.n_emitters, "draws": self.n_draws}


def make_lights(device: Device, gpu_scene: GpuScene) -> Lights:
    """The lights of `gpu_scene` on the device. GpuError names the buffer that does not fit."""
    scope, scene = device.scope(), gpu_scene.scene
    own, many = _split([light for light in scene.lights if max(light.emitted) > 0])
    emitters, sky = emitters_of(gpu_scene), sky_table(scene)
    lamp_tree = light_tree(*_boxes(many, gpu_scene.centre_ws), np.array([_intensity(light) for light in many]))
    emitter_tree = light_tree(emitters.low, emitters.high, emitters.intensity)
    rows = np.zeros(len(emitters.work), layouts.dtype(layouts.EMITTER))
    rows["work"], rows["instance"], rows["triangle"] = emitters.work, emitters.instance, emitters.triangle
    rows["leaf"] = leaf_of_light(emitter_tree)
    lamp_tree["light"] += len(own)
    bound = {
        "Lights": scope.buffer("drawn lamps", light_rows([*own, *many], gpu_scene.centre_ws)),
        "u_light_nodes": scope.texels("light tree", np.concatenate([lamp_tree, emitter_tree])),
        "u_emitters": scope.texels("emitters", rows), "u_sky": scope.texels("sky table", _whole_texels(sky)),
        "u_lamp_tree": (0, len(lamp_tree) // 2), "u_emitter_tree": (len(lamp_tree), len(emitter_tree) // 2),
        "u_n_emitters": len(rows), "u_sky_size": (0, 0) if sky is None else (sky.shape[1] - 1, sky.shape[0]),
        "u_world_from_env": np.eye(3) if sky is None else np.linalg.inv(scene.world.env_from_world)}
    return Lights(scope, bound, len(own), len(many), len(rows), sky is not None)


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


def _whole_texels(table: np.ndarray | None) -> np.ndarray:
    """The table in a row, filled up to whole texels of four numbers."""
    flat = np.zeros(0, "f4") if table is None else table.ravel()
    return np.concatenate([flat, np.zeros(-len(flat) % 4 or 4 * (not len(flat)), "f4")])
