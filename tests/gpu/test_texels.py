# SPDX-License-Identifier: GPL-3.0-or-later
"""gpu/texels.py: storage buffers that shaders read as texels."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.errors import GpuError
from tests.compute import evaluate

PRELUDE = "uniform usamplerBuffer u_{0};"


def test_words_come_back(device):
    """Two buffers at a time, each its own words, bits of floats that are no numbers among them."""
    rng = np.random.default_rng(2)
    words = rng.integers(0, 2**32, (2, 300, 4), dtype="u8").astype("u4")
    words[:, :4] = np.array([0, 1, 0x80000001, 0x7F800001, 0xFFFFFFFF, 0x7FC00000, 0xFF800000, 0x00400000,
                             *range(8)], "u4").reshape(4, 4)
    with device.scope() as scope:
        both = {f"u_{name}": scope.texels(name, w) for name, w in zip("ab", words, strict=True)}
        for i, name in enumerate("ab"):
            read = evaluate(device, "uvec4", f"texelFetch(u_{name}, int(at)) + 0u * texelFetch(u_{'ba'[i]}, int(at))",
                            prelude=PRELUDE.format("a") + PRELUDE.format("b"), textures=both,
                            at=np.arange(300, dtype="u4"))
            assert (read == words[i]).all()


def test_what_is_written_is_read(device):
    """The texels are the buffer's own memory; both count and go once."""
    before = device.n_bytes
    with device.scope() as scope:
        texels = scope.texels("words", 64)
        texels.buffer.write(np.arange(16, dtype="u4").tobytes())
        read = evaluate(device, "uvec4", "texelFetch(u_a, int(at))", prelude=PRELUDE.format("a"),
                        textures={"u_a": texels}, at=np.arange(4, dtype="u4"))
        assert (read.ravel() == np.arange(16)).all()
        assert scope.n_bytes == 64
    assert device.n_bytes == before


def test_more_texels_than_the_device_reads(device, monkeypatch):
    """The limit of the texture unit is named."""
    monkeypatch.setitem(device.limits, "GL_MAX_TEXTURE_BUFFER_SIZE", 100)
    with device.scope() as scope, pytest.raises(GpuError, match=r"'words' needs .* MiB, the device allows 0.0 MiB"):
        scope.texels("words", 1616)
