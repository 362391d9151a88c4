# SPDX-License-Identifier: GPL-3.0-or-later
"""Words in the layers of a texture."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.gpu.words import HEIGHT, WIDTH, size_of


@pytest.mark.parametrize(("n", "size"), [
    (0, (1, 1, 1)), (5, (5, 1, 1)), (WIDTH + 1, (WIDTH, 2, 1)), (WIDTH * HEIGHT, (WIDTH, HEIGHT, 1)),
    (WIDTH * HEIGHT + 1, (WIDTH, HEIGHT, 2))])
def test_size(n, size):
    assert size_of(n) == size


def test_what_is_put_lies_where_shaders_look(device):
    """Across rows and layers, and beside what was put before."""
    n_words, first = WIDTH * HEIGHT + 2 * WIDTH, WIDTH * (HEIGHT - 3)
    words = np.arange(4 * WIDTH + 7, dtype="u4") + 1
    with device.scope() as scope:
        made = scope.words("words", n_words)
        made.write(np.zeros(WIDTH * HEIGHT * 2, "u4"))
        made.put(first, words)
        found = made.read().ravel()
    assert np.array_equal(found[first:first + len(words)], words)
    assert not found[:first].any()
    assert not found[first + len(words):].any()
