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
from ...nodes.sources import settled, wants_view
from ...scene.types import Material, Scene
from ...settings import RenderSettings
from ..albedo import Albedo, albedo
from .emission import Emission, emissions_of, upload_emission
from .lamps import Lamps, light_rows
from .looks import Looks
from .opacity import Opacity, alphas_of, upload_opacity
from .pictures import Pictures, upload_pictures
from .placing import Draw, Placing, place
from .shading import Shading, upload_shading
from .shapes import pack_units, upload_shapes
from .sky import Sky, linear_pixels, world_uniforms
from .surfaces import Surfaces, upload_surfaces
from .trees import Trees, upload_trees

__all__ = ["Draw", "GpuScene", "assemble", "light_rows", "linear_pixels", "pack_units", "upload", "world_uniforms"]

Make = Callable[..., Any]

_NO_TREE = Material("")


@dataclass(frozen=True, eq=False)
class GpuScene:
    """The scene on the device. `scope` owns the parts, unless somebody else keeps them."""

    scope: GpuScope
    scene: Scene
    needs: Needs
    placing: Placing
    trees: Trees
    shading: Shading
    pictures: Pictures
    surfaces: Surfaces
    looks: Looks
    opacity: Opacity
    emission: Emission
    lamps: Lamps
    sky: Sky
    table: Albedo

    @property
    def matter(self) -> tuple[Placing, Surfaces, Looks, Emission, Albedo]:
        """All that a voxel can hold: where surfaces are and what they look like."""
        return self.placing, self.surfaces, self.looks, self.emission, self.table

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
        return *self.sky.notes, *self.pictures.limits

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
    return make("shaders", upload_trees, _trees_alone(scene.plain.materials), scene.images)


def _trees_alone(materials: tuple[Material, ...]) -> tuple[Material, ...]:
    """The same but for materials that are no trees, of which nothing is left: so they can be edited."""
    return tuple(_NO_TREE if material.is_exact else material for material in materials)


def assemble(scope: GpuScope, scene: Scene, needs: Needs, trees: Trees, make: Make) -> GpuScene:
    """The scene from parts: `make(name, function, *inputs, n_kept)` gives function(device, *inputs), or a kept one."""
    from ..bake import bake  # which need this package
    from ..displace import displace, moving_of, with_moved
    from ..lights.lamps import make_lamps
    from ..sources import make_sky

    scene = scene.plain
    if found := moving_of(scene, trees):
        moving, shown = found
        scene = with_moved(scene, make("displaced", displace, moving).meshes, shown)
    shapes = make("shapes", upload_shapes, scene.meshes, needs.textures)
    placing = make("placing", place, shapes, scene.instances)
    shares = tuple(sorted({m.alpha_texture for m in scene.materials if m.is_exact and m.alpha_texture >= 0}))
    pictures = make("pictures", upload_pictures, scene.textures, scene.images, tuple(sorted(trees.compiled.images)),
                    shares)
    surfaces = make("surfaces", upload_surfaces, scene.materials, pictures, trees)
    table = make("albedo", albedo, needs.principled or needs.trees, n_kept=2)
    asked = trees.compiled.attributes if trees.passes else None
    shading = make("shading", upload_shading, placing, scene.meshes, scene.instances, asked)
    of_trees = make("surfaces of trees", upload_surfaces, _trees_alone(scene.materials), pictures, trees)
    looks = make("looks", bake, placing, of_trees, trees, table, shading, scene.camera if trees.want_view else None)
    world = scene.images[scene.world.image] if scene.world.image >= 0 else None
    tree = None if scene.world.is_exact else scene.world.graph
    images = () if all(light.is_exact for light in scene.lights) else scene.images
    camera = scene.camera if tree and wants_view(tree) else None
    sky = make("sky", make_sky, world, tree, scene.images if tree else (), camera)
    return GpuScene(
        scope, scene, needs, placing, trees, shading, pictures, surfaces, looks,
        _opacity(scene, needs, trees, make, placing, pictures, looks),
        _emission(scene, trees, make, pictures, looks),
        make("lamps", make_lamps, (*scene.lights, *sky.suns), images, placing.centre_ws), sky, table)


def _opacity(scene: Scene, needs: Needs, trees: Trees, make: Make, placing: Placing, pictures: Pictures,
             looks: Looks) -> Opacity:
    passes = tuple(t is not None and t.passes for t in trees.compiled.traits)
    return make("opacity", upload_opacity, placing, pictures, alphas_of(scene.materials, trees.compiled.traits), passes,
                looks if any(passes) else None, needs.skips)


def _emission(scene: Scene, trees: Trees, make: Make, pictures: Pictures, looks: Looks) -> Emission:
    given = emissions_of(scene.materials, trees.compiled.traits)
    has_images = any(texture >= 0 for _, texture, _, _ in given)
    textures, images = (scene.textures, scene.images) if has_images else ((), ())
    shines = any(t is not None and t.emits for t in trees.compiled.traits)
    return make("emission", upload_emission, pictures, given, textures, images, looks if shines else None)
