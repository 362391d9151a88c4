# SPDX-License-Identifier: GPL-3.0-or-later
"""skipping.md: what it saves to leave out what a scene does not need."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..tables import Skipped
from .markdown import number, size, table
from .runs import Run

_INTRO = """# Only what a scene needs

Written by `python -m svo_engine bench --report` from what `--skipping` measured; [README](README.md) says how the
numbers come about.

Programs do not depend on the scene. What a scene does not need is left out as dispatches that are not made, planes that
are not there, and branches that all invocations take alike; `svo_engine/needs.py` decides it by one look at the scene.
For each need there is a small scene *with* it and one *without*: a room with a red and a green wall and a ball, which
is the diffuse Cornell box where nothing else is said. Each is rendered as usual, and (*all*) with the developer's
setting `skip_unneeded` off, with which all is done that any scene could need. One sample, wavelet filter, light cache
at 32 cubed. *Anew*: milliseconds with nothing kept; *picture*: with nothing to do but the picture. MiB on the device.
*Same*: whether the picture is the same to the bit as with all left out that is not needed.

What was done, of a frame with everything anew: *dispatches*, draws included, which a software renderer cuts into slices
by their speed, so that there their number varies; *cache rays* of the light cache; *diffuse
rays* of pixels; *draws* of light, one shadow ray each at most; *path steps*: invocations that light and trace mirrors'
and glass's paths, of which a graphics card is given as many as paths could be left; *principled*: invocations of the
program of all that is not plain diffuse; *emitters*: of the programs that draw points on emissive triangles and weigh
them; *cutouts*: instances at which rays ask how opaque the surface is; *texels* on the device. Images of materials are
read by the last three's programs alone.
"""

_MEANINGS = {
    "light": "Anything shines at all.", "lamps": "A lamp beside a grey world, or that world alone.",
    "emission": "The ball glows.", "world": "A grey world outside of the open room.",
    "principled": "The ball has an image for its colour.", "textures": "The same on a rough varnished ball.",
    "alpha": "The ball lets half of all rays through.", "gloss": "The ball is varnished, but rough: no path goes on.",
    "glass": "The ball is of glass, or a metal mirror.", "long paths": "The metal is a mirror, or rough.",
    "passes": "Four render passes are asked for."}

_COUNTS = ("n_dispatches", "cache_rays", "diffuse_rays", "draws", "path_steps", "principled", "emitters", "cutouts",
           "texels")


def page(runs: Sequence[Run]) -> str:
    """The page's text."""
    parts = [_INTRO]
    for run in runs:
        if run.skipping:
            parts += [run.heading(), *_sections(run.skipping)]
    return "\n".join(parts)


def _sections(rows: Sequence[Skipped]) -> Iterator[str]:
    yield _diffuse(rows)
    headers = ("Need", "Anew, ms", "Picture, ms", "MiB", "Same",
               *(name.removeprefix("n_").replace("_", " ").capitalize() for name in _COUNTS))
    yield table(headers, ([f"**{row.need}**: {_what(row)}", number(row.anew * 1e3), number(row.seconds * 1e3),
                           size(row.n_bytes), "yes" if row.is_same else "no",
                           *(f"{getattr(row, name):,}" for name in _COUNTS)] for row in rows))
    yield "\n".join(f"- **{need}**: {_MEANINGS[need]}" for need in dict.fromkeys(row.need for row in rows)) + "\n"


def _diffuse(rows: Sequence[Skipped]) -> str:
    """What the counters say of the diffuse Cornell box, which has lamps and nothing else."""
    box = next(row for row in rows if (row.need, row.has_it, row.skips) == ("light", True, True))
    return (f"On the diffuse Cornell box: {box.path_steps} steps of specular paths, {box.principled} invocations of the"
            f" principled program, {box.texels} texels, {box.cutouts} instances with an alpha test.\n")


def _what(row: Skipped) -> str:
    return f"{'with' if row.has_it else 'without'}{'' if row.skips else ', all'}"
