# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of `figures.py` within their bounds."""

from __future__ import annotations

import pytest

from tests.physics.figures import FIGURES


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: f"{figure.group.partition(':')[0]}, {figure.name}")
def test_figure(session, figure):
    assert figure.measure(session) <= figure.most
