# SPDX-License-Identifier: GPL-3.0-or-later
"""gpu/oidn.py and gpu/cuda.py: the library filters OpenGL's buffers, by way of the host or of CUDA."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu import oidn
from svo_engine.gpu.cuda import Cuda
from svo_engine.gpu.device import Device
from svo_engine.gpu.oidn import IMAGES, QUALITIES, Oidn, OidnDevice

SIZE = 96, 80
HEIGHT_WIDTH = SIZE[::-1]
NEEDED = pytest.mark.skipif(oidn.library() is None, reason="Open Image Denoise is not installed")


def chart() -> np.ndarray:
    """A checkerboard of albedo, (h, w, 3)."""
    y, x = np.indices(HEIGHT_WIDTH)
    return np.where((x // 16 + y // 16) % 2, 0.8, 0.2)[..., None] * np.ones(3)


def noisy(mean: np.ndarray, sigma: float) -> np.ndarray:
    """RGBA f4 with multiplicative noise, and an alpha of its own."""
    rng = np.random.default_rng(4)
    rgb = mean * np.maximum(1 + sigma * rng.normal(size=mean.shape), 0)
    return np.concatenate([rgb, rng.uniform(0, 1, (*HEIGHT_WIDTH, 1))], 2).astype("f4")


def filtered(device, color: np.ndarray, albedo: np.ndarray, quality: str = "high",
             cuda: Cuda | None = None) -> np.ndarray:
    """What the library makes of `color`, on a wall that faces the eye."""
    guides = albedo, np.broadcast_to([0.0, 0, 1], (*HEIGHT_WIDTH, 3))
    with device.scope() as scope:
        buffers = [scope.pixels(name, SIZE) for name in IMAGES]
        for buffer, data in zip(buffers, (color, *(np.pad(guide, ((0, 0), (0, 0), (0, 1))) for guide in guides)),
                                strict=True):
            buffer.write(np.ascontiguousarray(data, "f4").tobytes())
        runs_on = OidnDevice(cuda)
        scope.adopt(runs_on)
        made = Oidn(runs_on, buffers, SIZE, quality, is_clean=True)
        scope.adopt(made)
        pixels = np.empty((*HEIGHT_WIDTH, 4), "f4")
        made.run(pixels, scope.pixels("staging", SIZE, for_host=True))
        return pixels


@NEEDED
@pytest.mark.parametrize("quality", QUALITIES)
def test_noise_goes_and_edges_stay(device, quality):
    """Three quarters of the noise, in each half of the checkerboard, brightness to 5 %; alpha is not touched."""
    albedo, color = chart(), noisy(chart(), 0.3)
    pixels = filtered(device, color, albedo, quality)
    assert np.array_equal(pixels[..., 3], color[..., 3])
    for value in (0.2, 0.8):
        part = albedo[..., 0] == value
        assert pixels[part][:, :3].std() < 0.25 * color[part][:, :3].std()
        assert pixels[part][:, :3].mean() == pytest.approx(value, rel=0.05)


@NEEDED
def test_the_same_bits_again(device):
    color = noisy(chart(), 0.3)
    assert np.array_equal(filtered(device, color, chart()), filtered(device, color, chart()))


@NEEDED
def test_cuda_and_the_host_agree(device):
    if device.cuda is None:
        pytest.skip("OpenGL draws without CUDA")
    color = noisy(chart(), 0.3)
    assert np.array_equal(filtered(device, color, chart(), cuda=device.cuda), filtered(device, color, chart()))


@NEEDED
def test_a_card_that_the_library_cannot_use_leaves_it_the_processor():
    found = Device.denoising.func(SimpleNamespace(cuda=SimpleNamespace(number=99)))
    assert found.cuda is None
    found.close()


def test_a_software_renderer_has_no_cuda(device):
    if not device.profiler.is_software:
        pytest.skip("there is a graphics card")
    assert device.cuda is None


@NEEDED
def test_what_the_library_cannot_is_told_in_its_words(device, monkeypatch):
    monkeypatch.setitem(QUALITIES, "high", 99)
    with pytest.raises(GpuError, match=r"^Open Image Denoise failed: .+"):
        Oidn(device.denoising, [], SIZE, "high", is_clean=True)


def test_a_missing_library_is_told(device, monkeypatch):
    monkeypatch.setattr(oidn, "library", lambda: None)
    with pytest.raises(GpuError, match="Open Image Denoise was not found"):
        OidnDevice(None)
