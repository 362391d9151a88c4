# SPDX-License-Identifier: GPL-3.0-or-later
"""Values as they are typed on the command line."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable

# Blender's own limits, so that both kinds of scene take the same
SIZE_LIMITS, FRAME_LIMITS = (4, 65536), (-1048574, 1048574)


def size(text: str) -> tuple[int, int]:
    """'WIDTHxHEIGHT' in pixels."""
    low, high = SIZE_LIMITS
    match = re.fullmatch(r"(\d+)x(\d+)", text)
    if match is None or not all(low <= int(n) <= high for n in match.groups()):
        raise argparse.ArgumentTypeError(f"'{text}' is no size: WIDTHxHEIGHT, each {low} to {high} pixels")
    return int(match[1]), int(match[2])


def integer(low: int, high: int) -> Callable[[str], int]:
    """A reader of whole numbers from `low` to `high`."""
    def read(text: str) -> int:
        if not re.fullmatch(r"[+-]?\d+", text) or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"'{text}' is no whole number from {low} to {high}")
        return int(text)

    return read


def assignment(text: str) -> tuple[str, str]:
    """'NAME=VALUE' as (name, value)."""
    name, equals, value = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=VALUE")
    return name, value


def named(name: str) -> Callable[[str], tuple[str, str]]:
    """A reader of the value of `name`, as `assignment` gives it."""
    return lambda text: (name, text)
