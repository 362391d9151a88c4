# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of shaders/nodes and their twins on the host: the same numbers, and finite ones, for any input."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import numpy as np
import pytest

from svo_engine.nodes.signatures import Signature, library
from svo_engine.nodes.twins import TWINS
from tests.compute import evaluate

N_PLAIN, N_HOSTILE, MOST_ARGUMENTS = 200, 200, 6
HOSTILE = np.array([0, -0.0, 1, -1, 0.5, 2, -2, 3, 1e-6, -1e-6, 1e-20, 1e20, -1e20, 3e38, -3e38, 1e5, 88, -100], "f4")


def by_file() -> dict[str, list[Signature]]:
    known = sorted((s for name, s in library().items() if name in TWINS and not name.endswith("_of_weights")),
                   key=lambda s: s.file)  # weights are from 0 to 1
    return {file: list(found) for file, found in groupby(known, key=lambda s: s.file)}


def inputs(seed: int) -> np.ndarray:
    """(rows, MOST_ARGUMENTS, 3) f4: what is usual, half of it on halves where functions jump, and what is hostile."""
    random = np.random.default_rng(seed)
    plain = random.uniform(-3, 3, (N_PLAIN, MOST_ARGUMENTS, 3))
    plain[::3] = np.abs(plain[::3]) / 3
    plain[::4] = np.round(plain[::4] * 2) / 2
    hostile = random.choice(HOSTILE, (N_HOSTILE, MOST_ARGUMENTS, 3))
    return np.concatenate([plain, hostile]).astype("f4")


def calls(functions: list[Signature]) -> str:
    """GLSL: the function of each number, called with the first parts of what are vec3."""
    lines = []
    for i, f in enumerate(functions):
        given = ", ".join(f"a{k}{'' if type_ == 'vec3' else '.x'}" for k, type_ in enumerate(f.arguments))
        rest = ", 0.0, 0.0" if f.type == "float" else ""
        lines.append(f"    if (f == {i}u)\n        made = vec3({f.name}({given}){rest});")
    heads = ", ".join(f"vec3 a{k}" for k in range(MOST_ARGUMENTS))
    body = ["    vec3 made = vec3(0.0);", *lines, "    return made;"]
    return "\n".join([f"vec3 called(uint f, {heads})", "{", *body, "}"])


def of_host(f: Signature, rows: np.ndarray) -> np.ndarray:
    """(rows, 3) f4, as the twin has it."""
    is_vector = [type_ == "vec3" for type_ in f.arguments]
    given = ([tuple(map(float, row[k])) if is_vector[k] else float(row[k, 0]) for k in range(len(is_vector))]
             for row in rows)
    made = np.array([TWINS[f.name](*row) for row in given], "f4").reshape(len(rows), -1)
    return np.pad(made, ((0, 0), (0, 3 - made.shape[1])))


def perturbed(rows: np.ndarray) -> Iterator[np.ndarray]:
    """The rows with each argument a few roundings larger and smaller."""
    for k in range(MOST_ARGUMENTS):
        for by in (-2e-6, 2e-6):
            other = rows.copy()
            other[:, k] += np.maximum(np.abs(other[:, k]), 0.1) * by
            yield np.clip(other, -3.4e38, 3.4e38).astype("f4")


def outside(values: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """(rows,) whether a value lies outside, beyond what rounding explains: built-in functions are right to 1e-5."""
    with np.errstate(over="ignore"):
        room = 2e-5 * np.maximum(np.maximum(np.abs(low), np.abs(high)), 1)
        return ((values < low - room) | (values > high + room)).any(1)


@pytest.mark.parametrize("file", by_file())
def test_host_and_shader_compute_alike(device, file):
    """Within what a few roundings of the arguments change, which at jumps is the whole jump. Where arguments are so
    large that sums of them overflow, or sines mean nothing, both are finite and no more."""
    functions = by_file()[file]
    sets = [inputs(i) for i in range(len(functions))]
    rows = np.concatenate(sets)
    number = np.repeat(np.arange(len(functions), dtype="u4"), len(sets[0]))
    names = [f"a{k}" for k in range(MOST_ARGUMENTS)]
    made = evaluate(device, "vec3", f"called(f, {', '.join(names)})", (file,), calls(functions), f=number,
                    **{name: rows[:, k] for k, name in enumerate(names)})
    assert np.isfinite(made).all(), {functions[i].name for i in number[~np.isfinite(made).all(1)]}
    for i, f in enumerate(functions):
        of_twin, part = of_host(f, sets[i]), made[number == i]
        assert np.isfinite(of_twin).all(), f.name
        is_small = (np.abs(sets[i][:, :len(f.arguments)]) < 1e6).all((1, 2))
        doubtful = outside(part, of_twin, of_twin) & is_small
        if doubtful.any():
            given = sets[i][doubtful]
            near = [of_host(f, other) for other in (given, *perturbed(given))]
            bad = outside(part[doubtful], np.min(near, 0), np.max(near, 0))
            assert not bad.any(), (f.name, given[bad][0], near[0][bad][0], part[doubtful][bad][0])
