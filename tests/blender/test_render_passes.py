# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes beside those of Cycles: their names, their channels, and what stands in them."""

from __future__ import annotations

from dataclasses import fields
from functools import partial
from types import SimpleNamespace

import bpy
import numpy as np
import OpenEXR
import pytest

from svo_engine.blender import view_layer_panels
from svo_engine.blender.render_passes import SWITCHES, ask_for, blender_name, lines_of, list_passes, passes_of
from svo_engine.settings import PASSES, Lines
from tests.blender import build

SIZE = 48, 36
NAMES = {blender_name(name): name for name in ("Combined", *PASSES)}
EDGES = 0.06  # of all pixels are those in which an object ends: the engines place samples differently there


@pytest.fixture
def scene(empty, extension, tmp_path):
    """A floor, a metal that leans, something that glows, a lamp and a sky, seen from the side; all passes asked for."""
    build.plane(principled(Base_Color=(0.6, 0.3, 0.2, 1)), size=4.0)
    metal = principled(Base_Color=(0.9, 0.7, 0.3, 1), Metallic=1.0, Roughness=0.3)
    build.plane(metal, name="Metal", size=1.0, at=(1, 0, 1), turn=(0.3, 0, 0))
    build.plane(principled(Base_Color=(0.5, 0.5, 0.5, 1), Emission_Color=(1, 0.5, 0.2, 1), Emission_Strength=3.0),
                name="Glow", size=1.0, at=(-1, 0.5, 1))
    build.lamp("POINT", (1, -1, 3), energy=100, shadow_soft_size=0)
    world = build.world()
    world.show(world.new("Background", Color=(0.2, 0.4, 0.8, 1)))
    camera = build.place(bpy.data.cameras.new("Camera"), "Camera", (0.3, -7, 3.2), (1.25, 0, 0))
    empty.camera = camera
    render = empty.render
    (render.resolution_x, render.resolution_y), render.resolution_percentage = SIZE, 100
    render.use_compositing = False
    if "media_type" in render.image_settings.bl_rna.properties:
        render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    render.filepath = str(tmp_path / "passes.exr")
    ask_for(empty.view_layers[0], PASSES)
    return empty


def principled(**inputs):
    """A material of one Principled BSDF."""
    made = build.material()
    return made.show(made.new("BsdfPrincipled", **inputs))


def render(scene, engine):
    """{"Depth": (height, width, channels) f4, ...} of the passes that `engine` wrote, row 0 at the bottom."""
    scene.render.engine = engine
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    return read(scene.render.filepath)


def read(path):
    planes: dict[str, dict[str, np.ndarray]] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            for name, channel in part.channels.items():
                *_, plane, letter = name.split(".")
                if plane in NAMES:
                    planes.setdefault(NAMES[plane], {})[letter] = channel.pixels[::-1]
    return {plane: np.stack([found[letter] for letter in PASSES.get(plane, "RGBA") if letter in found], 2)
            for plane, found in planes.items()}


@pytest.fixture
def both(scene):
    """The passes of our engine, and those of Cycles at equal settings."""
    scene.svo.samples, scene.svo.cache_resolution, scene.svo.denoise = 64, "32", False
    ours = render(scene, "SVO_ENGINE")
    cycles = scene.cycles
    cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling, cycles.device = 256, False, False, "CPU"
    scene.view_layers[0].cycles.denoising_store_passes = True
    return ours, render(scene, "CYCLES")


def differing(ours, theirs, tolerance):
    """The part of the pixels that differ by more."""
    return (np.abs(ours - theirs) > tolerance * np.maximum(np.abs(theirs), 1)).any(2).mean()


