# SPDX-License-Identifier: GPL-3.0-or-later
"""Images that do not fit are halved, the largest first, and told by name."""

from __future__ import annotations

import numpy as np

from svo_engine.passes.upload.pictures import fitted, halved
from svo_engine.scene.types import Image


def test_nothing_happens_where_there_is_room():
    images = [Image("A", np.zeros((4, 4, 4), "u1"))]
    assert fitted(images, 64) == (images, ())


def test_the_largest_is_halved_again_and_again():
    small, large = Image("Small", np.zeros((4, 4, 4), "u1")), Image("Large", np.ones((32, 16, 4), "f4"))
    made, limits = fitted([small, large], 700)
    assert made[0] is small
    assert made[1].pixels.shape == (8, 4, 4)
    assert (made[1].pixels == 1).all()
    assert limits == ("Image 'Large' is read at 4x8 pixels: all images together do not fit into 0 MiB",)


def test_halves_are_means():
    rng = np.random.default_rng(0)
    floats = rng.normal(size=(4, 6, 4)).astype("f4")
    assert np.allclose(halved(floats), floats.reshape(2, 2, 3, 2, 4).mean((1, 3)), atol=1e-6)
    numbers = rng.integers(0, 256, (5, 1, 4)).astype("u1")  # of an odd row at the end nothing is left
    assert np.abs(halved(numbers) - numbers[:4].reshape(2, 2, 1, 4).mean(1)).max() <= 0.5
