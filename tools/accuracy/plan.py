# SPDX-License-Identifier: GPL-3.0-or-later
"""What is compared, and the files between the steps."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "sample_blends"


@dataclass(frozen=True)
class Plan:
    """samples: of ours; n_reference: of Cycles, in two halves."""

    scenes: tuple[str, ...]
    size: tuple[int, int]
    samples: tuple[int, ...]
    n_reference: int
    out: Path
    docs: Path

    def scene(self, name: str) -> Path:
        """The extracted scene."""
        return self.out / f"{name}.npz"

    def reference(self, name: str) -> Path:
        """Both halves of Cycles' picture."""
        return self.out / f"{name}_{self.size[0]}x{self.size[1]}_cycles_{self.n_reference}.npz"

    def ours(self, name: str) -> Path:
        """Our pictures: "16", "256" (height, width, 3) f4, row 0 at the bottom."""
        return self.out / f"{name}_{self.size[0]}x{self.size[1]}_ours.npz"


def sample_scenes() -> tuple[str, ...]:
    """The names of all sample scenes."""
    return tuple(sorted(path.stem for path in SAMPLES.glob("*.blend")))


def size_of(text: str) -> tuple[int, int]:
    """(width, height) of "400x300"."""
    width, height = map(int, text.split("x"))
    return width, height
