# SPDX-License-Identifier: GPL-3.0-or-later
"""Extraction reads: the user's file is afterwards what it was, and the same file gives the same Scene to the bit."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest

from svo_engine.blender.extract.meshes import read_mesh
from svo_engine.scene import store
from tests.blender.build import extracted, lamp, material, one_color, place, plane, world


@pytest.fixture
def rich(empty, tmp_path):
    """A file, just saved, with something of everything that is read."""
    nodes = material()
    texture = nodes.new("TexImage")
    texture.image = one_color(1, 0, 0, 0.5)
    texture.image.pack()
    missing = nodes.new("TexImage")
    missing.image = bpy.data.images.new("Missing", 4, 4)
    missing.image.source, missing.image.filepath = "FILE", str(tmp_path / "missing.png")
    shown = nodes.show(nodes.new("BsdfPrincipled", Base_Color=texture, Emission_Color=missing, Emission_Strength=1.0))
    sky = world()
    sky.show(sky.new("Background", Color=sky.new("TexSky")))
    bpy.ops.object.text_add()
    bpy.ops.object.metaball_add()
    lamp("SPOT", at=(0, 0, 3))
    plane(shown).modifiers.new("Array", "ARRAY")
    empty.camera = place(bpy.data.cameras.new("Camera"), "Camera", at=(0, 0, 5))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "rich.blend"))
    return empty


def datablocks():
    """Every datablock of the file by its kind and name, with the number of its users."""
    kinds = [p.identifier for p in bpy.data.bl_rna.properties if p.type == "COLLECTION"]
    return {(kind, item.name_full): item.users for kind in kinds for item in getattr(bpy.data, kind)}


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_file_is_what_it_was(rich, mode):
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.wm.save_mainfile()
    before = datablocks(), bpy.data.is_dirty
    (told,) = extracted().warnings  # the sky and all else are understood
    assert "//missing.png" in told
    assert (datablocks(), bpy.data.is_dirty) == before
    assert bpy.context.object.mode == mode


def test_same_file_same_scene(rich, tmp_path):
    for name in ("a.npz", "b.npz"):
        store.save(extracted(), tmp_path / name)
        bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_copy_of_an_edited_mesh_is_given_back_even_if_it_cannot_be_read():
    calls = []
    owner = SimpleNamespace(name="Edited", data=SimpleNamespace(is_editmode=True), to_mesh=lambda: calls.append("made"),
                            to_mesh_clear=lambda: calls.append("cleared"))
    with pytest.raises(AttributeError):
        read_mesh(owner, calls.append)
    assert calls == ["made", "cleared"]
