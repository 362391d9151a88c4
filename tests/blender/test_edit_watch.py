# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits in front of a viewport without a window: what is seen of them, and that the scene is as it was afterwards."""

from __future__ import annotations

from dataclasses import replace
from math import isnan

import bpy
import pytest
from mathutils import Matrix

from svo_engine.blender import edit_watch, session
from svo_engine.blender.extract import extract
from tests.blender.build import lamp, material, plane
from tests.blender.fake_session import FakeSession
from tests.blender.following import differences

SIZE = 32, 24


class Fake(FakeSession):
    """Films say that no program was compiled for them."""

    def films(self, *args, **more):
        for film in super().films(*args, **more):
            yield replace(film, stats={**film.stats, "counts": {"programs compiled": 0}})

    def client(self):
        return self

    def compile_now(self):
        """There is nothing."""


@pytest.fixture
def watch(empty, extension, monkeypatch):
    made = material("Plain")
    made.show(made.new("BsdfPrincipled", Roughness=0.5))
    plane(made.owner, name="Plain")
    lamp("POINT", at=(0, 0, 3), energy=100.0)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    empty.collection.objects.link(camera)
    empty.camera = camera
    camera.matrix_world = Matrix.Translation((0, 0, 9))
    empty.svo.viewport_samples = 2
    monkeypatch.setattr(session, "current", Fake())
    with edit_watch.watched(empty, SIZE) as watch:
        yield watch


def test_every_act_gives_pictures_and_leaves_the_scene_as_it_was(watch):
    graph = bpy.context.evaluated_depsgraph_get
    acts = watch.acts()
    assert {"lamp's power", "10th lamp added", "roughness", "object deleted", "mesh edited", "camera"} <= set(acts)
    for name, act in acts.items():
        before = extract(graph())
        watch.see(act.start)
        seen = watch.see(lambda act=act: act.do(1))
        assert 0 < seen.first <= seen.final and seen.main > 0, name
        act.end()
        if name != "mesh edited":
            assert set(differences(before, extract(graph()))) <= {"warnings"}, name


def test_what_changes_no_picture_gives_none(watch):
    seen = watch.see(lambda: None)
    assert isnan(seen.first) and isnan(seen.final)
