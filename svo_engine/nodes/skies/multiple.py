# SPDX-License-Identifier: GPL-3.0-or-later
"""The sky with multiple scattering [GarciaLinan24]: four wavelengths that stand for the spectrum, sunlight that is
scattered once, and a fit for all that is scattered more often or comes from the ground. As Blender 5.0 has it: its
densities, fits and steps are the model's own figures.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

EARTH, THICKNESS = 6371.0, 100.0  # kilometres
GROUND = 0.3  # albedo
FORWARD = 0.8  # asymmetry of aerosols
STEPS = 64
WIDE, HIGH = 256, 64  # of the table of transmittances: cosines of the sun's zenith angle, altitudes
LOWEST, HIGHEST = 1e-3, 99.999  # km of the viewer's altitude

# At 630, 560, 490 and 430 nm: irradiance above the atmosphere, scattering by molecules [km^-1], absorption by ozone
# and by aerosols, scattering by aerosols; and what a spectrum of those looks like in CIE XYZ
SUN = np.array((1.679, 1.828, 1.986, 1.307))
MOLECULES = np.array((6.605e-3, 1.067e-2, 1.842e-2, 3.156e-2))
OZONE = 334.5 * np.array((3.472e-25, 3.914e-25, 1.349e-25, 1.103e-26))
AEROSOL_ABSORBS = np.array((2.8722e-24, 4.6168e-24, 7.9706e-24, 1.3578e-23))
AEROSOL_SCATTERS = np.array((1.5908e-22, 1.7711e-22, 2.0942e-22, 2.4033e-22))
AEROSOL_DENSITY, AEROSOL_EVERYWHERE, AEROSOL_SCALE = 1.3681e20, 2e6, 0.73
OBSERVER = np.array(((53.386917739, 22.981337507, 0.0), (43.904844466, 71.347795700, 0.102506868),
                     (1.613727825, 18.422960591, 31.742921188), (20.762668674, 2.361421352, 110.480096433)))
MANY = 0.02 * np.array((0.217, 0.347, 0.594, 1.0))

Densities = tuple[float, float, float]


def sky(elevations: np.ndarray, azimuths: np.ndarray, sun_elevation: float, altitude: float,
        densities: Densities) -> np.ndarray:
    """CIE XYZ (n_elevations, n_azimuths, 3) f4, as `single.sky`; directions may look down to the ground."""
    table = _transmittances(densities)
    distance = EARTH + _clamped(altitude)
    rows = [_row(e, azimuths, sun_elevation, distance, densities, table) for e in np.asarray(elevations)]
    return np.array(rows, "f4").reshape(len(rows), len(azimuths), 3)


def sun(elevation: float, size: float, altitude: float, densities: Densities) -> np.ndarray:
    """As `single.sun`."""
    ends = np.sin(elevation + np.array((-0.5, 0.5)) * size)
    seen = _transmittance(ends, np.full(2, _clamped(altitude)), densities)
    return seen * SUN @ OBSERVER / (2 * np.pi * (1 - np.cos(size / 2)))


def _clamped(altitude: float) -> float:
    return min(max(altitude / 1000, LOWEST), HIGHEST)


def _row(elevation: float, azimuths: np.ndarray, sun_elevation: float, distance: float, densities: Densities,
         table: np.ndarray) -> np.ndarray:
    """XYZ (m, 3) in directions of one elevation, whose steps lie at the same heights at every azimuth."""
    up, across = np.sin(elevation), np.cos(elevation)
    step = _length(distance, up) / STEPS
    along = (np.arange(STEPS) + 0.5) * step
    radius = np.sqrt(distance**2 + along**2 + 2 * distance * along * up)
    height = np.maximum(radius - EARTH, 0.0)
    absorbs, molecules, aerosol = _coefficients(height, densities)
    extinction = np.maximum(absorbs + molecules + aerosol, 1e-7)
    passed = np.exp(-extinction * step)
    # The share of each step's light that gets here, and what the step itself makes of it
    weight = np.concatenate([np.ones((1, 4)), np.cumprod(passed, 0)[:-1]]) * (1 - passed) / extinction * SUN
    cosine = up * np.sin(sun_elevation) + across * np.cos(sun_elevation) * np.cos(azimuths)
    sun_up = ((distance * np.sin(sun_elevation) + along * cosine[:, None]) / radius).astype("f4")
    to_sun = _looked_up(table, sun_up, height / THICKNESS)
    once = (weight * molecules * _phase_molecules(cosine)[:, None, None]
            + weight * aerosol * _phase_aerosol(cosine)[:, None, None]).astype("f4")
    light = (once * to_sun).sum(1) + _often(table, sun_up, height, radius, weight * (molecules + aerosol))
    return light @ OBSERVER


def _often(table: np.ndarray, sun_up: np.ndarray, height: np.ndarray, radius: np.ndarray,
           weight: np.ndarray) -> np.ndarray:
    """Light (m, 4) that has been scattered more than once: from the ground, and by a fit from everywhere else."""
    covered = 2 * np.pi * (1 - np.sqrt(np.maximum(1 - (EARTH / radius) ** 2, 0.0)))  # solid angle of the Earth
    overhead = _rows_at(table, height / THICKNESS)[:, -1]
    ground = (covered * GROUND / (4 * np.pi**2))[:, None] * table[0, -1] / overhead
    lit = _columns_at(table[0], sun_up) * sun_up[..., None]
    rest = 1 / (1 + 5 * np.exp(-17.92 * sun_up))
    return np.einsum("msw,sw->mw", lit, (weight * ground).astype("f4")) + (rest @ weight.astype("f4")) * MANY


def _length(radius: float, up: float) -> float:
    """Kilometres to the ground or to the top of the atmosphere."""
    b = radius * up
    to_ground = b * b - radius**2 + EARTH**2
    if b < 0 and to_ground >= 0:
        return float(-b - np.sqrt(to_ground))
    return float(np.sqrt(b * b - radius**2 + (EARTH + THICKNESS) ** 2) - b)


def _coefficients(height: np.ndarray, densities: Densities) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """At heights (...) [km]: what absorbs, molecules that scatter, aerosols that scatter, each (..., 4) [km^-1]."""
    h = height[..., None]
    air, aerosol, ozone = densities
    particles = aerosol * AEROSOL_DENSITY * (np.exp(-h / AEROSOL_SCALE) + AEROSOL_EVERYWHERE / AEROSOL_DENSITY)
    log = np.log(np.maximum(h, 1e-4))
    of_ozone = ozone * 3.78547397e20 * np.exp(-(5.55555555 * (log - 3.22261) ** 2) - log)
    molecules = air * MOLECULES * np.exp(-0.07771971 * h**1.16364243)
    return AEROSOL_ABSORBS * particles + OZONE * of_ozone, molecules, AEROSOL_SCATTERS * particles


@lru_cache(maxsize=4)
def _transmittances(densities: Densities) -> np.ndarray:
    """(HIGH, WIDE, 4) f4: from altitudes 0 to the top, towards suns from the nadir to the zenith."""
    sun_up, height = np.meshgrid(np.linspace(-1, 1, WIDE), np.linspace(0, THICKNESS, HIGH))
    return _transmittance(sun_up, height, densities).astype("f4")


def _transmittance(sun_up: np.ndarray, height: np.ndarray, densities: Densities) -> np.ndarray:
    """(..., 4) from those heights [km] out of the atmosphere; the Earth is in nobody's way."""
    radius = EARTH + height
    b = radius * sun_up
    step = (np.sqrt(np.maximum(b * b - radius**2 + (EARTH + THICKNESS) ** 2, 0.0)) - b) / STEPS
    depth = np.zeros((*sun_up.shape, 4))
    for i in range(STEPS):
        along = (i + 0.5) * step
        at = np.sqrt(np.maximum(radius**2 + along**2 + 2 * along * b, 0.0)) - EARTH
        depth += sum(_coefficients(np.maximum(at, 0.0), densities)) * step[..., None]
    return np.exp(-depth)


