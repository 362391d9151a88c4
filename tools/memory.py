# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.memory SCENE.npz`: writes to docs/benchmarks/memory.md what the octree takes at each resolution."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from math import log2
from pathlib import Path

from svo_engine.errors import GpuError
from svo_engine.gpu.device import Device
from svo_engine.gpu.thread import GpuThread
from svo_engine.passes.octree import build_octree
from svo_engine.passes.upload import upload
from svo_engine.scene import store
from svo_engine.scene.types import Scene

PAGE = Path(__file__).resolve().parents[1] / "docs/benchmarks/memory.md"
RESOLUTIONS = (64, 128, 256, 512, 1024)

HEAD = """# Memory

What the octree takes on the device, its masks, counts and surfels, beside a dense grid that would hold the same: in
every voxel a surfel of 48 bytes for each of the three axes. Slope: the growth since the row above, as a power of the
resolution; that of a surface is 2, that of a volume 3. The light of the cache is not in it: each surfel has as much of
that in both.

`python -m tools.memory SCENE.npz` writes this page; `svo_engine extract` makes a .npz of a .blend. This one:
{scene}, {triangles:,} triangles; {device}.

| voxels a side | nodes | surfels | octree | dense grid | dense over octree | slope |
|---|---|---|---|---|---|---|
"""


@dataclass(frozen=True)
class Size:
    """An octree of n^3 voxels. sentence: why there is none."""

    n: int
    n_nodes: int = 0
    n_surfels: int = 0
    n_bytes: int = 0
    n_dense_bytes: int = 0
    sentence: str = ""


def sizes(device: Device, scene: Scene, resolutions: tuple[int, ...] = RESOLUTIONS) -> Iterator[Size]:
    """Build the octree at each resolution."""
    gpu_scene = upload(device, scene)
    with gpu_scene.scope:
        for n in resolutions:
            try:
                octree = build_octree(device, gpu_scene.placing, n)
            except GpuError as error:
                yield Size(n, sentence=str(error))
                continue
            with octree.scope:
                yield Size(n, octree.n_nodes, octree.n_surfels, octree.n_bytes, octree.n_dense_bytes)


def lines(found: list[Size]) -> Iterator[str]:
    """The rows of the table."""
    for last, size in zip([Size(0), *found], found, strict=False):
        if size.sentence:
            yield f"| {size.n} | does not fit: {size.sentence} | | | | | |"
            continue
        slope = f"{log2(size.n_bytes / last.n_bytes) / log2(size.n / last.n):.2f}" if last.n_bytes else ""
        yield (f"| {size.n} | {size.n_nodes:,} | {size.n_surfels:,} | {size.n_bytes / 2**20:,.1f} MiB | "
               f"{size.n_dense_bytes / 2**20:,.0f} MiB | {size.n_dense_bytes / size.n_bytes:,.0f} | {slope} |")


def main() -> None:
    """Measure and write the page."""
    parser = argparse.ArgumentParser("tools.memory", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("scene", type=Path, metavar="SCENE.npz")
    path: Path = parser.parse_args().scene
    scene, thread = store.load(path), GpuThread()
    try:
        found = thread.call(lambda device: list(sizes(device, scene)))
        renderer = thread.call(lambda device: device.info["renderer"])
    finally:
        thread.close()
    text = HEAD.format(scene=path.stem, triangles=scene.n_triangles, device=renderer) + "\n".join(lines(found)) + "\n"
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
