# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays against every triangle, in double precision: slow, and plain to see that it is right."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from svo_engine.scene.types import Scene
from tests.tracing import Hits

# Of the coordinates: of rays brought into object space (4 products and sums, and 3 for the direction), and of the
# triangle test (corner minus origin, the shear and its products), each within 2^-24: 16 in all
ROUNDING = 16 * 2.0**-24

_RAYS = 256  # at a time


@dataclass(frozen=True)
class Soup:
    """All triangles of a scene. corners (n, 3, 3) f8, metres relative to its centre; instance, triangle: as in Hit.

    error  (n,) metres by which single precision may displace a triangle, for coordinates of 1 m
    """

    corners: np.ndarray
    instance: np.ndarray
    triangle: np.ndarray
    error: np.ndarray


def soup_of(scene: Scene) -> Soup:
    """The triangles of `scene`, instances in the order in which the device has them."""
    low, high = scene.bounds()
    inst = scene.instances
    order = np.argsort(inst.mesh, kind="stable")
    firsts = np.cumsum([0] + [len(mesh.triangles) for mesh in scene.meshes])
    corners, instance, triangle, error = [], [], [], []
    for number, i in enumerate(order):
        mesh, m = scene.meshes[inst.mesh[i]], inst.world_from_object[i]
        n = len(mesh.triangles)
        positions = mesh.positions.astype("f8") @ m[:3, :3].T + m[:3, 3] - (low + high) / 2
        corners.append(positions[mesh.triangles])
        instance.append(np.full(n, number))
        triangle.append(firsts[inst.mesh[i]] + np.arange(n))
        error.append(np.full(n, ROUNDING * np.linalg.cond(m[:3, :3])))
    return Soup(*(np.concatenate(part) for part in (corners, instance, triangle, error)))


def disagreements(soup: Soup, o: np.ndarray, d: np.ndarray, hits: Hits) -> list[str]:
    """What is wrong with `hits` of the rays (n, 3), one sentence for each ray of which it is wrong.

    A triangle may be taken for displaced by the error of single precision. Rays that pass its edges closer than that
    may hit or miss, hits that close to each other may come in any order, and a ray in the plane of a triangle may do as
    it likes with it; nothing else is allowed.
    """
    found = []
    o, d = o.astype("f4").astype("f8"), d.astype("f4").astype("f8")
    for first in range(0, len(o), _RAYS):
        part = slice(first, first + _RAYS)
        found += [f"ray {first + ray}: {sentence}" for ray, sentence in _of_rays(
            soup, o[part], d[part], hits.t[part], hits.instance[part], hits.triangle[part], hits.is_hit[part])]
    return found


def _of_rays(soup: Soup, o: np.ndarray, d: np.ndarray, t: np.ndarray, instance: np.ndarray, triangle: np.ndarray,
             is_hit: np.ndarray) -> list[tuple[int, str]]:
    t_exact, inside, slack, t_slack = _meet(soup, o, d)  # not numbers for a ray in the plane of a triangle
    with np.errstate(invalid="ignore"):
        certain = (inside > slack) & (t_exact > t_slack)
        nearest = np.where(certain, t_exact + t_slack, np.inf).min(1)
        own = (soup.instance == instance[:, None]) & (soup.triangle == triangle[:, None])
        agrees = (own & ~(inside < -slack) & ~(np.abs(t_exact - t[:, None]) > t_slack)).any(1)
    wrong = ((is_hit & ~agrees, "no such hit"), (is_hit & (t > nearest), "a nearer one was missed"),
             (~is_hit & np.isfinite(nearest), "missed"))
    return [(int(ray), sentence) for mask, sentence in wrong for ray in np.flatnonzero(mask)]


def _meet(soup: Soup, o: np.ndarray, d: np.ndarray) -> tuple[np.ndarray, ...]:
    """Each ray with each plane [Moeller97]: t, the smallest of the three barycentrics, and the error of both."""
    a, ab, ac = soup.corners[:, 0], soup.corners[:, 1] - soup.corners[:, 0], soup.corners[:, 2] - soup.corners[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        p = np.cross(d[:, None], ac)
        det = (p * ab).sum(2)
        s = o[:, None] - a
        u = (p * s).sum(2) / det
        q = np.cross(s, ab)
        v = (q * d[:, None]).sum(2) / det
        t = (q * ac).sum(2) / det
        area = np.linalg.norm(np.cross(ab, ac), axis=1)
        longest = np.linalg.norm([ab, ac, ac - ab], axis=2).max(0)
        length = np.linalg.norm(d, axis=1)[:, None]
        cosine = np.abs(det) / area / length
        reach = np.abs(o).max(1)[:, None] + np.abs(soup.corners).max()
        error = soup.error * reach / cosine  # along the plane, and along the ray
        return t, np.minimum(np.minimum(u, v), 1 - u - v), error * longest / area, error / length
