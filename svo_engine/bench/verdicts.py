# SPDX-License-Identifier: GPL-3.0-or-later
"""What a ladder says of us and a peer: where the curves cross, and by what factors we are ahead or behind."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from .curves import Curve, ahead, crossover, error_ratios, geometric_mean, make_curve, time_ratios
from .rungs import OURS, PEERS
from .tables import Rendered

NAMES = {"rays": "rays", "cones": "cones", "cycles": "Cycles", "cycles-oidn": "Cycles + OIDN", "eevee": "EEVEE"}


@dataclass(frozen=True, eq=False)
class Verdict:
    """Ours, the better of rays and cones at each time, against one peer, on one scene.

    rungs       the peer's, those that are better than all quicker ones
    by_error    for each, its error over ours at its time; by_time: its time over ours at its error. Above 1 we are
                ahead; 0: we have no picture by then, or never reach that error
    crossing    seconds from which on the peer's error is the lower one; None: not within these ladders
    spans       of seconds within which ours is the lower error
    """

    scene: str
    size: str
    peer: str
    rungs: tuple[Rendered, ...]
    by_error: np.ndarray
    by_time: np.ndarray
    crossing: float | None
    spans: tuple[tuple[float, float], ...]

    def sentence(self) -> str:
        """All of it in one sentence."""
        crossing = f"crossover at {seconds(self.crossing)}" if self.crossing else "no crossover within these ladders"
        return (f"{self.scene} {self.size}, beside {NAMES[self.peer]}: {crossing}; its error over ours at equal time "
                f"{_mean(self.by_error)}; its time over ours at equal error {_mean(self.by_time)}")


def verdicts(rows: Sequence[Rendered]) -> Iterator[Verdict]:
    """One for each scene, size and peer that can be compared."""
    for scene, size in dict.fromkeys((row.scene, row.size) for row in rows):
        group = [row for row in rows if (row.scene, row.size) == (scene, size) and is_whole(row)]
        ours = curve_of([row for row in group if row.renderer in OURS])
        for peer in reversed(PEERS):
            theirs = curve_of(mine := [row for row in group if row.renderer == peer])
            if ours is None or theirs is None:
                continue
            kept = tuple(next(row for row in mine if row.seconds == time) for time in theirs.times)
            yield Verdict(scene, size, peer, kept, error_ratios(ours, theirs), time_ratios(ours, theirs),
                          crossover(ours, theirs), tuple(ahead(ours, theirs)))


def curve_of(rows: Sequence[Rendered]) -> Curve | None:
    """The curve of some rungs; None without a measured error."""
    try:
        return make_curve([row.seconds for row in rows], [row.error for row in rows])
    except ValueError:
        return None


def is_whole(row: Rendered) -> bool:
    """Whether its time is that of everything."""
    return row.kind in ("render", "all")


def seconds(time: float | None) -> str:
    """A time as people say it."""
    if time is None:
        return "-"
    return f"{time * 1e3:.3g} ms" if time < 0.9995 else f"{time:.3g} s"


def _mean(ratios: np.ndarray) -> str:
    """The geometric mean, and of how many rungs it could be taken: the others are lost to the peer."""
    n_known = int((ratios > 0).sum())
    return f"{geometric_mean(ratios):.3g} ({n_known} of {len(ratios)} rungs)" if n_known else "unknown (no rung)"
