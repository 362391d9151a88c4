# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures on disk: what is written is what is read, and what cannot be written is told."""

from __future__ import annotations

import numpy as np
import OpenEXR
import pytest
from PIL import Image as PillowImage

from svo_engine import film as module
from svo_engine.errors import SvoError
from svo_engine.film import Film, encode_srgb


@pytest.fixture
def film() -> Film:
    """5 by 3 pixels, all different; brighter than white, negative, half clear."""
    rng = np.random.default_rng(1)
    combined = rng.uniform(-0.2, 2, (3, 5, 4)).astype("f4")
    combined[..., 3] = np.linspace(0, 1, 15).reshape(3, 5)
    return Film({"Combined": combined, "Depth": rng.normal(size=(3, 5, 1)).astype("f4")}, 7)


def test_size_is_width_and_height(film):
    assert film.size == (5, 3)


def test_npz_keeps_every_plane_to_the_bit(film, tmp_path):
    film.save(tmp_path / "a.npz")
    back = module.load(tmp_path / "a.npz")
    assert back.n_samples == 7
    assert back.planes.keys() == film.planes.keys()
    assert all(np.array_equal(back.planes[name], plane) for name, plane in film.planes.items())


def test_exr_keeps_the_picture_to_the_bit_with_its_first_row_at_the_top(film, tmp_path):
    film.save(tmp_path / "a.exr")
    with OpenEXR.File(str(tmp_path / "a.exr")) as file:
        pixels = file.channels()["RGBA"].pixels
    assert np.array_equal(pixels[::-1], film.planes["Combined"])


def test_png_is_srgb_with_straight_alpha_and_its_first_row_at_the_top(film, tmp_path):
    film.save(str(tmp_path / "a.png"))
    with PillowImage.open(tmp_path / "a.png") as image:
        assert image.mode == "RGBA"
        pixels = np.asarray(image)[::-1] / 255
    rgba = film.planes["Combined"].astype("f8")
    straight = np.clip(rgba[..., :3] / np.maximum(rgba[..., 3:], 1e-8), 0, 1)
    expected = np.where(straight <= 0.0031308, 12.92 * straight, 1.055 * straight ** (1 / 2.4) - 0.055)
    assert np.allclose(pixels[..., 3], rgba[..., 3], atol=0.51 / 255)
    assert np.allclose(pixels[..., :3], expected, atol=0.51 / 255)


def test_srgb_values():
    linear = np.array([-1, 0, 0.0031308, 0.18, 0.5, 1, 7])
    assert np.allclose(encode_srgb(linear), [0, 0, 0.04045, 0.461356, 0.735357, 1, 1], atol=1e-5)
    assert encode_srgb(linear).dtype == np.float32


def test_srgb_has_no_step_between_its_two_parts():
    around = encode_srgb(np.array([0.0031308 - 1e-7, 0.0031308 + 1e-7]))
    assert abs(around[1] - around[0]) < 1e-5


@pytest.mark.parametrize("name", ["a.jpg", "a", "a.png.bak", ".png"])
def test_an_unknown_ending_is_told(film, tmp_path, name):
    with pytest.raises(SvoError, match=r"its ending must be one of \.npz, \.png, \.exr"):
        film.save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", [".npz", ".png", ".exr"])
class TestUnwritable:
    def test_no_such_folder(self, film, tmp_path, ending):
        path = tmp_path / "none" / f"a{ending}"
        with pytest.raises(SvoError, match=f"Cannot write '{path}': "):
            film.save(path)

    def test_a_folder_of_that_name(self, film, tmp_path, ending):
        path = tmp_path / f"a{ending}"
        path.mkdir()
        with pytest.raises(SvoError, match=f"Cannot write '{path}': "):
            film.save(path)

    def test_a_file_where_a_folder_should_be(self, film, tmp_path, ending):
        (tmp_path / "file").touch()
        path = tmp_path / "file" / f"a{ending}"
        with pytest.raises(SvoError, match=f"Cannot write '{path}': "):
            film.save(path)


def test_exr_has_a_layer_for_each_render_pass(film, tmp_path):
    film.planes["Normal"] = np.random.default_rng(2).normal(size=(3, 5, 3)).astype("f4")
    film.save(tmp_path / "a.exr")
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        channels = {name: channel.pixels[::-1] for name, channel in file.channels().items()}
    assert channels.keys() == {*"RGBA", "Depth.Z", "Normal.X", "Normal.Y", "Normal.Z"}
    assert np.array_equal(channels["Depth.Z"], film.planes["Depth"][..., 0])
    assert all(np.array_equal(channels[f"Normal.{letter}"], film.planes["Normal"][..., i])
               for i, letter in enumerate("XYZ"))
