# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that outlive the frame which needed them first, so that the next frame redoes only what an edit touched."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, TypeVar

import numpy as np

from .device import Device

T = TypeVar("T")


@dataclass(eq=False)
class _Result:
    """What a stage made of `inputs`. n_users: the frames that need it, and every Kept while it is among its last."""

    inputs: tuple[Any, ...]
    value: Any
    n_users: int = 1

    def is_of(self, inputs: tuple[Any, ...]) -> bool:
        """Whether it was made of the same."""
        return len(self.inputs) == len(inputs) and all(map(_same, self.inputs, inputs))

    def drop(self) -> None:
        """One user less; the last one releases it."""
        self.n_users -= 1
        if not self.n_users:
            self.value.scope.close()


class Kept:
    """The last results of each stage, given again while their inputs are the same: an edit redoes only what it touches.

    Of most stages the last one is kept. Frames may take turns on the device, sample by sample: what a frame uses stays
    until it ends, whatever others do.

    family    all that render on one device: what one of them has kept serves the others too, so that meshes and trees
              are there once, and none drops what another one still needs
    """

    def __init__(self, family: list[Kept] | None = None) -> None:
        self._results: defaultdict[str, list[_Result]] = defaultdict(list)
        self._family = [] if family is None else family
        self._family.append(self)

    def forget(self, names: Iterable[str] | None = None) -> None:
        """Drop the last results of some stages, or of all, so that the next frame makes them anew."""
        for name in list(self._results if names is None else names):
            for result in self._results.pop(name, []):
                result.drop()

    def close(self) -> None:
        """Drop all, and leave the family."""
        self.forget()
        if self in self._family:
            self._family.remove(self)

    @contextmanager
    def frame(self, device: Device) -> Iterator[Callable[..., Any]]:
        """The function `stage(name, make, *inputs, n_kept=1)` for one frame.

        It gives `make(device, *inputs)`, or one of its n_kept last results if all inputs are the same objects or equal
        values. `make` sees nothing but its inputs, so that nothing else can make a kept result wrong.
        """
        with ExitStack() as used:

            def stage(name: str, make: Callable[..., T], *inputs: Any, n_kept: int = 1) -> T:
                result = self._result(name, make, device, inputs, n_kept)
                result.n_users += 1
                used.callback(result.drop)
                return result.value

            yield stage

    def _result(self, name: str, make: Callable[..., Any], device: Device, inputs: tuple[Any, ...],
                n_kept: int) -> _Result:
        own = self._results[name]
        for result in own:
            if result.is_of(inputs):
                own.remove(result)
                own.append(result)
                return result
        others = (result for kept in self._family for result in kept._results.get(name, ()))
        found = next((result for result in others if result.is_of(inputs)), None)
        while len(own) >= n_kept:
            own.pop(0).drop()
        if found:
            found.n_users += 1
        own.append(found or _Result(inputs, _whole(make, device, inputs)))
        return own[-1]


def _same(a: Any, b: Any) -> bool:
    """Whether two inputs are the same: values, arrays and records of them by value, results of stages by identity."""
    if a is b or type(a) is not type(b) or hasattr(a, "scope"):
        return a is b
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b)
    if isinstance(a, tuple):
        return len(a) == len(b) and all(map(_same, a, b))
    if is_dataclass(a):
        return all(_same(getattr(a, field.name), getattr(b, field.name)) for field in fields(a))
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    return isinstance(a, (int, float, str)) and a == b


def _whole(make: Callable[..., T], device: Device, inputs: tuple[Any, ...]) -> T:
    """`make(device, *inputs)`; if it fails or is stopped, what it had made so far is released."""
    before = set(device.scopes)
    try:
        return make(device, *inputs)
    except BaseException:
        for scope in device.scopes - before:
            scope.close()
        raise
