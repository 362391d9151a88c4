# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaders that tests write themselves."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from svo_engine.gpu import glsl
from svo_engine.gpu.device import Device
from svo_engine.gpu.passes import Pass

HEAD = """layout(local_size_x = 64) in;
uniform uint u_first;
uniform uint u_end;
"""


@contextmanager
def written(device: Device, folder: Path) -> Iterator[Callable[[str, str], Pass]]:
    """write(name, text): a compute pass of `folder`; no program of the device's own is there meanwhile, nor after."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(glsl, "compose", partial(glsl.compose, root=folder))
        patch.setattr(device.programs, "_ready", {})
        patch.setattr(device.programs, "_jobs", {})

        def write(name: str, text: str) -> Pass:
            (folder / f"{name}.comp.glsl").write_text(HEAD + text)
            return Pass(f"{name}.comp.glsl")

        yield write
        device.programs.release()
