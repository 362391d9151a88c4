# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms of the equirectangular image; `tests/blender/test_extract_world.py` holds them against Cycles."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.scene.environment import direction_to_uv


@pytest.mark.parametrize(("direction", "uv"), [
    ((1, 0, 0), (0.5, 0.5)), ((0, 1, 0), (0.25, 0.5)), ((0, -1, 0), (0.75, 0.5)),
    ((1, 0, 1), (0.5, 0.75)), ((1, 0, -1), (0.5, 0.25))])
def test_main_directions(direction, uv):
    np.testing.assert_allclose(direction_to_uv(direction), uv)


def test_poles_are_the_lowest_and_the_highest_row():
    assert direction_to_uv((0, 0, -1))[1] == 0
    assert direction_to_uv((0, 0, 1))[1] == 1


def test_left_and_right_edge_meet_at_minus_x():
    left, right = direction_to_uv([(-1, 1e-9, 0), (-1, -1e-9, 0)])
    assert left[0] == pytest.approx(0, abs=1e-9)
    assert right[0] == pytest.approx(1, abs=1e-9)


def test_length_does_not_matter():
    directions = np.random.default_rng(0).normal(size=(5, 7, 3))
    uv = direction_to_uv(directions)
    assert uv.shape == (5, 7, 2)
    np.testing.assert_allclose(direction_to_uv(directions * 1e-3), uv)


def test_solid_angle_is_that_of_the_sphere():
    """Uniform directions fill rows in proportion to the cosine of their elevation: the mean of sin(pi v) is pi / 4."""
    directions = np.random.default_rng(0).normal(size=(100_000, 3))
    uv = direction_to_uv(directions)
    standard_error = 0.223 / np.sqrt(len(uv))  # deviation of cos(elevation): sqrt(2/3 - pi^2/16)
    assert np.sin(np.pi * uv[:, 1]).mean() == pytest.approx(np.pi / 4, abs=5 * standard_error)
    assert uv[:, 0].mean() == pytest.approx(0.5, abs=5 * 0.289 / np.sqrt(len(uv)))
