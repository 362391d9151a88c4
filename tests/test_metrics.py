# SPDX-License-Identifier: GPL-3.0-or-later
"""Error measures against closed forms, hand-computed values and a slow SSIM written straight from its definition."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from svo_engine import metrics
from svo_engine.errors import SvoError

EXACT = 1e-12  # relative: sums of at most a few thousand f8 numbers
pictures = arrays("f4", (13, 12, 3), elements=st.floats(0, 100, width=32))


def noise(shape: tuple[int, ...], seed: int) -> np.ndarray:
    return np.random.default_rng(seed).random(shape).astype("f4")


def test_measures_of_a_hand_computed_picture():
    r = np.array([[[1, 2, 3], [0, 0, 6]]], "f4")
    a = np.array([[[2, 2, 1], [0, 1, 6]]], "f4")  # a - r: 1 0 -2, 0 1 0: sum 0, sum of squares 6, mean of r: 2
    assert metrics.nrmse(a, r) == pytest.approx(math.sqrt(6 / 6) / 2, rel=EXACT)
    assert metrics.bias(a, r) == 0
    assert metrics.rel_mse(a, r) == pytest.approx((1 / 1.01 + 4 / 9.01 + 1 / 0.01) / 6, rel=EXACT)
    assert metrics.psnr(a, r) == pytest.approx(20 * math.log10(6), rel=EXACT)  # peak 6, RMSE 1


@given(scale=st.floats(0.1, 10), value=st.floats(0.1, 10))
def test_a_scaled_flat_picture_has_the_closed_form_of_every_measure(scale: float, value: float):
    r = np.full((12, 14, 3), value)
    a = r * scale
    e = metrics.errors(a, r)
    off = abs(scale - 1)
    assert e.nrmse == pytest.approx(off, abs=1e-9)
    assert e.bias == pytest.approx(scale - 1, abs=1e-9)
    assert e.rel_mse == pytest.approx((off * value) ** 2 / (value**2 + 0.01), abs=1e-9)
    if off > 1e-3:
        assert e.psnr == pytest.approx(-20 * math.log10(off), abs=1e-6)
    c1 = (0.01 * value) ** 2  # flat windows: no variance, the second factor is 1
    assert e.ssim == pytest.approx((2 * a[0, 0, 0] * value + c1) / (a[0, 0, 0] ** 2 + value**2 + c1), abs=1e-9)


@given(pictures)
def test_a_picture_equals_itself(picture: np.ndarray):
    assert metrics.errors(picture, picture) == metrics.Errors(0, 0, 0, math.inf, 1, 0, 0)


@given(pictures, pictures)
def test_bounds_hold_for_any_two_pictures(a: np.ndarray, r: np.ndarray):
    e = metrics.errors(a, r)
    assert e.rel_mse >= 0
    assert e.nrmse >= abs(e.bias) * (1 - EXACT)  # Jensen: the root mean square is never below the mean
    assert -1 - 1e-6 <= e.ssim <= 1 + 1e-6


@pytest.mark.parametrize("shape", [(11, 11, 3), (16, 23, 3)])
def test_ssim_is_its_definition(shape: tuple[int, int, int]):
    a, r = noise(shape, 1).astype("f8"), noise(shape, 2).astype("f8")
    x = np.arange(-5, 6)
    window = np.exp(-(x[:, None] ** 2 + x**2) / (2 * 1.5**2))
    window = (window / window.sum())[..., None]
    c1, c2 = (0.01 * r.max()) ** 2, (0.03 * r.max()) ** 2
    found = []
    for i in range(shape[0] - 10):
        for j in range(shape[1] - 10):
            p, q = a[i : i + 11, j : j + 11], r[i : i + 11, j : j + 11]
            mean_p, mean_q = (window * p).sum((0, 1)), (window * q).sum((0, 1))
            var_p, var_q = (window * (p - mean_p) ** 2).sum((0, 1)), (window * (q - mean_q) ** 2).sum((0, 1))
            covariance = (window * (p - mean_p) * (q - mean_q)).sum((0, 1))
            found.append((2 * mean_p * mean_q + c1) * (2 * covariance + c2)
                         / ((mean_p**2 + mean_q**2 + c1) * (var_p + var_q + c2)))
    assert metrics.ssim(a, r) == pytest.approx(np.mean(found), rel=1e-9)  # E[x^2] - E[x]^2 loses a few digits


def test_ssim_sees_structure_that_the_mean_error_does_not():
    r = 0.5 + 0.4 * np.sin(np.arange(32) / 2)[:, None, None] * np.ones((32, 32, 3))
    shifted, noisy = r + 0.1, r + np.where(noise(r.shape, 3) < 0.5, -0.1, 0.1)  # the same RMSE of 0.1
    assert metrics.nrmse(shifted, r) == pytest.approx(metrics.nrmse(noisy, r), rel=1e-9)
    assert metrics.ssim(noisy, r) < metrics.ssim(shifted, r) < 1


def test_pixels_that_are_not_finite_are_left_out_and_counted():
    r, a = noise((30, 30, 3), 4), noise((30, 30, 3), 5)
    bad_a, bad_r = a.copy(), r.copy()
    bad_a[0, 0, 1], bad_a[0, 1, :], bad_r[29, 29, 0] = np.nan, np.inf, -np.inf
    e = metrics.errors(bad_a, bad_r)
    assert (e.n_not_finite, e.n_reference_not_finite) == (2, 1)
    good = np.ones((30, 30), bool)
    good[0, :2] = good[29, 29] = False
    assert e.nrmse == pytest.approx(metrics.nrmse(a[good], r[good]), rel=EXACT)
    windows = np.ones((20, 20), bool)
    windows[0, :2] = windows[19, 19] = False
    peak = float(r[good].max())
    assert e.ssim == pytest.approx(metrics.ssim_map(a, r, peak)[windows].mean(), rel=EXACT)
    assert math.isnan(metrics.nrmse(bad_a, r))


def test_nothing_left_to_measure_is_not_a_number():
    e = metrics.errors(np.full((2, 3, 3), np.nan), np.ones((2, 3, 3)))
    assert all(math.isnan(x) for x in (e.nrmse, e.rel_mse, e.bias, e.psnr, e.ssim)) and e.n_not_finite == 6


def test_a_picture_below_the_window_has_no_ssim_but_the_rest():
    e = metrics.errors(np.full((10, 40, 3), 2.0), np.ones((10, 40, 3)))
    assert math.isnan(e.ssim) and e.nrmse == 1


def test_a_black_reference():
    black = np.zeros((12, 12, 3))
    e = metrics.errors(black + 0.5, black)
    assert (e.nrmse, e.bias, e.psnr, e.ssim) == (math.inf, math.inf, -math.inf, 0)
    assert e.rel_mse == pytest.approx(25, rel=EXACT)


@pytest.mark.parametrize("shape", [(4, 5, 3), (4, 4, 4), (4, 4)])
def test_pictures_of_another_shape_are_refused(shape: tuple[int, ...]):
    with pytest.raises(SvoError, match="Cannot compare"):
        metrics.errors(np.zeros(shape), np.zeros((4, 4, 3)))


def test_the_relative_difference_squares_to_rel_mse():
    a, r = noise((9, 7, 3), 6), noise((9, 7, 3), 7)
    assert np.mean(metrics.relative_difference(a, r) ** 2) == pytest.approx(metrics.rel_mse(a, r), rel=EXACT)


def test_the_heat_map_grows_lighter_with_the_difference_and_marks_the_rest_green():
    r = np.ones((1, 101, 3))
    a = r + np.linspace(0, 1.2, 101)[None, :, None]
    a[0, 100, 2] = np.inf
    colors = metrics.difference_heatmap(a, r)
    lightness = colors[0, :100] @ (0.2126, 0.7152, 0.0722)
    below_one = np.linspace(0, 1.2, 101)[:100] < math.sqrt(1.01)
    assert colors.dtype == np.float32 and colors.shape == (1, 101, 3)
    assert (np.diff(lightness[below_one]) > 0).all()
    assert np.allclose(colors[0, :100][~below_one], metrics.HEAT[-1])
    assert tuple(colors[0, 0]) == pytest.approx(tuple(metrics.HEAT[0])) and tuple(colors[0, 100]) == (0, 1, 0)
