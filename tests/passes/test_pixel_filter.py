# SPDX-License-Identifier: GPL-3.0-or-later
"""Where samples lie in a pixel."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes.pixel_filter import blackman_harris, jitter


def test_the_window_is_one_in_the_middle_and_nothing_at_its_ends():
    assert blackman_harris(np.array([0.0]))[0] == pytest.approx(1)
    assert np.allclose(blackman_harris(np.array([-0.5, 0.5])), 6e-5, atol=1e-6)
    x = np.linspace(0, 0.5, 50)
    assert np.allclose(blackman_harris(x), blackman_harris(-x))
    assert (np.diff(blackman_harris(x)) < 0).all()


def test_the_first_sample_lies_in_the_centre():
    assert jitter(0, 0, 1.5) == pytest.approx((0, 0), abs=1e-9)


@pytest.mark.parametrize("seed", [0, 3])
@pytest.mark.parametrize("width", [1.0, 1.5])
def test_samples_are_distributed_as_the_window(seed, width):
    """Shares of 4096 samples in ten parts of the filter, within 0.004: what the sequence leaves open.

    As in Cycles the window reaches `width` to either side.
    """
    samples = np.array([jitter(i, seed, width) for i in range(4096)])
    edges = np.linspace(-0.5, 0.5, 11)
    fine = np.linspace(-0.5, 0.5, 10_001)
    middle = (fine[1:] + fine[:-1]) / 2
    mass = np.histogram(middle, edges, weights=blackman_harris(middle))[0]
    for axis in range(2):
        found = np.histogram(samples[:, axis] / (2 * width), edges)[0] / len(samples)
        assert np.allclose(found, mass / mass.sum(), atol=4e-3)
    assert abs(np.corrcoef(samples.T)[0, 1]) < 0.02


def test_seeds_give_other_patterns():
    assert len({jitter(0, seed, 1.5) for seed in range(20)}) == 20
