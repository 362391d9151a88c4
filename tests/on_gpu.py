# SPDX-License-Identifier: GPL-3.0-or-later
"""One OpenGL context for all tests. A folder's conftest.py imports what it needs from here.

A test that takes `device` runs in the context's own thread, as a pass does. A test that takes `session` runs where
pytest runs, as a user's call does. No test takes both.
"""

from __future__ import annotations

import atexit
from functools import cache

import pytest

from svo_engine.gpu.device import Device
from svo_engine.gpu.thread import GpuThread
from svo_engine.render import Session


@cache
def _session() -> Session:
    made = Session()
    atexit.register(made.close)
    return made


def _thread() -> GpuThread:
    return _session()._opened()[0]


@pytest.fixture(scope="session")
def session() -> Session:
    """The Session that the tests share."""
    return _session()


@pytest.fixture(scope="session")
def device() -> Device:
    """The device of that session."""
    return _thread().call(lambda device: device)


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run the body of a test that takes `device`, itself or by a fixture, in the device's thread."""
    if "device" not in pyfuncitem.fixturenames:
        return None
    assert "session" not in pyfuncitem.fixturenames, "no test needs both"
    arguments = {name: pyfuncitem.funcargs[name] for name in pyfuncitem._fixtureinfo.argnames}
    _thread().call(lambda _: pyfuncitem.obj(**arguments))
    return True
