# SPDX-License-Identifier: GPL-3.0-or-later
"""An atrium of two storeys of columns and arches, open to sun and sky. Few parts, many placings."""

from __future__ import annotations

from math import cos, pi, sin

from . import lights, shapes, stage

BAY, BAYS = 3.0, (6, 3)  # metres; number of arches along X and Y
HALF = (BAY * BAYS[0] / 2, BAY * BAYS[1] / 2)  # from the centre to the columns' axes
AISLE = 3.0  # from the columns' axes to the outer walls
ARCH_RADIUS, ARCH_HEIGHT, THICKNESS = 1.15, 1.75, 0.5
SHAFTS = (3.2, 2.3)  # height of a column in each storey
SLAB = 0.35
FLOORS = (0.0, SHAFTS[0] + ARCH_HEIGHT + SLAB)
EAVES = FLOORS[1] + SHAFTS[1] + ARCH_HEIGHT

Place = tuple[float, float, float]  # x, y, turn about Z


def build() -> None:
    """Sun through the open roof on one flank; behind the arches there is only light that has bounced."""
    stone = stage.material("Limestone", (0.66, 0.58, 0.45))
    for level, (floor, shaft) in enumerate(zip(FLOORS, SHAFTS, strict=True)):
        _storey(level, floor, shaft, stone)
    _shell(stone)
    _furnish(stone)
    lights.sun_lamp((0.33, 0.52, -1.0), strength=5.0, color=(1.0, 0.93, 0.82))
    lights.world_color((0.38, 0.58, 0.95), 1.0)
    stage.camera((-8.6, -1.9, 1.75), (4.0, 1.7, 3.5), lens=19.0)


def _columns() -> list[Place]:
    """The axes of one storey's columns, once around the atrium."""
    (nx, ny), (hx, hy) = BAYS, HALF
    rows = [(-hx + BAY * i, y, 0.0) for i in range(nx + 1) for y in (-hy, hy)]
    return rows + [(x, -hy + BAY * j, 0.0) for j in range(1, ny) for x in (-hx, hx)]


def _bays() -> list[Place]:
    """The middles between neighbouring columns, turned so that +Y looks out of the atrium."""
    (nx, ny), (hx, hy) = BAYS, HALF
    rows = [(-hx + BAY * (i + 0.5), y, turn) for i in range(nx) for y, turn in ((-hy, pi), (hy, 0.0))]
    return rows + [(x, -hy + BAY * (j + 0.5), turn) for j in range(ny) for x, turn in ((-hx, pi / 2), (hx, -pi / 2))]


def _storey(level: int, floor: float, shaft: float, stone: shapes.Material) -> None:
    column, arch = _column(f"Column {level}", shaft, 0.26 - 0.05 * level, stone), _arch(f"Arch {level}", stone)
    for x, y, _ in _columns():
        stage.place(column, (x, y, floor))
    for x, y, turn in _bays():
        stage.place(arch, (x, y, floor + shaft), (0.0, 0.0, turn))
    low, side = floor + shaft, THICKNESS / 2 + 0.03
    piers = [((x - side, y - side, low), (x + side, y + side, low + ARCH_HEIGHT))
             for x in (-HALF[0], HALF[0]) for y in (-HALF[1], HALF[1])]
    stage.place(shapes.boxes(f"Corners {level}", piers, stone))


def _column(name: str, height: float, radius: float, stone: shapes.Material) -> shapes.Mesh:
    """Base with two rings, a shaft that swells a little, capital; 0.62 m square slabs at its foot and its head."""
    swell = [(radius * (1.0 - 0.14 * t * t), 0.34 + t * (height - 0.8)) for t in (i / 8 for i in range(9))]
    foot = [(radius + 0.04 + 0.05 * sin(pi * i / 6), 0.12 + 0.1 * i / 6) for i in range(7)]
    ring = [(radius + 0.02 + 0.03 * sin(pi * i / 6), 0.24 + 0.08 * i / 6) for i in range(7)]
    top = radius * 0.86
    bell = [(top + 0.03, height - 0.44), (top + 0.03, height - 0.4)]
    bell += [(top + (0.31 - top) * (i / 6) ** 2, height - 0.4 + 0.28 * i / 6) for i in range(7)]
    turned = shapes.lathe(name, foot + ring + swell + bell, 32, stone)
    slabs = shapes.boxes("Slabs", [((-0.33, -0.33, 0.0), (0.33, 0.33, 0.12)),
                                   ((-0.33, -0.33, height - 0.12), (0.33, 0.33, height))])
    return shapes.joined(turned, slabs)


