# SPDX-License-Identifier: GPL-3.0-or-later
"""Modes as cards, in one picture by each engine."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from svo_engine.blender.extract import extract
from svo_engine.nodes.compile import compiled_tree
from svo_engine.render import Session
from svo_engine.scene.camera import make_view
from tests.blender import build, cycles
from tests.nodes import cards

from . import feeds
from .modes import Mode


def fresh_nodes() -> build.Nodes:
    """The nodes of a material in a new file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return build.material()


def compare(session: Session, modes: Sequence[Mode], samples: int) -> tuple[np.ndarray, np.ndarray, list[Any]]:
    """Cards (n, size, size, 3) f4 by us and by Cycles, and what the compiler told of each. Shaders lie below a white
    sky, values are scaled to what light can show."""
    makers: list[Callable[..., Any]] = [mode.make if mode.is_shader else partial(_scaled, mode) for mode in modes]
    cards.make_cards(makers)
    for i in range(len(modes)):
        feeds.dress(bpy.data.objects[f"Card {i}"], i + 1)
    if modes[0].is_shader:
        sky = build.world()
        sky.show(sky.new("Background", Color=(1, 1, 1, 1)))
    return _by_us(session, len(modes), samples), _by_cycles(len(modes), samples), _notes(len(modes))


def _scaled(mode: Mode, nodes: build.Nodes) -> Any:
    node = nodes.new("VectorMath")
    node.operation = "MULTIPLY_ADD"
    nodes.tree.links.new(mode.make(nodes), node.inputs[0])
    node.inputs[1].default_value, node.inputs[2].default_value = (0.25,) * 3, (0.5,) * 3
    return node.outputs["Vector"]


def _scene() -> Any:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    depsgraph.update()
    return cards.by_trees(extract(depsgraph))


def _by_us(session: Session, n: int, samples: int) -> np.ndarray:
    scene, size = _scene(), bpy.context.scene.render.resolution_x
    view = make_view(replace(scene.camera, size=(size, size)))
    settings = cards.SETTINGS
    if samples > 1:
        settings = replace(settings, samples=samples // 4, gather_rays=4, adaptive_sampling=False, cache_rays=16)
    return cards._cut(list(session.films(scene, view, settings))[-1].planes["Combined"], n)


def _by_cycles(n: int, samples: int) -> np.ndarray:
    size = bpy.context.scene.render.resolution_x
    with tempfile.TemporaryDirectory() as folder:
        picture = cycles.render(Path(folder), size=(size, size), samples=samples, filter_width=0.01)
    return cards._cut(picture, n)


def _notes(n: int) -> list[tuple[str, ...]]:
    graphs = {material.name: material.graph for material in _scene().materials}
    return [compiled_tree(graphs[f"Card {i}"]).notes for i in range(n)]
