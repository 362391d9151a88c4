# SPDX-License-Identifier: GPL-3.0-or-later
"""The same as yesterday: kept pictures, to notice what nobody meant to change.

`python -m tests.golden.refresh` renews them. They are those of Mesa's software renderer; other versions of it and other
processors, round otherwise: that moves single pixels at edges, and a radiance by far less than a percent.
"""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine import film
from tests.golden import pictures


@pytest.mark.parametrize("name", pictures.SETTINGS)
def test_the_picture_is_that_of_yesterday(session, name):
    renderer = session.device_info()["renderer"]
    if pictures.RENDERER not in renderer:
        pytest.skip(f"kept pictures are those of {pictures.RENDERER}, this is {renderer}")
    kept = film.load(pictures.FOLDER / f"{name}.npz").planes["Combined"]
    found = pictures.render(session, name).planes["Combined"]
    same = np.isclose(found, kept, rtol=0.01, atol=1e-3).all(2)
    assert same.mean() > 0.99, f"{(~same).sum()} of {same.size} pixels differ: by chance, or for the better?"
    assert found.mean() == pytest.approx(kept.mean(), rel=1e-3)


@pytest.mark.parametrize("name", pictures.SETTINGS)
def test_kept_pictures_are_small_and_show_something(name):
    path = pictures.FOLDER / f"{name}.npz"
    assert path.stat().st_size <= 30_000
    kept = film.load(path).planes["Combined"]
    assert kept.shape == (pictures.SIZE[1], pictures.SIZE[0], 4)
    assert kept[..., :3].std() > 0.05
