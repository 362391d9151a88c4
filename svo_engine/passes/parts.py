# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in parts: what the passes between the camera and the film hand on, for so many pixels at once as fit.

A slot is a pixel's place in its part, in tiles of 8 by 8. All that is handed on lies in one buffer, in planes of 16
bytes a slot (bind/wave.glsl); a plane that a scene does not need is not there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..needs import Needs
from ..scene import layouts

MOST_SLOTS = 1 << 19  # of a part: 800 by 600 pixels in one go
MOST_SLOTS_OF_SOFTWARE = 1 << 14  # what a processor's caches hold
PLANE = 16  # bytes a slot
LIST_HEAD = 16  # bytes before the slots of a list, the number of slots first
EYE = 0  # first plane of the points that the eye sees
_SIZES = {name.partition("_")[0].lower(): n for name, n in layouts.CONSTANTS.items() if name.endswith("_PLANES")}
_SET = _SIZES["hit"] + _SIZES["point"]


@dataclass(frozen=True)
class Part:
    """Slots `start` to `start + n` of a picture."""

    start: int
    n: int


@dataclass(frozen=True, eq=False)
class Parts:
    """Room for one part at a time of a picture.

    n_slots  of the whole picture: its pixels in whole tiles
    met      first plane of the points that paths meet
    planes   the first plane of all else
    lists    of slots: two that rounds of paths take in turns
    """

    scope: GpuScope
    n_slots: int
    capacity: int
    wave: Buffer
    met: int
    planes: dict[str, int]
    lists: tuple[Buffer, Buffer]

    def __iter__(self) -> Iterator[Part]:
        """The parts one after another."""
        for start in range(0, self.n_slots, self.capacity):
            yield Part(start, min(self.capacity, self.n_slots - start))

    def of(self, part: Part, points: int) -> Resources:
        """What bind/wave.glsl reads, for the points whose first plane that is."""
        return {"Wave": self.wave, "u_stride": part.n, "u_set": points, "u_arrivals": self.planes["arrivals"],
                "u_draws": self.planes["draws"]}


def make_parts(device: Device, size: tuple[int, int], n_ends: int, n_draws: int, needs: Needs) -> Parts:
    """n_ends: ends of diffuse rays, n_draws: draws of light to be kept for a pixel. GpuError if they do not fit."""
    scope = device.scope()
    points = _SET + _SIZES["lobes"] * needs.gloss
    first, planes = points, {}
    for name, n in (("arrivals", _SIZES["arrival"]), ("gloss", _SIZES["gloss"] * needs.gloss),
                    ("met", points * needs.gloss), ("paths", _SIZES["path"] * needs.gloss), ("ends", n_ends),
                    ("draws", _SIZES["draw"] * n_draws)):
        planes[name], first = first, first + n
    most = MOST_SLOTS_OF_SOFTWARE if device.profiler.is_software else MOST_SLOTS
    tiles = max(int(device.limits["GL_MAX_SHADER_STORAGE_BLOCK_SIZE"]) // (PLANE * first) // 64, 1)
    n_slots = -(-size[0] // 8) * -(-size[1] // 8) * 64
    n = min(n_slots, most, 64 * tiles)
    n_listed = n * (needs.gloss or needs.passes)
    lists = [scope.buffer(label, LIST_HEAD + 4 * n_listed) for label in ("paths", "paths that go on")]
    return Parts(scope, n_slots, n, scope.buffer("wave", PLANE * first * n), planes.pop("met"), planes,
                 (lists[0], lists[1]))
