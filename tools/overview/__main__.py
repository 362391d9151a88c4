# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.overview`: new pictures and times for docs/gi-overview.md, whose text stays as it is.

Two steps, with out/overview.npz between them: `render` needs a GPU or patience, and the core alone; `page` needs
Pillow. Both read what the steps `references` and `render` of tools.accuracy left in out/accuracy.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import numpy as np

from svo_engine.render import Session
from svo_engine.scene import store
from svo_engine.scene.camera import make_view
from svo_engine.scene.types import Scene
from svo_engine.settings import RenderSettings
from tools.accuracy.plan import ROOT, make_parser, parse, plan_of, sample_scenes

from .stages import STAGES

STEPS = ("render", "page")
WARM_FRAMES = 9  # an idle graphics card has slowed down


def main() -> int:
    """Run the asked steps."""
    parser = make_parser("tools.overview", __doc__, STEPS, ROOT / "out", ROOT / "docs")
    parser.add_argument("--scene", default="cornell_suzanne_area")
    options = parse(parser, STEPS)
    plan = plan_of(options, sample_scenes(), options.out / "accuracy")
    if "render" in options.steps:
        render(store.load(plan.scene(options.scene)), plan.size, options.out / "overview.npz")
    if "page" in options.steps:
        from .page import write_page

        write_page(plan, options.scene, options.out / "overview.npz")
    return 0


def render(scene: Scene, size: tuple[int, int], out: Path) -> None:
    """The picture of each stage, and the times of a frame of one sample with nothing kept from before."""
    assert scene.camera, "sample scenes have a camera"
    session, view, found = Session(), make_view(scene.camera, size), {}
    for stage in STAGES:
        print(f"tools.overview: {stage.name}", file=sys.stderr, flush=True)
        *_, film = session.films(scene, view, RenderSettings(**stage.settings), interval=math.inf)
        found[stage.name] = stage.show(film).astype("f4")
    for _ in range(WARM_FRAMES):
        session.forget()
        *_, film = session.films(scene, view, RenderSettings(samples=1), interval=math.inf)
    stats = {"device": film.stats["device"], "times_ms": film.stats["times_ms"], "counts": film.stats["counts"]}
    np.savez_compressed(out, stats=np.array(json.dumps(stats)), **found)  # type: ignore[arg-type]
    session.close()


if __name__ == "__main__":
    sys.exit(main())
