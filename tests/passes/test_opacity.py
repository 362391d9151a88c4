# SPDX-License-Identifier: GPL-3.0-or-later
"""bind/opacity.glsl: the number that rays read of a texture is the one that its material reads."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes.upload.pictures import upload_pictures
from svo_engine.scene.types import Image, Texture
from tests.compute import evaluate

RNG = np.random.default_rng(11)
BYTES = RNG.integers(0, 256, (5, 7, 4), "u1")
GREY = np.repeat(BYTES[..., :1], 4, 2)
FLOATS = RNG.random((4, 3, 4)).astype("f4")
STEP = 0.5 / 255  # of a picture that is made of one number

CASES = {
    "alpha": (Image("a", BYTES), Texture(0, channel=3), 1e-6),
    "alpha of sRGB": (Image("a", BYTES, is_srgb=True), Texture(0, channel=3), 1e-6),
    "green of sRGB": (Image("a", BYTES, is_srgb=True), Texture(0, channel=1), 1e-6),
    "red of floats": (Image("a", FLOATS), Texture(0, channel=0), 1e-6),
    "luminance": (Image("a", BYTES), Texture(0), STEP + 1e-6),
    "luminance of floats": (Image("a", FLOATS), Texture(0, extension="EXTEND"), STEP + 1e-6),
    "closest luminance of sRGB": (Image("a", BYTES, is_srgb=True), Texture(0, interpolation="Closest"), STEP + 1e-6),
    "clipped": (Image("a", BYTES), Texture(0, (2, 0, -0.5, 0, 2, -0.5), "CLIP", channel=2), 1e-6)}


@pytest.mark.parametrize("name", CASES)
def test_rays_read_what_materials_read(device, name):
    """Pictures that are made hold 8 bits; sums of sRGB's texels are decoded in both, but not of those pictures, so that
    they are looked at where one texel counts."""
    image, texture, error = CASES[name]
    uv = RNG.uniform(-2, 3, (300, 2)).astype("f4")
    made = upload_pictures(device, (texture,), (image,), (), (0,))
    shapes = {name: np.zeros(64, "u4") for name in ("Instances", "Triangles", "CornerUvs", "SlotMaterials",
                                                    "Opacities", "Cutouts")}
    given = {"includes": ("bind/opacity.glsl",), "uv": uv,
             "buffers": {**shapes, **{n: made.read[n] for n in ("Textures", "Pictures")}},
             "textures": {"u_words": made.read["u_words"]}}
    wanted, found = (evaluate(device, "float", f"{call}(0, uv)", **given) for call in ("texture_value", "share_at"))
    made.scope.close()
    assert wanted.max() > 0.1
    assert np.abs(found - wanted).max() <= error


def test_rays_find_the_tile(device):
    """Two tiles with a gap between them; where there is none materials are magenta and rays are undecided."""
    tiles = tuple(Image("a", BYTES + np.uint8(k), tile=1001 + k, n_tiles=2 - (k > 0)) for k in (0, 12))
    uv = np.concatenate([RNG.uniform((0, 0), (1, 1), (100, 2)), RNG.uniform((2, 1), (3, 2), (100, 2))]).astype("f4")
    made = upload_pictures(device, (Texture(0, channel=3),), tiles, (), (0,))
    names = ("Instances", "Triangles", "CornerUvs", "SlotMaterials", "Opacities", "Cutouts")
    blocks = {**{name: np.zeros(64, "u4") for name in names}, **{n: made.read[n] for n in ("Textures", "Pictures")}}
    wanted, found = (evaluate(device, "float", f"{call}(0, uv)", ("bind/opacity.glsl",), buffers=blocks, uv=uv,
                              textures={"u_words": made.read["u_words"]}) for call in ("texture_value", "share_at"))
    made.scope.close()
    assert np.abs(found - wanted).max() < 1e-6
