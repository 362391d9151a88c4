# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that outlive the frame which needed them first, so that the next frame redoes only what an edit touched."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, TypeVar

import numpy as np

from .device import Device

T = TypeVar("T")


@dataclass(eq=False)
class _Result:
    """What a stage made of `inputs`. n_users: the frames that need it, and Kept itself while it is the last one."""

    inputs: tuple[Any, ...]
    value: Any
    n_users: int = 1

    def drop(self) -> None:
        """One user less; the last one releases it."""
        self.n_users -= 1
        if not self.n_users:
            self.value.scope.close()


class Kept:
    """The last result of each stage, given again while its inputs are the same; an edit redoes only what it touches.

    Frames may take turns on the device, sample by sample: what a frame uses stays until it ends, whatever others do.
    """

    def __init__(self) -> None:
        self._results: dict[str, _Result] = {}

    def forget(self, names: Iterable[str] | None = None) -> None:
        """Drop the last results of some stages, or of all, so that the next frame makes them anew."""
        for name in list(self._results if names is None else names):
            if name in self._results:
                self._results.pop(name).drop()

    @contextmanager
    def frame(self, device: Device) -> Iterator[Callable[..., Any]]:
        """The function `stage(name, make, *inputs)` for one frame.

        It gives `make(device, *inputs)`, or its last result if all inputs are the same objects or equal values.
        """
        with ExitStack() as used:

            def stage(name: str, make: Callable[..., T], *inputs: Any) -> T:
                result = self._result(name, make, device, inputs)
                result.n_users += 1
                used.callback(result.drop)
                return result.value

            yield stage

    def _result(self, name: str, make: Callable[..., Any], device: Device, inputs: tuple[Any, ...]) -> _Result:
        last = self._results.get(name)
        if last and len(last.inputs) == len(inputs) and all(map(_same, last.inputs, inputs)):
            return last
        if last:
            del self._results[name]
            last.drop()
        result = self._results[name] = _Result(inputs, _whole(make, device, inputs))
        return result


def _same(a: Any, b: Any) -> bool:
    """Whether two inputs are the same: values, arrays and records of them by value, results of stages by identity."""
    if a is b:
        return True
    if type(a) is not type(b) or hasattr(a, "scope"):
        return False
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b)
    if isinstance(a, tuple):
        return len(a) == len(b) and all(map(_same, a, b))
    if is_dataclass(a):
        return all(_same(getattr(a, field.name), getattr(b, field.name)) for field in fields(a))
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