def _arch(name: str, stone: shapes.Material, segments: int = 32) -> shapes.Mesh:
    """The wall over one bay, `ARCH_HEIGHT` high on the capitals, a half circle cut out and moulded."""
    turns = [pi - pi * i / segments for i in range(segments + 1)]
    lower = [(-BAY / 2, 0.0), *((ARCH_RADIUS * cos(a), ARCH_RADIUS * sin(a)) for a in turns), (BAY / 2, 0.0)]
    upper = [(x, ARCH_HEIGHT) for x, _ in lower]
    wall = _extruded(name, lower, upper, THICKNESS / 2, stone)
    inner = [((ARCH_RADIUS - 0.02) * cos(a), (ARCH_RADIUS - 0.02) * sin(a)) for a in turns]
    outer = [((ARCH_RADIUS + 0.16) * cos(a), (ARCH_RADIUS + 0.16) * sin(a)) for a in turns]
    return shapes.joined(wall, _extruded("Moulding", inner, outer, THICKNESS / 2 + 0.06))


def _extruded(name: str, lower: list[tuple[float, float]], upper: list[tuple[float, float]], half: float,
              *materials: shapes.Material) -> shapes.Mesh:
    """The band between two lines in XZ, from Y = -half to half: front, back, under side and upper side."""
    n = len(lower)
    lines = ((upper, -half), (lower, -half), (lower, half), (upper, half))
    vertices = [(x, y, z) for line, y in lines for x, z in line]
    faces = [(a * n + i, b * n + i, b * n + i + 1, a * n + i + 1)
             for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)) for i in range(n - 1)]
    return shapes.mesh(name, vertices, faces, *materials)


def _shell(stone: shapes.Material) -> None:
    """Floor tiles, the slabs over both storeys, the outer walls: ochre below, white above."""
    outer = (HALF[0] + AISLE, HALF[1] + AISLE)
    light, dark = stage.material("Tile light", (0.55, 0.5, 0.42)), stage.material("Tile dark", (0.2, 0.13, 0.1))
    nx, ny = round(2 * outer[0]), round(2 * outer[1])
    stage.place(shapes.grid("Floor", nx, ny, lambda u, v: (outer[0] * (2 * u - 1), outer[1] * (2 * v - 1), 0.0),
                            light, dark, slot=lambda i, j: (i + j) % 2))
    edge = (HALF[0] - 0.4, HALF[1] - 0.4)
    plaster = (stage.material("Terracotta", (0.5, 0.2, 0.1)), stage.material("Plaster", (0.72, 0.68, 0.6)))
    for level, top in enumerate((FLOORS[1], EAVES + SLAB)):
        stage.place(_frame(f"Slab {level}", edge, (outer[0] + 0.3, outer[1] + 0.3), top - SLAB, top, stone))
        stage.place(_frame(f"Wall {level}", outer, (outer[0] + 0.3, outer[1] + 0.3), FLOORS[level], top - SLAB,
                           plaster[level]))


def _frame(name: str, inner: tuple[float, float], outer: tuple[float, float], low: float, high: float,
           material: shapes.Material) -> shapes.Mesh:
    """A rectangular ring between two half sizes: four boxes that meet without overlapping."""
    (a, b), (c, d) = inner, outer
    sides = [((-c, -d, low), (c, -b, high)), ((-c, b, low), (c, d, high)), ((-c, -b, low), (-a, b, high)),
             ((a, -b, low), (c, b, high))]
    return shapes.boxes(name, sides, material)


