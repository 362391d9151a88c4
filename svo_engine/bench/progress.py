# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the benchmark is and how long it still takes: a bar by rich in a terminal, else lines."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager


class Lines:
    """What each step is, one a line, on stderr."""

    def step(self, text: str, cost: float = 1.0) -> None:  # noqa: ARG002 - a bar needs it
        """Say that `text` begins, which is `cost` of the total."""
        self.say(text)

    def skip(self, cost: float, sentence: str = "") -> None:  # noqa: ARG002
        """Pass over a step, and say why if there is something to say."""
        if sentence:
            self.say(sentence)

    def say(self, sentence: str) -> None:
        """Tell something by the way."""
        print(f"svo_engine: {sentence}", file=sys.stderr, flush=True)


@contextmanager
def progress(total: float) -> Iterator[Lines]:
    """Progress through steps whose costs add up to `total`, whatever the unit."""
    try:
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    except ModuleNotFoundError:
        yield Lines()
        return
    if not sys.stderr.isatty():
        yield Lines()
        return
    from rich.console import Console

    columns = BarColumn(), TimeElapsedColumn(), TextColumn("left:"), TimeRemainingColumn()
    with Progress(*columns, TextColumn("{task.description}"), console=Console(stderr=True)) as bar:
        task, pending = bar.add_task("", total=total), 0.0

        class Bar(Lines):
            """The same as a bar; a step is done when the next one begins."""

            def step(self, text: str, cost: float = 1.0) -> None:
                nonlocal pending
                bar.update(task, advance=pending, description=text)
                pending = cost

            def skip(self, cost: float, sentence: str = "") -> None:
                bar.update(task, advance=cost)
                super().skip(cost, sentence)

            def say(self, sentence: str) -> None:
                bar.console.print(sentence, highlight=False)

        yield Bar()
        bar.update(task, completed=total, description="")
