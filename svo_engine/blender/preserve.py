# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of the user's scene that are changed for a while and come back exactly as they were."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import bpy


def change(until: ExitStack, owner: bpy.types.bpy_struct, **values: Any) -> None:
    """Set properties of `owner` in the order given; when `until` closes, they come back in that order.

    The same order both ways, because a property may limit what the next one can be (a file format its depth). One that
    was never set, and so only showed its default, is unset again. Names that this Blender does not know are left out.
    """
    values = {name: value for name, value in values.items() if name in owner.bl_rna.properties}
    for name in reversed(values):
        if owner.is_property_set(name):
            until.callback(setattr, owner, name, getattr(owner, name))
        else:
            until.callback(owner.property_unset, name)
    for name, value in values.items():
        setattr(owner, name, value)
