# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials and their textures on the device."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...needs import has_alpha, is_matte
from ...nodes.traits import Traits
from ...scene import layouts
from ...scene.types import Image, Material, Texture
from .pictures import upload_pictures
from .trees import Trees


@dataclass(frozen=True, eq=False)
class Surfaces:
    """What was uploaded, and where.

    rows, textures, pictures  the scene's materials, textures and images
    materials      the buffers of bind/materials.glsl; images: those of bind/textures.glsl among them
    opacities      the buffer of bind/opacity.glsl
    has_alpha      (n_materials,) bool: whether a ray may pass through it
    emission_unit  the highest radiance that any material sends out
    limits         a sentence for each image that is smaller there
    """

    scope: GpuScope
    rows: tuple[Material, ...]
    textures: tuple[Texture, ...]
    pictures: tuple[Image, ...]
    materials: Resources
    images: Resources
    opacities: Buffer
    has_alpha: np.ndarray
    emission_unit: float
    limits: tuple[str, ...]


def upload_surfaces(device: Device, materials: tuple[Material, ...], textures: tuple[Texture, ...],
                    images: tuple[Image, ...], trees: Trees) -> Surfaces:
    """Copy the materials, and the texels of the images that textures and trees read."""
    scope = device.scope()
    used = frozenset((*(texture.image for texture in textures), *trees.compiled.images))
    pictures = upload_pictures(device, images, used)
    scope.adopt(pictures.scope)
    read = {"Textures": scope.buffer("textures", _textures(textures)), **pictures.read}
    return Surfaces(
        scope, materials, textures, images,
        {"Materials": scope.buffer("materials", _materials(materials, trees)), **read}, read,
        scope.buffer("opacities", _opacities(materials)), np.array([has_alpha(m) for m in materials], bool),
        max((_emission_bound(m, textures, images) for m in materials), default=0.0), pictures.limits)


def _emission_bound(material: Material, textures: tuple[Texture, ...], images: tuple[Image, ...]) -> float:
    """The highest radiance that the material can send out: the unit of fixed-point sums."""
    bound = max(material.emission)
    if bound > 0 and material.emission_texture >= 0:
        pixels = images[textures[material.emission_texture].image].pixels
        bound *= 1.0 if pixels.dtype == np.uint8 else float(pixels.max(initial=0.0))
    return max(bound, 0.0)


def _materials(materials: tuple[Material, ...], trees: Trees | None = None) -> np.ndarray:
    rows = np.zeros(len(materials), layouts.dtype(layouts.MATERIAL))
    names = [name for name in rows.dtype.names or () if name not in ("program", "first_value", "detail")]
    for row, material in zip(rows, materials, strict=True):
        for name in names:
            row[name] = getattr(material, name)
        row["program"] = layouts.CONSTANTS["PROGRAM_MATTE" if is_matte(material) else "PROGRAM_PRINCIPLED"]
    if trees:
        structure = trees.compiled.structure_of
        rows["program"] = np.where(structure < 0, rows["program"], layouts.CONSTANTS["PROGRAM_TREE"] + structure)
        rows["first_value"] = trees.compiled.first_value
        rows["detail"] = [_detail(t) for t in trees.compiled.traits]
    return rows


def _detail(traits: Traits | None) -> float:
    """How finely a tree is baked; finer where shadows show its outlines."""
    return 0.0 if traits is None or not traits.varies else 4.0 if traits.passes else 1.0


def _opacities(materials: tuple[Material, ...]) -> np.ndarray:
    rows = np.zeros(len(materials), layouts.dtype(layouts.OPACITY))
    rows["alpha"], rows["alpha_texture"] = [m.alpha for m in materials], [m.alpha_texture for m in materials]
    return rows


def _textures(textures: tuple[Texture, ...]) -> np.ndarray:
    rows = np.zeros(len(textures), layouts.dtype(layouts.TEXTURE))
    for row, texture in zip(rows, textures, strict=True):
        row["u_from_uv"], row["v_from_uv"] = texture.uv_from_mesh[:3], texture.uv_from_mesh[3:]
        row["picture"] = texture.image
        row["extension"] = layouts.CONSTANTS[f"EXTENSION_{texture.extension}"]
        row["closest"], row["channel"] = texture.interpolation == "Closest", texture.channel
        row["divides"] = texture.divides
    return rows
