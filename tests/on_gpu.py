# SPDX-License-Identifier: GPL-3.0-or-later
"""One OpenGL context for all tests. A folder's conftest.py imports what it needs from here.

A test that takes `device` runs in the context's own thread, as a pass does. A test that takes `session` runs where
pytest runs, as a user's call does. No test takes both.
"""

from __future__ import annotations

import atexit
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from svo_engine.film import Film
from svo_engine.gpu.device import Device
from svo_engine.gpu.thread import GpuThread
from svo_engine.render import Session
from svo_engine.scene.types import Scene, View
from tests import scenes


@cache
def _session() -> Session:
    made = Session()
    atexit.register(made.close)
    return made


def _thread() -> GpuThread:
    return _session().opened().thread


@pytest.fixture(scope="session")
def session() -> Session:
    """The Session that the tests share."""
    return _session()


@pytest.fixture(scope="session")
def device() -> Device:
    """The device of that session."""
    return _thread().call(lambda device: device)


def film_of(session: Session, scene: Scene, through: View | None = None, **settings: Any) -> Film:
    """The last Film of `scene`, small, with some settings changed."""
    films = session.films(scene, through or scenes.view(scene), replace(scenes.SMALL, **settings))
    return list(films)[-1]


def picture_of(session: Session, scene: Scene, through: View | None = None, **settings: Any) -> np.ndarray:
    """The Combined plane of that film, (height, width, 4) f4."""
    return film_of(session, scene, through, **settings).planes["Combined"]


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run the body of a test that takes `device`, itself or by a fixture, in the device's thread."""
    if "device" not in pyfuncitem.fixturenames:
        return None
    assert "session" not in pyfuncitem.fixturenames, "no test needs both"
    arguments = {name: pyfuncitem.funcargs[name] for name in pyfuncitem._fixtureinfo.argnames}
    _thread().call(lambda _: pyfuncitem.obj(**arguments))
    return True
