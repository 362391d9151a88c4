# SPDX-License-Identifier: GPL-3.0-or-later
"""lib/math.glsl: unit vectors in 32 bits, frames, quasi-random numbers."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.passes.upload import pack_units
from svo_engine.scene.layouts import CONSTANTS
from tests.compute import evaluate

MATH = ("lib/math.glsl",)


def unit_vectors(n: int = 5000) -> np.ndarray:
    """Random directions, and the axes, edges and corners where an octahedron folds."""
    random = np.random.default_rng(1).normal(size=(n, 3))
    special = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1], [-1, 0, 1]), -1).reshape(-1, 3).astype("f8")
    near = special[special.any(1)] + 1e-7
    vectors = np.concatenate([random, special[special.any(1)], near])
    return (vectors / np.linalg.norm(vectors, axis=1, keepdims=True)).astype("f4")


def signed_halves(words: np.ndarray) -> np.ndarray:
    return np.stack([words & 0xFFFF, words >> 16], 1).astype("u2").view("i2").astype("i4")


def test_host_and_shader_pack_alike(device):
    """Both round the same two numbers; they may differ where those lie within an error of f4 of one half."""
    v = unit_vectors()
    difference = signed_halves(evaluate(device, "uint", "pack_unit(v)", MATH, v=v)) - signed_halves(pack_units(v))
    assert np.abs(difference).max() <= 1
    assert (difference != 0).mean() < 0.02


@pytest.mark.parametrize("packed_by", ["shader", "host"])
def test_packed_vectors_come_back(device, packed_by):
    """Half a step of 1/32767 along both axes, at most sqrt(3) longer on the sphere than on the octahedron."""
    v = unit_vectors()
    words = pack_units(v) if packed_by == "host" else evaluate(device, "uint", "pack_unit(v)", MATH, v=v)
    back = evaluate(device, "vec3", "unpack_unit(w)", MATH, w=words)
    assert np.linalg.norm(back - v, axis=1).max() < 1e-4
    assert np.allclose(np.linalg.norm(back, axis=1), 1, atol=1e-6)


def test_no_unit_vector_packs_to_the_word_for_none(device):
    v = unit_vectors()
    assert CONSTANTS["NO_NORMAL"] not in evaluate(device, "uint", "pack_unit(v)", MATH, v=v)
    assert CONSTANTS["NO_NORMAL"] not in pack_units(v)


def test_frames_are_orthonormal_and_right_handed(device):
    n = np.concatenate([unit_vectors(), [[0, 0, -1], [1e-4, 0, -1], [0, 0, -0.0], [1, 0, -0.0]]]).astype("f4")
    n /= np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-30)
    n = n[np.linalg.norm(n, axis=1) > 0]
    frame = np.stack([evaluate(device, "vec3", f"frame_of(n)[{i}]", MATH, n=n) for i in range(3)], -1).astype("f8")
    assert np.array_equal(frame[..., 2], n)
    assert np.abs(np.einsum("nij,nik->njk", frame, frame) - np.eye(3)).max() < 2e-6  # a few roundings of f4
    assert np.allclose(np.linalg.det(frame), 1, atol=2e-6)


@pytest.mark.parametrize("seed", [0, 7, 2**32 - 1])
def test_sobol_points_share_the_square_evenly(device, seed):
    """Of the first 256, as of each 256 after them, every rectangle of area 1/256 with sides of powers of 2 has one."""
    points = evaluate(device, "vec2", "sobol_point(i, seed)", MATH, i=np.arange(1024, dtype="u4"),
                      seed=np.full(1024, seed, "u4"))
    assert points.min() >= 0 and points.max() < 1
    for part in points.reshape(4, 256, 2):
        for rows in (1, 2, 4, 8, 16, 32, 64, 128, 256):
            cell = np.floor(part * (rows, 256 // rows)).astype(int)
            assert len(np.unique(cell, axis=0)) == 256


def test_sobol_points_of_other_seeds_know_nothing_of_each_other(device):
    """Of 4096 pairs of points of two sequences, 16 fall into each of 256 cells on average; that many in a cell has a
    standard deviation of 4.
    """
    i = np.arange(4096, dtype="u4")
    a, b = (evaluate(device, "vec2", f"sobol_point(i, {seed}u)", MATH, i=i) for seed in (3, 4))
    for x in a.T:
        for y in b.T:
            assert np.abs(np.histogram2d(x, y, 16, ((0, 1), (0, 1)))[0] - 16).max() < 5 * 4


def test_hash_has_no_pattern(device):
    """Each bit of the hash of a counter is set half of the time, within 5 sigma, and no two are alike."""
    words = evaluate(device, "uint", "hash(i)", MATH, i=np.arange(2**16, dtype="u4"))
    shares = np.unpackbits(words.view("u1").reshape(-1, 4), axis=1).mean(0)
    assert np.abs(shares - 0.5).max() < 5 * 0.5 / 2**8
    assert len(np.unique(words)) == len(words)


def test_disk_points_are_uniform(device):
    """A square ring of the unit square becomes a round ring of the same share of the area, at any angle."""
    side = (np.arange(128) + 0.5) / 128
    u = np.stack(np.meshgrid(side, side), -1).reshape(-1, 2).astype("f4")
    p = evaluate(device, "vec2", "disk_point(u)", MATH, u=u).astype("f8")
    radius, angle = np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])
    assert np.allclose(radius, np.abs(2 * u - 1).max(1), atol=1e-6)  # so that the share inside r is r^2
    counts = np.histogram(angle, 16, (-np.pi, np.pi))[0]
    assert np.abs(counts - 1024).max() <= 128  # cells on the borders between sectors: two lines of 64


def test_the_centre_of_the_square_is_the_centre_of_the_disk(device):
    assert np.array_equal(evaluate(device, "vec2", "disk_point(u)", MATH, u=np.array([[0.5, 0.5]], "f4")), [[0, 0]])


@pytest.mark.parametrize("size", [(64, 48), (13, 7), (1, 1), (8, 9)])
def test_tiles_cover_every_pixel_once(device, size):
    n = -(-size[0] // 8) * -(-size[1] // 8) * 64
    i = np.arange(n, dtype="u4")
    pixels = evaluate(device, "ivec2", f"tiled_pixel(i, ivec2{size})", MATH, i=i)
    inside = pixels[(pixels < size).all(1)]
    assert len(inside) == len(np.unique(inside, axis=0)) == size[0] * size[1]
