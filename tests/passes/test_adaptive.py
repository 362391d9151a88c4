# SPDX-License-Identifier: GPL-3.0-or-later
"""Adaptive sampling: what counts as noise, which tiles are done, and that what is done is a true mean."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.passes.adaptive import EVERY, TILE, is_adaptive, is_done, limits, make_progress
from svo_engine.passes.resolve import make_film
from svo_engine.scene.types import World
from svo_engine.settings import PASSES, RenderSettings
from tests import scenes
from tests.on_gpu import film_of
from tests.rays import RAYS, above

SIZE = 44, 30  # the last tiles are cut on both sides
ADAPTIVE = RenderSettings(samples=64, min_samples=EVERY, noise_threshold=0.01)


@pytest.mark.parametrize(("threshold", "n"), [(0.1, 32), (0.01, 64), (0.001, 128)])
def test_least_number_of_samples_by_the_threshold_is_that_of_cycles(threshold, n):
    """Cycles' own manual names these three."""
    assert limits(RenderSettings(noise_threshold=threshold)) == (threshold, n)


def test_automatic_threshold_goes_by_the_samples():
    assert limits(RenderSettings(noise_threshold=0, samples=256))[0] == 1 / 256
    assert limits(RenderSettings(noise_threshold=0, samples=2**16))[0] == 0.001


def test_at_default_samples_nothing_is_left_out():
    """64 samples are the least, and 16 the default."""
    assert not is_adaptive(RenderSettings())
    assert not is_adaptive(RenderSettings().for_viewport())
    assert is_adaptive(RenderSettings(samples=65))
    assert not is_adaptive(RenderSettings(samples=65, adaptive_sampling=False))
    assert not is_adaptive(RenderSettings(samples=65, view="voxel_albedo"))


class Painted:
    """A film of `SIZE` of numbers, all its samples and half of them, and its progress."""

    def __init__(self, device, scope, whole, half, n, settings=ADAPTIVE):
        camera = above(size=SIZE)
        view = scenes.view(scenes.scene(camera=camera))
        self.film = make_film(scope, view, ("COMBINED", "HALF"), np.zeros(3))
        self.progress = make_progress(scope, self.film, settings)
        self.device = device
        self.paint(whole, half, n)

    def paint(self, whole, half, n):
        self.film.sums.write(np.stack([whole * n, half * n / 2]).astype("f4"))
        self.film.n_samples = n

    def look(self):
        """Whether all is done, and the samples with which each tile was: 0 while it is not."""
        done = is_done(self.device, self.progress)
        return done, self.film.tiles.read()[..., 0]


def grey(value):
    """(height, width, 4) f8."""
    return np.broadcast_to(np.asarray(value, "f8")[..., None], (SIZE[1], SIZE[0], 4))


def noise_of(whole, half):
    """Root mean square of the measure over each tile, slow and obvious."""
    error = np.abs(whole - half)[..., :3].sum(2) / (1e-4 + np.sqrt(whole[..., :3].sum(2)))
    return np.array([[np.sqrt((error[y:y + TILE, x:x + TILE] ** 2).mean()) for x in range(0, SIZE[0], TILE)]
                     for y in range(0, SIZE[1], TILE)])


def test_noise_is_the_difference_of_half_the_samples_and_all(device):
    rng = np.random.default_rng(1)
    whole = rng.uniform(0, 2, (SIZE[1], SIZE[0], 4))
    half = whole * rng.uniform(0.9, 1.1, whole.shape)
    with device.scope() as scope:
        painted = Painted(device, scope, whole, half, EVERY)
        painted.look()
        errors = np.frombuffer(painted.progress.errors.read(), "f4").reshape(4, 6)
    assert np.allclose(errors, noise_of(whole, half), rtol=1e-4)


def test_a_noisy_tile_keeps_its_neighbours_and_no_others(device):
    whole, half = grey(np.ones(SIZE[::-1])).copy(), grey(np.ones(SIZE[::-1])).copy()
    half[1 * TILE, 2 * TILE] = 5
    expected = np.full((4, 6), EVERY)
    expected[0:3, 1:4] = 0
    with device.scope() as scope:
        painted = Painted(device, scope, whole, half, EVERY)
        done, tiles = painted.look()
        assert not done
        assert np.array_equal(tiles, expected)
        assert painted.progress.n_running == 9
        painted.paint(whole, whole, 2 * EVERY)
        done, tiles = painted.look()
        assert done
        assert np.array_equal(tiles, np.where(expected, EVERY, 2 * EVERY))
        saved = painted.progress.n_saved(64)
    pixels = np.repeat(np.repeat(tiles, TILE, 0), TILE, 1)[:SIZE[1], :SIZE[0]].astype("i8")
    assert saved == (64 - pixels).sum()


