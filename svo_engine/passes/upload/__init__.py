# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene -> GpuScene: the arrays as buffers in the layouts that the shaders read, positions relative to its centre.

In parts, each of which stays while its own arrays are the same: an edit uploads only what it touched.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...needs import Needs, needs_of
from ...nodes.sources import settled
from ...scene.types import Scene
from ...settings import RenderSettings
from ..albedo import Albedo, albedo
from .cutouts import Cutouts, mark_cutouts, opacity_of
from .lamps import Lamps, light_rows
from .looks import Looks
from .placing import Draw, Placing, place
from .shading import Shading, upload_shading
from .shapes import pack_units, upload_shapes
from .sky import Sky, linear_pixels, world_uniforms
from .surfaces import Surfaces, upload_surfaces
from .trees import Trees, upload_trees

__all__ = ["Draw", "GpuScene", "assemble", "light_rows", "linear_pixels", "pack_units", "upload", "world_uniforms"]

Make = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class GpuScene:
    """The scene on the device. `scope` owns the parts, unless somebody else keeps them."""

    scope: GpuScope
    scene: Scene
    needs: Needs
    placing: Placing
    trees: Trees
    shading: Shading
    surfaces: Surfaces
    looks: Looks
    cutouts: Cutouts
    lamps: Lamps
    sky: Sky
    table: Albedo

    @property
    def matter(self) -> tuple[Placing, Looks, Albedo]:
        """All that a voxel can hold: where surfaces are and what they look like."""
        return self.placing, self.looks, self.table

    @property
    def opacity(self) -> Resources:
        """What bind/opacity.glsl reads: all that rays know of materials."""
        return opacity_of(self.placing, self.looks, self.cutouts)

    @property
    def geometry(self) -> Resources:
        """What bind/geometry.glsl reads."""
        return self.placing.geometry

    @property
    def materials(self) -> Resources:
        """What bind/materials.glsl reads."""
        return self.surfaces.materials

    @property
    def of_trees(self) -> Resources:
        """All that functions of shaders/nodes can ask for, but `view_uniforms`."""
        return {**self.geometry, **self.materials, "Values": self.trees.values, **self.shading.read,
                "u_albedo": self.table.table, "u_centre": self.centre_ws, "u_place": np.eye(4),
                **self.looks.baked}

    @property
    def centre_ws(self) -> np.ndarray:
        """(3,) f8, metres: what positions on the device are relative to."""
        return self.placing.centre_ws

    def told(self) -> tuple[str, ...]:
        """A sentence for each thing that is not as in Blender."""
        return *self.sky.notes, *self.surfaces.limits

    def world(self) -> Resources:
        """What bind/environment.glsl reads."""
        return world_uniforms(self.sky, self.scene.world)


def upload(device: Device, scene: Scene) -> GpuScene:
    """Copy `scene` to the device, all of it into one scope. GpuError names the buffer that does not fit."""
    scope = device.scope()

    def make(_name: str, part: Make, *inputs: Any, n_kept: int = 1) -> Any:  # noqa: ARG001 - all is kept
        made = part(device, *inputs)
        scope.adopt(made.scope)
        return made

    scene = settled(scene)
    trees = trees_of(scene, make)
    return assemble(scope, scene, needs_of(scene, RenderSettings(), trees.compiled), trees, make)


def trees_of(scene: Scene, make: Make) -> Trees:
    """The compiled node trees of a scene; `make` as for `assemble`."""
    return make("shaders", upload_trees, scene.plain.materials, scene.images)


def assemble(scope: GpuScope, scene: Scene, needs: Needs, trees: Trees, make: Make) -> GpuScene:
    """The scene from parts: `make(name, function, *inputs, n_kept)` gives function(device, *inputs), or a kept one."""
    from ..bake import bake  # which need this package
    from ..lights.lamps import make_lamps
    from ..sources import make_sky

    scene = scene.plain
    shapes = make("shapes", upload_shapes, scene.meshes, needs.textures)
    placing = make("placing", place, shapes, scene.instances)
    surfaces = make("surfaces", upload_surfaces, scene.materials, scene.textures, scene.images, trees)
    table = make("albedo", albedo, needs.principled or needs.trees, n_kept=2)
    asked = trees.compiled.attributes if trees.passes else None
    shading = make("shading", upload_shading, placing, scene.meshes, scene.instances, asked)
    looks = make("looks", bake, placing, surfaces, trees, table, shading, scene.camera if trees.want_view else None)
    world = scene.images[scene.world.image] if scene.world.image >= 0 else None
    tree = None if scene.world.is_exact else scene.world.graph
    images = () if all(light.is_exact for light in scene.lights) else scene.images
    sky = make("sky", make_sky, world, tree, scene.images if tree else ())
    return GpuScene(
        scope, scene, needs, placing, trees, shading, surfaces, looks,
        make("cutouts", mark_cutouts, placing, looks, needs.skips),
        make("lamps", make_lamps, (*scene.lights, *sky.suns), images, placing.centre_ws), sky, table)
