# SPDX-License-Identifier: GPL-3.0-or-later
"""F12 up to the file that it writes, with a Session that paints gradients: every pixel must lie in its place."""

from __future__ import annotations

import logging
from dataclasses import replace

import bpy
import numpy as np
import OpenEXR
import pytest

from svo_engine.blender import engine, final, session, told
from svo_engine.errors import GpuError, SceneError
from tests.blender.fake_session import FakeSession, gradient

WIDTH, HEIGHT, SAMPLES = 40, 20, 3


@pytest.fixture(autouse=True)
def fake(monkeypatch):
    fake = FakeSession()
    monkeypatch.setattr(session, "current", fake)
    return fake


@pytest.fixture
def scene(empty, extension, tmp_path):
    """A camera and a cube, 40 x 20 pixels, ready for F12."""
    bpy.ops.mesh.primitive_cube_add()
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0, 0, 5)
    empty.collection.objects.link(camera)
    empty.camera = camera
    render = empty.render
    render.engine = extension.engine.SVORenderEngine.bl_idname
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    render.filepath = str(tmp_path / "picture.exr")
    if "media_type" in render.image_settings.bl_rna.properties:
        render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    empty.svo.samples = SAMPLES
    return empty


def render(scene, **options):
    """F12, and what it wrote: {"ViewLayer.Combined": (height, width, 4) f4, ...}, row 0 at the bottom."""
    assert bpy.ops.render.render(write_still=True, **options) == {"FINISHED"}
    return read(scene.render.filepath)


def read(path):
    """The colour planes of a multilayer file, "ViewLayer.Combined", in stereo "ViewLayer.Combined.left" and so on."""
    planes: dict[str, np.ndarray] = {}
    with OpenEXR.File(path) as file:
        for part in file.parts:
            ending = f".{part.header['view']}" if "view" in part.header else ""
            planes |= {name + ending: channel.pixels[::-1] for name, channel in part.channels.items()}
    return planes


def combined(scene):
    return render(scene)["ViewLayer.Combined"]


def test_picture_arrives_as_the_session_made_it(scene, fake):
    np.testing.assert_array_equal(combined(scene), gradient(WIDTH, HEIGHT, SAMPLES))
    (_, view, settings), = fake.calls
    assert view.size == (WIDTH, HEIGHT)
    assert settings.samples == SAMPLES


