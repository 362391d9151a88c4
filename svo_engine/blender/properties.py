# SPDX-License-Identifier: GPL-3.0-or-later
"""`scene.svo`: the settings as Blender properties, built from the Specs of `settings.py`, which alone name them."""

from __future__ import annotations

from dataclasses import fields
from functools import lru_cache
from typing import Any

import bpy
import numpy as np

from ..settings import RenderSettings, Spec, specs

# Spec.unit -> how Blender shows a number of that unit; the units that it does not know stand in the label
_UNIT_OPTIONS: dict[str, dict[str, str]] = {
    "rad": {"subtype": "ANGLE"},
    "px": {"subtype": "PIXEL"},
    "s": {"unit": "TIME_ABSOLUTE"},
}

# With Blender's two digits 0.005 and 0.01 would look the same
_DIGITS = {"noise_threshold": 4, "viewport_noise_threshold": 4}


def defaults() -> dict[str, Any]:
    """Every setting's default by its name."""
    return {f.name: f.default for f in fields(RenderSettings) if f.name in specs()}


_DEFAULTS = defaults()


def settings_of(scene: bpy.types.Scene) -> RenderSettings:
    """The settings of `scene`, evaluated or original."""
    group = scene.svo
    return _settings(*(getattr(group, name) for name in _DEFAULTS))


@lru_cache(maxsize=8)
def _settings(*values: Any) -> RenderSettings:
    """Kept, as a viewport asks at each redraw."""
    return RenderSettings(**{name: _as_typed(value, _DEFAULTS[name])
                             for name, value in zip(_DEFAULTS, values, strict=True)})


def register() -> None:
    """Put the settings on every scene."""
    bpy.utils.register_class(SVOSceneSettings)
    bpy.types.Scene.svo = bpy.props.PointerProperty(type=SVOSceneSettings)


def unregister() -> None:
    """Take them away; what a file has stored stays in it."""
    del bpy.types.Scene.svo
    bpy.utils.unregister_class(SVOSceneSettings)


def _as_typed(value: Any, default: Any) -> Any:
    """The number that the user typed: Blender keeps 32 bits of it, which would miss a default or a limit by a hair."""
    if not isinstance(value, float):
        return value
    return default if np.float32(value) == np.float32(default) else float(str(np.float32(value)))


def _property(name: str, spec: Spec) -> Any:
    """The bpy property for one setting: its kind from the default, all else from the Spec."""
    default = defaults()[name]
    options: dict[str, Any] = {"name": spec.label, "description": spec.description, "default": default}
    if spec.choices:
        return bpy.props.EnumProperty(items=spec.choices, **options)
    if isinstance(default, bool):
        return bpy.props.BoolProperty(**options)
    if isinstance(default, int):
        return bpy.props.IntProperty(**options, **_limits(spec, int))
    if spec.unit and spec.unit not in _UNIT_OPTIONS:
        options["description"] += f" ({spec.unit})"
    options.update(_UNIT_OPTIONS.get(spec.unit, {}), precision=_DIGITS.get(name, 2))
    return bpy.props.FloatProperty(**options, **_limits(spec, float))


def _limits(spec: Spec, kind: type) -> dict[str, Any]:
    """`min` and `max` where the Spec has them."""
    limits = {"min": spec.low, "max": spec.high}
    return {name: kind(limit) for name, limit in limits.items() if limit is not None}


class SVOSceneSettings(bpy.types.PropertyGroup):
    """Settings of the SVO render engine."""

    __annotations__ = {name: _property(name, spec) for name, spec in specs().items()}
