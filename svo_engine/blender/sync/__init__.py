# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps what `extract` reads, so that an update costs what has changed. Nothing of the user's is changed."""

from __future__ import annotations

from .same import keep_picture
from .sync import Sync

__all__ = ["Sync", "keep_picture"]
