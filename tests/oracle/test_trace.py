# SPDX-License-Identifier: GPL-3.0-or-later
"""bind/trace.glsl against brute force: every ray hits what it must, at the right distance, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.scene.meshes import make_mesh
from svo_engine.scene.types import Material, Mesh, Scene
from tests import scenes
from tests.oracle.slow_rays import disagreements, soup_of
from tests.scenes import Thing, moved
from tests.tracing import traced


def directions(rng: np.random.Generator, n: int) -> np.ndarray:
    d = rng.normal(size=(n, 3))
    return d / np.linalg.norm(d, axis=1, keepdims=True)


def soup(n: int, smallest: float, largest: float, seed: int = 0) -> Mesh:
    """Random triangles in a cube of 2 m, their sizes spread over orders of magnitude."""
    rng = np.random.default_rng(seed)
    size = np.exp(rng.uniform(np.log(smallest), np.log(largest), (n, 1, 1)))
    corners = rng.uniform(-1, 1, (n, 1, 3)) + size * rng.normal(size=(n, 3, 3))
    return make_mesh("Soup", corners.reshape(-1, 3), np.arange(3 * n).reshape(-1, 3))[0]


def turned(scale: tuple[float, float, float], seed: int) -> np.ndarray:
    """A rotation after a scaling, (4, 4); a negative factor mirrors."""
    m = moved(*np.random.default_rng(seed).uniform(-2, 2, 3))
    m[:3, :3] = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0] * scale
    return m


SCENES = {
    "cornell": scenes.cornell(),
    "soup": scenes.scene(Thing(soup(400, 0.02, 0.5))),
    "huge and tiny": scenes.scene(Thing(soup(300, 1e-4, 1e2))),
    "one triangle": scenes.scene(Thing(soup(1, 1, 1))),
    "instances": scenes.scene(Thing(soup(40, 0.1, 0.6), places=tuple(turned((1, 1, 1), i) for i in range(12)))),
    "mirrored and stretched": scenes.scene(
        Thing(soup(60, 0.1, 0.6), places=(turned((-1, 1, 1), 0), turned((2, 0.3, 5), 1), turned((-1, -0.1, -3), 2)))),
    "far from the origin": scenes.scene(Thing(soup(200, 0.05, 0.5), places=(moved(1e6, -2e6, 3e6),))),
}


@pytest.mark.parametrize("name", SCENES)
def test_random_rays(device, name):
    """From anywhere in and around the scene, anywhere; d is not a unit vector."""
    rng = np.random.default_rng(7)
    soup = soup_of(SCENES[name])
    half = np.abs(soup.corners).max((0, 1))
    o = rng.uniform(-1.5, 1.5, (3000, 3)) * half
    aimed = soup.corners[rng.integers(len(soup.corners), size=1500)].mean(1) - o[:1500]
    d = np.concatenate([aimed, directions(rng, 1500) * np.exp(rng.uniform(-3, 3, (1500, 1)))])
    with traced(device, SCENES[name]) as rays:
        hits = rays.closest(o, d)
        assert disagreements(soup, o, d, hits) == []
        assert hits.is_hit[:1500].mean() > 0.9
        t_max = rng.uniform(0, 2, len(o)).astype("f4") * np.where(hits.is_hit, hits.t, 1)
        assert (rays.any(o, d) == hits.is_hit).all()
        assert (rays.any(o, d, t_max) == (hits.is_hit & (hits.t < t_max))).all()


@pytest.mark.parametrize("name", SCENES)
def test_adversarial_rays(device, name):
    """Through corners and edges, along axes, along faces and in their planes, grazing, from far away."""
    rng = np.random.default_rng(8)
    soup = soup_of(SCENES[name])
    some = soup.corners[rng.integers(len(soup.corners), size=400)]
    corner, edge, middle = some[:, 0], some[:, 1] - some[:, 0], some.mean(1)
    side, axes = np.abs(soup.corners).max(), np.eye(3)[rng.integers(3, size=400)] * rng.choice([-1, 1], (400, 1))
    away = directions(rng, 400)
    pairs = [
        (corner + away, -away), (some[:, 0] + edge / 2 + away, -away),
        (corner - 2 * side * axes, axes), (middle - 2 * side * axes, axes), (corner, axes), (middle, axes),
        (corner - edge, edge), (middle - 3 * edge, edge), (middle - edge + 1e-7 * side * away, edge),
        (middle + 1e4 * side * away, -away), (middle, away), (corner, some[:, 2] - corner)]
    o, d = (np.concatenate(part) for part in zip(*pairs, strict=True))
    with traced(device, SCENES[name]) as rays:
        hits = rays.closest(o, d)
        assert disagreements(soup, o, d, hits) == []
        assert (rays.any(o, d) == hits.is_hit).all()


def welded(mesh: Mesh) -> Mesh:
    """Without the cracks of 1e-16 m where angles of 0 and of a full turn give different numbers."""
    return make_mesh(mesh.name, mesh.positions.astype("f8").round(6) + 0.0, mesh.triangles)[0]


@pytest.mark.parametrize("mesh", [welded(scenes.sphere("Sphere", n=24)), scenes.box("Box", (-1, -1, -1), (1, 1, 1))],
                         ids=["sphere", "box"])
@pytest.mark.parametrize("place", [np.eye(4), turned((0.3, -2, 1), 5)], ids=["as it is", "turned and mirrored"])
def test_nothing_leaks(device, mesh, place):
    """100,000 rays inside a closed mesh, half of them exactly at corners and edges, axes among them: all hit."""
    rng = np.random.default_rng(9)
    scene = scenes.scene(Thing(mesh, places=(place,)))
    points = soup_of(scene).corners
    o = points.mean(0).mean(0) + rng.uniform(-0.05, 0.05, (100_000, 3)) * np.abs(points).max((0, 1))
    o[:50] = points.mean(0).mean(0)
    d = directions(rng, len(o))
    d[:6] = np.concatenate([np.eye(3), -np.eye(3)])
    corner = points[rng.integers(len(points), size=50_000)]
    along = np.where(rng.random((50_000, 1)) < 0.5, 0.0, rng.random((50_000, 1)))
    d[50_000:] = corner[:, 0] + along * (corner[:, 1] - corner[:, 0]) - o[50_000:]
    with traced(device, scene) as rays:
        assert rays.closest(o, d).is_hit.all()
        assert rays.any(o, d).all()


def test_rays_in_faces_of_boxes(device):
    """A grid of flat squares whose boxes have no thickness, and rays that run in the planes of box faces."""
    scene = scenes.scene(Thing(scenes.floor(2.0, 8)), Thing(scenes.quad("Wall", (1, -1, -1), (0, 2, 0), (0, 0, 2), 8)))
    steps = np.linspace(-1, 1, 9)
    x, y = (a.ravel() for a in np.meshgrid(steps, steps[1:-1]))
    with traced(device, scene) as rays:
        centre = rays.gpu_scene.centre_ws
        down = np.stack([x, y, np.full(len(x), 0.5)], 1) - centre
        assert rays.closest(down, np.broadcast_to([0, 0, -1.0], down.shape)).is_hit.all()
        across = np.stack([np.full(len(x), -3.0), y, 0.99 * x], 1) - centre
        hits = rays.closest(across, np.broadcast_to([1.0, 0, 0], across.shape))
        assert hits.is_hit.all()
        assert np.abs(hits.t[0.99 * x != 0] - 4).max() < 1e-5


def test_barycentrics_give_the_place(device):
    """The point at t on the ray is the point at the barycentrics in the triangle; those come back in 16 bits."""
    rng = np.random.default_rng(10)
    soup = soup_of(SCENES["mirrored and stretched"])
    o = rng.uniform(-2, 2, (2000, 3)).astype("f4")
    d = directions(rng, 2000).astype("f4")
    with traced(device, SCENES["mirrored and stretched"]) as rays:
        hits = rays.closest(o, d)
    o, d, is_hit = o.astype("f8")[hits.is_hit], d.astype("f8")[hits.is_hit], hits.is_hit
    row = np.lexsort((soup.triangle, soup.instance))
    key = soup.instance[row] * 1000 + soup.triangle[row]
    corners = soup.corners[row[np.searchsorted(key, hits.instance[is_hit] * 1000 + hits.triangle[is_hit])]]
    u, v = hits.bary[is_hit].T[..., None]
    size = np.abs(corners - corners[:, :1]).max((1, 2))
    off = np.abs(o + hits.t[is_hit, None] * d - (corners[:, 0] * (1 - u - v) + corners[:, 1] * u + corners[:, 2] * v))
    assert is_hit.sum() > 300
    assert (off.max(1) < 2 * size / 65535 + 1e-4).all()


def test_rays_leave_the_surface_that_they_start_from(device):
    """Offset origins on a slanted plane: nothing is hit on either side, however far off or large the plane is."""
    rng = np.random.default_rng(11)
    prelude = """
    bool meets_itself(uint triangle, vec2 bary, vec3 d)
    {
        Surface s = seen_at(0u, triangle, bary, d).surface;
        return meets_any(offset_origin(s.position, s.normal_geometric, d), d, 1e30, 0u);
    }
    """
    for size, shift in ((1e-2, 0.0), (1.0, 0.0), (1e4, 0.0), (1.0, 50.0)):
        things = [Thing(scenes.floor(2 * size, 4), places=(turned((1, 1, 1), 3) @ moved(shift, shift, shift),))]
        if shift:  # a far thing, so that the plane is away from the centre
            things.append(Thing(scenes.box("Block", (-60, -60, -60), (-59, -59, -59))))
        with traced(device, scenes.scene(*things)) as rays:
            bary = rng.random((5000, 2))
            bary = np.where(bary.sum(1, keepdims=True) > 1, 1 - bary, bary)
            triangle = rng.integers(32, size=5000).astype("u4")
            d = directions(rng, 5000)
            found = rays.call("bool", "meets_itself(triangle, bary, d)", prelude, triangle=triangle, bary=bary, d=d)
            near = rays.closest(*(np.zeros((1, 3)), np.ones((1, 3))))
            assert near.t.shape == (1,)
            assert found.mean() < (0.02 if shift else 1e-9)  # the block lies in the way of a few


def cut_out(alpha: float) -> Scene:
    """A half transparent square below an opaque one."""
    return scenes.scene(Thing(scenes.floor(2.0), Material("Leaf", alpha=alpha)),
                        Thing(scenes.floor(2.0), places=(moved(z=1.0),)))


def test_alpha_lets_its_share_through(device):
    """Of 4,000 seeds a share within four standard deviations; closest and any hits decide alike."""
    n, alpha = 4000, 0.3
    o, d = np.tile([0.3, 0.1, -2.0], (n, 1)), np.tile([0, 0, 1.0], (n, 1))
    seeds = np.arange(n, dtype="u4")
    with traced(device, cut_out(alpha)) as rays:
        words = rays.call("uvec4", "closest(o, d, 1e30, seed)", o=o, d=d, seed=seeds)
        blocked = rays.call("bool", "meets_any(o, d, 2.0, seed)", o=o, d=d, seed=seeds) != 0
    t = words[:, 0].copy().view("f4")
    assert (words[:, 1] != 0xFFFFFFFF).all()
    assert abs((t < 2).mean() - alpha) < 4 * np.sqrt(alpha * (1 - alpha) / n)
    assert (blocked == (t < 2)).all()
    for opaque, share in ((1.0, 1.0), (0.0, 0.0)):
        with traced(device, cut_out(opaque)) as rays:
            assert (rays.closest(o, d).t < 2).mean() == share


def test_a_squeezed_instance_is_still_there(device):
    """It has no inverse. A sphere scaled to nothing along z is a disk; one scaled to a point is gone."""
    flat, point = np.diag([1.0, 1, 0, 1]), np.diag([0.0, 0, 0, 1])
    o, d = np.array([[0.5, 0.1, 3], [0.5, 0.1, -3], [1.2, 0, 3]]), np.array([[0, 0, -1.0], [0, 0, 1], [0, 0, -1]])
    with traced(device, scenes.scene(Thing(scenes.sphere("Sphere"), places=(flat, point)))) as rays:
        hits = rays.closest(o, d)
    assert hits.is_hit.tolist() == [True, True, False]
    assert np.abs(hits.t[:2] - 3).max() < 2e-5  # its thickness


def test_nothing_to_hit(device):
    """An empty scene, a mesh without triangles, rays that are not numbers: no hits, and an end."""
    empty = make_mesh("Empty", np.zeros((0, 3)), np.zeros((0, 3), "u4"))[0]
    o, d = np.zeros((8, 3)), np.ones((8, 3))
    for scene in (Scene(), scenes.scene(Thing(empty)), scenes.scene(Thing(empty), Thing(scenes.floor(), places=()))):
        with traced(device, scene) as rays:
            assert not rays.closest(o, d).is_hit.any()
            assert not rays.any(o, d).any()
    d[0], d[1], o[2], o[3] = 0, np.nan, np.nan, np.inf
    with traced(device, SCENES["cornell"]) as rays:
        assert not rays.closest(o[:4], d[:4]).is_hit.any()
