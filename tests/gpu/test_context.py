# SPDX-License-Identifier: GPL-3.0-or-later
"""Without OpenGL 4.3: a sentence that says what was found and what to install."""

from __future__ import annotations

import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu import context as module
from svo_engine.render import Session
from tests import scenes


class OldContext:
    """What an old graphics card gives."""

    def __init__(self) -> None:
        self.info, self.version = {"renderer": "Old Card", "version": "3.3.0 Core"}, 330

    def release(self) -> None:
        pass


@pytest.fixture
def no_opengl(monkeypatch):
    def fail(_):
        raise Exception("(load_library) libEGL.so.1: no such file")  # as glcontext does

    monkeypatch.setattr(module, "_create", fail)


@pytest.fixture(params=[430, 330], ids=["which does not heed what is asked", "which refuses"])
def old_opengl(monkeypatch, request):
    def make(version):
        if version > request.param:
            raise Exception("cannot create context")
        return OldContext()

    monkeypatch.setattr(module, "_create", make)


@pytest.mark.usefixtures("no_opengl")
def test_without_opengl(monkeypatch):
    monkeypatch.setattr(module.sys, "platform", "linux")
    with pytest.raises(GpuError) as caught:
        module.create_context()
    sentence = str(caught.value)
    assert "OpenGL 4.3 is needed" in sentence
    assert "no such file" in sentence
    assert "apt-get install libegl1" in sentence
    assert "\n" not in sentence


@pytest.mark.usefixtures("old_opengl")
def test_with_an_old_opengl():
    with pytest.raises(GpuError, match=r"OpenGL 4\.3 is needed, but Old Card offers only 3\.3\.0 Core; install"):
        module.create_context()


@pytest.mark.usefixtures("old_opengl")
def test_a_session_tells_its_caller_and_can_be_closed():
    session = Session()
    scene = scenes.cornell()
    for _ in range(2):
        with pytest.raises(GpuError, match="Old Card"):
            session.device_info()
    with pytest.raises(GpuError, match="Old Card"):
        next(session.films(scene, scenes.view(scene), scenes.SMALL))
    session.close()
