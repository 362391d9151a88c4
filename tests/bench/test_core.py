# SPDX-License-Identifier: GPL-3.0-or-later
"""The core measures without Blender and without the report's packages; edits; the thesis's tables; scaling."""

from __future__ import annotations

import subprocess
import sys
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

from svo_engine.bench import core, edits, references, scaling, shapes, skipping, tables, thesis
from svo_engine.bench.progress import Lines, progress
from svo_engine.cli import main
from svo_engine.errors import GpuError
from svo_engine.gpu.thread import GpuThread
from svo_engine.needs import needs_of
from svo_engine.scene import store
from svo_engine.scene.camera import make_view
from svo_engine.settings import RenderSettings
from tests import scenes
from tests.on_gpu import film_of

SIZE = 16, 12
QUICK = {"cache_resolution": "32", "cache_rays": 4, "bounces": 2}
ABSENT = ("bpy", "matplotlib", "rich", "flip_evaluator", "PIL", "OpenEXR")


@pytest.fixture
def saved(tmp_path, session):
    """A scene and two halves of its reference, in files."""
    scene = scenes.cornell()
    store.save(scene, tmp_path / "room.npz")
    view = make_view(scene.camera, SIZE)
    halves = [film_of(session, scene, view, method="rays", seed=seed, **QUICK).planes["Combined"][..., :3]
              for seed in (1, 2)]
    references.save(references.from_halves(*halves), tmp_path / "room_reference.npz")
    return tmp_path


def test_ladder_with_nothing_but_the_core(saved, root):
    arguments = ["bench", "--core", "--scenes", saved / "room.npz", "--references", saved / "room_reference.npz",
                 "--out", saved / "out", "--renderers", "rays", "--samples", "1", "2", "--time-limits", "1000",
                 *(word for name, value in QUICK.items() for word in ("--set", f"{name}={value}"))]
    code = f"""
import sys
sys.modules.update(dict.fromkeys({ABSENT}))
from svo_engine.cli import main
sys.exit(main())
"""
    command = [sys.executable, "-c", code, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=root)
    assert done.returncode == 0, done.stderr
    ladder = tables.read(saved / "out", tables.Rendered)
    assert [(row.rung, row.kind) for row in ladder] == [(rung, kind) for rung in ("1 sample", "2 samples")
                                                        for kind in ("all", "light", "camera")]
    assert all(row.size == "16x12" and row.seconds > 0 and np.isfinite(row.error) for row in ladder)
    assert np.isnan(ladder[0].flip)
    by_kind = {row.kind: tables.unpack(row.parts) for row in ladder}
    assert "cache" in by_kind["light"] and "cache" not in by_kind["camera"]


def test_no_edit_compiles_a_program(session, monkeypatch):
    monkeypatch.setattr(core, "repeat", lambda shoot, _n=0: [shoot()])
    found = list(core.edit_rows(session, "room", scenes.cornell(), {**QUICK, "resolution": "32"}, SIZE, Lines()))
    assert [row.edit for row in found] == list(edits.EDITS)
    assert {row.edit: row.n_programs for row in found} == dict.fromkeys(edits.EDITS, 0)
    assert all(min(row.first, row.seconds, row.warm) > 0 for row in found)


