# SPDX-License-Identifier: GPL-3.0-or-later
"""A viewport's rendering, in a thread of its own so that Blender never waits for it. No bpy here."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from ..errors import Cancelled
from ..film import Film
from ..scene.types import Scene, View
from ..settings import RenderSettings
from .viewport_view import Rect

FilmSource = Callable[..., Iterator[Film]]  # as Client.films


@dataclass(frozen=True, eq=False)
class Job:
    """What a viewport wants to see, and where: `rect` is (x, y, width, height) in pixels of its region."""

    scene: Scene
    view: View
    settings: RenderSettings
    rect: Rect

    def is_same(self, other: Job | None) -> bool:
        """Whether both give the same picture; scenes are the same only if they are one object."""
        return other is not None and self._key() == other._key()

    def _key(self) -> tuple[object, ...]:
        matrices = self.view.world_from_view.tobytes(), self.view.clip_from_view.tobytes()
        return id(self.scene), matrices, self.settings, self.rect

    def draft(self) -> Job:
        """The same at half the resolution and with one sample."""
        width, height = self.view.size
        view = replace(self.view, size=(max(width // 2, 1), max(height // 2, 1)))
        return replace(self, view=view, settings=replace(self.settings, samples=1))


class Worker:
    """Renders the newest job: a draft first, which only `close` interrupts, so that a moving view is never starved;
    then the samples, until another job comes in.

    finish    called in the thread when it ends
    describe  turns what a job ended with into a sentence; the exception itself would keep its whole stack alive
    shown     the newest Film with the job that it belongs to, or None
    failure   the sentence on the last job, or ""
    is_idle   whether there is nothing to be done
    """

    def __init__(self, films: FilmSource, describe: Callable[[Exception], str],
                 finish: Callable[[], None] = lambda: None) -> None:
        self.shown: tuple[Job, Film] | None = None
        self.failure = ""
        self._films, self._describe, self._finish = films, describe, finish
        self.is_idle = True
        self._job: Job | None = None
        self._finished: Job | None = None
        self._changed = threading.Condition()
        self._is_closed = False
        self._news = threading.Event()
        self._thread = threading.Thread(target=self._run, name="SVO viewport", daemon=True)
        self._thread.start()

    def show(self, job: Job) -> None:
        """Render `job`, unless that is just what is being rendered."""
        with self._changed:
            if not job.is_same(self._job):
                self._job = job
                self._changed.notify()

    def retry(self) -> None:
        """Have a job that failed begun again when it is shown next, though it be the same."""
        with self._changed:
            if self.failure:
                self._job = None

    @property
    def is_finished(self) -> bool:
        """Whether nothing more will come of the newest job."""
        return self._job is self._finished

    def take_news(self) -> bool:
        """Whether there is a new film or failure since the last call."""
        has_news = self._news.is_set()
        self._news.clear()
        return has_news

    def close(self) -> None:
        """End the thread; returns at once, and the thread ends when its sample notices."""
        with self._changed:
            self._is_closed = True
            self._changed.notify()

    def join(self, timeout: float) -> None:
        """Wait until the thread has ended, at most `timeout` seconds."""
        self._thread.join(timeout)

    def _run(self) -> None:
        job = None
        while (job := self._next(job)) is not None:
            self.is_idle = False
            try:
                self._render(job)
            except Cancelled:
                continue
            except Exception as error:  # noqa: BLE001 - the main thread tells the user
                self.failure = self._describe(error)
                self._news.set()
            finally:
                self.is_idle = True
            self._finished = job
        self._finish()

    def _next(self, done: Job | None) -> Job | None:
        """Wait for a job other than `done`; None when it is time to end."""
        with self._changed:
            self._changed.wait_for(lambda: self._is_closed or self._job not in (done, None))
            return None if self._is_closed else self._job

    def _render(self, job: Job) -> None:
        """Publish the draft's film and then the job's."""
        for part, should_stop in ((job.draft(), lambda: self._is_closed),
                                  (job, lambda: self._is_closed or self._job is not job)):
            for film in self._films(part.scene, part.view, part.settings, should_stop, is_draft=part is not job):
                self.shown, self.failure = (job, film), ""
                self._news.set()
