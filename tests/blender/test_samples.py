# SPDX-License-Identifier: GPL-3.0-or-later
"""The sample scenes: they open, they are what their README promises, and `build.py` builds the very same."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

from svo_engine.blender.cli import extract_scene
from svo_engine.scene.bounds import mesh_boxes, placed_boxes

SAMPLES = Path(__file__).resolve().parents[2] / "sample_blends"


def promises() -> dict[str, tuple[set[str], int]]:
    """Scene name -> (kinds of light, number of triangles), as the README's table has them."""
    rows = [[cell.strip() for cell in line.split("|")] for line in (SAMPLES / "README.md").read_text().splitlines()]
    rows = [row for row in rows if len(row) > 3 and row[1].startswith("`")]
    return {row[1].strip("`"): (set(row[2].split(", ")), int(row[3].replace(",", ""))) for row in rows}


def open_scene(path: Path):
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    return bpy.context.scene


def n_triangles() -> int:
    instances = bpy.context.evaluated_depsgraph_get().object_instances
    return sum(len(i.object.data.loop_triangles) for i in instances if i.object.type == "MESH")


def kinds_of_light(scene) -> set[str]:
    """In the words of the README's table."""
    kinds = {thing.data.type.lower() for thing in scene.objects if thing.type == "LIGHT"}
    background = scene.world.node_tree.nodes["Background"]
    if background.inputs["Color"].is_linked:
        kinds.add("world image")
    elif max(background.inputs["Color"].default_value[:3]) * background.inputs["Strength"].default_value > 0:
        kinds.add("world")
    if any(emits(material) for material in bpy.data.materials):
        kinds.add("emission")
    return kinds


def emits(material) -> bool:
    nodes = material.node_tree.nodes
    shown = [node.inputs for node in nodes if node.bl_idname == "ShaderNodeBsdfPrincipled"]
    return any(node.bl_idname == "ShaderNodeEmission" for node in nodes) or any(
        max(inputs["Emission Color"].default_value[:3]) * inputs["Emission Strength"].default_value > 0
        for inputs in shown)


def contents(path: Path) -> dict[str, tuple[np.ndarray, ...]]:
    """Object name -> its matrix, its mesh's vertices, corners and the materials of its faces, the colours of its
    materials, the power of its lamp."""
    found = {}
    open_scene(path)
    for thing in bpy.data.objects:
        parts = [np.array(thing.matrix_world).ravel()]
        if thing.type == "MESH":
            mesh = thing.data
            parts += [read(mesh.vertices, "co", 3, "f4"), read(mesh.loops, "vertex_index", 1, "i4"),
                      read(mesh.polygons, "material_index", 1, "i4")]
            parts += [colors(slot.material) for slot in thing.material_slots]
        if thing.type == "LIGHT":
            parts.append(np.array([thing.data.energy]))
        found[thing.name] = tuple(parts)
    for image in bpy.data.images:
        if image.packed_file:
            found[f"image {image.name}"] = (np.array(image.pixels[:]),)
    return found


def colors(material) -> np.ndarray:
    """Those of all nodes' inputs called so, in the nodes' order."""
    named = (node.inputs.get(name) for node in material.node_tree.nodes for name in ("Base Color", "Color"))
    return np.array([tuple(socket.default_value) for socket in named if socket])


def read(items, name: str, width: int, dtype: str) -> np.ndarray:
    values = np.empty(len(items) * width, dtype)
    items.foreach_get(name, values)
    return values


@pytest.fixture(scope="module")
def rebuilt(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("samples")
    subprocess.run([sys.executable, SAMPLES / "build.py", "--out", folder], check=True, capture_output=True)
    return folder


def test_the_readme_lists_every_file():
    assert set(promises()) == {path.stem for path in SAMPLES.glob("*.blend")}


def test_the_files_are_small():
    sizes = [path.stat().st_size for path in SAMPLES.glob("*.blend")]
    assert max(sizes) < 1.5e6 and sum(sizes) < 5e6  # what a clone of the repository should cost at most


@pytest.mark.parametrize("name", promises())
def test_it_is_what_the_readme_promises(name, capfd):
    scene = open_scene(SAMPLES / f"{name}.blend")
    said = "".join(capfd.readouterr()).lower()
    assert "warning" not in said and "error" not in said
    assert scene.camera is not None
    assert (kinds_of_light(scene), n_triangles()) == promises()[name]
    assert (scene.render.resolution_x, scene.render.resolution_y) == (800, 600)
    assert scene.view_settings.view_transform == "Standard"


@pytest.mark.parametrize("name", promises())
def test_it_needs_no_other_file(name):
    open_scene(SAMPLES / f"{name}.blend")
    assert bpy.utils.blend_paths(packed=False) == []
    assert len(bpy.data.libraries) == 0


@pytest.mark.parametrize("name", promises())
def test_no_two_things_fill_the_same_place(name):
    """They would shadow each other, or not, as rounding falls. A millimetre apart is apart."""
    scene = extract_scene(SAMPLES / f"{name}.blend", None)
    inst = scene.instances
    boxes = placed_boxes(mesh_boxes(scene.meshes)[inst.mesh], inst.world_from_object)
    coincide = np.triu(np.abs(boxes[:, None] - boxes).max((2, 3)) < 1e-3, 1)
    assert [(inst.names[i], inst.names[j]) for i, j in np.argwhere(coincide)] == []


@pytest.mark.parametrize("name", promises())
def test_build_makes_the_committed_scene(name, rebuilt):
    committed, built = contents(SAMPLES / f"{name}.blend"), contents(rebuilt / f"{name}.blend")
    assert list(committed) == list(built)
    for thing, parts in committed.items():
        for was, now in zip(parts, built[thing], strict=True):
            # Another C library may round a sine differently: a few units in the last place of a 17 m wide scene
            np.testing.assert_allclose(now, was, rtol=0, atol=1e-5, err_msg=thing)


def test_build_names_what_it_does_not_know(tmp_path):
    done = subprocess.run([sys.executable, SAMPLES / "build.py", "nowhere", "--out", tmp_path], check=False,
                          capture_output=True, text=True)
    assert done.returncode == 2
    assert "there is no scene 'nowhere'" in done.stderr and "Traceback" not in done.stderr


def test_no_ray_of_cycles_passes_the_thin_wall(tmp_path):
    scene = open_scene(SAMPLES / "two_rooms.blend")
    scene.cycles.samples, scene.render.resolution_percentage = 16, 8
    scene.render.image_settings.file_format, scene.render.filepath = "OPEN_EXR", str(tmp_path / "rooms.exr")
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    width, height = picture.size
    luminance = np.array(picture.pixels[:]).reshape(height, width, 4)[..., :3].mean(2)
    middle, filter_reach = width // 2, 2  # the pixel filter is 1.5 pixels wide
    assert luminance[:, :middle - filter_reach].min() > 0  # lit all over, if dimly in some corners
    assert luminance[:, middle + filter_reach:].max() == 0.0
