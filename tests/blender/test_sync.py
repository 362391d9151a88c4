# SPDX-License-Identifier: GPL-3.0-or-later
"""An edit reads what it changes, and nothing else; all else stays the same object."""

from __future__ import annotations

from dataclasses import fields
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from svo_engine.blender.sync import Sync, copies
from tests.blender.build import place, plane
from tests.blender.following import Followed, differences, space_of_window, studio
from tests.blender.test_extract_instances import Geometry
from tests.blender.test_restarts import change, edit_mesh, shader, sky, thing

N_MANY = 50


@pytest.fixture
def followed():
    studio()
    return Followed(space_of_window())


def done(followed, act):
    """What `act` has cost, zeros left out, and the parts of the Scene that are other objects than before."""
    before, counts = followed.scene, followed.counts()
    after = followed.after(act)
    return {name: n - counts[name] for name, n in followed.counts().items() if n > counts[name]}, others(before, after)


def others(before, after):
    """Fields that hold another object than before."""
    return {f.name for f in fields(before) if getattr(before, f.name) is not getattr(after, f.name)}


def retouch():
    """Another texel of the image, of which Blender is told."""
    bpy.data.images["Image"].pixels[0] = 0.25
    bpy.data.images["Image"].update_tag()


@pytest.mark.parametrize(("act", "cost", "parts"), [
    (lambda: thing("Plain").select_set(True), {}, set()),
    (lambda: change(bpy.data.lights["Lamp"], energy=5.0), {}, {"lights"}),
    (lambda: change(thing("Lamp"), location=(1, 2, 3)), {}, {"lights"}),
    (lambda: change(thing("Camera"), location=(1, 2, 3)), {}, set()),
    (lambda: change(thing("Textured"), location=(1, 2, 3)), {"rows": 1}, {"instances"}),
    (lambda: change(shader("Plain").inputs["Roughness"], default_value=0.1), {"materials": 1}, {"materials"}),
    (lambda: change(shader("Textured").inputs["Roughness"], default_value=0.1), {"materials": 1}, {"materials"}),
    (lambda: change(sky().inputs["Strength"], default_value=3.0), {}, {"world"}),
    (lambda: edit_mesh("Textured"), {"walks": 1, "meshes": 1}, {"meshes"}),
    (retouch, {"walks": 1, "images": 1, "materials": 1}, {"images"}),
    (lambda: change(thing("Instancer 1"), location=(1, 2, 3)), {"rows": 1}, {"instances", "lights"}),
    (lambda: change(thing("Inside"), location=(1, 2, 3)), {"rows": 2}, {"instances"}),
    (lambda: thing("Plain").hide_set(True), {"walks": 1}, {"instances", "meshes"}),
    (lambda: place(bpy.data.lights["Lamp"], "New"), {"walks": 1}, {"lights"}),
], ids=["selection", "lamp", "lamp moved", "camera", "object moved", "material", "material with image", "world", "mesh",
        "image", "instancer moved", "inside moved", "hide", "lamp added"])
def test_edit_costs_what_it_changes(followed, act, cost, parts):
    assert done(followed, act) == (cost, parts)
    assert differences(followed.scene, followed.fresh()) == []


def test_meshes_that_did_not_change_stay_the_same(followed):
    before = {mesh.name: mesh for mesh in followed.scene.meshes}
    after = {mesh.name: mesh for mesh in followed.after(lambda: edit_mesh("Textured")).meshes}
    assert {name for name in before if before[name] is not after[name]} == {"Textured"}


def test_moved_object_leaves_all_but_the_matrices(followed):
    before = followed.scene.instances
    after = followed.after(lambda: change(thing("Copy"), location=(9, 9, 9))).instances
    assert others(before, after) == {"world_from_object"}
    changed = (before.world_from_object != after.world_from_object).any((1, 2))
    assert [name for name, is_other in zip(after.names, changed, strict=True) if is_other] == ["Copy"]


def test_lamps_that_did_not_change_stay_the_same(followed):
    before = followed.scene.lights
    after = followed.after(lambda: change(bpy.data.lights["Lamp"], energy=5.0)).lights
    assert [a is b for a, b in zip(before, after, strict=True)] == [True, True, False]


def smooth():
    bpy.data.meshes["Textured"].polygons[0].use_smooth = True
    bpy.data.meshes["Textured"].update()


def second_uv_map():
    layers = bpy.data.meshes["Textured"].uv_layers
    layers.new(name="Second", do_init=False).active_render = True
    layers["Second"].uv[0].vector = (0.25, 0.75)


