# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture that counts as the truth, how noisy it is itself, and how far another one is from it.

Two independent halves, renders with different seeds, tell the noise of their mean: E[((a - b) / 2)^2] is its variance.
They also give an error without that noise: E[(x - a) (x - b)] is the mean square of x - truth, because the noises of a
and b have nothing to do with each other. So a reference of few samples can measure errors far below its own noise.
Only the weights of relMSE still have it, which is of second order: a picture too bright by d where a half's noise is
sigma, both relative, seems worse by 2 d sigma^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import SvoError
from ..film import encode_srgb
from ..metrics import RELATIVE_FLOOR, bias, nrmse, rel_mse


@dataclass(frozen=True, eq=False)
class Reference:
    """picture  (h, w, 3) f4, scene-linear, row 0 at the bottom; halves  the two that `picture` is the mean of, or none

    noise  relMSE of `picture` against the truth; nan: not known
    """

    picture: np.ndarray
    halves: tuple[np.ndarray, ...] = ()
    noise: float = float("nan")

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.picture.shape[1], self.picture.shape[0]


@dataclass(frozen=True)
class Measures:
    """See `tables.Rendered`."""

    nrmse: float
    rel_mse: float
    error: float
    noise: float
    bias: float
    flip: float


NOTHING = Measures(*[float("nan")] * 6)


def from_halves(a: np.ndarray, b: np.ndarray) -> Reference:
    """The mean of two independent renders of the same number of samples, both (h, w, 3)."""
    picture = ((a + b) / 2).astype("f4")
    noise = np.mean(((a - b).astype("f8") / 2) ** 2 / _weight(picture))
    return Reference(picture, (a, b), float(noise))


def measure(x: np.ndarray, reference: Reference) -> Measures:
    """All measures of a picture (h, w, 3); SvoError if its size is another one."""
    r = reference.picture
    if x.shape != r.shape:
        raise SvoError(f"A picture of {x.shape[1]}x{x.shape[0]} pixels has a reference of "
                       f"{r.shape[1]}x{r.shape[0]}: they must be of one size")
    return Measures(nrmse(x, r), rel_mse(x, r), error_of(x, reference), reference.noise, bias(x, r), flip(x, r))


def error_of(x: np.ndarray, reference: Reference) -> float:
    """relMSE against the truth: without the reference's noise where its halves or a figure tell it, else with it."""
    if reference.halves:
        a, b = (np.subtract(x, half, dtype="f8") for half in reference.halves)
        return float(np.mean(a * b / _weight(reference.picture)))
    plain = rel_mse(x, reference.picture)
    return plain if np.isnan(reference.noise) else plain - reference.noise


def flip(x: np.ndarray, r: np.ndarray) -> float:
    """Mean FLIP [Andersson20] of both as Blender's view 'Standard' shows them; nan where flip-evaluator is missing."""
    try:
        import flip_evaluator
    except ModuleNotFoundError:
        return float("nan")
    shown, wanted = (np.ascontiguousarray(encode_srgb(image)[::-1]) for image in (x, r))
    return float(flip_evaluator.evaluate(wanted, shown, "LDR", inputsRGB=True, applyMagma=False)[1])


def load(path: Path) -> Reference:
    """A .npz that `save` wrote (or one with the picture alone, as 'r'), or an .exr; SvoError if it is neither."""
    try:
        if path.suffix == ".exr":
            return Reference(_load_exr(path))
        with np.load(path, allow_pickle=False) as data:
            if "a" in data.files:
                return from_halves(data["a"], data["b"])
            return Reference(data["r"], noise=float(data["noise"]) if "noise" in data.files else float("nan"))
    except OSError as error:
        raise SvoError(f"Cannot read '{path}': {error.strerror or error}") from error
    except (KeyError, ValueError) as error:
        raise SvoError(f"'{path}' is no reference picture: {error}") from error


def save(reference: Reference, path: Path) -> None:
    """Write the halves, or the picture and its noise; SvoError if that cannot be done."""
    arrays = dict(zip("ab", reference.halves, strict=True)) if reference.halves else {
        "r": reference.picture, "noise": np.float64(reference.noise)}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(path, **arrays)  # type: ignore[arg-type]
    except OSError as error:
        raise SvoError(f"Cannot write '{path}': {error.strerror or error}") from error


def _weight(r: np.ndarray) -> np.ndarray:
    return np.square(r, dtype="f8") + RELATIVE_FLOOR


def _load_exr(path: Path) -> np.ndarray:
    """RGB of an EXR file, row 0 at the bottom."""
    import OpenEXR

    try:
        with OpenEXR.File(str(path)) as file:
            channels = file.channels()
            pixels = next(channels[name].pixels for name in ("RGBA", "RGB") if name in channels)
    except (RuntimeError, StopIteration) as error:
        raise SvoError(f"'{path}' is no EXR picture with RGB") from error
    return np.ascontiguousarray(pixels[::-1, :, :3], "f4")
