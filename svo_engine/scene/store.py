# SPDX-License-Identifier: GPL-3.0-or-later
"""A Scene as one .npz file: arrays under their path, all the rest as JSON. No pickle, so a file cannot run code."""

from __future__ import annotations

import json
import typing
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import SceneError
from . import types
from .types import Scene

FORMAT = 1


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
            if header["format"] != FORMAT:
                raise SceneError(f"'{path}' is a scene of format {header['format']}; this version reads {FORMAT}")
            return _unpack(header["scene"], Scene, data)
    except OSError as error:
        raise SceneError(f"Cannot read '{path}': {error.strerror or error}") from error
    except SceneError:
        raise
    except Exception as error:  # numpy, zipfile and json raise of everything for a cut or foreign file
        raise SceneError(f"'{path}' is not a saved scene") from error


def _pack(value: Any, where: str, arrays: dict[str, np.ndarray]) -> Any:
    """JSON for `value`; its arrays go into `arrays` and leave their name behind."""
    if is_dataclass(value):
        return {f.name: _pack(getattr(value, f.name), f"{where}/{f.name}", arrays) for f in fields(value)}
    if isinstance(value, np.ndarray):
        arrays[where] = value
        return where
    if isinstance(value, tuple):
        return [_pack(v, f"{where}/{i}", arrays) for i, v in enumerate(value)]
    return value.item() if isinstance(value, np.generic) else value


def _unpack(tree: Any, kind: Any, data: Any) -> Any:
    """The value of type `kind` that `_pack` turned into `tree`."""
    if tree is None:
        return None
    if kind is np.ndarray:
        return data[tree]
    if is_dataclass(kind):
        hints = typing.get_type_hints(kind, vars(types))
        return kind(**{name: _unpack(tree[name], hints[name], data) for name in tree})  # type: ignore[operator]
    args = typing.get_args(kind)
    if typing.get_origin(kind) is tuple:
        kinds = [args[0]] * len(tree) if args[-1] is Ellipsis else args
        return tuple(_unpack(t, k, data) for t, k in zip(tree, kinds, strict=True))
    optional = [a for a in args if a is not type(None)]
    return _unpack(tree, optional[0], data) if len(optional) == 1 and len(args) == 2 else tree
