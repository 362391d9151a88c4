# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a picture is from its reference: the field's measures, in scene-linear light.

Every function takes a picture `a` and its reference `r`, both (h, w, 3) floats, scene-linear, computes in f8 and
averages over pixels and channels. Numbers that are not finite go through to the result; `errors` leaves those pixels
out and counts them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .errors import SvoError

RELATIVE_FLOOR = 0.01  # of relMSE: keeps the error of nearly black pixels finite, (0.1)^2 in units of radiance
SSIM_WINDOW, SSIM_SIGMA, SSIM_K1, SSIM_K2 = 11, 1.5, 0.01, 0.03  # [Wang04]

# Heat map: sRGB-encoded colours for differences of 0, 0.2, ... 1, each lighter than the one before it
HEAT = np.array([(0.0, 0.0, 0.03), (0.20, 0.07, 0.44), (0.56, 0.14, 0.50), (0.89, 0.32, 0.34), (0.99, 0.66, 0.28),
                 (0.99, 0.98, 0.75)])
HEAT_NOT_FINITE = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Errors:
    """All measures of one picture against its reference, and how many pixels of each were not finite."""

    nrmse: float
    rel_mse: float
    bias: float
    psnr: float
    ssim: float
    n_not_finite: int
    n_reference_not_finite: int


def errors(a: np.ndarray, r: np.ndarray) -> Errors:
    """All measures over the pixels that are finite in both pictures (SSIM: over the windows that are).

    SvoError if the pictures differ in size; measures are nan where no pixel is left, SSIM also below 11 x 11 pixels.
    """
    if a.shape != r.shape or a.ndim != 3 or a.shape[2] != 3:
        raise SvoError(f"Cannot compare a picture of {a.shape} with one of {r.shape}: both must be (height, width, 3)")
    bad_a, bad_r = (~np.isfinite(image).all(2) for image in (a, r))
    good = ~(bad_a | bad_r)
    counts = int(bad_a.sum()), int(bad_r.sum())
    if not good.any():
        return Errors(math.nan, math.nan, math.nan, math.nan, math.nan, *counts)
    peak = float(r[good].max())
    similarity = ssim_map(a, r, peak)
    similarity = similarity[np.isfinite(similarity).all(2)]
    return Errors(nrmse(a[good], r[good]), rel_mse(a[good], r[good]), bias(a[good], r[good]), psnr(a[good], r[good]),
                  float(similarity.mean()) if similarity.size else math.nan, *counts)


def nrmse(a: np.ndarray, r: np.ndarray) -> float:
    """Root mean square error over the reference's mean."""
    return _ratio(_rmse(a, r), float(np.mean(r, dtype="f8")))


def rel_mse(a: np.ndarray, r: np.ndarray) -> float:
    """Mean of (a - r)^2 / (r^2 + 0.01): every pixel's error against its own brightness."""
    return float(np.mean(_rel_square(a, r)))


def bias(a: np.ndarray, r: np.ndarray) -> float:
    """Mean of a - r over the reference's mean: above 0, the picture is too bright."""
    return _ratio(float(np.mean(np.subtract(a, r, dtype="f8"))), float(np.mean(r, dtype="f8")))


def psnr(a: np.ndarray, r: np.ndarray) -> float:
    """Peak signal to noise ratio in dB. The peak is the reference's largest value, as usual for scene-linear light.

    inf for equal pictures, -inf for a black reference.
    """
    ratio = _ratio(float(np.max(r)), _rmse(a, r))
    if np.array_equal(a, r):
        return math.inf
    return 20 * math.log10(ratio) if ratio > 0 else -math.inf


def ssim(a: np.ndarray, r: np.ndarray) -> float:
    """Mean structural similarity [Wang04], -1 to 1. The range of values L is the reference's largest value."""
    return float(ssim_map(a, r, float(np.max(r))).mean())


def ssim_map(a: np.ndarray, r: np.ndarray, value_range: float) -> np.ndarray:
    """SSIM of every 11 x 11 Gaussian window (sigma 1.5) that lies inside the picture, each channel by itself.

    Returns (h - 10, w - 10, 3) f8, empty for a picture that is smaller. Linear light: no gamma, no luminance weights.
    """
    x, y = np.asarray(a, "f8"), np.asarray(r, "f8")
    c1, c2 = (SSIM_K1 * value_range) ** 2, (SSIM_K2 * value_range) ** 2
    with np.errstate(invalid="ignore", over="ignore"):
        mean_x, mean_y = _blur(x), _blur(y)
        var_x, var_y = _blur(x * x) - mean_x**2, _blur(y * y) - mean_y**2
        covariance = _blur(x * y) - mean_x * mean_y
        above = (2 * mean_x * mean_y + c1) * (2 * covariance + c2)
        below = (mean_x**2 + mean_y**2 + c1) * (var_x + var_y + c2)
        return np.divide(above, below, out=np.ones_like(below), where=below != 0)


def relative_difference(a: np.ndarray, r: np.ndarray) -> np.ndarray:
    """Every pixel's own root of relMSE, (h, w) f8: 0.5 means off by about half of the reference's brightness."""
    return np.sqrt(_rel_square(a, r).mean(2))


def difference_heatmap(a: np.ndarray, r: np.ndarray) -> np.ndarray:
    """`relative_difference` as colours, (h, w, 3) f4, sRGB-encoded: from black at 0 to light yellow at 1 and above.

    Pixels that are not finite are pure green, which the colour map does not have.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        difference = relative_difference(a, r)
    known = np.isfinite(difference)
    stops = np.linspace(0, 1, len(HEAT))
    colors = np.stack([np.interp(np.where(known, difference, 0), stops, channel) for channel in HEAT.T], 2)
    colors[~known] = HEAT_NOT_FINITE
    return colors.astype("f4")


def _rmse(a: np.ndarray, r: np.ndarray) -> float:
    return math.sqrt(np.mean(np.subtract(a, r, dtype="f8") ** 2))


def _rel_square(a: np.ndarray, r: np.ndarray) -> np.ndarray:
    return np.subtract(a, r, dtype="f8") ** 2 / (np.asarray(r, "f8") ** 2 + RELATIVE_FLOOR)


def _ratio(x: float, y: float) -> float:
    """x / y where nothing over nothing is no error: 0; anything else over 0 is infinite."""
    if y != 0:
        return x / y
    return 0.0 if x == 0 else math.copysign(math.inf, x)


def _blur(image: np.ndarray) -> np.ndarray:
    """Gaussian mean over every whole window, one axis after the other: (h, w, c) to (h - 10, w - 10, c)."""
    offsets = np.arange(SSIM_WINDOW) - SSIM_WINDOW // 2
    weights = np.exp(-(offsets**2) / (2 * SSIM_SIGMA**2))
    weights /= weights.sum()
    n_rows, n_columns = (max(n - SSIM_WINDOW + 1, 0) for n in image.shape[:2])
    rows = sum(w * image[i : i + n_rows] for i, w in enumerate(weights))
    return sum(w * rows[:, i : i + n_columns] for i, w in enumerate(weights))
