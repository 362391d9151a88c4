# SPDX-License-Identifier: GPL-3.0-or-later
"""The sky by single scattering [Nishita93]: sunlight that is scattered once in a spherical atmosphere of air, aerosols
and ozone, at 21 wavelengths, as Cycles has it: its densities, steps and spectra are the model's own figures.
"""

from __future__ import annotations

import numpy as np

EARTH = 6360e3  # metres
TOP = 6420e3  # of the atmosphere
SCALE_AIR, SCALE_AEROSOL = 8e3, 1.2e3  # heights [m] in which density falls to 1/e
OZONE_MIDDLE, OZONE_HALF = 25e3, 15e3  # metres
AEROSOL = 2e-5  # scattering [m^-1]; extinction is 1.11 times as much
FORWARD = 0.76  # asymmetry of aerosols
STEPS = 32
HIGHEST = 59999.0  # metres of the viewer's altitude

# From 380 to 780 nm by 20: irradiance above the atmosphere [W m^-2 nm^-1], scattering by air and absorption by ozone
# [m^-1], and the CIE 1931 colour matching functions
SUN = np.array((
    1.457568, 1.565963, 1.651484, 1.714962, 1.757980, 1.782564, 1.790951, 1.785416, 1.768156, 1.741221, 1.706471,
    1.665561, 1.619934, 1.570836, 1.519323, 1.466285, 1.412459, 1.358450, 1.304749, 1.251750, 1.199760), "f4")
AIR = 1e-6 * np.array((
    54.24820, 44.18550, 36.35152, 30.17929, 25.26320, 21.30859, 18.09838, 15.47057, 13.30285, 11.50185, 9.995574,
    8.728000, 7.655137, 6.742172, 5.961341, 5.290346, 4.711157, 4.209105, 3.772184, 3.390513, 3.055915), "f4")
OZONE = 1e-9 * np.array((
    3.251268, 5.853954, 19.77191, 73.09569, 200.8456, 403.8396, 635.5134, 967.0704, 1547.974, 2090.386, 2461.281,
    2735.513, 2151.259, 1590.518, 1123.562, 735.2755, 464.5013, 330.9608, 225.1261, 148.7913, 168.2862), "f4")
OBSERVER = np.array((
    (0.001368, 0.000039, 0.006450), (0.014310, 0.000396, 0.067850), (0.134380, 0.004000, 0.645600),
    (0.348280, 0.023000, 1.747060), (0.290800, 0.060000, 1.669200), (0.095640, 0.139020, 0.812950),
    (0.004900, 0.323000, 0.272000), (0.063270, 0.710000, 0.078250), (0.290400, 0.954000, 0.020300),
    (0.594500, 0.995000, 0.003900), (0.916300, 0.870000, 0.001650), (1.062200, 0.631000, 0.000800),
    (0.854450, 0.381000, 0.000190), (0.447900, 0.175000, 0.000020), (0.164900, 0.061000, 0.0),
    (0.046770, 0.017000, 0.0), (0.011359, 0.004102, 0.0), (0.002899, 0.001047, 0.0),
    (0.000690, 0.000249, 0.0), (0.000166, 0.000060, 0.0), (0.000042, 0.000015, 0.0)), "f4") * 20.0

# Gauss-Laguerre of 8 points over 25 units of exponential decay, as shares of a ray
_NODES, _WEIGHTS = np.polynomial.laguerre.laggauss(8)  # type: ignore[no-untyped-call]
NODES, WEIGHTS = _NODES / 25.0, _WEIGHTS * np.exp(_NODES) / 25.0


def sky(elevations: np.ndarray, azimuths: np.ndarray, sun_elevation: float, altitude: float,
        densities: tuple[float, float, float]) -> np.ndarray:
    """CIE XYZ (n_elevations, n_azimuths, 3) f4 of the sky in those directions.

    elevations  (n,) f8, radians above the horizon; azimuths  (m,) f8, radians from the sun's
    altitude    metres of the viewer
    densities   of air, aerosols and ozone: factors, 1 is usual
    """
    distance = EARTH + _clamped(altitude)
    rows = [_row(e, azimuths, sun_elevation, distance, np.asarray(densities)) for e in np.asarray(elevations)]
    return np.array(rows, "f4").reshape(len(rows), len(azimuths), 3)


