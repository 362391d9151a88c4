# SPDX-License-Identifier: GPL-3.0-or-later
"""What each kind of node means: a function from a Reader to its outputs, registered by Blender's name of the kind."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from functools import cache

from ..closures import Closure
from ..expr import Expr
from ..reader import Reader

LIT = "light of"  # an output that is no socket: the shader whose light the others tell of

Outputs = Mapping[str, Expr | Closure | None]
Kind = Callable[[Reader], Outputs]

_found: dict[str, Kind] = {}


def kind(*names: str) -> Callable[[Kind], Kind]:
    """Register a function for nodes of these kinds."""

    def register(function: Kind) -> Kind:
        for name in names:
            assert name not in _found, f"{name} is there twice"
            _found[name] = function
        return function

    return register


@cache
def kinds() -> Mapping[str, Kind]:
    """All that there are."""
    for module in pkgutil.iter_modules(__path__):
        importlib.import_module(f"{__name__}.{module.name}")
    return _found
