# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs that write pages: what they choose, and what they leave alone."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.bench.references import from_halves
from svo_engine.settings import RenderSettings
from tools.accuracy.page import AMPLIFIED, MOST_BYTES, montage, rows, save_small, section
from tools.overview.page import BLOCK, error_map, put, worst_block
from tools.overview.stages import STAGES, milliseconds

SIZE = (144, 192, 3)


def noisy(seed: int, sigma: float = 0.01) -> np.ndarray:
    return (0.5 + sigma * np.random.default_rng(seed).normal(size=SIZE)).astype("f4")


def test_noise_of_the_reference_is_no_error():
    """The mean of products of independent noises: 0 within four of their own sigma."""
    reference, truth = from_halves(noisy(1), noisy(2)), np.full(SIZE, 0.5, "f4")
    error = error_map(truth, reference)
    assert abs(error.mean()) < 4 * 1e-4 / 0.26 / np.sqrt(np.prod(SIZE))
    assert reference.noise == pytest.approx(1e-4 / 2 / 0.26, rel=0.05)


def test_the_worst_block_is_where_the_error_is():
    ours = np.full(SIZE, 0.5, "f4")
    ours[60:90, 110:150] += 0.3
    (x, y), worst = worst_block(error_map(ours, from_halves(noisy(1), noisy(2))))
    assert y <= 60 and y + BLOCK[1] >= 90 and x <= 110 and x + BLOCK[0] >= 150
    assert worst == pytest.approx(0.09 / 0.26 * 30 * 40 / np.prod(BLOCK), rel=0.01)


def test_only_the_marked_part_of_a_page_is_replaced():
    text = "a\n<!-- x -->\nold\nlines\n<!-- end -->\nb\n<!-- y -->\nkept\n<!-- end -->\n"
    assert put(text, "x", iter(["new"])) == text.replace("old\nlines", "new")
    with pytest.raises(AssertionError, match="no part 'z'"):
        put(text, "z", iter(["new"]))


def test_the_overview_has_its_parts(root):
    text = (root / "docs/gi-overview.md").read_text()
    for name in ("stages", "errors"):
        assert put(text, name, iter(["new"])) != text


def test_stages_are_renders_that_can_be_asked_for():
    assert len({stage.name for stage in STAGES}) == len(STAGES)
    for stage in STAGES:
        assert RenderSettings(**stage.settings)
    times = {"cache/direct": 1.0, "cache/link": 2.0, "cache/bounce": 4.0, "upload": 8.0}
    by_name = {stage.name: milliseconds(stage, times) for stage in STAGES}
    assert (by_name["lamps"], by_name["cache"], by_name["bounce_1"]) == (1, 6, 0)


def test_pictures_are_small_files(tmp_path):
    path = tmp_path / "noise.png"
    save_small(np.random.default_rng(0).random((600, 800, 3)), path)
    assert path.stat().st_size <= MOST_BYTES
    picture = montage(noisy(1), noisy(2))
    assert picture.shape[1] > 3 * SIZE[1] and AMPLIFIED > 1


def test_a_large_error_asks_for_its_cause():
    truth = from_halves(noisy(1, 0), noisy(2, 0))
    good, bad = truth.picture, 1.1 * truth.picture
    (line,) = rows("a", {16: bad}, truth)
    assert "| +10.00% |" in line
    assert "because" in list(section("a", {16: bad}, truth, "because"))
    assert any("not known" in text for text in section("a", {16: bad}, truth, ""))
    assert not any("because" in text for text in section("a", {16: bad, 256: good}, truth, "because"))
