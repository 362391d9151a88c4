# SPDX-License-Identifier: GPL-3.0-or-later
"""Which programs a frame runs, so that they are compiled together before it begins, and all that there are.

Programs do not depend on scenes; a frame waits for those that it runs, and the others can be compiled when nothing else
is to be done, so that no edit ever waits.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache

from ..gpu.passes import Pass
from ..needs import Needs
from ..settings import RenderSettings
from . import (
    adaptive,
    albedo,
    bake,
    bvh,
    cache,
    debug,
    denoise,
    evaluate,
    gather,
    light,
    lines,
    octree,
    path,
    planes,
    raster,
    resolve,
    voxelize,
)
from .denoise import atrous
from .variants import variant_of

Variant = tuple[Pass, Mapping[str, bool]]

# The passes that trace exact rays
_TRACE = (raster.CAMERA, raster.BEYOND, lines.DRAW, cache.LINK, cache.DIRECT, gather.RAYS, path.STEP)
_EMITTERS = (cache.FOUND, cache.DRAW, gather.FOUND, gather.DRAW)


@lru_cache(64)
def programs_for(needs: Needs, settings: RenderSettings, denoiser: str, is_software: bool) -> tuple[Variant, ...]:
    """Those of a frame. denoiser: the one that is asked for, "" for none."""
    used = [*_of_view(needs, settings, is_software)]
    if denoiser == "atrous" or (denoiser == "automatic" and not is_software):
        used += [atrous.PREPARE, atrous.ATROUS]
    if settings.passes or denoiser in ("openimagedenoise", "automatic"):
        used.append(planes.MEAN)
    if adaptive.is_adaptive(settings):
        used += [adaptive.MEASURE, adaptive.DECIDE]
    return _variants([*used, denoise.COMPOSE], is_software)


@lru_cache(2)
def all_programs(is_software: bool) -> tuple[Variant, ...]:
    """All that any frame could run, most needed first."""
    everything = [
        *_rays(True, True, True), *_picture(True, False, is_software), *_picture(True, True, is_software),
        *bake.PASSES, raster.BEYOND, lines.DRAW,
        denoise.COMPOSE, planes.MEAN, adaptive.MEASURE, adaptive.DECIDE, atrous.PREPARE, atrous.ATROUS, *_voxels(),
        light.INJECT, light.MIP, gather.CONES, debug.SURFELS, debug.VOXELS, debug.ATTRIBUTE]
    return _variants(list(dict.fromkeys(everything)), is_software)


def _variants(used: list[Pass], is_software: bool) -> tuple[Variant, ...]:
    return tuple((pass_, variant_of(is_software) if pass_ in _TRACE else {}) for pass_ in used)


def _of_view(needs: Needs, settings: RenderSettings, is_software: bool) -> Iterator[Pass]:
    is_drawn = is_software or needs.alpha
    if settings.lines and settings.method == "rays":
        yield lines.DRAW
    if needs.trees:
        yield from (*bake.PASSES, albedo.INTEGRATE)
    if needs.passes and settings.method == "rays":
        yield from (raster.BEYOND, evaluate.PRINCIPLED)
    if settings.view.startswith("voxel"):
        yield from _voxels()
        yield from (debug.VOXELS, debug.ATTRIBUTE, light.INJECT, light.MIP, raster.VISIBILITY)
        return
    if settings.method == "cones" and settings.view == "combined":
        yield from (*_voxels(), light.INJECT, light.MIP, gather.CONES, *_picture(needs.principled, True, is_software))
        return
    yield from _rays(needs.gloss, needs.emission, needs.world)
    yield from _picture(needs.principled, is_drawn or settings.view != "combined", is_software)
    if settings.view != "combined":
        yield debug.SURFELS


def _picture(principled: bool, is_drawn: bool, is_software: bool) -> Iterator[Pass]:
    yield from (raster.VISIBILITY, raster.HITS) if is_drawn or is_software else (raster.CAMERA,)
    yield from (evaluate.MATTE, resolve.ACCUMULATE)
    if principled:
        yield from (evaluate.PRINCIPLED, albedo.INTEGRATE)


def _voxels() -> Iterator[Pass]:
    yield from (voxelize.COUNT, voxelize.BLOCK_SUMS, voxelize.SCAN)
    yield from (voxelize.MARK, voxelize.ACCUMULATE, voxelize.AVERAGE)


def _rays(gloss: bool, emission: bool, world: bool) -> Iterator[Pass]:
    yield from (gather.RAYS, cache.LINK, cache.DIRECT, octree.PAINT)  # those that take long first
    yield from (path.STEP, evaluate.PRINCIPLED) if gloss else ()
    yield from _EMITTERS if emission else ()
    yield from (cache.SKY,) if world else ()
    yield from (path.WEIGH,) if emission and gloss else ()
    yield from (bvh.NEAREST, bvh.SURVIVE, bvh.MERGE, voxelize.COUNT, voxelize.BLOCK_SUMS, voxelize.SCAN)
    yield from (octree.MARK_NODES, octree.MARK, octree.ACCUMULATE, octree.AVERAGE, octree.BLEND)
    yield from (cache.START, cache.BOUNCE, cache.FINISH)
