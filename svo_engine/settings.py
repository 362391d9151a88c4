# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything a user can set, once: default, range, unit, a sentence. The UI and the command line are built from it."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from typing import Any

from .errors import SvoError


@dataclass(frozen=True)
class Spec:
    """What the UI must know of a setting beyond its default. `choices`: (identifier, label, sentence) of an enum."""

    label: str
    description: str
    group: str
    low: float | None = None
    high: float | None = None
    unit: str = ""
    choices: tuple[tuple[str, str, str], ...] = ()


def _setting(default: Any, label: str, description: str, group: str, **more: Any) -> Any:
    return field(default=default, metadata={"spec": Spec(label, description, group, **more)})


METHODS = (
    ("rays", "Rays", "Rays with exact hits, lit from an octree: accurate"),
    ("cones", "Cones", "Filtered voxels, gathered by cone tracing: smooth, quick, approximate"),
)
CACHE_RESOLUTIONS = tuple((str(n), f"{n}\u00b3", f"{n} voxels along the longest side of the scene")
                          for n in (32, 64, 128, 256, 512, 1024))
RESOLUTIONS = CACHE_RESOLUTIONS[:4]
DENOISERS = (
    ("automatic", "Automatic", "OpenImageDenoise where it runs on the device that draws, else the wavelet"),
    ("openimagedenoise", "OpenImageDenoise", "Blender's own neural filter, as in Cycles: the least error"),
    ("atrous", "A-Trous Wavelet", "On the graphics card, for diffuse and glossy light: no library, a millisecond"),
)
QUALITIES = (
    ("high", "High", "The least error"),
    ("balanced", "Balanced", "Between the other two"),
    ("fast", "Fast", "The quickest: a quarter of the time"),
)
VIEWS = (
    ("combined", "Combined", "The picture"),
    ("cache_albedo", "Light Cache Albedo", "The surfels that hold the light, showing the colour of their surfaces"),
    ("cache", "Light Cache", "The surfels that hold the light, showing what they send out"),
    ("voxel_albedo", "Voxel Albedo", "The voxels themselves, showing the colour of their surfaces"),
    ("voxel_normal", "Voxel Normal", "The voxels themselves, showing the direction of their surfaces as XYZ = RGB"),
    ("voxel_radiance", "Voxel Radiance", "The voxels themselves, showing the light that they send out"),
    ("voxel_coverage", "Voxel Coverage", "The voxels themselves, showing how much of them the surfaces fill"),
)

# Render passes that can be had beside Combined, as Blender and Cycles name them -> a letter for each channel
PASSES = {"Depth": "Z", "Position": "XYZ", "Normal": "XYZ",
          **{f"{kind} {part}": "RGB" for kind in ("Diffuse", "Glossy", "Transmission")
             for part in ("Direct", "Indirect", "Color")},
          "Emission": "RGB", "Environment": "RGB", "Noisy Image": "RGBA", "Denoising Normal": "XYZ",
          "Denoising Albedo": "RGB", "Denoising Depth": "Z"}


@dataclass(frozen=True)
class Lines:
    """Outlines. thickness: pixels; color: scene-linear; crease_angle: radians between two faces whose edge is drawn."""

    thickness: float = 1.5
    color: tuple[float, float, float] = (0.0, 0.0, 0.0)
    silhouettes: bool = True
    creases: bool = True
    crease_angle: float = 0.7853981633974483
    materials: bool = True
    objects: bool = True