@pytest.mark.parametrize(("arguments", "sentence"), [
    ((), "There is nothing to do"),
    (("--scenes", "a.npz", "--core"), "--out is missing"),
    (("--scenes", "a.npz", "--core", "--out", "x", "--renderers", "cycles"), "There is no renderer 'cycles' here"),
    (("--scenes", "a.npz", "--core", "--out", "x"), "a.npz"),
    (("--scaling", "--out", "x", "--set", "bounces=-1"), "must lie between"),
    (("--report", "nowhere"), "There are no tables"),
])
def test_mistakes_are_sentences(arguments, sentence, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert main(["bench", *arguments]) == 1
    assert sentence in capsys.readouterr().err


def test_one_reference_for_each_scene_or_none(saved, capsys):
    two = [str(saved / "room.npz")] * 2
    assert main(["bench", "--core", "--scenes", *two, "--references", two[0], "--out", str(saved / "out")]) == 1
    assert "2 scenes and 1 references" in capsys.readouterr().err


CHANGES = {
    "meshes": ("mesh edited",), "camera": ("camera",), "instances": ("object moved", "object added", "object deleted"),
    "lights": ("lamp's power", "lamp moved", "2nd lamp added", "3rd lamp added", "10th lamp added"),
    "materials": ("colour", "roughness", "specular 0 to .5", "metallic", "transmission", "alpha", "emission"),
    "values": ("a pass switched on", "F12's samples after a viewport's", "rays to cones", "cones to rays")}
ALIKE = ("F12's samples after a viewport's", "rays to cones", "cones to rays")  # each time the same change


def look():
    scene = scenes.cornell()
    return edits.Look(scene, scene.camera, {"samples": 1})


def changed(a, b):
    parts = ("meshes", "instances", "materials", "lights", "world")
    return {name for name in parts if getattr(a.scene, name) is not getattr(b.scene, name)} | {
        name for name in ("camera", "values") if getattr(a, name) != getattr(b, name)}


@pytest.mark.parametrize("name", edits.EDITS)
def test_every_edit_changes_what_it_says_and_nothing_else(name):
    edit = edits.EDITS[name]
    before = edit.start(look())
    first, second = edit.change(before, 1), edit.change(before, 2)
    expected = {part for part, names in CHANGES.items() if name in names}
    assert changed(before, first) == expected
    if name not in ALIKE:
        assert changed(first, second) == expected  # no two frames are the same
    RenderSettings(**first.values)


def test_lamps_and_objects_are_as_many_as_edits_say():
    def counts(name):
        before = edits.EDITS[name].start(look())
        return [(len(each.scene.lights), len(each.scene.instances)) for each in (
            before, edits.EDITS[name].change(before, 1))]

    n = len(look().scene.instances)
    assert counts("2nd lamp added") == [(1, n), (2, n)]
    assert counts("10th lamp added") == [(9, n), (10, n)]
    assert counts("object added") == [(1, n), (1, n + 1)]
    assert counts("object deleted") == [(1, n + 1), (1, n)]


def test_a_scene_without_lamps_has_no_lamp_to_edit():
    found = edits.possible(replace(scenes.cornell(), lights=()))
    assert {name for name in edits.EDITS if "lamp" in name} == set(edits.EDITS) - set(found)


def test_the_cornell_box_needs_nothing_of_mirrors_images_or_alpha(session):
    lit, _ = skipping.cases()["light"]
    shot = core.Shooter(session, SIZE).shoot(lit.scene, {**skipping.SETTINGS, **QUICK}, anew=edits.KINDS["all"])
    done = skipping.counters(shot, RenderSettings(**QUICK))
    assert {name for name, n in done.items() if not n} == {"path_steps", "principled", "emitters", "cutouts", "texels"}


@pytest.mark.parametrize("need", skipping.cases())
def test_cases_of_needs_are_scenes_that_have_them_and_lack_them(need):
    having, lacking = (needs_of(case.scene, RenderSettings(**case.values)) for case in skipping.cases()[need])
    if need == "passes":
        assert having == lacking
    else:
        assert (need in having.told(), need in lacking.told()) == (False, True)


@pytest.mark.parametrize("n", [100, 5000, 20000])
def test_a_ball_has_about_as_many_triangles_as_asked(n):
    assert len(shapes.bumpy_ball(n).triangles) == pytest.approx(n, rel=3 / np.sqrt(n) + 0.1)


@pytest.mark.parametrize(("n_lamps", "n_balls"), [(1, 1), (7, 9)])
def test_a_hall_shares_its_light_and_its_space(n_lamps, n_balls):
    hall = shapes.hall(100, n_lamps, n_balls)
    assert (len(hall.lights), len(hall.instances)) == (n_lamps, n_balls + 1)
    assert sum(lamp.emitted[0] for lamp in hall.lights) == pytest.approx(shapes.POWER)
    low, high = hall.bounds()
    assert low == pytest.approx([-1, -1, 0], abs=1e-6) and high == pytest.approx([1, 1, 2], abs=1e-6)


def test_the_walls_of_a_hall_face_inwards():
    room = shapes.hall().meshes[0]
    centres = room.positions[room.triangles].mean(1)
    assert (np.einsum("ij,ij->i", room.corner_normals[:, 0], centres - (0, 0, 1)) < 0).all()


def test_tables_of_the_thesis(monkeypatch):
    monkeypatch.setattr(thesis, "FRAME_SIZE", SIZE)
    monkeypatch.setattr(thesis, "FRAME", {**thesis.FRAME, "resolution": "32"})
    with closing(GpuThread()) as thread:
        rows = list(thesis.voxelization_rows(thread, "room", scenes.cornell(), (32,), Lines()))
    rows += thesis.frame_rows("room", scenes.cornell(), Lines())
    assert [row.what for row in rows] == ["occupancy", "voxels", "direct light", "whole frame"]
    assert all("voxelize" in row.parts for row in rows[2:])  # nothing is left from the frame before
    assert all(row.gpu_ms > 0 and row.n_runs for row in rows)
    assert rows[1].n_voxels > 0
    assert tables.unpack(rows[1].parts).keys() > tables.unpack(rows[0].parts).keys()


def test_direct_light_is_less_than_all_light(session):
    scene = scenes.cornell()
    direct, whole = (film_of(session, scene, **{**values, "resolution": "32"}).planes["Combined"][..., :3]
                     for values in (thesis.DIRECT, thesis.FRAME))
    assert 0 < direct.mean() < whole.mean()


def test_scaling_measures_each_point():
    todo = [scaling.Point("lamps", n, SIZE, {"n_triangles": 100, "n_lamps": n}, {"samples": 1, **QUICK})
            for n in (1, 2)]
    rows = list(scaling.rows(todo, Lines()))
    assert [(row.axis, row.x) for row in rows] == [("lamps", 1), ("lamps", 2)]
    assert all(row.seconds > 0 and row.n_bytes > 0 and "gather/rays" in tables.unpack(row.parts) for row in rows)


def test_what_does_not_fit_the_device_is_left_out_with_a_sentence(monkeypatch, capsys):
    def refuse(*_, **__):
        raise GpuError("Too large")

    monkeypatch.setattr(scaling.Shooter, "shoot", refuse)
    todo = [scaling.Point("lamps", 1, SIZE, {"n_triangles": 100}, {"samples": 1})]
    assert list(scaling.rows(todo, Lines())) == []
    assert "lamps: 1 is left out: Too large" in capsys.readouterr().err


@pytest.mark.parametrize("is_software", [False, True])
def test_points_are_settings_and_halls(is_software):
    points = scaling.points(is_software)
    for point in points:
        RenderSettings(**point.settings)
    assert len({(point.axis, point.x) for point in points}) == len(points)
    for axis in {point.axis for point in points}:
        xs = [point.x for point in points if point.axis == axis]
        assert len(xs) > 2 and xs == sorted(xs)


def test_progress_says_each_step_where_there_is_no_terminal(capsys):
    with progress(2) as lines:
        lines.step("one")
        lines.skip(1, "two is left out")
    assert capsys.readouterr().err == "svo_engine: one\nsvo_engine: two is left out\n"
