# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.nodes`: every node of the shader editor in every mode, beside Cycles, written to docs/nodes.md.

Results are kept in out/nodes.json, so that a run that was ended goes on, and one for some nodes measures those anew.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from fnmatch import fnmatch
from typing import Any

import numpy as np

from svo_engine.render import Session

from .page import PAGE, ROOT, page

KEPT = ROOT / "out/nodes.json"
SCALE, OFFSET = 0.25, 0.5  # what is shown of a value: light cannot be negative

Results = dict[str, dict[str, Any]]


def main() -> int:
    """Measure what is asked for, or all that is not known, and write the page."""
    parser = argparse.ArgumentParser("tools.nodes", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--again", default="", metavar="GLOB", help="kinds to measure anew, as '*Noise*'; '*': all")
    parser.add_argument("--only", default="", metavar="GLOB", help="only these kinds, anew, and no page")
    parser.add_argument("--batch", type=int, default=36, metavar="N", help="cards in a picture")
    parser.add_argument("--samples", type=int, default=64, metavar="N", help="of Cycles and of us, for shaders")
    options = parser.parse_args()
    from . import modes
    from .cards import fresh_nodes

    known: Results = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    found = list(modes.all_modes(fresh_nodes()))
    todo = [m for m in found if m.key not in known or fnmatch(m.kind, options.again)]
    if options.only:
        todo = [m for m in found if fnmatch(m.kind, options.only)]
    print(f"{len(found)} modes, {len(todo)} to measure", flush=True)
    session = Session()
    for is_shader in (False, True):
        part = [m for m in todo if m.is_shader == is_shader]
        for i in range(0, len(part), options.batch):
            known.update(_measured(session, part[i:i + options.batch], options.samples if is_shader else 1))
            KEPT.parent.mkdir(exist_ok=True)
            KEPT.write_text(json.dumps(known, indent=1))
    if options.only:
        return 0
    PAGE.write_text(page(found, known, session.device_info()["renderer"]), encoding="utf-8")
    print(PAGE.relative_to(ROOT))
    return 0


def _measured(session: Session, batch: Sequence[Any], samples: int) -> Results:
    """Results of one picture of cards."""
    from .cards import compare

    started = time.monotonic()
    ours, theirs, notes = compare(session, batch, samples)
    made = {}
    for mode, a, b, told in zip(batch, ours, theirs, notes, strict=True):
        if samples > 1:
            a, b = (x.mean((0, 1), keepdims=True) for x in (a, b))
        else:
            a, b = ((x - OFFSET) / SCALE for x in (a, b))
        error = np.abs(a - b).max(-1) / max(np.ptp(b), 1.0)
        made[mode.key] = {"worst": float(np.nan_to_num(error.max(), nan=99.0)), "off": float((error > 1e-3).mean()),
                          "most": float(np.nan_to_num(np.quantile(error, 0.95), nan=99.0)), "notes": list(told)}
        print(f"{made[mode.key]['worst']:9.5f} {made[mode.key]['off']:6.3f}  {mode.key}  {' | '.join(told)[:120]}")
    print(f"{len(batch)} cards in {time.monotonic() - started:.1f} s", flush=True)
    return made


if __name__ == "__main__":
    sys.exit(main())
