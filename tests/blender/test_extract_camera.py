# SPDX-License-Identifier: GPL-3.0-or-later
"""The extracted camera, through `make_view`, against the projection that Blender itself makes of it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from svo_engine.blender.extract import border
from svo_engine.errors import SceneError
from svo_engine.scene.camera import make_view
from tests.blender.build import extracted, place


@pytest.fixture
def camera(empty):
    """The scene's camera object."""
    empty.camera = place(bpy.data.cameras.new("Camera"), "Camera")
    return empty.camera


def test_random_cameras_project_as_blenders(empty, camera):
    rng = np.random.default_rng(0)
    for _ in range(300):
        _randomize(rng, camera, empty.render)
        found = extracted().camera
        view = make_view(found)
        expected = camera.calc_matrix_camera(
            bpy.context.evaluated_depsgraph_get(), x=found.size[0], y=found.size[1],
            scale_x=empty.render.pixel_aspect_x, scale_y=empty.render.pixel_aspect_y)
        # Blender takes differences of 32-bit window edges: what is left of their 6e-8 after shifts up to 1 and aspects
        # up to 20 is below 1e-5 of the matrix's largest entry
        np.testing.assert_allclose(view.clip_from_view, np.array(expected), rtol=1e-5,
                                   atol=1e-5 * np.abs(view.clip_from_view).max())


def _randomize(rng, camera, render):
    data = camera.data
    data.type = rng.choice(["PERSP", "ORTHO"])
    data.sensor_fit = rng.choice(["AUTO", "HORIZONTAL", "VERTICAL"])
    data.sensor_width, data.sensor_height = rng.uniform(5, 60, 2)
    data.lens, data.ortho_scale = rng.uniform(5, 200), rng.uniform(0.1, 30)
    data.shift_x, data.shift_y = rng.uniform(-1, 1, 2)
    data.clip_start, data.clip_end = rng.uniform(0.01, 1), rng.uniform(10, 2000)
    render.resolution_x, render.resolution_y = (int(n) for n in rng.integers(100, 2000, 2))
    render.resolution_percentage = int(rng.integers(10, 100))
    render.pixel_aspect_x, render.pixel_aspect_y = rng.uniform(1, 2, 2) if rng.random() < 0.5 else (1, 1)


def test_place_is_that_of_the_object_without_its_scale(camera):
    parent = place(None, "Parent", at=(1, 2, 3), turn=(0.3, 0.2, 0.1), scale=(2, 2, 2))
    camera.parent, camera.location = parent, (1, 0, 0)
    found = extracted().camera.world_from_camera
    np.testing.assert_allclose(found[:3, 3], camera.matrix_world.translation, rtol=1e-6)
    np.testing.assert_allclose(found[:3, :3], parent.rotation_euler.to_matrix(), atol=1e-6)


def test_negative_scale_mirrors(camera):
    """Blender's own engines see through `RenderEngine.camera_model_matrix`, which keeps the mirroring."""
    camera.scale = (-2, 2, 2)
    np.testing.assert_allclose(extracted().camera.world_from_camera, np.diag((-1, 1, 1, 1)), atol=1e-6)


def test_scale_of_zero_is_told(camera):
    camera.scale = (0, 1, 1)
    with pytest.raises(SceneError, match="Camera 'Camera' has a scale of zero"):
        extracted()


@pytest.mark.parametrize(("side", "percentage", "pixels"), [(1000, 50, 500), (33, 50, 16), (333, 33, 109), (4, 1, 1)])
def test_percentage_is_cut_to_whole_pixels(empty, camera, side, percentage, pixels):
    empty.render.resolution_x, empty.render.resolution_y, empty.render.resolution_percentage = side, 100, percentage
    assert extracted().camera.size[0] == pixels


def test_animated_lens(empty, camera):
    for frame, lens in ((1, 20), (11, 40)):
        camera.data.lens = lens
        camera.data.keyframe_insert("lens", frame=frame)
    empty.frame_set(6)
    assert 20 < extracted().camera.lens < 40


def test_panoramic_is_drawn_as_perspective(camera):
    camera.data.type = "PANO"
    scene = extracted()
    assert not scene.camera.is_orthographic
    assert scene.warnings == ("Camera 'Camera' is panoramic, which is not supported; it is drawn as a perspective one",)


def test_depth_of_field_is_told(camera):
    camera.data.dof.use_dof = True
    assert extracted().warnings == ("Camera 'Camera': depth of field is left out",)


def test_no_camera_is_an_error_only_when_one_is_needed(empty):
    assert extracted().camera is None
    with pytest.raises(SceneError, match="Scene 'Scene' has no camera"):
        extracted(needs_camera=True)


def test_camera_that_is_none(empty):
    empty.camera = place(bpy.data.lights.new("Lamp", "POINT"), "Lamp")
    with pytest.raises(SceneError, match="Object 'Lamp' is the scene's camera, but it is no camera object"):
        extracted()


def test_border(empty):
    assert border(empty) is None
    render = empty.render
    render.border_min_x, render.border_min_y, render.border_max_x, render.border_max_y = 0.125, 0.25, 0.5, 0.75
    assert border(empty) is None
    render.use_border = True
    assert border(empty) == (0.125, 0.25, 0.5, 0.75)