def move_uv():
    bpy.data.meshes["Textured"].uv_layers[0].uv[0].vector = (0.25, 0.75)
    bpy.data.meshes["Textured"].update()


def normals():
    mesh = bpy.data.meshes["Textured"]
    mesh.normals_split_custom_set([(1, 0, 0)] * len(mesh.loops))


def faces():
    mesh = bpy.data.meshes["Textured"]
    mesh.clear_geometry()
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 2, 0)], [], [(0, 1, 2, 3)])


def material_of_a_face():
    mesh = bpy.data.meshes["Textured"]
    mesh.materials.append(bpy.data.materials["Other"])
    mesh.polygons[0].material_index = 1


@pytest.mark.parametrize("act", [edit_mesh, smooth, second_uv_map, move_uv, normals, faces, material_of_a_face])
def test_arrays_tell_whether_a_large_mesh_has_changed(followed, monkeypatch, act):
    monkeypatch.setattr(copies, "_FEWEST_CORNERS", 0)
    followed.after(bpy.data.meshes["Textured"].update)
    counts, parts = done(followed, bpy.data.meshes["Textured"].update)
    assert ("meshes" in counts, parts) == (False, set())
    assert done(followed, act)[0]["meshes"] == 1
    assert differences(followed.scene, followed.fresh()) == []


@pytest.mark.parametrize(("is_smooth", "n_read"), [(True, 1), (False, 0)])
def test_sharp_edges_count_where_faces_are_smooth(empty, monkeypatch, is_smooth, n_read):
    monkeypatch.setattr(copies, "_FEWEST_CORNERS", 0)
    bpy.ops.mesh.primitive_cube_add()
    mesh = bpy.context.object.data
    mesh.polygons.foreach_set("use_smooth", [is_smooth] * 6)
    mesh.edges[0].use_edge_sharp = True
    followed = Followed()

    def sharpen():
        mesh.edges[5].use_edge_sharp = True
        mesh.update()

    assert done(followed, sharpen)[0].get("meshes", 0) == n_read
    assert differences(followed.scene, followed.fresh()) == []


def test_large_mesh_is_not_read_again_for_its_materials_alone(followed, monkeypatch):
    monkeypatch.setattr(copies, "_FEWEST_CORNERS", 0)
    followed.after(bpy.data.meshes["Textured"].update)
    counts, parts = done(followed, lambda: change(thing("Textured").material_slots[0],
                                                   material=bpy.data.materials["Other"]))
    assert (counts.get("meshes", 0), "meshes" in parts) == (0, False)
    assert differences(followed.scene, followed.fresh()) == []


@pytest.mark.parametrize("kind", ["linked", "instanced", "scattered"])
def test_one_of_many_moves(empty, kind):
    """No matter how the many come about, only one row is written, and none is visited."""
    name = {"linked": linked, "instanced": instanced, "scattered": scattered}[kind]()
    followed = Followed()
    assert len(followed.scene.instances) >= N_MANY
    counts, parts = done(followed, lambda: change(thing(name), location=(0, 0, 5)))
    assert (counts, parts) == ({"rows": 1}, {"instances"})
    assert differences(followed.scene, followed.fresh()) == []


def linked():
    mesh = plane(name="One").data
    for i in range(N_MANY):
        place(mesh, "Another", at=(i, 0, 0))
    return "One"


def instanced():
    inside = plane(name="Inside", turn=(1, 2, 3), scale=(1, 2, 3))
    shown = bpy.data.collections.new("Shown")
    shown.instance_offset = (3, 2, 1)
    bpy.context.scene.collection.objects.unlink(inside)
    shown.objects.link(inside)
    for i in range(N_MANY):
        made = place(None, f"Instancer {i}", at=(i, 0, 0), turn=(i, 2, 3), scale=(1, 2, i + 1))
        made.instance_type, made.instance_collection = "COLLECTION", shown
    return "Instancer 7"


def scattered():
    nodes = Geometry()
    grid, on_points = nodes.new("GeometryNodeMeshGrid", Vertices_X=8, Vertices_Y=8), nodes.new(
        "GeometryNodeInstanceOnPoints")
    nodes.link(grid, on_points, "Points")
    nodes.link(nodes.new("GeometryNodeMeshCube"), on_points, "Instance")
    nodes.link(on_points, nodes.output)
    plane(name="One")
    return "One"


