# SPDX-License-Identifier: GPL-3.0-or-later
"""The viewport's worker and its view, which need no window; `tests/gui` has the rest."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from mathutils import Matrix, Vector

from svo_engine.blender import present, session, viewport
from svo_engine.blender.viewport_view import view_of
from svo_engine.blender.worker import Job, Worker
from svo_engine.errors import Cancelled, GpuError, SceneError
from svo_engine.film import Film
from svo_engine.scene.types import Scene, View
from svo_engine.settings import RenderSettings
from tests.blender.following import space_of_window

SECONDS = 10.0  # until a thread that does not answer counts as hung


def job(scene=None, width=8, samples=3):
    view = View(np.eye(4), np.eye(4), (width, 4))
    return Job(scene or Scene(), view, RenderSettings(samples=samples), (0, 0, width, 4))


class Gated:
    """Films that come one for each `step`; `wait_for_call` gives the arguments of the next request."""

    status = ""

    def client(self):
        return SimpleNamespace(films=self.films, close=lambda: None)

    def compile_all(self):
        """There is nothing to compile."""

    def __init__(self):
        self.calls, self.gate, self.called = [], threading.Semaphore(0), threading.Semaphore(0)
        self.error = None

    def films(self, scene, view, settings, should_stop, is_draft):  # noqa: ARG002
        self.calls.append((scene, view, settings))
        self.called.release()
        for n in range(1, settings.samples + 1):
            while not self.gate.acquire(timeout=0.01):
                if should_stop():
                    raise Cancelled("Cancelled")
            if self.error is not None:
                raise self.error
            yield Film({"Combined": np.zeros((*view.size[::-1], 4), "f4")}, n)

    def close(self):
        """Nothing is held."""

    def step(self, n=1):
        self.gate.release(n)

    def wait_for_call(self):
        assert self.called.acquire(timeout=SECONDS)
        return self.calls[-1]


def until(condition):
    """Wait for what another thread does."""
    waiting = threading.Event()
    for _ in range(int(SECONDS / 0.01)):
        if condition():
            return True
        waiting.wait(0.01)
    return False


@pytest.fixture
def gated():
    return Gated()


@pytest.fixture
def worker(gated):
    worker = Worker(gated.films, str)
    yield worker
    worker.close()
    worker.join(SECONDS)
    assert "SVO viewport" not in {thread.name for thread in threading.enumerate()}


def test_draft_comes_first_then_all_samples(worker, gated):
    ordered = job(samples=3)
    worker.show(ordered)
    assert gated.wait_for_call()[1].size == (4, 2)
    gated.step()
    assert gated.wait_for_call()[1].size == (8, 4)
    assert worker.shown[0] is ordered
    gated.step(3)
    assert until(lambda: worker.shown[1].n_samples == 3)
    assert worker.take_news()
    assert not worker.take_news()


def test_same_job_is_not_begun_again(worker, gated):
    scene = Scene()
    worker.show(job(scene))
    gated.step(4)
    assert until(lambda: worker.shown and worker.shown[1].n_samples == 3)
    worker.show(job(scene))
    worker.show(job(scene, width=16))
    gated.step(4)
    assert until(lambda: len(gated.calls) == 4 and worker.shown[1].size == (16, 4))
    assert [view.size[0] for _, view, _ in gated.calls] == [4, 8, 8, 16]


@pytest.mark.parametrize("other", [job(samples=4), job(width=9), job(Scene())], ids=["settings", "size", "scene"])
def test_other_picture_is_another_job(other):
    assert not job(Scene()).is_same(other)


def test_new_job_interrupts_the_samples(worker, gated):
    worker.show(job())
    gated.step(2)
    assert until(lambda: worker.shown and worker.shown[1].size == (8, 4))
    worker.show(job(width=16))
    assert until(lambda: gated.calls[-1][1].size == (8, 2))


def test_draft_is_not_interrupted_so_that_a_moving_view_shows_something(worker, gated):
    worker.show(job())
    gated.wait_for_call()
    worker.show(job(width=16))
    gated.step()
    assert until(lambda: worker.shown is not None)
    assert worker.shown[0].rect == (0, 0, 8, 4)


def test_close_interrupts_the_draft(gated):
    worker = Worker(gated.films, str)
    worker.show(job())
    gated.wait_for_call()
    worker.close()
    worker.join(SECONDS)
    assert "SVO viewport" not in {thread.name for thread in threading.enumerate()}


def test_error_becomes_a_sentence_and_the_next_job_clears_it(worker, gated):
    gated.error = GpuError("The device was lost")
    worker.show(job())
    gated.step()
    assert until(lambda: worker.failure == "The device was lost")
    assert worker.take_news()
    gated.error = None
    worker.show(job(width=16))
    gated.step(4)
    assert until(lambda: worker.shown and worker.shown[1].size == (16, 4))
    assert not worker.failure


# The viewport on the main thread


class Engine:
    """What a viewport uses of its RenderEngine."""

    n_redraws = 0

    def tag_redraw(self):
        self.n_redraws += 1


@pytest.fixture
def drawn(monkeypatch, gated):
    """The films that viewports have drawn, in place of a window."""
    drawn = []
    monkeypatch.setattr(session, "current", gated)
    monkeypatch.setattr(present, "make_texture", lambda film: film)
    monkeypatch.setattr(present, "draw_texture", lambda _engine, _scene, film, _rect: drawn.append(film))
    yield drawn
    viewport.close_all()


def graph():
    return bpy.context.evaluated_depsgraph_get()


def region_of(scene, is_lit=True):
    context = looking_through(scene, "PERSP")
    context.space_data = space_of_window()  # a real one, for it alone can tell what it hides
    context.space_data.shading.use_scene_lights_render = is_lit
    return context


@pytest.fixture
def shown(drawn, scene, extension, monkeypatch):
    """A viewport of the scene, which has one lamp, and the engine that it belongs to."""
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    scene.collection.objects.link(lamp)
    scene.svo.viewport_samples = 2
    engine = Engine()
    shown = viewport.Viewport(engine, str)
    shown.update(region_of(scene), graph())
    return shown, engine


def test_viewport_asks_for_a_redraw_for_each_film(shown, drawn, gated, scene):
    shown, engine = shown
    shown.draw(engine, region_of(scene), graph())
    assert (drawn, shown.status) == ([], ("", "Preparing"))
    gated.step()
    assert until(lambda: shown.poll() and engine.n_redraws == 1)
    shown.draw(engine, region_of(scene), graph())
    assert drawn[-1].size == (WIDTH // 2, HEIGHT // 2)
    gated.step(2)
    assert until(lambda: shown.poll() and shown.status == ("", "Sample 2/2"))
    shown.draw(engine, region_of(scene), graph())
    assert drawn[-1].size == (WIDTH, HEIGHT)


@pytest.mark.parametrize("is_lit", [True, False])
def test_scene_lights_can_be_switched_off(shown, gated, scene, is_lit):
    shown, engine = shown
    shown.draw(engine, region_of(scene, is_lit), graph())
    assert len(gated.wait_for_call()[0].lights) == is_lit


def test_finished_picture_stays_until_something_changes(shown, gated, scene):
    shown, engine = shown

    def act(change):
        change()
        shown.update(region_of(scene), graph())
        shown.draw(engine, region_of(scene), graph())
        gated.step(3)

    act(lambda: None)
    assert until(lambda: shown.status == ("", "Sample 2/2"))
    act(lambda: bpy.data.objects["Lamp"].select_set(True))
    assert len(gated.calls) == 2
    shown._sync._walk = None  # here no handler tells of the change, so that all is read
    act(lambda: setattr(bpy.data.lights["Lamp"], "energy", 3.0))
    assert until(lambda: len(gated.calls) == 4)


def test_edited_image_is_found_by_the_timer(shown, monkeypatch):
    shown, engine = shown
    monkeypatch.setattr(shown._sync.images, "compare", lambda: True)
    polls = range(viewport._POLLS_TO_COMPARE)
    assert all(shown.poll() for _ in polls)
    assert engine.n_redraws == 1


def test_status_tells_a_failure_until_it_is_mended(shown, gated, scene):
    shown, engine = shown
    gated.error = GpuError("The device was lost")
    shown.draw(engine, region_of(scene), graph())
    gated.step()
    assert until(lambda: shown.status == ("Error", "The device was lost"))
    gated.error = None
    shown.update(region_of(scene), graph())
    shown.draw(engine, region_of(scene), graph())
    gated.step(3)
    assert until(lambda: shown.status == ("", "Sample 2/2"))


def test_scene_that_cannot_be_read_is_not_drawn(shown, drawn, scene, monkeypatch):
    shown, engine = shown

    def update(*_args):
        raise SceneError("Mesh 'Cube' is broken")

    monkeypatch.setattr(shown._sync, "update", update)
    with pytest.raises(SceneError):
        shown.update(region_of(scene), graph())
    shown.failure = "Mesh 'Cube' is broken"
    shown.draw(engine, region_of(scene), graph())
    assert (drawn, shown.status) == ([], ("Error", "Mesh 'Cube' is broken"))


@pytest.mark.usefixtures("drawn")
def test_viewport_ends_with_its_engine():
    engine = Engine()
    shown = viewport.Viewport(engine, str)
    assert viewport._poll() is not None
    del engine
    assert viewport._poll() is None
    shown.join()
    assert "SVO viewport" not in {thread.name for thread in threading.enumerate()}


# The viewport's view

WIDTH, HEIGHT = 200, 100


@pytest.fixture
def scene(empty):
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    empty.collection.objects.link(camera)
    empty.camera = camera
    camera.matrix_world = Matrix.Translation((1, 2, 9)) @ Matrix.Rotation(0.3, 4, "X")
    empty.render.resolution_x, empty.render.resolution_y = 100, 100
    return empty


def looking_through(scene, perspective, border=None):
    """A context like that of a 3D viewport which looks through the scene's camera with a view twice as wide."""
    camera = scene.camera
    window = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=WIDTH, y=HEIGHT)
    box = border or (0, 0, 1, 1)
    space = SimpleNamespace(use_local_camera=False, camera=None, use_render_border=border is not None,
                            render_border_min_x=box[0], render_border_min_y=box[1], render_border_max_x=box[2],
                            render_border_max_y=box[3])
    region_data = SimpleNamespace(window_matrix=window, view_matrix=camera.matrix_world.inverted(),
                                  view_perspective=perspective)
    region = SimpleNamespace(width=WIDTH, height=HEIGHT)
    return SimpleNamespace(region=region, region_data=region_data, space_data=space)


