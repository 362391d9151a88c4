# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.accuracy`: every sample scene by rays and by Cycles; writes docs/benchmarks/accuracy.md.

Three steps, which can be run one by one on different machines, with files in out/accuracy between them: `references`
needs Blender's module and takes longest, what is there is not made again; `render` needs a GPU or patience, and the
core alone; `page` needs Pillow and flip-evaluator. Other sizes and samples have files of their own.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial

import numpy as np

from svo_engine.bench import host, references
from svo_engine.render import Session
from svo_engine.scene import store

from .plan import ROOT, SAMPLES, Plan, make_parser, parse, plan_of, sample_scenes


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
    parser = make_parser("tools.accuracy", __doc__, STEPS, ROOT / "out/accuracy", ROOT / "docs/benchmarks")
    parser.add_argument("--scenes", nargs="+", default=sample_scenes())
    options = parse(parser, STEPS)
    plan = plan_of(options, options.scenes, options.out)
    plan.out.mkdir(parents=True, exist_ok=True)
    for step in options.steps:
        STEPS[step](plan)
    return 0


def say(sentence: str) -> None:
    print(f"tools.accuracy: {sentence}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