@dataclass(frozen=True)
class RenderSettings:
    """One render's settings. Angles in radians, lengths in voxels where the label says so.

    passes  those of PASSES that are wanted; Blender asks for them by view layer, so that no panel is made of this
    lines   outlines, likewise of the view layer; None for none
    """

    method: str = _setting("rays", "Method", "How indirect light is gathered", "Sampling", choices=METHODS)
    samples: int = _setting(16, "Samples", "Pictures with shifted pixel centres that are averaged into the final one",
                            "Sampling", low=1, high=65536)
    adaptive_sampling: bool = _setting(True, "Use Adaptive Sampling",
                                       "Take no more samples where the noise is below the threshold", "Sampling")
    noise_threshold: float = _setting(0.01, "Noise Threshold",
                                      "Noise at which sampling stops: lower is cleaner and slower; 0 means automatic, "
                                      "by the number of samples", "Sampling", low=0, high=1)
    min_samples: int = _setting(0, "Min Samples",
                                "Samples before any part of the picture may stop, so that rare light is found; 0 means "
                                "automatic, by the noise threshold", "Sampling", low=0, high=4096)
    viewport_adaptive_sampling: bool = _setting(True, "Use Viewport Adaptive Sampling",
                                                "The same in the viewport", "Sampling")
    viewport_noise_threshold: float = _setting(0.1, "Viewport Noise Threshold", "The same in the viewport",
                                               "Sampling", low=0, high=1)
    viewport_min_samples: int = _setting(0, "Viewport Min Samples", "The same in the viewport", "Sampling", low=0,
                                         high=4096)
    viewport_samples: int = _setting(16, "Viewport Samples", "Samples after which a resting viewport stops", "Sampling",
                                     low=1, high=65536)
    time_limit: float = _setting(0.0, "Time Limit", "Seconds after which no new sample is begun; 0 means no limit",
                                 "Sampling", low=0, high=86400, unit="s")
    seed: int = _setting(0, "Seed", "Another number gives another pattern of noise", "Sampling", low=0, high=2**31 - 1)
    gather_rays: int = _setting(2, "Diffuse Rays", "Rays of each pixel and sample that look for indirect light", "Rays",
                                low=1, high=16)
    cache_resolution: str = _setting("128", "Light Cache",
                                     "Voxels along the longest side of the octree that holds the light",
                                     "Rays", choices=CACHE_RESOLUTIONS)
    cache_rays: int = _setting(16, "Cache Rays", "Rays with which each surface in the octree gathers its light", "Rays",
                               low=1, high=1024)
    bounces: int = _setting(12, "Bounces", "Most bounces of diffuse light after the first", "Rays", low=0, high=1024)
    denoise: bool = _setting(True, "Denoise", "Smooth what noise the samples leave", "Sampling")
    denoiser: str = _setting("openimagedenoise", "Denoiser", "What smooths the noise", "Sampling",
                             choices=DENOISERS)
    denoising_quality: str = _setting("high", "Quality", "Of OpenImageDenoise", "Sampling", choices=QUALITIES)
    viewport_denoise: bool = _setting(True, "Viewport Denoise", "The same in the viewport", "Sampling")
    viewport_denoiser: str = _setting("automatic", "Denoiser", "What smooths the noise in the viewport", "Sampling",
                                      choices=DENOISERS)
    viewport_denoising_quality: str = _setting("fast", "Quality", "Of OpenImageDenoise in the viewport", "Sampling",
                                               choices=QUALITIES)
    filter_width: float = _setting(1.5, "Filter Width", "Width of the Blackman-Harris pixel filter", "Film", low=0.01,
                                   high=10, unit="px")
    resolution: str = _setting("128", "Resolution", "Voxels along the longest side of the scene", "Voxel Grid",
                               choices=RESOLUTIONS)
    view: str = _setting("combined", "View", "What the picture shows", "Debug", choices=VIEWS)
    view_lod: int = _setting(0, "Voxel Level", "Mip level of the voxels that are shown; 0 is the finest", "Debug",
                             low=0, high=8)
    cone_ring_angle: float = _setting(0.7853981633974483, "Ring Angle",
                                      "Angle between the normal and the eight diffuse cones around it", "Cones",
                                      low=0.1, high=1.5, unit="rad")
    cone_aperture: float = _setting(0.4, "Diffuse Aperture", "Full opening angle of a diffuse cone",
                                    "Cones", low=0.05, high=2.5, unit="rad")
    cone_offset: float = _setting(1.0, "Offset", "Distance from the surface at which a cone starts", "Cones", low=0,
                                  high=8, unit="voxels")
    cone_step: float = _setting(0.5, "Step", "Length of a step as a part of the cone's diameter there", "Cones",
                                low=0.1, high=2)
    cone_distance: float = _setting(2.0, "Distance",
                                    "Length at which a cone ends, as a part of the voxel grid's side", "Cones",
                                    low=0.01, high=2)
    shadow_aperture: float = _setting(0.05, "Shadow Aperture", "Full opening angle of a shadow cone", "Cones",
                                      low=0.001, high=1, unit="rad")
    specular_cone: bool = _setting(True, "Specular Cone", "Trace a cone along the mirror direction", "Cones")
    injection_samples: int = _setting(4, "Light Points", "Points of each extended lamp that light a voxel",
                                      "Light Injection", low=1, high=64)
    injection_ambient: float = _setting(0.0, "Ambient", "Blinn-Phong's k_a: ambient light that every voxel gets",
                                        "Light Injection", low=0, high=10)
    injection_specular: float = _setting(0.0, "Specular",
                                         "Blinn-Phong's k_s: view-dependent highlight stored in the voxels",
                                         "Light Injection", low=0, high=1)
    injection_shininess: float = _setting(32.0, "Shininess", "Blinn-Phong's exponent alpha", "Light Injection", low=1,
                                          high=1000)
    skip_unneeded: bool = _setting(True, "Skip What Is Not Needed",
                                   "For developers: off, all is done that any scene could need; the picture is the "
                                   "same",
                                   "Debug")
    passes: tuple[str, ...] = ()
    lines: Lines | None = None

    def for_viewport(self) -> RenderSettings:
        """The same with the viewport's own samples and denoiser, and no time limit."""
        return replace(self, samples=self.viewport_samples, time_limit=0.0,
                       adaptive_sampling=self.viewport_adaptive_sampling,
                       noise_threshold=self.viewport_noise_threshold, min_samples=self.viewport_min_samples,
                       denoise=self.viewport_denoise, denoiser=self.viewport_denoiser,
                       denoising_quality=self.viewport_denoising_quality)

    def __post_init__(self) -> None:
        if unknown := [name for name in self.passes if name not in PASSES]:
            raise SvoError(f"There is no render pass '{unknown[0]}'; there are {', '.join(PASSES)}")
        for name, spec in specs().items():
            value = getattr(self, name)
            if spec.choices and value not in (known := [c[0] for c in spec.choices]):
                raise SvoError(f"Setting '{name}' is '{value}'; it can be {', '.join(known)}")
            if spec.low is not None and spec.high is not None and not spec.low <= value <= spec.high:
                raise SvoError(f"Setting '{name}' is {value}; it must lie between {spec.low} and {spec.high}")


def specs() -> dict[str, Spec]:
    """The Spec of every setting that has one by its name, in the order of declaration."""
    return {f.name: f.metadata["spec"] for f in fields(RenderSettings) if "spec" in f.metadata}


def with_text(settings: RenderSettings, name: str, text: str) -> RenderSettings:
    """`settings` with one field read from `text`, as the command line's --set NAME=VALUE gives it, or SvoError."""
    if name == "passes":
        return replace(settings, passes=tuple(part.strip() for part in text.split(",") if part.strip()))
    if name not in specs():
        raise SvoError(f"There is no setting '{name}'; there are {', '.join(specs())}")
    kind = type(getattr(settings, name))
    try:
        if kind is bool:
            value: Any = {"true": True, "1": True, "on": True, "false": False, "0": False, "off": False}[text.lower()]
        else:
            value = kind(text)
    except (ValueError, KeyError):
        raise SvoError(f"Setting '{name}' needs a value of type {kind.__name__}, not '{text}'") from None
    return replace(settings, **{name: value})
