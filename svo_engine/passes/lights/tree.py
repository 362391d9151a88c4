# SPDX-License-Identifier: GPL-3.0-or-later
"""A tree over many lights, from which one is drawn by its intensity and distance [ContyEstevez18].

The tree is complete, so that a leaf's number says the way from the root to it, and so the probability of drawing it.
"""

from __future__ import annotations

import numpy as np

from ...scene import layouts


def light_tree(low: np.ndarray, high: np.ndarray, intensity: np.ndarray) -> np.ndarray:
    """Nodes of layout LIGHT_NODE over n lights: the root is node 1, node i has the children 2 i and 2 i + 1, and the
    second half of all nodes are leaves.

    low, high   (n, 3) f8, metres: the lights' boxes
    intensity   (n,) f8, above zero: radiant intensity [W sr^-1] towards where it is highest

    Where n is no power of two, some leaves are empty: their intensity is 0.
    """
    n = len(intensity)
    if n == 0:
        return np.zeros(2, layouts.dtype(layouts.LIGHT_NODE))
    n_leaves = 1 << max(n - 1, 0).bit_length()
    light = np.arange(n_leaves) * n // n_leaves
    is_empty = np.diff(light, prepend=-1) == 0
    order = _median_order(((low + high) / 2)[light])
    light, is_empty = light[order], is_empty[order]
    nodes = np.zeros(2 * n_leaves, layouts.dtype(layouts.LIGHT_NODE))
    nodes["light"][n_leaves:] = light
    boxes = np.where(is_empty[:, None], np.inf, low[light]), np.where(is_empty[:, None], -np.inf, high[light])
    _fill(nodes, *boxes, np.where(is_empty, 0.0, intensity[light]))
    return nodes


def leaf_of_light(nodes: np.ndarray) -> np.ndarray:
    """(n,) u4: the leaf of each light, counted from the first leaf."""
    leaves = nodes[len(nodes) // 2:]
    taken = np.flatnonzero(leaves["intensity"] > 0)
    return taken[np.argsort(leaves["light"][taken])].astype("u4")


def _median_order(points: np.ndarray) -> np.ndarray:
    """An order of points (2^k, 3): halves, their halves and so on are cut at the median of their widest axis."""
    order = np.arange(len(points))[None]
    while order.shape[1] > 1:
        groups = points[order]
        axis = np.ptp(groups, axis=1).argmax(1)
        along = np.take_along_axis(groups, axis[:, None, None], 2)[..., 0]
        order = np.take_along_axis(order, np.argsort(along, axis=1, kind="stable"), 1)
        order = order.reshape(-1, order.shape[1] // 2)
    return order.ravel()


def _fill(nodes: np.ndarray, low: np.ndarray, high: np.ndarray, intensity: np.ndarray) -> None:
    """Boxes and intensities of the leaves, and of all nodes above them."""
    while True:
        n = len(intensity)
        level, is_full = nodes[n:2 * n], intensity > 0
        level["low"][is_full], level["high"][is_full], level["intensity"] = low[is_full], high[is_full], intensity
        if n == 1:
            return
        low, high = low.reshape(-1, 2, 3).min(1), high.reshape(-1, 2, 3).max(1)
        intensity = intensity.reshape(-1, 2).sum(1)