def test_resolution_percentage(scene):
    scene.render.resolution_percentage = 50
    np.testing.assert_array_equal(combined(scene), gradient(WIDTH // 2, HEIGHT // 2, SAMPLES))


def test_camera_of_the_view(scene, fake):
    render(scene)
    (extracted, view, _), = fake.calls
    np.testing.assert_allclose(view.world_from_view, np.array(scene.camera.matrix_world), atol=1e-6)
    expected = np.array(scene.camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=WIDTH, y=HEIGHT))
    np.testing.assert_allclose(view.clip_from_view, expected, rtol=1e-5, atol=1e-6)
    assert len(extracted.instances) == 1


# 0.1, 0.3 and 0.7 are the ones where Blender's 32-bit product and a 64-bit one fall on both sides of a whole pixel
@pytest.mark.parametrize("border", [(0.25, 0.3, 0.75, 0.8), (0.1, 0.1, 0.7, 0.7), (0.3, 0.3, 0.9, 0.9)])
@pytest.mark.parametrize("crop", [False, True])
def test_render_border(scene, border, crop):
    scene.render.use_border, scene.render.use_crop_to_border = True, crop
    scene.render.border_min_x, scene.render.border_min_y = border[:2]
    scene.render.border_max_x, scene.render.border_max_y = border[2:]
    x0, x1 = (int(np.float32(f) * np.float32(WIDTH)) for f in border[::2])
    y0, y1 = (int(np.float32(f) * np.float32(HEIGHT)) for f in border[1::2])
    inside = gradient(x1 - x0, y1 - y0, SAMPLES)
    if crop:
        expected = inside
    else:
        expected = np.zeros((HEIGHT, WIDTH, 4), "f4")
        expected[y0:y1, x0:x1] = inside
    np.testing.assert_array_equal(combined(scene), expected)


def test_each_view_layer_shows_its_own_objects(scene, fake):
    second = scene.view_layers.new("Second")
    second.layer_collection.exclude = True  # all objects lie in the scene's own collection
    collection = bpy.data.collections.new("Only first")
    scene.collection.children.link(collection)
    cube = bpy.data.objects["Cube"]
    scene.collection.objects.unlink(cube)
    collection.objects.link(cube)
    second.layer_collection.children["Only first"].exclude = True
    layers = render(scene)
    assert {"ViewLayer.Combined", "Second.Combined"} <= set(layers)
    assert [len(extracted.instances) for extracted, _, _ in fake.calls] == [1, 0]
    np.testing.assert_array_equal(layers["Second.Combined"], gradient(WIDTH, HEIGHT, SAMPLES))


def test_transparent_film_is_premultiplied(scene):
    scene.render.film_transparent = True
    np.testing.assert_array_equal(combined(scene), gradient(WIDTH, HEIGHT, SAMPLES, alpha=0.5))


def test_stereo_eyes_look_from_either_side(scene, fake):
    scene.render.use_multiview = True
    scene.camera.data.stereo.interocular_distance = 0.5
    scene.camera.data.stereo.convergence_mode = "PARALLEL"
    scene.render.image_settings.views_format = "MULTIVIEW"
    layers = render(scene)
    assert {"ViewLayer.Combined.left", "ViewLayer.Combined.right"} <= set(layers)
    left, right = (view.world_from_view[:3, 3] for _, view, _ in fake.calls)
    np.testing.assert_allclose(right - left, (0.5, 0, 0), atol=1e-6)


def test_multi_view_uses_each_views_own_camera(scene, fake):
    scene.render.use_multiview, scene.render.views_format = True, "MULTIVIEW"
    scene.render.image_settings.views_format = "MULTIVIEW"
    scene.camera.name = "Camera_L"
    wide = bpy.data.objects.new("Camera_R", bpy.data.cameras.new("Wide"))
    wide.data.lens, wide.location = 20, (1, 2, 3)
    scene.collection.objects.link(wide)
    render(scene)
    left, right = (view for _, view, _ in fake.calls)
    np.testing.assert_allclose(right.world_from_view[:3, 3], (1, 2, 3))
    # Both sensors are 36 mm wide: the focal lengths are in proportion
    np.testing.assert_allclose(left.clip_from_view[0, 0] / right.clip_from_view[0, 0], 50 / 20, rtol=1e-6)


@pytest.mark.parametrize("persistent", [False, True])
def test_animation_renders_each_frame_anew(scene, fake, persistent, tmp_path):
    scene.render.use_persistent_data = persistent
    cube = bpy.data.objects["Cube"]
    for frame in (1, 2):
        cube.location.x = frame
        cube.keyframe_insert("location", frame=frame)
    scene.frame_start, scene.frame_end = 1, 2
    scene.render.filepath = str(tmp_path / "frame_")
    bpy.ops.render.render(animation=True)
    assert [extracted.instances.world_from_object[0, 0, 3] for extracted, _, _ in fake.calls] == [1, 2]
    assert len(list(tmp_path.glob("frame_*"))) == 2


def test_animated_setting_is_the_frames_own(scene, fake):
    for frame, samples in ((1, 2), (11, 12)):
        scene.svo.samples = samples
        scene.svo.keyframe_insert("samples", frame=frame)
    scene.frame_set(11)
    render(scene)
    assert fake.calls[0][2].samples == 12


def test_stats_of_the_last_render(scene):
    session.last_stats["left over"] = 1
    render(scene)
    assert session.last_stats.pop("n_samples") == SAMPLES
    assert set(session.last_stats) == {"device", "times_ms", "counts"}


@pytest.mark.usefixtures("scene")
@pytest.mark.parametrize(("kind", "sentence"), [(SceneError, "Mesh 'Cube' is broken"), (GpuError, "OpenGL is missing")])
def test_error_of_the_user_is_one_sentence(fake, kind, sentence, caplog):
    fake.error = kind(sentence)
    with pytest.raises(RuntimeError) as raised:
        bpy.ops.render.render()
    assert str(raised.value).splitlines()[0] == f"Error: {sentence}"
    assert "Traceback" not in caplog.text


@pytest.mark.usefixtures("scene")
def test_error_of_ours_is_one_sentence_and_a_traceback_in_the_log(fake, caplog):
    fake.error = ZeroDivisionError("division by zero")
    with caplog.at_level(logging.ERROR), pytest.raises(RuntimeError, match="internal error, ZeroDivisionError"):
        bpy.ops.render.render()
    assert "Traceback" in caplog.text


@pytest.mark.usefixtures("scene")
def test_error_while_extracting_is_told_and_nothing_is_rendered(fake, monkeypatch):
    def read(_sync, _depsgraph):
        raise SceneError("Mesh 'Cube' is broken")

    monkeypatch.setattr(final.Sync, "read", read)
    with pytest.raises(RuntimeError, match="Mesh 'Cube' is broken"):
        bpy.ops.render.render()
    assert fake.calls == []


def test_error_after_some_samples_keeps_them(scene, fake):
    fake.error, fake.n_before_error = GpuError("The device was lost"), 2
    with pytest.raises(RuntimeError, match="The device was lost"):
        bpy.ops.render.render()
    bpy.data.images["Render Result"].save_render(scene.render.filepath)
    np.testing.assert_array_equal(read(scene.render.filepath)["ViewLayer.Combined"], gradient(WIDTH, HEIGHT, 2))


def test_next_render_after_an_error_is_whole(scene, fake):
    fake.error = GpuError("The device was lost")
    with pytest.raises(RuntimeError, match="device"):
        bpy.ops.render.render()
    fake.error = None
    np.testing.assert_array_equal(combined(scene), gradient(WIDTH, HEIGHT, SAMPLES))


def test_no_camera_is_told(scene, fake):
    scene.camera = None
    with pytest.raises(RuntimeError, match="no camera"):
        bpy.ops.render.render()
    assert fake.calls == []


def test_warnings_of_the_extraction_are_reported(scene, monkeypatch, capfd):
    real = final.Sync.read
    warnings = ("Image 'wood' is missing",)
    monkeypatch.setattr(final.Sync, "read", lambda sync, depsgraph: replace(real(sync, depsgraph), warnings=warnings))
    render(scene)
    assert "Warning: Image 'wood' is missing" in capfd.readouterr().out
    assert not told.keep(warnings)  # for the panels


class Pretending:
    """A RenderEngine but for some attributes: Blender's own cannot be replaced, and nobody presses Esc here."""

    def __init__(self, engine, **pretended):
        self._engine = engine
        self.__dict__.update(pretended)

    def __getattr__(self, name):
        return getattr(self._engine, name)


def test_escape_keeps_the_samples_so_far_and_is_no_error(scene, monkeypatch):
    answers = iter([False, False, True])
    real = engine.render_frame
    monkeypatch.setattr(engine, "render_frame",
                        lambda host, frame: real(Pretending(host, test_break=lambda: next(answers)), frame))
    np.testing.assert_array_equal(combined(scene), gradient(WIDTH, HEIGHT, 2))


def test_progress_and_stats_line(scene, monkeypatch):
    progress: list[float] = []
    lines: list[str] = []
    real = engine.render_frame
    monkeypatch.setattr(engine, "render_frame", lambda host, frame: real(
        Pretending(host, update_progress=progress.append, update_stats=lambda _a, b: lines.append(b)), frame))
    render(scene)
    assert progress == [1 / 3, 2 / 3, 1]
    assert lines == ["Preparing", "Sample 1/3", "Sample 2/3", "Sample 3/3"]


def test_what_is_the_same_in_the_next_render_is_the_same_object(scene, fake):
    render(scene)
    render(scene)
    bpy.ops.mesh.primitive_plane_add()
    render(scene)
    first, second, third = (call[0] for call in fake.calls)
    assert first is second
    assert third.instances is not first.instances
    assert all(a is b for a, b in zip(third.meshes, first.meshes, strict=False))


def test_preview_is_small_work_and_leaves_the_stats(scene, fake, monkeypatch):
    real_extract, real_render = engine.extract_frame, engine.render_frame
    monkeypatch.setattr(engine, "extract_frame",
                        lambda host, depsgraph: real_extract(Pretending(host, is_preview=True), depsgraph))
    monkeypatch.setattr(engine, "render_frame",
                        lambda host, frame: real_render(Pretending(host, is_preview=True), frame))
    scene.svo.samples, scene.svo.view = 1000, "voxel_albedo"
    session.last_stats["kept"] = 1
    render(scene)
    (_, _, settings), = fake.calls
    assert (settings.samples, settings.cache_resolution, settings.view) == (4, "32", "combined")
    assert session.last_stats == {"kept": 1}
