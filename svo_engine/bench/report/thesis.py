# SPDX-License-Identifier: GPL-3.0-or-later
"""thesis.md: the thesis's tables beside ours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..curves import slope
from ..tables import Timed, unpack
from .markdown import factor, number, power, table
from .runs import Run

# Milliseconds by voxels a side. The thesis: GTX 1050 Ti, 4,977 triangles; cuda_voxelizer: GTX 1050 Ti, 70,000 triangles
THESIS = {64: 2.0, 128: 9.5, 256: 58.8}
CUDA_VOXELIZER = {64: 0.2, 128: 0.3, 256: 0.6, 512: 1.8}
THESIS_FRAMES = {"direct light": 9.17, "whole frame": 31.25}

_INTRO = """# The thesis's tables, measured again

Written by `python -m svo_engine bench --report`; [README](README.md) says how the numbers come about.

The thesis measured on a GeForce GTX 1050 Ti: the Cornell box with the Stanford bunny, 4,977 triangles, one point lamp,
800x600, and Mental Ray took 5 s for the same picture. cuda_voxelizer's figures are for occupancy alone, 70,000
triangles, on a GeForce GTX 1050 Ti. *GPU* is by timer queries, the software renderer's by the clock; *whole* is what
the host waits. Occupancy is a bit a voxel; voxels also have the means of colour, normal and emission.
"""


def page(runs: Sequence[Run]) -> str:
    """The page's text."""
    parts = [_INTRO]
    for run in runs:
        if run.thesis:
            first = run.thesis[0].mesh
            main = [row for row in run.thesis if row.mesh == first]
            parts += [run.heading(), f"### Voxelization of {first}, {main[0].n_triangles:,} triangles, milliseconds\n",
                      _voxelization(main), "### The frame at 800x600, 128 cubed, milliseconds\n", _frames(main),
                      *_triangles([row for row in run.thesis if row.mesh != first])]
    return "\n".join(parts)


def _voxelization(rows: Sequence[Timed]) -> str:
    headers = "Voxels a side", "Occupancy, GPU", "whole", "Voxels, GPU", "whole", "Thesis", "cuda_voxelizer", "Voxels"
    found = {(row.what, row.n): row for row in rows}

    def line(n: int) -> list[str]:
        bits, voxels = found["occupancy", n], found["voxels", n]
        return [str(n), number(bits.gpu_ms), number(bits.whole_ms), number(voxels.gpu_ms), number(voxels.whole_ms),
                factor(THESIS.get(n, 0)), factor(CUDA_VOXELIZER.get(n, 0)), f"{voxels.n_voxels:,}"]

    return table(headers, (line(n) for what, n in found if what == "occupancy" and ("voxels", n) in found))


def _frames(rows: Sequence[Timed]) -> str:
    return table(("Picture", "GPU", "whole", "Thesis", "Parts on the GPU"),
                 ([row.what, number(row.gpu_ms), number(row.whole_ms), number(THESIS_FRAMES[row.what]),
                   ", ".join(f"{name} {number(ms)}" for name, ms in unpack(row.parts).items())]
                  for row in rows if row.what in THESIS_FRAMES))


def _triangles(rows: Sequence[Timed]) -> Iterator[str]:
    """Balls of more and more triangles."""
    if not rows:
        return
    yield "### More and more triangles, milliseconds\n"
    yield table(("Triangles", "What", "Voxels a side", "GPU", "whole", "Million triangles a second"),
                ([f"{row.n_triangles:,}", row.what, str(row.n), number(row.gpu_ms), number(row.whole_ms),
                  number(row.n_triangles / row.gpu_ms / 1e3)] for row in rows))
    for what, n in dict.fromkeys((row.what, row.n) for row in rows):
        series = [row for row in rows if (row.what, row.n) == (what, n)]
        k = slope([row.n_triangles for row in series], [row.gpu_ms for row in series])
        yield f"Time of {what} at {n} cubed grows as triangles to the power {power(k)}.\n"
