# SPDX-License-Identifier: GPL-3.0-or-later
"""The wavelet on films made of numbers: what it must smooth and what it must leave."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from svo_engine.passes.denoise import read_picture
from svo_engine.passes.denoise.atrous import STEPS
from svo_engine.passes.denoise.choice import make_denoiser
from svo_engine.passes.raster import Eye
from svo_engine.passes.resolve import PLANES as FILM_PLANES
from svo_engine.passes.resolve import make_film
from svo_engine.scene.types import World
from tests import scenes
from tests.on_gpu import picture_of
from tests.rays import RAYS, above

SIDE = 64
REACH = 2 * sum(STEPS)  # pixels from which light may come
SIGMA = 0.3  # of one sample of irradiance 1


@dataclass(frozen=True, eq=False)
class Wall:
    """What pixels see: irradiance of each sample (n, h, w), albedo (h, w), normals (h, w, 3), depths (h, w) in metres
    from a camera `above` that is 2 m wide, and what else they send to the eye (h, w).
    """

    samples: np.ndarray
    albedo: np.ndarray
    normals: np.ndarray
    depths: np.ndarray
    gloss: np.ndarray
    blur: float = 0.0  # angle by which the eye sees reflections blurred

    def crop(self, low: int, high: int) -> Wall:
        part = slice(low, high), slice(low, high)
        return Wall(self.samples[:, *part], self.albedo[part], self.normals[part], self.depths[part], self.gloss[part],
                    self.blur)


def wall(samples: np.ndarray) -> Wall:
    """A white wall that faces the camera."""
    shape = samples.shape[1:]
    return Wall(samples, np.full(shape, 0.8), np.broadcast_to([0.0, 0, 1], (*shape, 3)), np.full(shape, 4.0),
                np.zeros(shape))


def noisy(n: int, mean: np.ndarray | float = 1.0, seed: int = 1) -> np.ndarray:
    """n samples (n, SIDE, SIDE) around `mean`."""
    return mean + SIGMA * np.random.default_rng(seed).normal(size=(n, SIDE, SIDE))


def unit(plane: str) -> float:
    """Albedo times light over this is what leaves: pi for irradiance."""
    return np.pi if plane.startswith("DIFFUSE") else 1.0


def film_planes(seen: Wall, plane: str) -> np.ndarray:
    """Sums over the samples, (layers, h, w, 4) f4, as resolve/accumulate leaves them; the light is in `plane`."""
    n, height, width = seen.samples.shape
    planes = {name: np.zeros((height, width, 4)) for name in FILM_PLANES}
    light = seen.albedo / unit(plane) * seen.samples.sum(0)
    has_surface = n * (seen.albedo > 0)
    planes["COMBINED"] += (light + n * seen.gloss)[..., None]
    planes["COMBINED"][..., 3] = n
    planes[plane][..., :3] = light[..., None]
    planes[plane][..., 3] = (seen.samples**2).sum(0)
    color = planes["GLOSSY_COLOR" if plane.startswith("GLOSSY") else "DIFFUSE_COLOR"]
    color[..., :3] = n * seen.albedo[..., None]
    planes["GLOSSY_COLOR"][..., 3] = n * seen.blur
    planes["DIFFUSE_COLOR"][..., 3] = has_surface
    planes["NORMAL_DEPTH"][..., :3] = has_surface[..., None] * seen.normals
    planes["NORMAL_DEPTH"][..., 3] = has_surface * seen.depths
    return np.stack([planes[name] for name in FILM_PLANES]).astype("f4")


def picture(device, seen: Wall, is_filtered: bool = True, plane: str = "DIFFUSE_INDIRECT") -> np.ndarray:
    """Radiance (h, w) of the picture, f8."""
    size = seen.samples.shape[2], seen.samples.shape[1]
    view = scenes.view(scenes.scene(camera=above(2.0 * size[0] / SIDE, size=size)))
    world_from_clip = view.world_from_view @ np.linalg.inv(view.clip_from_view)
    denoiser = make_denoiser(device, size, "atrous" if is_filtered else "")
    with device.scope() as scope, denoiser.scope:
        film = make_film(scope, view, FILM_PLANES, np.zeros(3))
        film.sums.write(film_planes(seen, plane))
        eye = Eye(view, world_from_clip, film.tiles, 0, True)
        film.n_samples, film.eye = len(seen.samples), eye
        pixels = read_picture(device, film, denoiser, []).planes["Combined"]
    assert np.array_equal(pixels[..., 3], np.ones(size[::-1]))
    assert np.allclose(pixels[..., :3], pixels[..., :1], rtol=1e-5)
    return pixels[..., 0].astype("f8")


def irradiance(device, seen: Wall, is_filtered: bool = True, plane: str = "DIFFUSE_INDIRECT") -> np.ndarray:
    return picture(device, seen, is_filtered, plane) * unit(plane) / seen.albedo


PLANES = ["DIFFUSE_DIRECT", "DIFFUSE_INDIRECT"]


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize("n", [1, 16])
def test_constant_light_passes_unchanged(device, n, plane):
    """On a wall of many colours, behind a gloss of any pattern."""
    rng = np.random.default_rng(1)
    seen = replace(wall(np.full((n, SIDE, SIDE), 2.0)), albedo=rng.uniform(0.05, 1, (SIDE, SIDE)),
                   gloss=rng.uniform(0, 9, (SIDE, SIDE)))
    plain = seen.albedo * 2 / np.pi + seen.gloss
    assert np.allclose(picture(device, seen, is_filtered=False), plain, rtol=1e-5)
    assert np.allclose(picture(device, seen, plane=plane), plain, rtol=1e-5)


def kernel_gain() -> float:
    """By how much the variance of independent noise falls under all passes, where every difference counts as noise."""
    line = np.ones(1)
    for step in STEPS:
        taps = np.zeros(4 * step + 1)
        taps[::step] = 1 / 16, 1 / 4, 3 / 8, 1 / 4, 1 / 16
        line = np.convolve(line, taps)
    return float((line**2).sum() ** 2)


@pytest.mark.parametrize("plane", PLANES)
def test_noise_of_one_sample_on_a_wall_is_smoothed_and_its_mean_kept(device, plane):
    """Differences within 8 sigma are noise, so that hardly a weight is less than the kernel's. In the picture's corners
    a quarter of the kernel is left: four times the variance. The mean changes by less than its own noise.
    """
    raw = noisy(1)
    found = irradiance(device, wall(raw), plane=plane)
    assert kernel_gain() < 1 / 900
    assert found.var() < 4 * kernel_gain() * SIGMA**2
    assert found.mean() == pytest.approx(raw.mean(), abs=SIGMA / SIDE)


@pytest.mark.parametrize("n", [2, 4, 16])
def test_more_samples_are_smoothed_less(device, n):
    """Yet better than raw ones: 8 / sqrt(n) sigma still hold most of the noise."""
    raw = noisy(n)
    found = irradiance(device, wall(raw))
    assert 4 * kernel_gain() * SIGMA**2 / n < found.var() < 0.5 * SIGMA**2 / n
    assert found.mean() == pytest.approx(raw.mean(), abs=SIGMA / np.sqrt(n) / SIDE)


def waves() -> np.ndarray:
    """Light (SIDE, SIDE) with true detail."""
    x = 2 * np.pi * np.arange(SIDE) / SIDE
    return 1 + 0.5 * np.sin(4 * x) * np.cos(3 * x)[:, None]


def test_with_samples_it_converges_to_the_unfiltered_picture(device):
    """Never farther from the truth than the raw mean, and with 8 / sqrt(n) sigma ever fewer neighbours count: at 1024
    samples 0.25 sigma, where they weigh exp(-4) or less.
    """
    from_raw = []
    for n in (1, 4, 16, 64, 256, 1024):
        samples = noisy(n, waves())
        raw, found = samples.mean(0), irradiance(device, wall(samples))
        assert ((found - waves()) ** 2).mean() < ((raw - waves()) ** 2).mean()
        from_raw.append(np.sqrt(((found - raw) ** 2).mean()) / (SIGMA / np.sqrt(n)))
    assert (np.diff(from_raw) < 0).all()
    assert from_raw[-1] < 0.1


def halves(left: float, right: float) -> np.ndarray:
    """(SIDE, SIDE): one value in the left half, another one in the right."""
    return np.where(np.arange(SIDE) < SIDE // 2, left, right) * np.ones((SIDE, 1))


@pytest.mark.parametrize("degrees", [45, 70])
def test_light_does_not_cross_an_edge(device, degrees):
    """The right half bends away from the camera: cos^64 of the angle between the normals is below 1e-9."""
    turned = np.array([np.sin(np.radians(degrees)), 0, np.cos(np.radians(degrees))])
    x = (np.arange(SIDE) - SIDE / 2 + 0.5) * 2 / SIDE
    shape = {"normals": np.where(halves(0, 1)[..., None] > 0, turned, [0, 0, 1]),
             "depths": 4 + halves(0, np.tan(np.radians(degrees))) * x}
    found = irradiance(device, replace(wall(halves(1, 5)[None]), **shape))
    assert np.allclose(found, halves(1, 5), rtol=1e-4)
    found = irradiance(device, replace(wall(noisy(1, halves(1, 5))), **shape))
    beside = found[:, SIDE // 2 - 4:SIDE // 2 + 4].mean(0)
    assert np.allclose(beside, [1] * 4 + [5] * 4, atol=4 * SIGMA / np.sqrt(SIDE))


def test_light_does_not_cross_from_one_shading_normal_to_another(device):
    """On a flat wall, where only a normal map tells the halves apart and their light differs by less than the filter
    takes for noise: cos^64 of 30 degrees is 1e-4. The mean of a column holds the noise of four at least.
    """
    normals = np.where(halves(0, 1)[..., None] > 0, [0.5, 0, np.sqrt(0.75)], [0, 0, 1])
    found = irradiance(device, replace(wall(noisy(1, halves(1, 2))), normals=normals))
    assert np.allclose(found[:, SIDE // 2 - 4:SIDE // 2].mean(0), 1, atol=SIGMA / np.sqrt(4 * SIDE))


def test_light_does_not_cross_a_step(device):
    """One wall half a metre behind the other: 16 pixels, exp(-2) in the widest pass and e^-16 in the first; where there
    is no noise, a difference of light holds it back as well.
    """
    depths = halves(3.5, 4.0)
    found = irradiance(device, replace(wall(halves(1, 5)[None]), depths=depths))
    assert np.allclose(found, halves(1, 5), rtol=0.02)


def test_an_edge_of_light_itself_is_kept_where_samples_tell_noise_from_it(device):
    """A shadow's edge on one wall, 13 standard deviations of the mean of 16 samples high."""
    samples = noisy(16, halves(1, 2))
    found, raw = irradiance(device, wall(samples)), samples.mean(0)
    edge = slice(SIDE // 2 - 2, SIDE // 2 + 2)
    assert np.abs(found - halves(1, 2))[:, edge].max() < 5 * SIGMA / 4
    assert found[:, SIDE // 2].mean() - found[:, SIDE // 2 - 1].mean() > 0.9
    assert ((found - halves(1, 2)) ** 2).mean() < 0.6 * ((raw - halves(1, 2)) ** 2).mean()


def test_pixels_without_diffuse_surface_are_left_and_give_nothing(device):
    """Sky or a mirror in the right half: as it was; the left half gets nothing of it."""
    albedo, gloss = halves(0.8, 0.0), halves(0, 1) * np.random.default_rng(2).uniform(0, 9, (SIDE, SIDE))
    seen = replace(wall(noisy(1)), albedo=albedo, gloss=gloss)
    found = picture(device, seen)
    right, left = halves(0, 1) > 0, halves(0, 1) == 0
    assert np.array_equal(found[right], gloss[right].astype("f4"))
    assert np.abs(found[left] * np.pi / 0.8 - 1).max() < 5 * SIGMA * np.sqrt(4 * kernel_gain())


def test_a_crop_differs_only_where_the_filter_looks_over_its_border(device):
    """A border render does not know the pixels around it. Where the filter reaches none of them it is the same; else
    both pictures are as good, made of nearly the same noise.
    """
    low, seen = 4, wall(noisy(4, waves()))
    whole, part = irradiance(device, seen)[low:, low:], irradiance(device, seen.crop(low, SIDE))
    differs = ~np.isclose(whole, part, rtol=1e-5)
    assert differs.any() and not differs[REACH:, REACH:].any()
    assert np.abs(whole - part).max() < 2 * SIGMA / np.sqrt(4)
    assert np.sqrt(((whole - part) ** 2).mean()) < 0.2 * SIGMA / np.sqrt(4)


def test_the_same_film_gives_the_same_bits(device):
    seen = wall(noisy(2, waves()))
    assert np.array_equal(picture(device, seen), picture(device, seen))


@pytest.mark.parametrize("plane", ["GLOSSY_DIRECT", "GLOSSY_INDIRECT"])
def test_light_on_a_rough_surface_is_smoothed(device, plane):
    """Blurred by half a radian: 64 pixels are 0.5 of them at a distance of 4 m, so that hardly a tap is left out."""
    found = irradiance(device, replace(wall(noisy(1)), blur=0.5), plane=plane)
    assert found.var() < 8 * kernel_gain() * SIGMA**2
    assert found.mean() == pytest.approx(noisy(1).mean(), abs=SIGMA / SIDE)


@pytest.mark.parametrize("blur", [0.0, 1e-4])
def test_what_a_mirror_shows_is_left_to_the_bit(device, blur):
    """A pixel is 1/128 rad: the eye sees no blur of a hundredth of that."""
    seen = replace(wall(noisy(1)), blur=blur)
    found, raw = (picture(device, seen, is_filtered, "GLOSSY_INDIRECT") for is_filtered in (True, False))
    assert np.allclose(found, raw, rtol=1e-6)


def test_reflections_are_smoothed_as_far_as_they_are_blurred(device):
    """The wider the blur, the less of the noise is left."""
    left = [irradiance(device, replace(wall(noisy(1)), blur=blur), plane="GLOSSY_INDIRECT").std()
            for blur in (0.0, 0.002, 0.005, 0.02, 0.5)]
    assert (np.diff(left) < 0).all()
    assert left[0] == pytest.approx(noisy(1).std(), rel=1e-5)


def test_light_that_is_negative_already_stays_so(device):
    """The film may hold it by a mistake that nobody should hide: the filter adds none and takes none."""
    seen = replace(wall(np.zeros((1, SIDE, SIDE))), gloss=halves(-0.5, 0.5))
    assert np.allclose(picture(device, seen), halves(-0.5, 0.5))


def test_a_whole_frame_is_quieter_and_as_bright(session):
    """Indirect light of one ray a pixel in a room; the sky beside it stays as it is to the bit.

    Rays that stand out by more than the filter takes for noise do not reach their neighbours: 2 % of the light here.
    """
    scene = scenes.cornell(world=World((0.25, 0.5, 1.0)))
    settings = {**RAYS, "gather_rays": 1}
    plain, smooth = (picture_of(session, scene, **{**settings, "denoise": denoise, "denoiser": "atrous"})
                     for denoise in (False, True))
    truth = picture_of(session, scene, **{**settings, "samples": 64})
    sky = np.isclose(plain, (0.25, 0.5, 1.0, 1.0)).all(2)
    assert sky.sum() > 100
    assert np.array_equal(plain[sky], smooth[sky])
    assert ((smooth - truth) ** 2).mean() < 0.5 * ((plain - truth) ** 2).mean()
    assert smooth.mean() == pytest.approx(plain.mean(), rel=0.02)
