# SPDX-License-Identifier: GPL-3.0-or-later
"""What is compared, the files between the steps, and the command line; tools.overview has the same."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Collection
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


def make_parser(program: str, doc: str | None, steps: Collection[str], out: Path, docs: Path) -> ArgumentParser:
    """The arguments that both programs have. out, docs: their default folders."""
    parser = ArgumentParser(program, description=(doc or "").partition("\n")[0])
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"{', '.join(steps)} (default: all)")
    parser.add_argument("--size", type=size_of, default="400x300", metavar="WxH")
    parser.add_argument("--samples", nargs="+", type=int, default=[16, 256], metavar="N", help="of our pictures")
    parser.add_argument("--reference-samples", type=int, default=1024, metavar="N", help="of Cycles")
    parser.add_argument("--out", type=Path, default=out, metavar="DIR")
    parser.add_argument("--docs", type=Path, default=docs, metavar="DIR")
    return parser


def parse(parser: ArgumentParser, steps: Collection[str]) -> Namespace:
    """What the command line says; its `steps` are all if it names none."""
    options = parser.parse_args()
    if unknown := set(options.steps) - set(steps):
        parser.error(f"there is no step {', '.join(sorted(unknown))}")
    options.steps = options.steps or list(steps)
    return options


def plan_of(options: Namespace, scenes: Collection[str], out: Path) -> Plan:
    """What the arguments of `make_parser` ask for."""
    return Plan(tuple(scenes), options.size, tuple(options.samples), options.reference_samples, out, options.docs)


def size_of(text: str) -> tuple[int, int]:
    """(width, height) of "400x300"."""
    width, height = map(int, text.split("x"))
    return width, height
