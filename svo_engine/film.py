# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture: named planes of 32-bit floats, scene-linear, row 0 at the bottom as in Blender."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .errors import SvoError
from .settings import PASSES


@dataclass(frozen=True, eq=False)
class Film:
    """Means over `n_samples` samples.

    planes  name -> (height, width, channels) f4. "Combined" is RGBA, premultiplied; the others have the names of
            Blender's render passes
    stats   what it took: see `render.py`
    """

    planes: dict[str, np.ndarray]
    n_samples: int
    stats: dict[str, Any] = field(default_factory=dict)

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        height, width = self.planes["Combined"].shape[:2]
        return width, height

    def save(self, path: str | Path) -> None:
        """Write by the ending of `path`, or SvoError.

        .npz has all planes as they are, .png the Combined plane. .exr has Combined as RGBA, and the channels of every
        other plane in a layer of its name, such as "Depth.Z".
        """
        path = Path(path)
        writers = {".npz": _save_npz, ".png": _save_png, ".exr": _save_exr}
        if path.suffix not in writers:
            raise SvoError(f"Cannot write '{path}': its ending must be one of {', '.join(writers)}")
        try:
            writers[path.suffix](self, path)
        except (OSError, RuntimeError) as error:  # the latter is OpenEXR's way
            raise SvoError(f"Cannot write '{path}': {getattr(error, 'strerror', None) or error}") from error


def load(path: str | Path) -> Film:
    """Read back what `Film.save` wrote as .npz."""
    with np.load(path) as data:
        return Film({k: data[k] for k in data.files if k != "n_samples"}, int(data["n_samples"]))


def encode_srgb(linear: np.ndarray) -> np.ndarray:
    """Scene-linear values to sRGB-encoded ones in 0 to 1 (IEC 61966-2-1), any shape, f4: Blender's view 'Standard'."""
    x = np.clip(linear, 0.0, 1.0)
    return np.where(x <= 0.0031308, x * 12.92, 1.055 * np.power(x, 1 / 2.4) - 0.055).astype("f4")


def _save_npz(film: Film, path: Path) -> None:
    with path.open("wb") as file:
        np.savez_compressed(file, n_samples=np.int64(film.n_samples), **film.planes)  # type: ignore[arg-type]


def _save_png(film: Film, path: Path) -> None:
    from PIL import Image as PillowImage

    rgba = film.planes["Combined"]
    alpha = np.clip(rgba[..., 3:], 0, 1)
    straight = rgba[..., :3] / np.maximum(alpha, 1e-8)
    pixels = np.concatenate([encode_srgb(straight), alpha], 2)
    PillowImage.fromarray(np.round(pixels[::-1] * 255).astype("u1")).save(path)


def _save_exr(film: Film, path: Path) -> None:
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    channels = {"RGBA": np.ascontiguousarray(film.planes["Combined"][::-1])}
    for name, plane in film.planes.items():
        for i, letter in enumerate(PASSES.get(name, "")):
            channels[f"{name}.{letter}"] = np.ascontiguousarray(plane[::-1, :, i])
    with OpenEXR.File(header, channels) as file:
        file.write(str(path))
