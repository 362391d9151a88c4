# SPDX-License-Identifier: GPL-3.0-or-later
"""References know their own noise, and measure errors below it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from svo_engine.bench import references
from svo_engine.errors import SvoError
from svo_engine.film import Film
from svo_engine.metrics import RELATIVE_FLOOR, rel_mse

SIGMA = 0.1
TRUTH = np.full((128, 128, 3), 1.0, "f4")
N = TRUTH.size
RNG = np.random.default_rng(7)


def noisy(sigma=SIGMA):
    return (TRUTH + sigma * RNG.standard_normal(TRUTH.shape)).astype("f4")


def test_halves_tell_the_noise_of_their_mean():
    made = references.from_halves(noisy(), noisy())
    # Both estimate sigma^2 / 2 by the mean of N squares of normal numbers, which is off by sqrt(2 / N) of it; the
    # weight, 1 / (r^2 + 0.01), spreads by its own noise, of second order
    true = rel_mse(made.picture, TRUTH)
    assert made.noise == pytest.approx(SIGMA**2 / 2, rel=5 * math.sqrt(2 / N) + 5 * SIGMA**2)
    assert made.noise == pytest.approx(true, rel=10 * math.sqrt(2 / N) + 5 * SIGMA**2)


def test_an_error_below_the_references_noise_is_measured():
    made = references.from_halves(noisy(), noisy())
    picture = TRUTH + 0.02 * RNG.choice([-1, 1], TRUTH.shape)
    wanted = 0.02**2 / (1 + RELATIVE_FLOOR)
    # The product of two noises has the mean 0 and spreads by sigma^2 / sqrt(N). The weight, as noisy as the mean of the
    # halves, adds its second derivative, 6, times sigma^4 / 4
    spread = 5 * SIGMA**2 / math.sqrt(N) + 6 * SIGMA**4 / 4
    assert references.error_of(picture, made) == pytest.approx(wanted, abs=1.5 * spread)
    assert rel_mse(picture, made.picture) > 10 * wanted


def test_a_known_noise_is_taken_off_and_an_unknown_one_stays():
    picture = noisy()
    plain = rel_mse(picture, TRUTH)
    assert references.error_of(picture, references.Reference(TRUTH, noise=1e-3)) == pytest.approx(plain - 1e-3)
    assert references.error_of(picture, references.Reference(TRUTH)) == pytest.approx(plain)


def test_all_measures_of_an_equal_picture():
    pytest.importorskip("flip_evaluator")
    found = references.measure(TRUTH, references.Reference(TRUTH))
    assert (found.nrmse, found.rel_mse, found.error, found.bias, found.flip) == (0, 0, 0, 0, 0)
    assert math.isnan(found.noise)


def test_flip_sees_a_difference_and_is_nan_without_its_package(monkeypatch):
    pytest.importorskip("flip_evaluator")
    darker = TRUTH * 0.5
    assert 0 < references.flip(darker, TRUTH) <= 1
    monkeypatch.setitem(__import__("sys").modules, "flip_evaluator", None)
    assert math.isnan(references.flip(darker, TRUTH))


def test_another_size_is_refused():
    with pytest.raises(SvoError, match="64x128 pixels has a reference of 128x128"):
        references.measure(TRUTH[:, :64], references.Reference(TRUTH))


@pytest.mark.parametrize("made", [references.from_halves(noisy(), noisy()), references.Reference(noisy(), noise=1e-5)])
def test_saved_and_loaded(made, tmp_path):
    references.save(made, tmp_path / "new" / "a.npz")
    loaded = references.load(tmp_path / "new" / "a.npz")
    assert np.array_equal(loaded.picture, made.picture)
    assert loaded.noise == made.noise and len(loaded.halves) == len(made.halves)
    assert loaded.size == (128, 128)


def test_pictures_of_others_are_read(tmp_path):
    picture = noisy()
    Film({"Combined": np.dstack([picture, TRUTH[..., :1]])}, 1).save(tmp_path / "a.exr")
    np.savez(tmp_path / "a.npz", r=picture)
    for name in ("a.exr", "a.npz"):
        loaded = references.load(tmp_path / name)
        assert np.array_equal(loaded.picture, picture) and math.isnan(loaded.noise)


@pytest.mark.parametrize("name", ["none.npz", "none.exr", "text.npz", "text.exr", "other.npz"])
def test_what_is_no_reference_is_named(name, tmp_path):
    (tmp_path / "text.npz").write_text("text")
    (tmp_path / "text.exr").write_text("text")
    np.savez(tmp_path / "other.npz", x=TRUTH)
    with pytest.raises(SvoError, match=name):
        references.load(tmp_path / name)
