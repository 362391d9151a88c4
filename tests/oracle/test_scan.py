# SPDX-License-Identifier: GPL-3.0-or-later
"""Prefix sums of the device against numpy's."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes.voxelize import FEW_BLOCKS, SCAN_BLOCK, number_bits, scan


@pytest.mark.parametrize("n", [1, 2, 8, 255, 2047, 2048, 2049, SCAN_BLOCK**2 - 1, SCAN_BLOCK**2 + 1, 5_000_000])
def test_sums_of_all_before(device, n):
    counts = np.random.default_rng(n).integers(0, 800, n).astype("u4")
    with device.scope() as scope:
        buffer = scope.buffer("counts", counts)
        total = scan(device, scope, buffer, n)
        found = np.frombuffer(buffer.read(), "u4")[:n]
    assert total == counts.sum(dtype="u8")
    assert np.array_equal(found, np.cumsum(counts, dtype="u4") - counts)


@pytest.mark.parametrize("n", [1, SCAN_BLOCK, SCAN_BLOCK + 1, FEW_BLOCKS * SCAN_BLOCK, FEW_BLOCKS * SCAN_BLOCK + 1])
def test_bits_set_before_each_word(device, n):
    """Blocks that add up all words before them, and blocks whose sums are there."""
    words = np.random.default_rng(n).integers(0, 2**32, n, dtype="u4")
    with device.scope() as scope:
        buffer, total = number_bits(device, scope, scope.buffer("words", words), n)
        found = np.frombuffer(buffer.read(), "u4")[:n]
    counts = np.unpackbits(words.view("u1")).reshape(n, 32).sum(1, dtype="u4")
    assert total == counts.sum()
    assert np.array_equal(found, np.cumsum(counts, dtype="u4") - counts)


def test_zeros_stay_zeros(device):
    with device.scope() as scope:
        assert scan(device, scope, scope.buffer("counts", np.zeros(5000, "u4")), 5000) == 0
