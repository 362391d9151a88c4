# SPDX-License-Identifier: GPL-3.0-or-later
"""The two renders of a comparison: which engine, with which settings, and what a report says of them.

Left as they are, because the user chose them or because a difference there is true: caustics, depth of field, motion
blur, transparent film, the device.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import bpy

from ..errors import SvoError
from . import session
from .properties import settings_of

# For Cycles: nothing that hides noise, drops light or weighs pixels in another way than our own film does
_CYCLES = {"pixel_filter_type": "BLACKMAN_HARRIS", "film_exposure": 1.0, "use_adaptive_sampling": False,
           "use_denoising": False, "time_limit": 0.0, "use_layer_samples": "IGNORE", "use_sample_subset": False,
           "sample_offset": 0, "sample_clamp_direct": 0.0, "sample_clamp_indirect": 0.0, "use_fast_gi": False}
_CYCLES_BOUNCES = ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "volume_bounces")
_CYCLES_AS_SET = ("transparent_max_bounces", "caustics_reflective", "caustics_refractive", "blur_glossy",
                  "light_sampling_threshold", "seed")


@dataclass(frozen=True)
class Run:
    """One engine's render. `values` are set on its own settings, `getattr(scene, group)`, as long as it takes.

    name      of its files, without ending
    describe  called right after the render, the settings still in place: what the report says
    """

    name: str
    engine: str
    group: str
    values: Mapping[str, Any]
    describe: Callable[[bpy.types.Scene], dict[str, Any]]


def svo_run() -> Run:
    """Our engine with the scene's own settings."""
    return Run("svo", "SVO_ENGINE", "svo", {}, _describe_svo)


def cycles_run(scene: bpy.types.Scene, samples: int, bounces: int | None = None) -> Run:
    """Cycles with our pixel filter; `bounces` of every kind, None: as Cycles' own settings have them."""
    values = _CYCLES | {"samples": samples, "filter_width": settings_of(scene).filter_width}
    if bounces is not None:
        values |= dict.fromkeys(_CYCLES_BOUNCES, bounces)
    return Run("cycles", "CYCLES", "cycles", values, describe_cycles)


def _describe_svo(scene: bpy.types.Scene) -> dict[str, Any]:
    if not session.last_stats:
        raise SvoError("SVO ended without a picture")
    return {"settings": asdict(settings_of(scene)), **session.last_stats}


def describe_cycles(scene: bpy.types.Scene) -> dict[str, Any]:
    """Cycles' settings that decide how the picture looks, and the device that it was told to use."""
    names = [*_CYCLES, "samples", "filter_width", *_CYCLES_BOUNCES, *_CYCLES_AS_SET]
    api = bpy.context.preferences.addons["cycles"].preferences.compute_device_type
    return {"settings": {name: getattr(scene.cycles, name) for name in names if hasattr(scene.cycles, name)},
            "device": f"GPU ({api})" if scene.cycles.device == "GPU" and api != "NONE" else "CPU"}