def test_passes_are_those_of_cycles(both):
    ours, theirs = both
    assert ours.keys() == theirs.keys()
    for name in ("Depth", "Position", "Normal", "Diffuse Color", "Glossy Color", "Emission", "Environment",
                 "Denoising Normal", "Denoising Depth"):
        assert ours[name].shape == theirs[name].shape
    for name, tolerance in (("Depth", 1e-3), ("Position", 1e-3), ("Environment", 0.01), ("Emission", 0.02),
                            ("Normal", 0.02), ("Diffuse Color", 0.01), ("Glossy Color", 0.03)):
        assert differing(ours[name], theirs[name], tolerance) < EDGES, name
    not_metal = ours["Diffuse Color"].max(2) > 0.01  # Cycles follows reflections of smooth metals to what they show
    for name in ("Denoising Normal", "Denoising Depth"):
        assert np.median(np.abs(ours[name] - theirs[name])[not_metal]) < 0.01 * np.abs(ours[name]).max()
    # Both have noise. Indirect light is a hundredth of the rest here, and the cache holds the metal for a diffuse one
    for kind, part, tolerance in (("Diffuse", "Direct", 0.02), ("Glossy", "Direct", 0.05), ("Diffuse", "Indirect", 0.3),
                                  ("Glossy", "Indirect", 0.3)):
        lights = [(planes[f"{kind} {part}"] * planes[f"{kind} Color"]).mean() for planes in both]
        assert lights[0] == pytest.approx(lights[1], rel=tolerance), (kind, part)
    assert (ours["Depth"][-1] == 1e10).all()
    assert (theirs["Depth"][-1] == 1e10).all()
    assert total(ours) == pytest.approx(ours["Combined"][..., :3], rel=1e-4, abs=1e-5)


def total(planes):
    """What the light passes add up to."""
    lit = sum((planes[f"{kind} Direct"] + planes[f"{kind} Indirect"]) * planes[f"{kind} Color"]
              for kind in ("Diffuse", "Glossy", "Transmission"))
    return lit + planes["Emission"] + planes["Environment"]


class Recorder:
    """Notes what is registered."""

    def __init__(self):
        self.passes = []

    def register_pass(self, _scene, _layer, name, n, channels, kind):
        assert n == len(channels)
        self.passes.append((name, channels, kind))


def registered(scene):
    recorder = Recorder()
    list_passes(recorder, scene, scene.view_layers[0])
    return recorder.passes


def test_a_layer_that_asks_for_nothing_has_the_picture_alone(empty, extension):
    ask_for(empty.view_layers[0], ())
    assert registered(empty) == [("Combined", "RGBA", "COLOR")]


def test_names_and_channels_are_registered_as_cycles_does(scene):
    """Of every pass that both know, so that the compositor's sockets are the same."""
    from cycles import engine  # type: ignore[import-not-found]

    layer = scene.view_layers[0]
    layer.cycles.denoising_store_passes = True
    scene.cycles.use_denoising = layer.cycles.use_denoising = scene.svo.denoise = True
    theirs = {name: (channels, kind) for name, channels, kind in engine.list_render_passes(scene, layer)}
    ours = {name: (channels, kind) for name, channels, kind in registered(scene)}
    assert ours.keys() == set(NAMES)
    assert ours == {name: theirs[name] for name in ours}


def test_the_noisy_picture_is_a_pass_where_the_other_one_is_smoothed(scene):
    scene.svo.denoise = False
    assert set(passes_of(scene, scene.view_layers[0])) == set(PASSES) - {"Noisy Image"}


def test_passes_go_to_their_own_layer(scene):
    second = scene.view_layers.new("Second")
    ask_for(second, ("Depth",))
    assert passes_of(scene, second) == ("Depth",)
    assert len(passes_of(scene, scene.view_layers[0])) == len(PASSES)


def test_lines_are_those_that_the_layer_asks_for(scene):
    layer = scene.view_layers[0]
    assert lines_of(layer) is None
    layer.svo_lines.show, layer.svo_lines.thickness, layer.svo_lines.creases = True, 3.0, False
    assert lines_of(layer) == Lines(thickness=3.0, creases=False, crease_angle=layer.svo_lines.crease_angle)
    assert layer.svo_lines.crease_angle == pytest.approx(Lines.crease_angle, rel=1e-6)  # a float of 32 bits


def test_every_switch_stands_in_a_panel(scene):
    shown = []

    class Layout:
        def prop(self, _owner, name, **_options):
            shown.append(name)

        def __getattr__(self, _name):
            return lambda *_args, **_options: self

    context = SimpleNamespace(view_layer=scene.view_layers[0], engine="SVO_ENGINE")
    for panel in view_layer_panels._CLASSES:
        assert panel.poll(context)
        assert not panel.poll(SimpleNamespace(engine="CYCLES"))
        drawn = SimpleNamespace(layout=Layout())
        drawn.columns = partial(view_layer_panels._LayerPanel.columns, drawn)
        panel.draw(drawn, context)
    of_lines = [field.name for field in fields(Lines)]
    assert sorted(shown) == sorted(["use_pass_combined", "denoising_data", *SWITCHES.values(), *of_lines])
