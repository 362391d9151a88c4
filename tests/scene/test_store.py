# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene in a file: what was saved comes back to the bit, and whatever else a file holds is one sentence."""

from __future__ import annotations

import json
import random
from dataclasses import fields, is_dataclass

import numpy as np
import pytest

from svo_engine.errors import SceneError
from svo_engine.scene import store
from svo_engine.scene.graph import Graph, Group, Link, Node
from svo_engine.scene.types import Attribute, Camera, Image, Instances, Light, Material, Mesh, Scene, Texture, World

GRAPH = Graph(
    nodes=(Node("ShaderNodeMath", {"operation": "ADD", "use_clamp": True}, {"Value": 1.5, "Value_001": Link(1, "Fac")},
                "Sum", {"Value": "Value"}),
           Node("ShaderNodeGroup", {"node_tree": "Ramp", "image": None}, {"Vector": (1.0, 2.0, 3.0), "Shader": None})),
    surface=Link(0, "Value"), displacement=Link(1, "Height"), aovs=(0,),
    groups={"Ramp": Group((Node("ShaderNodeValToRGB", {"color_ramp": ("RGB", "LINEAR", "NEAR", ((0.0, 1.0),))}),),
                          {"Fac": Link(0, "Color"), "Other": 0.5}, ())},
    settings={"displacement_method": "BOTH"})


