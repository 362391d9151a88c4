# SPDX-License-Identifier: GPL-3.0-or-later
"""Lifetimes of OpenGL objects: counted, limited, released."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.errors import GpuError


def test_a_scope_counts_what_it_makes_and_gives_it_back(device):
    before, n_scopes = device.n_bytes, len(device.scopes)
    with device.scope() as scope:
        scope.buffer("a", np.zeros(25, "f4"))
        scope.buffer("b", 28)
        texture = scope.texture("c", (8, 4), 4, "f4")
        scope.framebuffer("d", texture)
        scope.cube("e", 8)
        assert scope.n_objects == 5
        assert scope.n_bytes == 100 + 28 + 8 * 4 * 16 + 8 * 4 * 4 + 8 * 8**3 * 8 // 7
        assert device.n_bytes == before + scope.n_bytes
    assert scope.n_bytes == scope.n_objects == 0
    assert (device.n_bytes, len(device.scopes)) == (before, n_scopes)


def test_a_scope_is_closed_by_an_error(device):
    before = device.n_bytes
    with pytest.raises(ZeroDivisionError), device.scope() as scope:
        scope.buffer("a", 1000 // 0)
    assert device.n_bytes == before


def test_closing_twice_does_nothing(device):
    scope = device.scope()
    scope.buffer("a", 16)
    scope.close()
    scope.close()


def test_a_buffer_holds_what_it_is_given(device):
    data = np.arange(30, dtype="u4").reshape(5, 6)[:, ::2]  # not contiguous
    with device.scope() as scope:
        assert np.array_equal(np.frombuffer(scope.buffer("a", data).read(), "u4"), data.ravel())
        assert scope.buffer("b", 40, clear=True).read() == bytes(40)
        assert scope.buffer("c", np.zeros(0, "f4")).size > 0  # an empty block could not be bound


@pytest.mark.parametrize(("components", "dtype"), [(1, "u4"), (4, "u4"), (4, "f4")])
def test_a_texture_holds_what_it_is_given(device, components, dtype):
    pixels = np.arange(5 * 3 * components).reshape(3, 5, components).astype(dtype)
    with device.scope() as scope:
        texture = scope.texture("a", (5, 3), components, dtype, pixels)
        assert np.array_equal(texture.read(), pixels)
        buffer = scope.buffer("b", pixels.nbytes)
        texture.copy_to(buffer)
        assert buffer.read() == pixels.tobytes()


def test_layers_hold_what_they_are_given(device):
    pixels = np.arange(2 * 3 * 5 * 4, dtype="f4").reshape(2, 3, 5, 4)
    with device.scope() as scope:
        layers = scope.layers("a", (5, 3), 2)
        assert not layers.read().any()
        layers.write(pixels)
        assert np.array_equal(layers.read(), pixels)


def test_parts_of_a_buffer_are_read_written_and_copied(device):
    with device.scope() as scope:
        one, two = scope.buffer("a", np.arange(8, dtype="u4")), scope.buffer("b", 32, clear=True)
        one.write(b"\xff" * 4, offset=4)
        two.copy_from(one, 12, read_offset=4, write_offset=8)
        assert np.frombuffer(two.read(16, offset=4), "u4").tolist() == [0, 0xFFFFFFFF, 2, 3]
        rows = np.zeros((2, 2), "u4")
        two.read_into(rows, offset=8)
        assert rows.tolist() == [[0xFFFFFFFF, 2], [3, 0]]
        two.clear(12)
        assert np.frombuffer(two.read(), "u4").tolist() == [0, 0, 0, 2, 3, 0, 0, 0]


def test_a_buffer_past_the_limit_is_an_error_with_all_numbers(device, monkeypatch):
    monkeypatch.setattr(device, "limits", {**device.limits, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE": 2**20})
    with device.scope() as scope:
        with pytest.raises(GpuError, match=r"'voxels' .*1\.5 MiB.* 1\.0 MiB.*GL_MAX_SHADER_STORAGE_BLOCK_SIZE"):
            scope.buffer("voxels", 3 * 2**19)
        scope.buffer("voxels", 2**20)
        assert scope.n_objects == 1


def test_a_texture_past_the_limit_is_an_error_with_all_numbers(device):
    largest = device.limits["GL_MAX_TEXTURE_SIZE"]
    sentence = rf"'film' .*{largest + 1}x2 .*{largest}.*GL_MAX_TEXTURE_SIZE"
    with device.scope() as scope, pytest.raises(GpuError, match=sentence):
        scope.texture("film", (largest + 1, 2), 4, "f4")


def test_a_cube_past_the_limit_is_an_error_with_all_numbers(device):
    largest = device.limits["GL_MAX_3D_TEXTURE_SIZE"]
    sentence = rf"'light' .*{2 * largest} .*{largest}.*GL_MAX_3D_TEXTURE_SIZE"
    with device.scope() as scope, pytest.raises(GpuError, match=sentence):
        scope.cube("light", 2 * largest)
