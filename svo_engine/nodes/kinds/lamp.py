# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures of lamps."""

from __future__ import annotations

import numpy as np

from ..ies import read_ies
from ..reader import Reader
from . import Outputs, kind

WITHOUT_FILE = 100.0  # what Cycles gives for a file that is missing or broken


@kind("ShaderNodeTexIES")
def ies(n: Reader) -> Outputs:
    """The strength of a photometric file in the direction of a vector."""
    strength, found = n.number("Strength", 1.0), read_ies(str(n.setting("ies.text", "")))
    if found is None:
        n.warn("there is no photometric file that can be read; 100 is used, as in Cycles")
        return {"Fac": n.call("ies_without_file", strength, n.value(WITHOUT_FILE))}
    vector = n.vector("Vector", lambda: n.call("normal_in_object"))
    numbers = np.concatenate([found.across, found.down, found.strength.ravel()])
    size = n.value(float(len(found.across))), n.value(float(len(found.down)))
    return {"Fac": n.call("ies_strength", vector, strength, n.table(numbers.tolist()), *size)}