def _furnish(stone: shapes.Material) -> None:
    """Balustrades above, banners that colour their surroundings, a basin of water and potted trees."""
    _balustrades(stone)
    _banners()
    _basin(stone)
    _trees()


def _balustrades(stone: shapes.Material) -> None:
    """Seven balusters a bay by an Array, under a rail."""
    profile = [(0.07, 0.0), (0.07, 0.08), (0.04, 0.12), (0.085, 0.3), (0.075, 0.4), (0.035, 0.58), (0.06, 0.64),
               (0.06, 0.7)]
    baluster = shapes.lathe("Baluster", profile, 12, stone)
    rail = shapes.boxes("Rail", [((-BAY / 2, -0.11, 0.7), (BAY / 2, 0.11, 0.82))], stone)
    for x, y, turn in _bays():
        at = (x, y, FLOORS[1])
        stage.place(rail, at, (0.0, 0.0, turn))
        left = (x - 1.02 * cos(turn), y - 1.02 * sin(turn), FLOORS[1])
        stage.repeat(stage.place(baluster, left, (0.0, 0.0, turn)), 7, (0.34, 0.0, 0.0))


def _banners() -> None:
    """1.5 m wide cloths over the upper rail on the sunny side, down past the slab."""
    def point(u: float, v: float) -> shapes.Point:
        fold = 0.05 * (1 - v) * sin(9 * u) + 0.03 * sin(5 * v + 4 * u)
        return 1.5 * (u - 0.5), fold, 0.85 - 3.4 * (1 - v)

    for name, color, places in (("Red", (0.6, 0.02, 0.02), (-3.0, 3.0)), ("Blue", (0.03, 0.08, 0.5), (0.0,))):
        cloth = shapes.smooth(shapes.grid(f"Cloth {name}", 24, 48, point, stage.material(f"Cloth {name}", color)))
        for x in places:
            stage.place(cloth, (x, HALF[1] - 0.52, FLOORS[1]))


def _basin(stone: shapes.Material) -> None:
    profile = [(0.0, 0.0), (1.5, 0.0), (1.5, 0.12), (1.35, 0.16), (1.35, 0.5), (1.5, 0.56), (1.5, 0.62), (1.25, 0.62),
               (1.25, 0.3)]
    stage.place(shapes.lathe("Basin", profile, 64, stone), (1.5, 0.0, 0.0))
    water = stage.material("Water", (0.02, 0.08, 0.09), roughness=0.05, specular=0.5)
    stage.place(shapes.lathe("Water", [(1.25, 0.52), (0.0, 0.52)], 64, water), (1.5, 0.0, 0.0))
    bronze = stage.material("Bronze", (0.55, 0.33, 0.16), roughness=0.35, specular=0.5, metallic=1.0)
    stage.place(shapes.lathe("Stem", [(0.2, 0.5), (0.1, 0.7), (0.08, 1.1), (0.5, 1.3), (0.55, 1.36), (0.0, 1.3)], 48,
                             bronze), (1.5, 0.0, 0.0))
    stage.place(shapes.sphere("Globe", 0.24, bronze), (1.5, 0.0, 1.52))


def _trees() -> None:
    """Clipped trees in terracotta pots before every second column."""
    profile = [(0.0, 0.0), (0.2, 0.0), (0.3, 0.42), (0.34, 0.42), (0.34, 0.5), (0.28, 0.5), (0.27, 0.44), (0.0, 0.44)]
    pot = shapes.lathe("Pot", profile, 32, stage.material("Clay", (0.5, 0.19, 0.09)))
    leaf = stage.material("Leaves", (0.07, 0.2, 0.04))
    crown = shapes.joined(shapes.lathe("Tree", [(0.04, 0.4), (0.04, 0.9)], 12, leaf),
                          shapes.sphere("Crown", 0.42, segments=24), lift=1.2)
    for x in (-6.0, 0.0, 6.0):
        for y in (-HALF[1] + 0.85, HALF[1] - 0.85):
            stage.place(pot, (x, y, 0.0))
            stage.place(crown, (x, y, 0.0))