def pixel_of(view, rect, point):
    """Where `point` (world space) lies in the region, pixels."""
    p = view.clip_from_view @ np.linalg.inv(view.world_from_view) @ np.array([*point, 1])
    return (p[:2] / p[3] / 2 + 0.5) * rect[2:] + rect[:2]


POINT = (1.3, 1.7, 4.2)


def expected_pixel(context):
    p = context.region_data.window_matrix @ context.region_data.view_matrix @ Vector((*POINT, 1))
    return (np.array(p[:2]) / p[3] / 2 + 0.5) * (WIDTH, HEIGHT)


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_whole_region(scene, kind):
    scene.camera.data.type = kind
    context = looking_through(scene, kind)
    view, rect = view_of(context, scene)
    assert (view.size, rect) == ((WIDTH, HEIGHT), (0, 0, WIDTH, HEIGHT))
    np.testing.assert_allclose(pixel_of(view, rect, POINT), expected_pixel(context), atol=1e-3)


def test_viewports_own_border(scene):
    context = looking_through(scene, "PERSP", (0.25, 0.1, 0.75, 0.6))
    view, rect = view_of(context, scene)
    assert (view.size, rect) == ((100, 50), (50, 10, 100, 50))
    np.testing.assert_allclose(pixel_of(view, rect, POINT), expected_pixel(context), atol=1e-3)


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_cameras_border_lies_in_the_cameras_frame(scene, kind):
    scene.camera.data.type = kind
    render = scene.render
    render.use_border, render.border_min_x, render.border_max_x = True, 0.0, 0.5
    render.border_min_y, render.border_max_y = 0.5, 1.0
    context = looking_through(scene, "CAMERA")
    view, rect = view_of(context, scene)
    # A square picture, whose sensor is fitted to its width, is as wide as the region: 200 x 200 about (100, 50)
    assert rect == (0, 50, 100, 50)
    np.testing.assert_allclose(pixel_of(view, rect, POINT), expected_pixel(context), atol=1e-3)


@pytest.mark.parametrize("border", [(0.5, 0.5, 0.5, 0.5), (1, 1, 1, 1), (0.9999, 0, 1, 0.0001), (-3, -3, -2, -2)])
def test_border_of_no_size_or_outside_gives_one_pixel(scene, border):
    view, (x, y, width, height) = view_of(looking_through(scene, "PERSP", border), scene)
    assert (width, height) == view.size == (1, 1)
    assert 0 <= x < WIDTH and 0 <= y < HEIGHT