def sun(elevation: float, size: float, altitude: float, densities: tuple[float, float, float]) -> np.ndarray:
    """CIE XYZ (2, 3) f8 of the lowest and the highest point of the sun's disc of angular diameter `size` [rad]."""
    ends = np.maximum(elevation + np.array((-0.5, 0.5)) * size, 0.0)
    if ends[1] <= 0.0:
        return np.zeros((2, 3))
    distance = EARTH + _clamped(altitude)
    depth = _depth(np.full(2, distance), np.sin(ends)) * (densities[0], densities[1], 0.0)
    return _seen(depth) * SUN @ OBSERVER / (2 * np.pi * (1 - np.cos(size / 2)))


def _clamped(altitude: float) -> float:
    return min(max(altitude, 1.0), HIGHEST)


def _row(elevation: float, azimuths: np.ndarray, sun_elevation: float, distance: float,
         densities: np.ndarray) -> np.ndarray:
    """XYZ (m, 3) in directions of one elevation, whose steps lie at the same heights at every azimuth."""
    up, across = np.sin(elevation), np.cos(elevation)
    step = _length(distance, up) / STEPS
    along = (np.arange(STEPS) + 0.5) * step
    radius = np.sqrt(distance**2 + along**2 + 2 * distance * along * up)
    density = _density(radius - EARTH) * densities
    cosine = up * np.sin(sun_elevation) + across * np.cos(sun_elevation) * np.cos(azimuths)
    # Of the sun, above the horizon of each step: (m, STEPS)
    sun_up = (distance * np.sin(sun_elevation) + along * cosine[:, None]) / radius
    is_lit = (sun_up >= 0) | (radius * np.sqrt(np.maximum(1 - sun_up**2, 0)) > EARTH)
    depth = np.cumsum(density, 0) * step + _depth(np.broadcast_to(radius, sun_up.shape), sun_up) * densities
    air, aerosol = density[:, 0] * _phase_air(cosine)[:, None], density[:, 1] * _phase_aerosol(cosine)[:, None]
    seen = _seen(depth) * (is_lit * step)[..., None]
    spectrum = np.einsum("ms,msw->mw", air, seen) * AIR + np.einsum("ms,msw->mw", aerosol, seen) * AEROSOL
    return (spectrum * SUN) @ OBSERVER


def _length(radius: np.ndarray | float, up: np.ndarray | float) -> np.ndarray:
    """Metres from that distance to the Earth's centre to the top, in a direction whose sine of elevation is `up`."""
    b = np.multiply(radius, up)
    return np.sqrt(np.maximum(b**2 - np.square(radius) + TOP**2, 0.0)) - b


def _depth(radius: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Metres of air, aerosols and ozone (..., 3) at density 1 on the way out of the atmosphere."""
    length = _length(radius, up)
    along = length[..., None] * NODES
    r = radius[..., None]
    height = np.sqrt(r**2 + along**2 + 2 * r * along * up[..., None]) - EARTH
    return np.einsum("...qk,q->...k", _density(height), WEIGHTS) * length[..., None]


def _density(height: np.ndarray) -> np.ndarray:
    """Of air, aerosols and ozone (..., 3) f4 at heights [m]."""
    h = height.astype("f4")
    ozone = np.maximum(1 - np.abs(h - OZONE_MIDDLE) / OZONE_HALF, 0)
    return np.stack([np.exp(-h / SCALE_AIR), np.exp(-h / SCALE_AEROSOL), ozone], -1)


def _seen(depth: np.ndarray) -> np.ndarray:
    """Transmittance (..., 21) of so much air, aerosols and ozone."""
    per_metre = np.stack([AIR, np.full_like(AIR, 1.11 * AEROSOL), OZONE])
    return np.exp(-(depth.astype("f4") @ per_metre))


def _phase_air(cosine: np.ndarray) -> np.ndarray:
    return 3 / (16 * np.pi) * (1 + cosine**2)


def _phase_aerosol(cosine: np.ndarray) -> np.ndarray:
    g2 = FORWARD**2
    scale = 3 * (1 - g2) / (8 * np.pi * (2 + g2))
    return scale * (1 + cosine**2) / (1 + g2 - 2 * FORWARD * cosine) ** 1.5
