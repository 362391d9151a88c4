# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of wavelengths and of glowing bodies, in linear Rec. 709, as tables for shaders/nodes/spectrum.glsl."""

from __future__ import annotations

from functools import cache

import numpy as np

# The colour matching functions of the CIE 1931 standard observer, from 380 to 780 nm every 5 nm: x, y, z
_MATCHING_TEXT = """
.0014 .0000 .0065  .0022 .0001 .0105  .0042 .0001 .0201  .0076 .0002 .0362  .0143 .0004 .0679  .0232 .0006 .1102
.0435 .0012 .2074  .0776 .0022 .3713  .1344 .0040 .6456  .2148 .0073 1.0391 .2839 .0116 1.3856 .3285 .0168 1.6230
.3483 .0230 1.7471 .3481 .0298 1.7826 .3362 .0380 1.7721 .3187 .0480 1.7441 .2908 .0600 1.6692 .2511 .0739 1.5281
.1954 .0910 1.2876 .1421 .1126 1.0419 .0956 .1390 .8130  .0580 .1693 .6162  .0320 .2080 .4652  .0147 .2586 .3533
.0049 .3230 .2720  .0024 .4073 .2123  .0093 .5030 .1582  .0291 .6082 .1117  .0633 .7100 .0782  .1096 .7932 .0573
.1655 .8620 .0422  .2257 .9149 .0298  .2904 .9540 .0203  .3597 .9803 .0134  .4334 .9950 .0087  .5121 1.0000 .0057
.5945 .9950 .0039  .6784 .9786 .0027  .7621 .9520 .0021  .8425 .9154 .0018  .9163 .8700 .0017  .9786 .8163 .0014
1.0263 .7570 .0011 1.0567 .6949 .0010 1.0622 .6310 .0008 1.0456 .5668 .0006 1.0026 .5030 .0003 .9384 .4412 .0002
.8544 .3810 .0002  .7514 .3210 .0001  .6424 .2650 .0000  .5419 .2170 .0000  .4479 .1750 .0000  .3608 .1382 .0000
.2835 .1070 .0000  .2187 .0816 .0000  .1649 .0610 .0000  .1212 .0446 .0000  .0874 .0320 .0000  .0636 .0232 .0000
.0468 .0170 .0000  .0329 .0119 .0000  .0227 .0082 .0000  .0158 .0057 .0000  .0114 .0041 .0000  .0081 .0029 .0000
.0058 .0021 .0000  .0041 .0015 .0000  .0029 .0010 .0000  .0020 .0007 .0000  .0014 .0005 .0000  .0010 .0004 .0000
.0007 .0002 .0000  .0005 .0002 .0000  .0003 .0001 .0000  .0002 .0001 .0000  .0002 .0001 .0000  .0001 .0000 .0000
.0001 .0000 .0000  .0001 .0000 .0000  .0000 .0000 .0000
"""
_MATCHING = np.array(_MATCHING_TEXT.split(), "f8").reshape(-1, 3)
_FIRST, _STEP = 380.0, 5.0  # nm
_RGB_OF_XYZ = np.array([[3.2409699, -1.5373832, -0.4986108], [-0.9692436, 1.8759675, 0.0415551],
                        [0.0556301, -0.2039770, 1.0569715]])
_BRIGHTEST = 2.52  # Cycles' measure of wavelengths, which leaves their colours below 1

BLACKBODY_RANGE = 800.0, 12000.0  # K
BLACKBODY_SIZE = 256
_SECOND_RADIATION = 1.4387769e-2  # m K: h c / k


@cache
def wavelength_table() -> np.ndarray:
    """(243,) f8: RGB at each wavelength of the table; negative parts are cut off when it has been looked up."""
    return (_MATCHING @ _RGB_OF_XYZ.T / _BRIGHTEST).ravel()


def wavelength_at(wavelength: float) -> tuple[float, ...]:
    """RGB of a wavelength [nm]; black where nothing is seen."""
    x = (wavelength - _FIRST) / _STEP
    if x <= -1 or x >= len(_MATCHING) - 1:
        return 0.0, 0.0, 0.0
    i, table = max(int(x), 0), wavelength_table().reshape(-1, 3)
    return tuple(map(float, np.maximum(table[i] + (x - i) * (table[i + 1] - table[i]), 0)))


@cache
def blackbody_table() -> np.ndarray:
    """(3 * BLACKBODY_SIZE,) f8: RGB at temperatures that are even in one over them."""
    cold, hot = (1 / t for t in BLACKBODY_RANGE)
    temperatures = 1 / np.linspace(cold, hot, BLACKBODY_SIZE)
    return np.concatenate([_glow(t) for t in temperatures])


def blackbody_at(temperature: float) -> tuple[float, ...]:
    """RGB of a body of that temperature [K], of luminance 1."""
    return tuple(map(float, np.maximum(_glow(float(np.clip(temperature, *BLACKBODY_RANGE))), 0)))


def _glow(temperature: float) -> np.ndarray:
    """Planck's law, seen by the standard observer, over its luminance."""
    wavelengths = (_FIRST + _STEP * np.arange(len(_MATCHING))) * 1e-9
    radiance = wavelengths**-5 / np.expm1(_SECOND_RADIATION / (wavelengths * temperature))
    xyz = radiance @ _MATCHING
    return _RGB_OF_XYZ @ (xyz / xyz[1])
