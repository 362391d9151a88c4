# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison with an engine that paints known colours, so that every number has a closed form; and with Cycles."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar

import bpy
import numpy as np
import OpenEXR
import pytest
from PIL import Image as PillowImage

from svo_engine.blender import compare as operator
from svo_engine.blender import session
from svo_engine.blender.comparison import compare, steps
from svo_engine.blender.runs import Run, cycles_run, svo_run
from svo_engine.errors import Cancelled, GpuError, SvoError
from svo_engine.film import encode_srgb
from svo_engine.metrics import HEAT
from tests.blender.fake_session import FakeSession

WIDTH, HEIGHT = 40, 30


class Painter(bpy.types.RenderEngine):
    """Each render takes the next of `paints`: (engine, depsgraph) -> colour, broadcast to (height, width, 4)."""

    bl_idname = "TEST_PAINTER"
    bl_label = "Painter"
    paints: ClassVar[list[Callable]] = []

    def render(self, depsgraph):
        color = Painter.paints.pop(0)(self, depsgraph)
        if color is None:
            return
        size = self.get_result().resolution_x, self.get_result().resolution_y
        result = self.begin_result(0, 0, *size, layer=depsgraph.view_layer.name)
        pixels = np.broadcast_to(np.asarray(color, "f4"), (size[1], size[0], 4))
        result.layers[0].passes["Combined"].rect.foreach_set(pixels.ravel())
        self.end_result(result)


def plain(value):
    return lambda _engine, _depsgraph: (value, value, value, 1)


OURS, REFERENCE = (Run(name, "TEST_PAINTER", "cycles", {}, lambda _scene: {}) for name in ("ours", "reference"))


@pytest.fixture
def scene(empty, extension):
    """A camera that sees nothing, 40 x 30 pixels."""
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    empty.collection.objects.link(camera)
    empty.camera = camera
    empty.render.resolution_x, empty.render.resolution_y, empty.render.resolution_percentage = WIDTH, HEIGHT, 100
    bpy.utils.register_class(Painter)
    yield empty
    bpy.utils.unregister_class(Painter)


@pytest.fixture
def paint(scene, tmp_path):
    """Compare the paintings of the two given functions; the Comparison."""
    def run(*paints, ours=OURS, reference=REFERENCE, layer=None, folder=tmp_path):
        Painter.paints = list(paints)
        return compare(scene, layer or scene.view_layers[0], folder, ours, reference)

    return run


def test_numbers_of_two_flat_pictures(paint, tmp_path):
    found = paint(plain(0.5), plain(0.25))
    e = found.errors
    assert (e.nrmse, e.bias, e.rel_mse) == pytest.approx((1, 1, 0.0625 / (0.0625 + 0.01)), rel=1e-12)
    assert e.psnr == pytest.approx(0, abs=1e-9)
    assert min(found.seconds) > 0
    files = {path.name for path in tmp_path.iterdir()}
    assert files == {"ours.exr", "reference.exr", "comparison.png", "comparison.json"}
    report = json.loads((tmp_path / "comparison.json").read_text())
    assert report["errors"]["nrmse"] == e.nrmse
    assert report["size"] == [WIDTH, HEIGHT]
    assert (report["ours"]["seconds"], report["reference"]["seconds"]) == found.seconds
    assert report["versions"]["blender"] == bpy.app.version_string
    assert "NRMSE 1.0000" in found.sentence()


def override_output_space(scene):
    """The user writes EXRs in a space of their own, compressed with loss, and has a view of their own for the rest."""
    image = scene.render.image_settings
    image.file_format, image.exr_codec, image.color_management = "OPEN_EXR", "DWAA", "OVERRIDE"
    image.linear_colorspace_settings.name = "Linear Rec.2020"
    image.view_settings.view_transform, image.view_settings.exposure = "Raw", 2


@pytest.mark.parametrize("prepare", [lambda _scene: None, override_output_space], ids=["defaults", "output space"])
def test_files_hold_the_very_floats(paint, scene, tmp_path, prepare):
    prepare(scene)
    rng = np.random.default_rng(1)
    painted = [rng.normal(1, 30, (HEIGHT, WIDTH, 4)).astype("f4") for _ in range(2)]
    paint(*(lambda _engine, _depsgraph, p=p: p for p in painted))
    for name, pixels in zip(("ours", "reference"), painted, strict=True):
        with OpenEXR.File(str(tmp_path / f"{name}.exr")) as file:
            np.testing.assert_array_equal(file.channels()["RGBA"].pixels[::-1], pixels)


