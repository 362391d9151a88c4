# SPDX-License-Identifier: GPL-3.0-or-later
"""Every setting is a property with the Spec's default, range and unit, and stands in just one of our panels."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from svo_engine.blender import material_panels, panels, told
from svo_engine.blender.properties import defaults, settings_of
from svo_engine.settings import RenderSettings, specs


@pytest.fixture
def scene(empty, extension):
    empty.render.engine = extension.engine.SVORenderEngine.bl_idname
    return empty


class Layout:
    """Notes which properties and operators a panel shows, and which of them it greys out."""

    def __init__(self):
        self.shown, self.grey, self.active = [], set(), True

    def prop(self, _owner, name, **_options):
        self.shown.append(name)
        if not self.active:
            self.grey.add(name)

    def operator(self, name, **_options):
        self.shown.append(name)

    def label(self, text, icon):
        self.shown.append((text, icon))

    def __getattr__(self, _name):
        return lambda *_args, **_options: self


def context_of(scene, engine="SVO_ENGINE", kind_of_light="AREA"):
    return SimpleNamespace(scene=scene, engine=engine, light=SimpleNamespace(type=kind_of_light),
                           material=SimpleNamespace(name="Wood"), region=SimpleNamespace(width=300),
                           preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
                           space_data=SimpleNamespace(shading=SimpleNamespace(type="RENDERED")))


def shown_by(panel, context):
    """What `panel` shows, header and all; nothing if its poll says so."""
    return drawn_by(panel, context).shown


def drawn_by(panel, context):
    """The Layout after `panel` has drawn itself."""
    layout = Layout()
    if panel.poll(context):
        drawn = SimpleNamespace(layout=layout, column=lambda **_options: layout, group=getattr(panel, "group", ""),
                                prefix=getattr(panel, "prefix", ""))
        for draw in (getattr(panel, "draw_header", None), panel.draw):
            if draw:
                draw(drawn, context)
    return layout


@pytest.mark.parametrize("name", specs())
def test_property_is_what_its_spec_says(scene, name):
    spec, default, prop = specs()[name], defaults()[name], scene.svo.bl_rna.properties[name]
    assert (prop.name, prop.is_animatable) == (spec.label, True)
    assert prop.description.startswith(spec.description)
    assert prop.default == (default if not isinstance(default, float) else pytest.approx(default, rel=1e-7))
    if spec.choices:
        assert [(item.identifier, item.name, item.description) for item in prop.enum_items] == list(spec.choices)
    elif spec.low is not None:
        assert (prop.hard_min, prop.hard_max) == (pytest.approx(spec.low, rel=1e-7), pytest.approx(spec.high, rel=1e-7))
    if spec.unit == "rad":
        assert (prop.subtype, prop.unit) == ("ANGLE", "ROTATION")
    elif spec.unit == "px":
        assert prop.subtype == "PIXEL"
    elif spec.unit == "s":
        assert prop.unit == "TIME_ABSOLUTE"
    elif spec.unit:
        assert spec.unit in prop.description


def test_untouched_scene_has_the_default_settings(scene):
    assert settings_of(scene) == RenderSettings()


def test_settings_follow_the_properties(scene):
    scene.svo.samples, scene.svo.specular_cone, scene.svo.resolution, scene.svo.cone_step = 5, False, "32", 0.3
    expected = replace(RenderSettings(), samples=5, specular_cone=False, resolution="32", cone_step=0.3)
    assert settings_of(scene) == expected


@pytest.mark.parametrize("limit", ["low", "high"])
def test_limits_are_reached_in_spite_of_32_bits(scene, limit):
    numbers = [name for name, spec in specs().items() if spec.low is not None]
    for name in numbers:
        setattr(scene.svo, name, getattr(specs()[name], limit))
    settings = settings_of(scene)  # would raise if 0.01 came back as 0.0099999998
    assert [getattr(settings, name) for name in numbers] == [getattr(specs()[name], limit) for name in numbers]


def test_each_setting_stands_in_one_panel(scene):
    shown = []
    for method, _, _ in specs()["method"].choices:
        scene.svo.method = method
        names = [name for panel in panels._CLASSES for name in shown_by(panel, context_of(scene)) if name in specs()]
        assert len(names) == len(set(names))
        shown += names
    assert set(shown) == set(specs())


def test_only_the_settings_of_the_method_are_shown(scene):
    scene.svo.method = "rays"
    assert shown_by(panels.SVO_PT_cones, context_of(scene)) == []
    assert shown_by(panels.SVO_PT_voxel_grid, context_of(scene)) == []
    scene.svo.view = "voxel_albedo"
    assert shown_by(panels.SVO_PT_voxel_grid, context_of(scene)) == ["resolution"]
    scene.svo.method = "cones"
    assert shown_by(panels.SVO_PT_rays, context_of(scene)) == []


def test_what_has_no_effect_is_greyed_out(scene):
    of_voxels = {"injection_ambient", "injection_specular", "injection_shininess"}

    def grey():
        return {name for panel in (panels.SVO_PT_light_injection, panels.SVO_PT_debug)
                for name in drawn_by(panel, context_of(scene)).grey}

    assert grey() == of_voxels | {"view_lod"}
    scene.svo.view = "voxel_radiance"
    assert grey() == set()
    scene.svo.view, scene.svo.method = "combined", "cones"
    assert grey() == {"view_lod"}


@pytest.mark.parametrize("name", ["noise_threshold", "viewport_noise_threshold"])
def test_noise_thresholds_have_the_digits_of_cycles(scene, name):
    assert scene.svo.bl_rna.properties[name].precision == 4


def test_film_panel_has_blenders_own_transparency(scene):
    assert "film_transparent" in shown_by(panels.SVO_PT_film, context_of(scene))


def test_light_panels_have_what_eevees_lack(scene):
    assert shown_by(panels.SVO_PT_light_beam, context_of(scene)) == ["spread"]
    assert shown_by(panels.SVO_PT_light_beam, context_of(scene, kind_of_light="SPOT")) == []
    assert shown_by(panels.SVO_PT_light_shadow, context_of(scene)) == ["use_shadow"]


def test_material_panel_has_what_was_told_of_the_material(scene):
    told.keep(("Material 'Wooden': volume is left out",))
    assert shown_by(material_panels.SVO_PT_material_notes, context_of(scene)) == []
    assert told.keep(("Light 'Wood': a", "Material 'Wood': volume is left out", "Material 'Wood': " + "long " * 9))
    assert shown_by(material_panels.SVO_PT_material_notes, context_of(scene)) == [
        ("volume is left out", "ERROR"), ("long long long long long long long", "ERROR"), ("long long", "BLANK1")]


def test_comparison_has_its_button(scene):
    assert shown_by(panels.SVO_PT_comparison, context_of(scene)) == ["svo.compare"]


@pytest.mark.parametrize("engine", ["CYCLES", "BLENDER_WORKBENCH"])
def test_no_panel_of_ours_for_other_engines(scene, engine):
    assert not [panel for panel in panels._CLASSES if panel.poll(context_of(scene, engine))]


@pytest.mark.usefixtures("scene")
@pytest.mark.parametrize("name", [
    "RENDER_PT_color_management", "RENDER_PT_format", "RENDER_PT_output", "RENDER_PT_stamp", "RENDER_PT_stereoscopy",
    "RENDER_PT_post_processing", "DATA_PT_lens", "DATA_PT_camera", "DATA_PT_EEVEE_light", "DATA_PT_spot",
    "EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "MATERIAL_PT_preview", "EEVEE_WORLD_PT_surface",
    "WORLD_PT_context_world", "OBJECT_PT_visibility", "DATA_PT_uv_texture", "VIEWLAYER_PT_layer"])
def test_blenders_panels_that_we_show(name):
    assert "SVO_ENGINE" in getattr(bpy.types, name).COMPAT_ENGINES


@pytest.mark.usefixtures("scene")
@pytest.mark.parametrize("name", [
    "DATA_PT_light", "RENDER_PT_simplify", "RENDER_PT_simplify_viewport", "RENDER_PT_freestyle",
    "VIEWLAYER_PT_freestyle", "VIEWLAYER_PT_layer_passes",
    "EEVEE_MATERIAL_PT_volume", "DATA_PT_camera_dof", "EEVEE_WORLD_PT_volume"])
def test_blenders_panels_that_we_leave_out(name):
    assert "SVO_ENGINE" not in getattr(bpy.types, name).COMPAT_ENGINES


@pytest.mark.usefixtures("scene")
def test_no_panel_without_its_parent():
    visible = {panel.__name__: panel for panel in bpy.types.Panel.__subclasses__()
               if "SVO_ENGINE" in getattr(panel, "COMPAT_ENGINES", ()) and panel.is_registered}
    parents = {name: panel.bl_parent_id for name, panel in visible.items() if getattr(panel, "bl_parent_id", "")}
    assert {name: parent for name, parent in parents.items()
            if parent not in visible and hasattr(getattr(bpy.types, parent, None), "COMPAT_ENGINES")} == {}


def test_angles_read_in_degrees(scene):
    assert np.isclose(np.degrees(settings_of(scene).cone_ring_angle), 45)