@pytest.fixture
def scene():
    """A scene with something in every field."""
    rng = np.random.default_rng(0)
    mesh = Mesh("mesh", rng.random((4, 3)).astype("f4"), np.array([(0, 1, 2), (1, 2, 3)], "u4"),
                rng.random((2, 3, 3)).astype("f4"), np.array((0, 1), "u4"),
                tuple(Attribute(f"of {domain}", domain, rng.random((n, width)).astype("f4"))
                      for domain, n, width in (("POINT", 4, 1), ("FACE", 2, 3), ("CORNER", 6, 2))),
                "of CORNER", "of FACE", (1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (rng.random((4, 3)).astype("f4"),))
    instances = Instances(
        ("one", "\u017ctwo"), np.zeros(2, "u4"), rng.random((2, 4, 4)), np.array((0, 2, 3), "u4"),
        np.array((0, 1, 0), "u4"), np.array((-5, 2**62), "i8"), rng.random(2).astype("f4"), np.array((3, -4), "i4"),
        rng.random((2, 4)).astype("f4"), rng.random((2, 3)).astype("f4"), rng.random((2, 2)).astype("f4"),
        np.array((63, 5), "u4"), np.array((1, 2**63), "u8"), np.array((2, 3), "u8"),
        (Attribute("heat", "INSTANCE", np.ones((2, 1), "f4")),), (rng.random((2, 4, 4)),))
    return Scene(
        meshes=(mesh,), instances=instances,
        materials=(Material("plain"), Material("rich", roughness=np.float32(0.3), base_color_texture=0, graph=GRAPH,
                                              pass_index=7)),
        textures=(Texture(0, (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), "CLIP", "Closest", 2),),
        images=(Image("bytes", rng.integers(0, 255, (2, 3, 4)).astype("u1"), True),
                Image("floats", rng.random((2, 3, 4)).astype("f4"))),
        lights=(Light("lamp", "SPOT", np.eye(4), (1.0, 2.0, 3.0), radius=0.1, soft_falloff=True, graph=GRAPH),),
        world=World((0.1, 0.2, 0.3), 1, rng.random((3, 3)), GRAPH),
        camera=Camera("camera", rng.random((4, 4)), (30, 20)),
        film_transparent=True, warnings=("one", "two"))


def assert_same(a, b):
    assert type(a) is type(b)
    if is_dataclass(a):
        for field in fields(a):
            assert_same(getattr(a, field.name), getattr(b, field.name))
    elif isinstance(a, tuple):
        assert len(a) == len(b)
        for x, y in zip(a, b, strict=True):
            assert_same(x, y)
    elif isinstance(a, np.ndarray):
        assert a.dtype == b.dtype
        np.testing.assert_array_equal(a, b)
    else:
        assert a == b


def test_round_trip(scene, tmp_path):
    store.save(scene, tmp_path / "scene.npz")
    loaded = store.load(tmp_path / "scene.npz")
    assert loaded.materials[1].roughness == np.float32(0.3)
    store.save(loaded, tmp_path / "again.npz")
    assert_same(store.load(tmp_path / "again.npz"), loaded)
    assert_same(loaded.meshes + loaded.images + loaded.lights, scene.meshes + scene.images + scene.lights)
    for name in ("instances", "textures", "world", "camera", "film_transparent", "warnings"):
        assert_same(getattr(loaded, name), getattr(scene, name))


def test_empty_scene(tmp_path):
    store.save(Scene(), tmp_path / "scene.npz")
    loaded = store.load(tmp_path / "scene.npz")
    assert loaded.camera is None
    assert len(loaded.instances) == 0


def test_same_scene_same_bytes(scene, tmp_path):
    for name in ("a.npz", "b.npz"):
        store.save(scene, tmp_path / name)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


@pytest.mark.parametrize("content", [b"", b"text", b"PK\x03\x04", b"\x93NUMPY", b"BLENDER-v402RENDH"])
def test_foreign_file(content, tmp_path):
    path = tmp_path / "scene.npz"
    path.write_bytes(content)
    with pytest.raises(SceneError, match=r"scene\.npz' is not a saved scene"):
        store.load(path)


def test_arrays_of_somebody_else(tmp_path):
    path = tmp_path / "scene.npz"
    np.savez(path, header=np.zeros(3))
    with pytest.raises(SceneError, match="is not a saved scene"):
        store.load(path)
    with path.open("wb") as file:
        np.save(file, np.zeros(3))
    with pytest.raises(SceneError, match="is not a saved scene"):
        store.load(path)


def test_missing_and_unwritable(scene, tmp_path):
    missing = tmp_path / "nowhere" / "scene.npz"
    with pytest.raises(SceneError, match=r"^Cannot read '.*nowhere.*': No such file"):
        store.load(missing)
    with pytest.raises(SceneError, match=r"^Cannot write '.*nowhere.*': No such file"):
        store.save(scene, missing)
    with pytest.raises(SceneError, match="Is a directory"):
        store.load(tmp_path)


@pytest.mark.parametrize(("number", "sentence"), [
    (1, r"scene\.npz' was written by an older version \(format 1\); extract it again from its \.blend$"),
    (99, r"scene\.npz' was written by a newer version \(format 99\); this one reads format 2$")])
def test_other_format(scene, tmp_path, monkeypatch, number, sentence):
    path = tmp_path / "scene.npz"
    monkeypatch.setattr(store, "FORMAT", number)
    store.save(scene, path)
    monkeypatch.undo()
    with pytest.raises(SceneError, match=sentence):
        store.load(path)


def saved_with(path, edit):
    """The file at `path` with its header's scene changed by `edit`."""
    with np.load(path) as data:
        arrays = dict(data)
    header = json.loads(str(arrays.pop("header")))
    edit(header["scene"])
    np.savez(path, header=np.array(json.dumps(header)), **arrays)


@pytest.mark.parametrize(("edit", "sentence"), [
    (lambda s: s["materials"][0].update(roughness="rough"), "scene/materials/0/roughness is of the wrong kind"),
    (lambda s: s["materials"][0].update(base_color_texture=True), "base_color_texture is of the wrong kind"),
    (lambda s: s["materials"][0].update(base_color=[1, 2]), "base_color is of the wrong kind"),
    (lambda s: s["textures"][0].update(extension="FOLD"), "extension is of the wrong kind"),
    (lambda s: s["meshes"][0].update(positions="elsewhere"), "positions is of the wrong kind"),
    (lambda s: s["meshes"][0].pop("positions"), "scene/meshes/0/positions is missing"),
    (lambda s: s["meshes"][0].update(hair=1), "scene/meshes/0/hair, which this version does not know"),
    (lambda s: s["meshes"][0].update(uv_map="Gone"), "Mesh 'mesh': there is no attribute 'Gone'"),
    (lambda s: s["materials"][1]["graph"].pop("nodes"), "a node tree is damaged"),
    (lambda s: s["materials"][1]["graph"].update(aovs=[9]), "Graph: node 9 of 2 is named"),
    (lambda s: s["materials"][1]["graph"]["ends"].update(surface={"link": ["0", "Value"]}), "a node tree is damaged"),
    (lambda s: s["materials"][1]["graph"]["nodes"][0].pop(), "a node tree is damaged")])
def test_wrong_values_are_named(scene, tmp_path, edit, sentence):
    path = tmp_path / "scene.npz"
    store.save(scene, path)
    saved_with(path, edit)
    with pytest.raises(SceneError, match=sentence):
        store.load(path)


def test_fields_that_a_file_lacks_take_their_defaults(scene, tmp_path):
    path = tmp_path / "scene.npz"
    store.save(scene, path)
    saved_with(path, lambda s: (s["instances"].pop("visibility"), s["materials"][0].pop("pass_index")))
    loaded = store.load(path)
    assert loaded.instances.visibility.tolist() == [63, 63]
    assert loaded.materials[0].pass_index == 0


def test_contents_are_checked(scene, tmp_path):
    """A file that is well-formed but names what is not there."""
    path = tmp_path / "scene.npz"
    broken = Scene(materials=(Material("a"),), textures=scene.textures, images=scene.images)
    object.__setattr__(broken.materials[0], "alpha_texture", 5)
    store.save(broken, path)
    with pytest.raises(SceneError, match="Material 'a': texture 5 of 1 is named"):
        store.load(path)


def test_broken_files_raise_nothing_but_a_sentence(scene, tmp_path):
    path = tmp_path / "scene.npz"
    store.save(scene, path)
    whole, rng = path.read_bytes(), random.Random(0)
    n_refused = 0
    for i in range(400):
        broken = bytearray(whole)
        for _ in range(3):
            broken[rng.randrange(len(broken))] = rng.randrange(256)
        path.write_bytes(broken if i % 2 else broken[:rng.randrange(len(broken))])
        try:
            store.load(path)
        except SceneError:
            n_refused += 1
    assert n_refused > 300
