# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures side by side: each in its place and untouched, with a label that can be read."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.blender.montage import side_by_side


def test_pictures_stand_untouched_below_their_labels():
    pictures = [np.random.default_rng(i).random((6, 50, 3)).astype("f4") for i in range(3)]
    canvas = side_by_side(dict(zip(("A", "C", "E"), pictures, strict=True)))
    assert canvas.shape == (6 + 7, 3 * 50 + 2 * 4, 3)
    for i, picture in enumerate(pictures):
        np.testing.assert_array_equal(canvas[:6, i * 54 : i * 54 + 50], picture)


@pytest.mark.parametrize(("width", "scale"), [(50, 1), (320, 2)])
def test_letters_are_drawn_upright_and_grow_with_the_picture(width, scale):
    label = side_by_side({"LF": np.zeros((4, width, 3), "f4")})[4:]
    ink = (label[::-1, :, 0] > 0.5)[scale : 6 * scale : scale, scale : 9 * scale : scale]  # row 0 at the top
    drawn = ["".join("#" if pixel else "." for pixel in row) for row in ink]
    assert drawn == ["#...###.", "#...#...", "#...##..", "#...#...", "###.#..."]
    assert (label[:, 9 * scale :, 0] < 0.5).all()


def test_a_label_that_is_too_long_is_cut_off():
    canvas = side_by_side({"EEEEEEEEEE": np.zeros((2, 20, 3), "f4"), "": np.zeros((2, 20, 3), "f4")})
    assert (canvas[2:, 20:, 0] < 0.5).all()
    assert (canvas[2:, 17:20, 0] > 0.5).any()
