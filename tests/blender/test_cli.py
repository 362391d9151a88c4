# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line on .blend files, each time in a process of its own: what it prints, writes and exits with."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys

import bpy
import numpy as np
import OpenEXR
import pytest
from PIL import Image as PillowImage

from svo_engine.film import encode_srgb
from svo_engine.scene import store

QUICK = ("--set", "resolution=32", "--samples", "1")


@pytest.fixture
def blend(empty, tmp_path):
    """A moving, subdivided cube under a lamp, 24 x 16 pixels, saved at frame 1 and never changed."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    cube = bpy.context.object
    subdivision = cube.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels, subdivision.render_levels = 0, 2
    for frame, x in ((1, 0.0), (10, 1.5)):
        cube.location.x = x
        cube.keyframe_insert("location", frame=frame)
    bpy.ops.object.light_add(type="POINT", location=(2, -2, 4))
    bpy.context.object.data.energy = 500
    bpy.ops.object.camera_add(location=(0, 0, 8))
    empty.camera = bpy.context.object
    empty.render.resolution_x, empty.render.resolution_y, empty.render.resolution_percentage = 48, 32, 50
    empty.view_settings.view_transform, empty.render.dither_intensity = "Standard", 0
    return save(tmp_path / "scene.blend")


def save(path):
    bpy.ops.wm.save_as_mainfile(filepath=str(path), check_existing=False)
    return path


def run(root, *arguments):
    return subprocess.run([sys.executable, "-m", "svo_engine", *map(str, arguments)], capture_output=True, text=True,
                          check=False, cwd=root)


def succeed(root, *arguments):
    """What the command prints; it must end well and have nothing to say on stderr."""
    done = run(root, *arguments)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.splitlines()


def fail(root, *arguments):
    """The sentence that the command fails with, which must be all that it says."""
    done = run(root, *arguments)
    assert (done.returncode, done.stdout) == (1, "")
    (line,) = done.stderr.splitlines()
    return line.removeprefix("svo_engine: error: ")


def pixels(path):
    """(height, width, 4) f4, scene-linear, row 0 at the top."""
    with OpenEXR.File(str(path)) as file:
        return file.channels()["RGBA"].pixels


def test_render_writes_what_blender_would(root, blend, tmp_path):
    digest = hashlib.sha256(blend.read_bytes()).digest()
    lines = succeed(root, "render", blend, "--out", tmp_path / "out/", "--stats", tmp_path / "stats.json", *QUICK)
    assert lines[:2] == [str(tmp_path / "out/scene.png"), str(tmp_path / "out/scene.exr")]
    stats = json.loads((tmp_path / "stats.json").read_text())
    assert stats["device"] in lines[2]
    assert set(stats["times_ms"]) <= {line.split("  ")[1] for line in lines[3:]}
    assert (stats["size"], stats["settings"]["resolution"], stats["n_samples"]) == ([24, 16], "32", 1)
    assert stats["counts"]["triangles"] == 6 * 4**2 * 2  # two subdivisions, at render time only
    picture, linear = np.asarray(PillowImage.open(tmp_path / "out/scene.png")) / 255, pixels(tmp_path / "out/scene.exr")
    assert linear[..., :3].max() > 0.1
    np.testing.assert_allclose(picture[..., :3], encode_srgb(linear[..., :3]), atol=0.51 / 255)  # a byte's rounding
    assert hashlib.sha256(blend.read_bytes()).digest() == digest


def test_passes_make_the_exr_a_multilayer_one(root, blend, tmp_path):
    succeed(root, "render", blend, "--out", tmp_path / "out/", "--passes", "Depth,Glossy Color", *QUICK)
    with OpenEXR.File(str(tmp_path / "out/scene.exr"), separate_channels=True) as file:
        passes = {name.split(".")[-2] for part in file.parts for name in part.channels}
    assert passes == {"Combined", "Depth", "Glossy Color"}
    assert (tmp_path / "out/scene.png").stat().st_size > 100


def test_extracted_scene_gives_the_same_picture(root, blend, tmp_path):
    succeed(root, "extract", blend, tmp_path / "scene.npz", "--frame", 10)
    succeed(root, "render", tmp_path / "scene.npz", "--out", tmp_path / "extracted.exr", *QUICK)
    succeed(root, "render", blend, "--out", tmp_path / "blend.exr", "--frame", 10, *QUICK)
    succeed(root, "render", blend, "--out", tmp_path / "first.exr", *QUICK)
    np.testing.assert_array_equal(pixels(tmp_path / "extracted.exr"), pixels(tmp_path / "blend.exr"))
    assert (pixels(tmp_path / "first.exr") != pixels(tmp_path / "blend.exr")).any()


def test_scene_is_taken_as_it_is_at_render_time(root, blend, tmp_path):
    bpy.context.scene.objects["Cube"].hide_viewport = True
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.hide_render = True
    lines = succeed(root, "extract", save(blend), tmp_path / "scene.npz")
    assert store.load(tmp_path / "scene.npz").n_triangles == 6 * 4**2 * 2
    assert lines[0] == str(tmp_path / "scene.npz")
    assert lines[1].split() == ["triangles", "192"]


@pytest.mark.usefixtures("extension")
def test_file_has_the_settings_unless_they_are_given(root, blend, tmp_path):
    bpy.context.scene.svo.samples, bpy.context.scene.svo.resolution = 2, "64"
    bpy.context.scene.render.image_settings.file_format = "JPEG"
    succeed(root, "render", save(blend), "--out", tmp_path / "a.png", "--stats", tmp_path / "stats.json",
            "--set", "resolution=32", "--size", "20x12")
    stats = json.loads((tmp_path / "stats.json").read_text())
    assert (stats["n_samples"], stats["settings"]["resolution"], stats["resolution"]) == (2, "32", 32)
    with PillowImage.open(tmp_path / "a.png") as picture:
        assert (picture.format, picture.size) == ("PNG", (20, 12))


def test_compare_writes_pictures_and_numbers(root, blend, tmp_path):
    out = tmp_path / "not" / "yet"
    lines = succeed(root, "compare", blend, "--out", out, "--samples", 4, "--bounces", 1, "--set", "samples=1",
                    "--set", "resolution=32")
    assert {path.name for path in out.iterdir()} == {"svo.exr", "cycles.exr", "comparison.png", "comparison.json"}
    report = json.loads((out / "comparison.json").read_text())
    assert lines == [str(out / "comparison.png"), lines[1]]
    assert f"NRMSE {report['errors']['nrmse']:.4f}" in lines[1]
    assert (report["cycles"]["settings"]["samples"], report["cycles"]["settings"]["max_bounces"]) == (4, 1)
    assert (report["svo"]["settings"]["resolution"], report["size"]) == ("32", [24, 16])


def test_warning_is_one_line_and_no_failure(root, blend, tmp_path):
    material = bpy.data.materials.new("Material")
    if material.node_tree is None:  # before Blender 5.0
        material.use_nodes = True
    nodes = material.node_tree.nodes
    image = bpy.data.images.new("Lost", 4, 4)
    image.source, image.filepath = "FILE", str(tmp_path / "lost.png")
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    material.node_tree.links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    bpy.data.objects["Cube"].data.materials.append(material)
    save(blend)
    for command in (["render", blend, "--out", tmp_path / "a.png", *QUICK], ["extract", blend, tmp_path / "a.npz"]):
        done = run(root, *command)
        assert done.returncode == 0
        (line,) = done.stderr.splitlines()
        assert line.startswith("svo_engine: warning: ")
        assert "Lost" in line


@pytest.mark.parametrize(("content", "sentence"), [
    (lambda _whole: b"garbage" * 99, "File format is not supported in file"),
    (lambda _whole: b"", "File format is not supported in file"),
    (lambda whole: whole[: len(whole) // 2], "Loading"),
], ids=["garbage", "empty", "half"])
def test_file_that_is_no_blend(root, blend, tmp_path, content, sentence):
    (tmp_path / "bad.blend").write_bytes(content(blend.read_bytes()))
    told = fail(root, "render", tmp_path / "bad.blend", "--out", tmp_path / "a.png")
    assert told.startswith(sentence)
    assert "bad.blend" in told
    assert not (tmp_path / "a.png").exists()


@pytest.mark.parametrize("arguments", [["render", "--out", "out/"], ["extract", "a.npz"], ["compare", "--out", "out"]],
                         ids=lambda arguments: arguments[0])
def test_scene_without_camera(root, blend, tmp_path, arguments):
    bpy.context.scene.camera = None
    save(blend)
    *options, out = arguments[1:]
    assert fail(root, arguments[0], blend, *options, tmp_path / out) == f"Scene 'Scene' in '{blend}' has no camera"


def test_setting_that_there_is_not(root, blend, tmp_path):
    assert fail(root, "compare", blend, "--out", tmp_path, "--set", "none=1").startswith("There is no setting 'none'")


def test_folder_that_cannot_be_written(root, blend):
    told = fail(root, "compare", blend, "--out", blend / "below")
    assert told.startswith(f"Cannot write into the folder '{blend}/below'")


def test_error_of_the_engine_is_told_once(root, blend):
    code = """
import sys
from svo_engine import cli, errors, render

def films(*args, **more):
    raise errors.GpuError("OpenGL 4.3 is missing")

render.Client.films = films
sys.exit(cli.main(sys.argv[1:]))
"""
    done = subprocess.run([sys.executable, "-c", code, "render", blend, "--out", blend.with_suffix(".png")], cwd=root,
                          capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (1, "", "svo_engine: error: OpenGL 4.3 is missing\n")
    assert not blend.with_suffix(".png").exists()
