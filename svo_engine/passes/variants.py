# SPDX-License-Identifier: GPL-3.0-or-later
"""The constants of shaders that the host may set. Each of them doubles the programs that are to be compiled.

No other one is set: what a scene needs is told by uniforms, and by dispatches that are not made, so that no edit
compiles anything.
"""

from __future__ import annotations

# Constant -> why it is worth its variants, and what was measured. They differ by device, never by scene
VARIANTS = {
    "IN_LOCKSTEP": "branches that no ray takes cost a software renderer time too; shadow rays on a graphics card are a "
                   "third quicker without the inner loop",
}


def variant_of(is_software: bool) -> dict[str, bool]:
    """The constants of all programs that trace rays, on one kind of device."""
    return {"IN_LOCKSTEP": is_software}