def test_what_is_not_a_number_is_never_quiet(device):
    whole = grey(np.ones(SIZE[::-1])).copy()
    whole[0, 0] = np.nan
    with device.scope() as scope:
        _, tiles = Painted(device, scope, whole, whole, EVERY).look()
    assert not tiles[:2, :2].any()


def test_both_halves_lie_in_all_parts_of_the_square():
    """Of the van der Corput sequence, in which every second point lies in one half; as resolve/accumulate has it."""
    numbers = np.arange(64)
    points = sum((numbers >> bit & 1) / 2 ** (bit + 1) for bit in range(6))
    is_of_half = np.array([(n & 0xAAAAAAAA).bit_count() % 2 == 1 for n in numbers])
    for n in range(EVERY, 65, EVERY):
        assert is_of_half[:n].sum() == n / 2
        assert abs(points[:n][is_of_half[:n]].mean() - 0.5) < 1 / n**0.5 / 2


@pytest.mark.parametrize("n", [EVERY - 1, EVERY + 1, 2 * EVERY - 1, 128 + EVERY, 1024 + 64])
def test_nobody_looks_in_between(device, n):
    """Neither before the least number of samples, nor where halves are no halves, nor too often: each look waits."""
    with device.scope() as scope:
        done, tiles = Painted(device, scope, grey(np.ones(SIZE[::-1])), grey(np.ones(SIZE[::-1])), n).look()
    assert not done
    assert not tiles.any()


def test_a_quiet_picture_ends_early(session):
    scene = scenes.scene(camera=scenes.cornell().camera, world=World((0.1, 0.2, 0.3)))
    film = film_of(session, scene, **RAYS, samples=64, min_samples=16)
    assert film.n_samples == 16
    assert film.stats["counts"]["samples saved"] == 48 * 64 * 48
    assert film.stats["counts"]["gather/rays"] == 16
    assert np.allclose(film.planes["Combined"], (0.1, 0.2, 0.3, 1), rtol=1e-6)


def films(session, **settings):
    """A room by rays, filtered, with all passes: the film after each sample."""
    scene = scenes.cornell()
    settings = {**RAYS, "denoise": True, "passes": tuple(PASSES), "samples": 24, "min_samples": 8, **settings}
    return list(session.films(scene, scenes.view(scene), replace(scenes.SMALL, **settings)))


def shot(session, **settings):
    """The last of them."""
    return films(session, **settings)[-1]


def test_done_tiles_are_what_fewer_samples_give_to_the_bit(session):
    """Every tile is done at the first look; the filter and the passes divide by the true number of samples."""
    early, plain = shot(session, noise_threshold=1.0), films(session, adaptive_sampling=False)[7]
    assert early.n_samples == plain.n_samples == 8
    assert all(np.array_equal(early.planes[name], plain.planes[name]) for name in plain.planes)


def test_tiles_that_go_on_are_what_all_samples_give_to_the_bit(session):
    """No tile is done at a threshold that none reaches."""
    patient, plain = shot(session, noise_threshold=1e-6), shot(session, adaptive_sampling=False)
    assert patient.stats["counts"]["samples saved"] == 0
    assert all(np.array_equal(patient.planes[name], plain.planes[name]) for name in plain.planes)


def test_a_picture_of_many_ages_is_made_of_both(session):
    """Each tile equals that of the picture with its number of samples: no seam is anything else."""
    settings = {"denoise": False, "passes": ()}
    mixed = shot(session, noise_threshold=0.12, **settings).planes["Combined"]
    whole = [film.planes["Combined"] for film in films(session, adaptive_sampling=False, **settings)]
    equal = [(mixed == whole[n - 1]).all(2) for n in (8, 16, 24)]
    assert np.logical_or.reduce(equal).all()
    assert 0.01 < (~equal[2]).mean() < 0.99


def test_the_same_bits_again(session):
    one = shot(session, noise_threshold=0.12)
    session.forget()
    two = shot(session, noise_threshold=0.12)
    assert one.stats["counts"]["samples saved"] == two.stats["counts"]["samples saved"] > 0
    assert all(np.array_equal(one.planes[name], two.planes[name]) for name in one.planes)


def test_cones_stop_as_well(session):
    film = shot(session, method="cones", noise_threshold=1.0)
    assert film.n_samples == 8


def test_a_picture_that_cannot_be_adaptive_is_never_looked_at(device):
    """Its tiles are there, for shaders know one kind of film, and none of them is done."""
    with device.scope() as scope:
        film = make_film(scope, scenes.view(scenes.scene(camera=above(size=SIZE))), ("COMBINED",), np.zeros(3))
        progress = make_progress(scope, film, RenderSettings())
        film.n_samples, before = 64, device.profiler.counts["adaptive/measure"]
        assert progress is None
        assert not is_done(device, progress)
        assert device.profiler.counts["adaptive/measure"] == before
        assert not film.tiles.read().any()