def test_lamp_that_changes_with_its_warning(empty):
    """Warnings stand in the order of a walk."""
    data = bpy.data.lights.new("Spot", "SPOT")
    place(data, "Spot")
    followed = Followed()
    scaled = followed.after(lambda: change(thing("Spot"), scale=(1, 2, 1)))
    assert len(scaled.warnings) == 1
    assert scaled.warnings == followed.fresh().warnings
    assert followed.after(lambda: change(thing("Spot"), scale=(1, 1, 1))).warnings == ()


def test_object_whose_place_becomes_finite(empty):
    plane(name="Lost", at=(np.nan, 0, 0))
    followed = Followed()
    assert len(followed.scene.instances) == 0
    assert len(followed.after(lambda: change(thing("Lost"), location=(0, 0, 0))).instances) == 1
    assert len(followed.after(lambda: change(thing("Lost"), location=(np.nan, 0, 0))).instances) == 0


def test_image_reloaded(empty, tmp_path):
    studio()
    picture = bpy.data.images["Image"]
    picture.unpack(method="REMOVE")
    picture.filepath_raw, picture.file_format = str(tmp_path / "image.png"), "PNG"

    def save(value):
        made = bpy.data.images.new("Made", 4, 4)
        made.pixels.foreach_set(np.full(64, value, "f4"))
        made.filepath_raw, made.file_format = picture.filepath_raw, "PNG"
        made.save()
        bpy.data.images.remove(made)

    save(0.25)
    picture.source = "FILE"
    picture.reload()
    followed = Followed()
    save(0.75)
    counts, parts = done(followed, lambda: None)
    assert ("images" in counts, parts) == (False, set())
    counts, parts = done(followed, picture.reload)
    assert (counts["images"], parts) == (1, {"images"})
    assert differences(followed.scene, followed.fresh()) == []


@pytest.mark.parametrize(("side", "is_noticed"), [(64, True), (1024, False)])
def test_pixels_set_by_a_script_that_tells_nobody(empty, side, is_noticed):
    """As long as they are few, they are compared. Cycles does not notice them at all."""
    studio()
    picture = bpy.data.images.new("New", side, side)
    picture.pixels[0] = 0.5
    shader("Textured", "Image Texture").image = picture
    followed = Followed()
    picture.pixels[0] = 1.0
    assert bool(differences(followed.scene, followed.after(lambda: None))) == is_noticed


def test_image_that_nothing_shows_is_not_read(empty):
    studio()
    shader("Other").id_data.nodes.new("ShaderNodeTexImage").image = bpy.data.images.new("Unused", 9, 9)
    assert Followed().sync.images.n_read == 1


def test_read_anew_all_is_the_same_object(followed):
    """As final renders do, of which each has another depsgraph."""
    before = followed.sync.update(bpy.context.evaluated_depsgraph_get(), followed.space)
    assert followed.sync.read(bpy.context.evaluated_depsgraph_get(), followed.space) is before


def test_another_depsgraph_is_read_anew(followed):
    scene = bpy.data.scenes.new("Another")
    scene.collection.objects.link(thing("Plain"))
    scene.view_layers[0].update()
    graph = scene.view_layers[0].depsgraph
    n_walks = followed.sync.n_walks
    assert len(followed.sync.update(graph).instances) == 1
    assert followed.sync.n_walks == n_walks + 1


def test_after_an_error_all_is_read(followed, monkeypatch):
    def fail(*_):
        raise ValueError

    with monkeypatch.context() as broken:
        broken.setattr(followed.sync.materials, "follow", fail)
        with pytest.raises(ValueError):  # noqa: PT011 - ours
            followed.sync.update(bpy.context.evaluated_depsgraph_get(), followed.space)
    n_read = followed.sync.meshes.n_read
    followed.after(lambda: change(bpy.data.lights["Lamp"], energy=5.0))
    assert followed.sync.meshes.n_read > n_read
    assert differences(followed.scene, followed.fresh()) == []


def test_what_is_not_known_is_read_whole(empty):
    plane()
    sync = Sync()
    graph = bpy.context.evaluated_depsgraph_get()
    sync.update(graph)
    strange = SimpleNamespace(original=SimpleNamespace(session_uid=1))
    update = SimpleNamespace(id=strange, is_updated_transform=False, is_updated_geometry=False, is_updated_shading=True)

    class Graph:
        updates = (update,)

        def __getattr__(self, name):
            return getattr(graph, name)

    n_read = sync.meshes.n_read
    sync.update(Graph())
    assert sync.meshes.n_read == n_read + 1


def test_uid_without_session_uid():
    """Blender 4.1 and older have none."""
    from svo_engine.blender.sync.changes import uid_of

    assert uid_of(SimpleNamespace(name_full="Cube")) == ("SimpleNamespace", "Cube")
