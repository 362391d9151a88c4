# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's operators raise, as an error that the user can be told."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import SvoError


@contextmanager
def as_svo_errors() -> Iterator[None]:
    """Around calls into Blender alone: their RuntimeError holds every report, one a line; SvoError gets the first."""
    try:
        yield
    except RuntimeError as error:
        raise SvoError(str(error).strip().partition("\n")[0].removeprefix("Error: ")) from error
