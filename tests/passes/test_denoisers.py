# SPDX-License-Identifier: GPL-3.0-or-later
"""Which denoiser a frame gets, what it costs, and what happens where the one that is asked for cannot be had."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu import oidn
from svo_engine.gpu.device import Device
from svo_engine.gpu.oidn import OidnDevice
from svo_engine.scene.types import World
from svo_engine.settings import RenderSettings
from tests import scenes
from tests.on_gpu import film_of
from tests.rays import RAYS

NEEDED = pytest.mark.skipif(oidn.library() is None, reason="Open Image Denoise is not installed")
NOISY = {**RAYS, "gather_rays": 1, "denoise": True}
WAVELET = {"denoise/prepare", "denoise/atrous"}


def room():
    return scenes.cornell(world=World((0.25, 0.5, 1.0)))


@pytest.fixture
def nothing_kept(session):
    """Denoisers are made anew, before the test and after it."""
    session.forget("denoiser")
    yield
    session.forget("denoiser")


@NEEDED
def test_each_step_up_has_less_error(session):
    """Unfiltered, wavelet, library."""
    truth = film_of(session, room(), **{**NOISY, "denoise": False, "samples": 64}).planes["Combined"]
    errors = []
    for change in ({"denoise": False}, {"denoiser": "atrous"}, {"denoiser": "openimagedenoise"}):
        planes = film_of(session, room(), **{**NOISY, **change}).planes
        assert np.array_equal(planes["Combined"][..., 3], truth[..., 3])
        errors.append(((planes["Combined"] - truth) ** 2).mean())
    assert errors[0] > 2 * errors[1]
    assert errors[1] > errors[2]


@NEEDED
@pytest.mark.parametrize("quality", oidn.QUALITIES)
def test_the_same_bits_again(session, quality):
    films = []
    for _ in range(2):
        session.forget()
        films.append(film_of(session, room(), **NOISY, denoising_quality=quality).planes["Combined"])
    assert np.array_equal(*films)


@NEEDED
@pytest.mark.parametrize(("settings", "runs"), [
    ({"denoise": False}, set()),
    ({"denoiser": "openimagedenoise"}, set()),
    ({"denoiser": "atrous"}, WAVELET),
    ({"view": "cache"}, set()),
])
def test_nothing_is_run_that_is_not_asked_for(session, settings, runs):
    stats = film_of(session, room(), **{**NOISY, **settings}).stats
    assert WAVELET & set(stats["counts"]) == runs
    is_library = settings.get("denoiser") == "openimagedenoise"
    assert ("denoise" in stats["times_ms"]) == is_library
    assert stats["limits"] == []


@NEEDED
def test_a_software_renderer_takes_the_library_by_itself(session):
    if "llvmpipe" not in session.device_info()["renderer"]:
        pytest.skip("there is a graphics card")
    films = [film_of(session, room(), **NOISY, denoiser=name).planes["Combined"]
             for name in ("automatic", "openimagedenoise")]
    assert np.array_equal(*films)


@pytest.mark.parametrize(("asked", "told"), [
    ("automatic", []),
    ("openimagedenoise", ["The picture was filtered by the a-trous wavelet: Open Image Denoise was not found"]),
])
def test_without_the_library_the_wavelet_filters(session, nothing_kept, monkeypatch, asked, told):
    wavelet = film_of(session, room(), **NOISY, denoiser="atrous").planes["Combined"]
    monkeypatch.setattr(Device, "denoising", property(lambda _: OidnDevice(None)))
    monkeypatch.setattr(oidn, "library", lambda: None)
    film = film_of(session, room(), **NOISY, denoiser=asked)
    assert film.stats["limits"] == told
    assert np.array_equal(film.planes["Combined"], wavelet)


@NEEDED
def test_a_library_that_fails_leaves_the_noise_and_is_told_once(session, nothing_kept, monkeypatch):
    def fail(*_arguments):
        raise GpuError("Open Image Denoise failed: out of memory")

    noisy = film_of(session, room(), **{**NOISY, "denoise": False}, samples=2).planes["Combined"]
    monkeypatch.setattr(oidn.Oidn, "run", fail)
    films = list(session.films(room(), scenes.view(room()), RenderSettings(**NOISY, samples=2, resolution="32")))
    assert films[-1].stats["limits"] == ["The picture was not filtered: Open Image Denoise failed: out of memory"]
    assert np.array_equal(films[-1].planes["Combined"], noisy)


def test_the_viewport_has_a_denoiser_of_its_own():
    settings = RenderSettings(denoise=False, viewport_denoiser="atrous", viewport_denoising_quality="balanced")
    viewport = settings.for_viewport()
    assert (viewport.denoise, viewport.denoiser, viewport.denoising_quality) == (True, "atrous", "balanced")
