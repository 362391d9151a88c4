# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures that are computed, beside Cycles; at parameters that no one should set; and what of them is compiled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.nodes.signatures import SHADER_DIR
from svo_engine.scene.graph import Node
from tests.nodes.lookups import Case, by_cycles, by_us, text_of
from tests.nodes.textures import FAMILIES, FRACTALS, HOSTILE, T, hostile


def device_of(session):
    """What calls a function of the device in the device's thread."""
    return session.opened().thread.call


def seen(session, nodes, cases):
    return [device_of(session)(lambda device, n=n, c=c: by_us(device, n, c.outputs))
            for n, c in zip(nodes, cases, strict=True)]


@pytest.mark.parametrize("family", FAMILIES)
def test_as_cycles(session, family):
    """1e-3 of the range of values, at least of 1: the project's bound. On a software renderer the worst is 5e-5, of
    noise that is moved by noise: coordinates beyond 100 have steps of 1e-5. An H100's sines make it 6.5e-4, of Gabor's
    phase."""
    pytest.importorskip("bpy", exc_type=ImportError)
    cases = list(FAMILIES[family]())
    theirs, nodes = by_cycles(cases)
    worst = {}
    for case, a, b in zip(cases, seen(session, nodes, cases), theirs, strict=True):
        span = np.maximum(np.ptp(b, axis=(1, 2)), 1.0)
        worst[case.name] = (np.abs(a - b).max((1, 2)) / span).max()
        assert np.ptp(b[0]) > 0 or case.inputs.get("Distortion") == 0.0, f"Cycles' card is of one colour: {case.name}"
    print(*(f"{error:.1e}  {name}" for name, error in sorted(worst.items(), key=lambda pair: -pair[1])), sep="\n")
    assert {name: error for name, error in worst.items() if not error <= 1e-3} == {}


def test_places_and_colours_of_cells_are_those_of_cycles_to_the_bit(session):
    """White noise is often drawn of them. Other devices divide less exactly."""
    pytest.importorskip("bpy", exc_type=ImportError)
    if "llvmpipe" not in session.device_info()["renderer"]:
        pytest.skip("no software renderer")
    cases = [Case(f"{T}Voronoi", ("Position", "Color"), {"feature": f}, {"Scale": 1.3}) for f in ("F1", "F2")]
    theirs, nodes = by_cycles(cases)
    assert all(np.array_equal(a, b) for a, b in zip(seen(session, nodes, cases), theirs, strict=True))


def plain(kind, inputs=(), **settings):
    return Node(f"{T}{kind}", settings, dict(inputs))


@pytest.mark.parametrize("value", HOSTILE)
def test_hostile_numbers_give_numbers(session, value):
    """Each number in one input after the other, and in all of a noise's at once."""
    cases = list(hostile(value))
    nodes = [Node(case.kind, case.settings, case.inputs) for case in cases]
    found = zip(cases, seen(session, nodes, cases), strict=True)
    assert [case.name for case, got in found if not np.isfinite(got).all()] == []


@pytest.mark.parametrize("kind", FRACTALS)
@pytest.mark.parametrize("dimensions", ["1D", "3D"])
def test_musgrave_is_noise(session, kind, dimensions):
    """The noise that Blender 4.1 makes of it: an octave less, lacunarity to the power of minus the dimension."""
    old = {"Scale": 1.3, "Detail": 3.6, "Dimension": 0.8, "Lacunarity": 2.2, "Offset": 0.7, "Gain": 1.5}
    new = {**old, "Detail": 2.6, "Roughness": 2.2 ** -0.8}
    nodes = [plain("Musgrave", old, musgrave_type=kind, musgrave_dimensions=dimensions),
             plain("Noise", new, noise_type=kind, noise_dimensions=dimensions, normalize=False)]
    ours, theirs = seen(session, nodes, [Case("", ("Fac",))] * 2)
    assert np.abs(ours - theirs).max() < 1e-5


def test_less_than_an_octave_of_musgrave_is_part_of_it(session):
    """Of a sum that share of its first octave, of a product that share of it around 1."""
    for kind, without in (("FBM", 0.0), ("MULTIFRACTAL", 1.0)):
        part, one = (plain("Musgrave", {"Scale": 1.3, "Detail": d, "Lacunarity": 2.0}, musgrave_type=kind)
                     for d in (0.25, 1.0))
        ours, whole = seen(session, [part, one], [Case("", ("Fac",))] * 2)
        assert np.allclose(ours, without + 0.25 * (whole - without), atol=1e-6)


def test_unlinked_textures_look_at_generated_coordinates(session):
    """Through a whole frame. White noise has no such coordinates: it is of one colour."""
    pytest.importorskip("bpy", exc_type=ImportError)
    from tests.nodes import cards

    def unlinked(kind, name, **inputs):
        def make(nodes):
            return next(o for o in nodes.new(f"Tex{kind}", **inputs).outputs if o.identifier == name)
        return make

    makers = [unlinked("Checker", "Color", Scale=2.0), unlinked("Noise", "Fac", Scale=1.0),
              unlinked("WhiteNoise", "Color"), unlinked("Voronoi", "Distance", Scale=1.0),
              unlinked("Wave", "Fac", Scale=0.3),
              unlinked("Gabor", "Value", Scale=1.0, Frequency=0.5), unlinked("Brick", "Color", Scale=2.0)]
    ours, _, errors = cards.compare(session, makers)
    assert errors.max() < 1e-3
    assert np.ptp(ours[2], axis=(0, 1)).max() < 1e-6


def test_edits_of_values_keep_the_text():
    """What artists turn belongs to the values."""
    for kind, name in (("Noise", "Scale"), ("Voronoi", "Randomness"), ("Wave", "Distortion"), ("Brick", "Bias")):
        texts = {text_of(plain(kind, {name: x}), ("Fac" if kind != "Voronoi" else "Distance",))[0] for x in (0.0, 0.7)}
        assert len(texts) == 1
    rows = {text_of(plain("Brick", offset=x, offset_frequency=n), ("Fac",))[0] for x, n in ((0.0, 1), (0.3, 3))}
    assert len(rows) == 1


def test_a_texture_brings_its_own_files_alone():
    """A program compiles no other texture."""
    def files(node, output):
        return {line.split('"')[1] for line in text_of(node, (output,))[0].splitlines() if line.startswith("#include")}

    assert files(plain("Checker"), "Fac") <= {"nodes/patterns.glsl", "nodes/convert.glsl"}
    assert files(plain("Noise"), "Fac") <= {"nodes/noise.glsl", "nodes/noise_fbm.glsl", "nodes/convert.glsl"}
    edge = files(plain("Voronoi", feature="DISTANCE_TO_EDGE"), "Distance")
    assert edge <= {"nodes/voronoi_edge.glsl", "nodes/texture_space.glsl", "nodes/convert.glsl"}
    assert all((SHADER_DIR / file).exists() for file in edge)


def test_a_noise_of_which_both_outputs_count_is_made_once():
    """Its number is the red of its colour."""
    text = text_of(plain("Noise"), ("Fac", "Color"))[0]
    assert "noise_fbm_color(" in text
    assert "noise_fbm(" not in text


def test_a_point_density_is_told_and_empty():
    told = []
    text_of(replace(plain("PointDensity"), name="Dust"), ("Density",), told.append)
    assert len(told) == 1 and "Dust" in told[0]