def _looked_up(table: np.ndarray, sun_up: np.ndarray, height: np.ndarray) -> np.ndarray:
    """(m, steps, 4): table at sun_up (m, steps) and heights (steps,) of 0 to 1."""
    rows, steps = _rows_at(table, height), np.arange(len(height))
    x = np.clip(sun_up * 0.5 + 0.5, 0, 1) * (WIDE - 1)
    low = np.minimum(x.astype("i4"), WIDE - 2)
    share = (x - low)[..., None]
    return rows[steps, low] * (1 - share) + rows[steps, low + 1] * share


def _rows_at(table: np.ndarray, height: np.ndarray) -> np.ndarray:
    """(steps, WIDE, 4)."""
    y = np.clip(height, 0, 1) * (HIGH - 1)
    low = np.minimum(y.astype("i4"), HIGH - 2)
    share = (y - low).astype("f4")[:, None, None]
    return table[low] * (1 - share) + table[low + 1] * share


def _columns_at(row: np.ndarray, sun_up: np.ndarray) -> np.ndarray:
    """(m, steps, 4): a row of the table at sun_up (m, steps)."""
    x = np.clip(sun_up * 0.5 + 0.5, 0, 1) * (WIDE - 1)
    low = np.minimum(x.astype("i4"), WIDE - 2)
    share = (x - low)[..., None]
    return row[low] * (1 - share) + row[low + 1] * share


def _phase_molecules(cosine: np.ndarray) -> np.ndarray:
    return 3 / (16 * np.pi) * (1 + cosine**2)


def _phase_aerosol(cosine: np.ndarray) -> np.ndarray:
    g2 = FORWARD**2
    return (1 - g2) / (4 * np.pi * (1 + g2 - 2 * FORWARD * cosine) ** 1.5)
