# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.accuracy`: every sample scene by rays and by Cycles; writes docs/benchmarks/accuracy.md.

Three steps, which can be run one by one on different machines, with files in out/accuracy between them: `references`
needs Blender's module and takes longest, what is there is not made again; `render` needs a GPU or patience, and the
core alone; `page` needs Pillow and flip-evaluator. Other sizes and samples have files of their own.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from svo_engine.bench import host, references
from svo_engine.render import Session
from svo_engine.scene import store

from .plan import ROOT, SAMPLES, Plan, sample_scenes, size_of


def make_references(plan: Plan) -> None:
    """Extract each scene; render both halves by Cycles where they are not there yet."""
    from svo_engine.bench.through_blender import make_reference
    from svo_engine.blender import cli, peers

    for name in plan.scenes:
        file = SAMPLES / f"{name}.blend"
        store.save(cli.extract_scene(file, None), plan.scene(name))
        if not plan.reference(name).exists():
            say(f"{name}: {plan.n_reference} samples of Cycles")
            with peers.opened(file, plan.size) as scene:
                made = make_reference(partial(peers.renderer, scene, "cycles", "cpu"), plan.n_reference)
            references.save(made, plan.reference(name))


def render(plan: Plan) -> None:
    """Our pictures, with all settings at their defaults but the samples, through the benchmark's own shooter."""
    from svo_engine.bench.core import Shooter

    session = Session()
    shooter = Shooter(session, plan.size)
    for name in plan.scenes:
        scene, found = store.load(plan.scene(name)), {}
        for n in plan.samples:
            say(f"{name}: {n} samples")
            found[str(n)] = shooter.shoot(scene, {"samples": n}).picture
        np.savez_compressed(plan.ours(name), **found)  # type: ignore[arg-type]
    host.write(plan.out, session.device_info()["renderer"])
    session.close()


def page(plan: Plan) -> None:
    """Measure, and write the page with its pictures."""
    from .page import write_page

    pictures = {}
    for name in plan.scenes:
        with np.load(plan.ours(name)) as data:
            pictures[name] = {n: data[str(n)] for n in plan.samples}
    truths = {name: references.load(plan.reference(name)) for name in plan.scenes}
    write_page(plan.docs, pictures, truths, host.read(plan.out), plan.n_reference)
    say(str(plan.docs / "accuracy.md"))


STEPS: dict[str, Callable[[Plan], None]] = {"references": make_references, "render": render, "page": page}


def main() -> int:
    """Run the asked steps."""
    parser = argparse.ArgumentParser("tools.accuracy", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"{', '.join(STEPS)} (default: all)")
    parser.add_argument("--scenes", nargs="+", default=sample_scenes())
    parser.add_argument("--size", default="400x300", metavar="WxH")
    parser.add_argument("--samples", nargs="+", type=int, default=[16, 256], metavar="N", help="of ours")
    parser.add_argument("--reference-samples", type=int, default=1024, metavar="N", help="of Cycles")
    parser.add_argument("--out", type=Path, default=ROOT / "out/accuracy", metavar="DIR")
    parser.add_argument("--docs", type=Path, default=ROOT / "docs/benchmarks", metavar="DIR")
    options = parser.parse_args()
    if unknown := set(options.steps) - set(STEPS):
        parser.error(f"there is no step {', '.join(sorted(unknown))}")
    plan = Plan(tuple(options.scenes), size_of(options.size), tuple(options.samples), options.reference_samples,
                options.out, options.docs)
    plan.out.mkdir(parents=True, exist_ok=True)
    for step in options.steps or STEPS:
        STEPS[step](plan)
    return 0


def say(sentence: str) -> None:
    print(f"tools.accuracy: {sentence}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
