# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms of the projection; `tests/blender/test_extract_camera.py` holds it against Blender's own."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.scene.camera import make_view
from svo_engine.scene.types import Camera

# Lens and sensor of 90 degrees across the fitted side
WIDE = {"lens": 18.0, "sensor": (36.0, 24.0)}


def camera(**settings):
    return Camera("Camera", np.eye(4), **settings)


def seen(view, x, y, z=-1.0):
    """Where the point (x, y, z) of camera space lies in the picture: pixels, origin at the lower left corner."""
    clip = view.clip_from_view @ (x, y, z, 1)
    return (clip[:2] / clip[3] * 0.5 + 0.5) * view.size


def test_square_fits_its_sensor():
    view = make_view(camera(size=(100, 100), **WIDE))
    np.testing.assert_allclose(seen(view, 0, 0), (50, 50))
    np.testing.assert_allclose(seen(view, 1, 1), (100, 100))


@pytest.mark.parametrize(("fit", "size", "top_right"), [
    ("AUTO", (200, 100), (1, 0.5)), ("AUTO", (100, 200), (0.5, 1)),
    ("HORIZONTAL", (100, 200), (1, 2)), ("VERTICAL", (100, 200), (1 / 3, 2 / 3))])
def test_fitted_side_spans_the_sensor(fit, size, top_right):
    np.testing.assert_allclose(seen(make_view(camera(size=size, sensor_fit=fit, **WIDE)), *top_right), size)


def test_pixel_aspect_widens_the_picture():
    view = make_view(camera(size=(100, 100), pixel_aspect=(2.0, 1.0), **WIDE))
    np.testing.assert_allclose(seen(view, 1, 0.5), (100, 100))


def test_shift_is_in_units_of_the_fitted_side():
    view = make_view(camera(size=(200, 100), shift=(0.25, -0.5), **WIDE))
    np.testing.assert_allclose(seen(view, 0, 0), (200 * 0.25, 50 + 200 * 0.5))


def test_orthographic_scale_is_the_fitted_side_at_any_depth():
    view = make_view(camera(size=(100, 200), is_orthographic=True, ortho_scale=4.0))
    for z in (-1.0, -50.0):
        np.testing.assert_allclose(seen(view, 1, 2, z), (100, 200))


@pytest.mark.parametrize("is_orthographic", [False, True])
def test_clip_planes_are_the_ends_of_the_depth_range(is_orthographic):
    view = make_view(camera(is_orthographic=is_orthographic, clip_start=0.5, clip_end=20.0))
    for z, depth in ((-0.5, -1), (-20.0, 1)):
        clip = view.clip_from_view @ (0, 0, z, 1)
        assert clip[2] / clip[3] == pytest.approx(depth)


@pytest.mark.parametrize("border", [(0.25, 0.3, 0.75, 0.8), (0.0, 0.0, 1.0, 1.0), (0.5, 0.5, 0.5, 0.5)])
def test_border_shows_the_same_pixels(border):
    settings = camera(size=(40, 20), shift=(0.1, 0.2), **WIDE)
    whole, part = make_view(settings), make_view(settings, border=border)
    corner = np.floor(np.float32(border[:2]) * np.float32((40, 20)))
    for point in ((0.1, 0.2), (-0.4, 0.0)):
        np.testing.assert_allclose(seen(part, *point), seen(whole, *point) - corner, atol=1e-9)


def test_border_is_cut_as_blender_cuts_it():
    """Blender multiplies in 32-bit floats: 0.7 of 10 is 7, though its 0.7 is 0.699999988."""
    border = tuple(float(np.float32(f)) for f in (0.1, 0.3, 0.7, 0.9))
    assert make_view(camera(size=(10, 10)), border=border).size == (6, 6)


def test_empty_border_leaves_one_pixel():
    assert make_view(camera(size=(10, 10)), border=(0.5, 0.5, 0.5, 0.5)).size == (1, 1)


def test_size_overrules_the_cameras_own():
    assert make_view(camera(size=(10, 10)), size=(30, 20)).size == (30, 20)
