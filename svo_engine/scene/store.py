# SPDX-License-Identifier: GPL-3.0-or-later
"""A Scene as one .npz file: arrays under their path, all the rest as JSON. No pickle, so a file cannot run code.

Fields that are not in a file take their defaults, so a new field with a default needs no new format.
"""

from __future__ import annotations

import json
import typing
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import SceneError
from .graph import Graph, packed, unpacked
from .types import Scene

FORMAT = 2


def save(scene: Scene, path: str | Path) -> None:
    """Write `scene` to `path`; SceneError if the file cannot be written."""
    arrays: dict[str, np.ndarray] = {}
    tree = _pack(scene, "scene", arrays)
    try:
        with Path(path).open("wb") as file:
            np.savez(file, header=np.array(json.dumps({"format": FORMAT, "scene": tree})), **arrays)  # type: ignore[arg-type]
    except OSError as error:
        raise SceneError(f"Cannot write '{path}': {error.strerror or error}") from error


def load(path: str | Path) -> Scene:
    """Read what `save` wrote; SceneError if there is no such file, or it is none of ours."""
    try:
        with np.load(path, allow_pickle=False) as data:
            header = json.loads(str(data["header"]))
            _check_format(path, header["format"])
            made: Scene = _unpack(header["scene"], Scene, "scene", data)
            return made
    except OSError as error:
        raise SceneError(f"Cannot read '{path}': {error.strerror or error}") from error
    except SceneError:
        raise
    except Exception as error:  # numpy, zipfile and json raise of everything for a cut or foreign file
        raise SceneError(f"'{path}' is not a saved scene") from error


def _check_format(path: str | Path, number: Any) -> None:
    if int(number) < FORMAT:
        raise SceneError(f"'{path}' was written by an older version (format {number}); "
                         "extract it again from its .blend")
    if int(number) > FORMAT:
        raise SceneError(f"'{path}' was written by a newer version (format {number}); this one reads format {FORMAT}")


def _pack(value: Any, where: str, arrays: dict[str, np.ndarray]) -> Any:
    """JSON for `value`; its arrays go into `arrays` and leave their name behind."""
    if isinstance(value, Graph):
        return packed(value)
    if is_dataclass(value):
        return {f.name: _pack(getattr(value, f.name), f"{where}/{f.name}", arrays) for f in fields(value)}
    if isinstance(value, np.ndarray):
        arrays[where] = value
        return where
    if isinstance(value, tuple):
        return [_pack(v, f"{where}/{i}", arrays) for i, v in enumerate(value)]
    return value.item() if isinstance(value, np.generic) else value


def _unpack(tree: Any, kind: Any, where: str, data: Any) -> Any:
    """The value of type `kind` that `_pack` turned into `tree`; SceneError names the place of what is no such value."""
    args = typing.get_args(kind)
    if type(None) in args:
        if tree is None:
            return None
        kind, = (a for a in args if a is not type(None))
    if kind is Graph:
        return unpacked(tree)
    if is_dataclass(kind) and isinstance(tree, dict):
        return _record(tree, kind, where, data)
    if typing.get_origin(kind) is tuple and isinstance(tree, list):
        kinds = [args[0]] * len(tree) if args[-1] is Ellipsis else args
        if len(kinds) == len(tree):
            return tuple(_unpack(t, k, f"{where}/{i}", data) for i, (t, k) in enumerate(zip(tree, kinds, strict=True)))
    return _leaf(tree, kind, where, data)


def _leaf(tree: Any, kind: Any, where: str, data: Any) -> Any:
    """A value that holds no others."""
    if kind is np.ndarray and isinstance(tree, str) and tree in data:
        return data[tree]
    if kind is float and type(tree) is int:
        return float(tree)
    if (kind in (bool, int, float, str) and type(tree) is kind) or tree in _choices(kind):
        return tree
    raise SceneError(f"The saved scene is damaged: {where} is of the wrong kind")


def _choices(kind: Any) -> tuple[Any, ...]:
    return typing.get_args(kind) if typing.get_origin(kind) is typing.Literal else ()


def _record(tree: dict[str, Any], kind: Any, where: str, data: Any) -> Any:
    hints = typing.get_type_hints(kind)
    known = {field.name for field in fields(kind)}
    if unknown := sorted(tree.keys() - known):
        raise SceneError(f"The saved scene has {where}/{unknown[0]}, which this version does not know")
    if missing := [f.name for f in fields(kind) if _is_needed(f) and f.name not in tree]:
        raise SceneError(f"The saved scene is damaged: {where}/{missing[0]} is missing")
    return kind(**{name: _unpack(value, hints[name], f"{where}/{name}", data) for name, value in tree.items()})


def _is_needed(field: Any) -> bool:
    return field.default is MISSING and field.default_factory is MISSING