def test_picture_shows_both_and_the_difference(paint, scene, tmp_path):
    scene.view_settings.exposure = 1
    paint(plain(0.125), plain(0.25))
    pixels = np.asarray(PillowImage.open(tmp_path / "comparison.png")).astype("f4") / 255
    middles = [pixels[-HEIGHT // 2, WIDTH // 2 + i * (pixels.shape[1] + 4) // 3] for i in range(3)]
    stops = np.linspace(0, 1, len(HEAT))
    heat = [np.interp(0.125 / math.sqrt(0.25**2 + 0.01), stops, channel) for channel in HEAT.T]
    expected = [encode_srgb(np.full(3, 0.25)), encode_srgb(np.full(3, 0.5)), np.array(heat)]
    np.testing.assert_allclose(np.array(middles)[:, :3], expected, atol=0.5 / 255 + 1e-6)  # a byte's rounding


def test_pixels_that_are_not_finite_are_counted(paint, tmp_path):
    spoilt = np.ones((HEIGHT, WIDTH, 4))
    spoilt[3, 4, 0], spoilt[5, 6, 1] = np.nan, np.inf
    found = paint(lambda _engine, _depsgraph: spoilt, plain(1))
    assert (found.errors.n_not_finite, found.errors.nrmse) == (2, 0)
    assert "2 pixels not finite" in found.sentence()
    report = json.loads((tmp_path / "comparison.json").read_text(), parse_constant=pytest.fail)
    assert report["errors"]["psnr"] is None  # equal where they are finite


def test_border_alone_is_compared(paint, scene):
    scene.render.use_border, scene.render.use_crop_to_border = True, False
    scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75
    scene.render.border_min_y, scene.render.border_max_y = 0.5, 1.0
    found = paint(plain(3), plain(2))
    assert found.errors.nrmse == pytest.approx(0.5)
    with PillowImage.open(found.picture) as picture:
        assert picture.width == 3 * WIDTH // 2 + 2 * 4
    assert not scene.render.use_crop_to_border


@pytest.mark.parametrize("index", [0, 1, 2])
def test_view_layer_that_is_asked_for(paint, scene, index):
    layers = [scene.view_layers[0], scene.view_layers.new("Second"), scene.view_layers.new("Third")]
    layers[1].use = False
    rendered = []

    def by_layer(_engine, depsgraph):
        rendered.append(depsgraph.view_layer.name)
        return 4, 4, 4, 1

    assert paint(by_layer, plain(2), layer=layers[index]).errors.bias == 1
    assert rendered == [layers[index].name]
    assert [layer.use for layer in layers] == [True, False, True]


def test_settings_of_cycles_are_in_place_while_it_renders(paint, scene):
    seen: dict[str, Any] = {}

    def note(_engine, depsgraph):
        c, r = depsgraph.scene.cycles, depsgraph.scene.render
        seen.update(samples=c.samples, width=c.filter_width, filter=c.pixel_filter_type, bounces=c.max_bounces,
                    diffuse=c.diffuse_bounces, off=(c.use_adaptive_sampling, c.use_denoising, c.sample_clamp_direct,
                                                    c.sample_clamp_indirect, r.use_compositing, r.use_sequencer))
        return 1, 1, 1, 1

    scene.svo.filter_width, scene.cycles.filter_width = 2.5, 1.0
    scene.cycles.sample_clamp_indirect, scene.cycles.pixel_filter_type = 10, "BOX"
    reference = replace(cycles_run(scene, samples=7, bounces=2), engine="TEST_PAINTER")
    paint(plain(1), note, reference=reference)
    assert seen == {"samples": 7, "width": 2.5, "filter": "BLACKMAN_HARRIS", "bounces": 2, "diffuse": 2,
                    "off": (False, False, 0, 0, False, False)}


def test_bounces_stay_those_of_the_scene_unless_given(scene):
    assert "max_bounces" not in cycles_run(scene, 1).values


def state(scene):
    """Every property of the scene's settings, whether it was ever set, and the names of all datablocks."""
    apart = bpy.types.ID, bpy.types.Depsgraph  # what a setting points to is not a setting itself

    def dump(owner, path):
        for prop in list(owner.bl_rna.properties)[1:]:  # but the first, which is the type
            value, where = getattr(owner, prop.identifier), f"{path}.{prop.identifier}"
            if prop.type == "POINTER" and value is not None and not isinstance(value, apart):
                yield from dump(value, where)
            elif prop.type != "COLLECTION":
                is_set = owner.is_property_set(prop.identifier)
                yield where, (tuple(value) if getattr(prop, "is_array", False) else value, is_set)

    owners = {"render": scene.render, "cycles": scene.cycles, "svo": scene.svo, "layer": scene.view_layers[0],
              "view": scene.view_settings, "display": scene.display_settings}
    found = {key: value for name, owner in owners.items() for key, value in dump(owner, name)}
    blocks = {name: [block.name for block in getattr(bpy.data, name)] for name in dir(bpy.data)
              if isinstance(getattr(bpy.data, name), bpy.types.bpy_prop_collection)}
    space = "render.image_settings.linear_colorspace_settings.name"
    if found[space] == ("", True):  # Blender fills it in at the first change of the format, and takes no empty one
        found[space] = ("sRGB", True)
    handlers = bpy.app.handlers.render_cancel, bpy.app.handlers.render_complete
    return found | blocks | {"frame": (scene.frame_current, scene.frame_subframe), "camera": scene.camera.name,
                             "handlers": [len(functions) for functions in handlers]}


def disturb(scene):
    """Other values than a comparison needs, wherever it changes something."""
    render, image, cycles = scene.render, scene.render.image_settings, scene.cycles
    render.engine, render.dither_intensity, render.use_stamp, render.use_multiview = "BLENDER_WORKBENCH", 2, True, True
    render.use_persistent_data = render.use_freestyle = True
    if "media_type" in image.bl_rna.properties:
        image.media_type = "VIDEO"
    image.file_format = "FFMPEG"
    cycles.samples, cycles.filter_width, cycles.use_denoising, cycles.time_limit = 77, 3, True, 0.5
    cycles.sample_clamp_direct, cycles.use_fast_gi, cycles.device = 2, True, "GPU"


def report_error(engine, _depsgraph):
    engine.report({"ERROR"}, "The paint is dry")


def cancel(_engine, depsgraph):
    for handler in bpy.app.handlers.render_cancel:  # what Blender does when Esc was pressed
        handler(depsgraph.scene)
    return 1, 1, 1, 1


def fail(_scene):
    raise GpuError("No canvas")


@pytest.mark.parametrize("prepare", [lambda _scene: None, disturb, override_output_space],
                         ids=["defaults", "disturbed", "output space"])
@pytest.mark.parametrize(("ending", "change", "error"), [
    (plain(2), {}, None),
    (report_error, {}, "The paint is dry"),
    (cancel, {}, "was cancelled"),
    (plain(2), {"describe": fail}, "No canvas"),
    (plain(2), {"engine": "NONE_SUCH"}, "no render engine NONE_SUCH"),
    (plain(2), {"values": {"samples": 5, "pixel_filter_type": "NONE_SUCH"}}, "NONE_SUCH"),
], ids=["success", "error", "cancel", "describe", "engine", "setting"])
def test_scene_is_left_as_it_was(paint, scene, prepare, ending, change, error):
    prepare(scene)
    before = state(scene)
    run = replace(cycles_run(scene, samples=3, bounces=1), engine="TEST_PAINTER", describe=lambda _scene: {})
    reference = replace(run, **change)
    if error is None:
        paint(plain(1), ending, reference=reference)
    else:
        with pytest.raises((SvoError, TypeError), match=error):
            paint(plain(1), ending, reference=reference)
    assert state(scene) == before


def test_cancel_is_told_apart_from_an_error(paint):
    with pytest.raises(Cancelled):
        paint(plain(1), cancel)


def test_no_render_result_is_left_where_there_was_none(paint):
    for image in list(bpy.data.images):
        bpy.data.images.remove(image)
    paint(plain(1), plain(1))
    assert list(bpy.data.images) == []


@pytest.mark.parametrize("folder", ["/proc/none", "file/below"])
def test_folder_that_cannot_be_written_is_told_before_any_render(paint, tmp_path, folder):
    (tmp_path / "file").touch()
    with pytest.raises(SvoError, match=f"Cannot write into the folder '.*{folder}'"):
        paint(folder=tmp_path / folder)  # a render would fail for want of paint


def test_missing_folder_is_made(paint, tmp_path):
    paint(plain(1), plain(1), folder=tmp_path / "not" / "yet")
    assert (tmp_path / "not" / "yet" / "comparison.png").exists()


def test_scene_without_camera_is_told(paint, scene):
    scene.camera = None
    with pytest.raises(SvoError, match=r"^Cannot render, no camera$"):
        paint(plain(1), plain(1))


def test_stats_of_an_earlier_render_are_not_taken_for_this_one(paint, monkeypatch):
    monkeypatch.setattr(session, "last_stats", {"device": "an earlier one"})
    with pytest.raises(SvoError, match="without a picture"):
        paint(plain(1), ours=replace(svo_run(), engine="TEST_PAINTER"))


def test_cycles_equals_itself_and_names_its_settings(scene, tmp_path):
    bpy.ops.mesh.primitive_plane_add(location=(0, 0, -5))
    bpy.ops.object.light_add(type="POINT", location=(1, 0, -2))
    run = cycles_run(scene, samples=2)
    found = compare(scene, scene.view_layers[0], tmp_path, replace(run, name="again"), run)
    assert found.errors.nrmse == 0
    with OpenEXR.File(str(tmp_path / "cycles.exr")) as file:
        assert file.channels()["RGBA"].pixels[..., :3].max() > 0
    report = json.loads((tmp_path / "comparison.json").read_text())
    assert report["cycles"]["settings"]["samples"] == 2
    assert report["cycles"]["device"] == "CPU"


@pytest.fixture
def fake(monkeypatch):
    fake = FakeSession()
    monkeypatch.setattr(session, "current", fake)
    return fake


@pytest.mark.usefixtures("fake")
def test_operator_compares_the_frame_with_cycles(scene, tmp_path, capfd):
    before = state(scene)
    assert bpy.ops.svo.compare(samples=1, directory=str(tmp_path)) == {"FINISHED"}
    assert {path.name for path in tmp_path.iterdir()} == {"svo.exr", "cycles.exr", "comparison.png", "comparison.json"}
    report = json.loads((tmp_path / "comparison.json").read_text())
    assert report["svo"]["settings"]["method"] == scene.svo.method
    assert set(report["svo"]["times_ms"]) == {"extract", "paint", "hand over"}
    assert "NRMSE" in capfd.readouterr().out
    assert state(scene) == before


@pytest.fixture
def start(scene, tmp_path):
    """Begin what the operator does in a window; without one, Blender renders while `advance` waits."""
    def job(*paints):
        Painter.paints = list(paints)
        return operator.Job(scene, steps(scene, scene.view_layers[0], tmp_path, OURS, REFERENCE))

    return job


def test_job_renders_step_by_step(start, tmp_path):
    with start(plain(0.5), plain(0.25)) as job:
        assert [job.advance(), len(Painter.paints)] == [None, 1]
        assert [job.advance(), len(Painter.paints)] == [None, 0]
        assert job.advance().errors.nrmse == 1
    assert (tmp_path / "comparison.json").exists()


@pytest.mark.parametrize("n_steps", [0, 1, 2])
def test_job_that_is_given_up_leaves_the_scene_as_it_was(start, scene, n_steps):
    before = state(scene)
    with start(plain(1), plain(1)) as job:
        for _ in range(n_steps):
            job.advance()
        assert (state(scene) != before) == (n_steps > 0)
    assert state(scene) == before


def test_job_that_is_cancelled_leaves_the_scene_as_it_was(start, scene):
    before = state(scene)
    with start(plain(1), cancel) as job:
        job.advance()
        job.advance()
        with pytest.raises(Cancelled):
            job.advance()
    assert state(scene) == before


@pytest.mark.usefixtures("scene")
def test_operator_reports_an_error_of_ours(fake, tmp_path):
    fake.error = GpuError("OpenGL is missing")
    with pytest.raises(RuntimeError, match="OpenGL is missing"):
        bpy.ops.svo.compare(samples=1, directory=str(tmp_path))


@pytest.mark.usefixtures("scene")
def test_operator_takes_a_cancel_for_no_fault(tmp_path, monkeypatch):
    monkeypatch.setattr(operator, "svo_run", lambda: OURS)
    Painter.paints = [cancel]
    assert bpy.ops.svo.compare(samples=1, directory=str(tmp_path)) == {"CANCELLED"}
