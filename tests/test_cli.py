# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line on a saved scene, where there is no Blender; and what it says to every mistake."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import OpenEXR
import pytest
from PIL import Image as PillowImage

from svo_engine import __version__
from svo_engine.cli import main
from svo_engine.errors import GpuError
from svo_engine.render import Session
from svo_engine.scene import store
from svo_engine.scene.camera import make_view
from svo_engine.scene.types import Camera
from svo_engine.settings import specs
from tests import scenes

QUICK = ("--method", "cones", "--set", "resolution=32", "--set", "denoise=off", "--samples", "2")


@pytest.fixture
def saved(tmp_path):
    """A lit floor with a camera above it, 24 x 16 pixels, as a .npz."""
    above = np.eye(4)
    above[2, 3] = 4
    scene = scenes.scene(scenes.Thing(scenes.floor()), lights=(scenes.lamp("POINT", (0, 0, 1)),),
                         camera=Camera("Camera", above, (24, 16)), warnings=("A sentence.",))
    store.save(scene, tmp_path / "scene.npz")
    return tmp_path / "scene.npz"


def run(root, *arguments, missing=("bpy",)):
    """The command in a process of its own, in which the modules `missing` cannot be imported."""
    code = f"""
import sys
sys.modules.update(dict.fromkeys({missing}))
from svo_engine.cli import main
sys.exit(main())
"""
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=root)


def pixels(path):
    with OpenEXR.File(str(path)) as file:
        return file.channels()["RGBA"].pixels


def test_render_without_blender(root, saved, tmp_path):
    done = run(root, "render", saved, "--out", tmp_path / "out/", "--stats", tmp_path / "stats.json", *QUICK)
    assert (done.returncode, done.stderr) == (0, "svo_engine: warning: A sentence.\n")
    stats = json.loads((tmp_path / "stats.json").read_text())
    lines = done.stdout.splitlines()
    assert lines[:2] == [str(tmp_path / "out/scene.png"), str(tmp_path / "out/scene.exr")]
    assert stats["device"] in lines[2]
    assert set(stats["times_ms"]) <= {line.split("  ")[1] for line in lines[3:]}
    assert (stats["size"], stats["n_samples"], stats["counts"]["triangles"]) == ([24, 16], 2, 2)
    assert stats["settings"]["resolution"] == "32"
    assert stats["versions"]["svo_engine"] == __version__
    assert PillowImage.open(tmp_path / "out/scene.png").size == (24, 16)


def test_rays_tell_what_the_octree_takes_and_what_a_dense_grid_would(saved, tmp_path, capsys):
    quick = ("--size", "16x12", "--samples", "1", "--set", "cache_resolution=32", "--set", "cache_rays=1")
    assert main(["render", str(saved), "--out", str(tmp_path / "a.png"), "--stats", str(tmp_path / "stats.json"),
                 *quick]) == 0
    counts = json.loads((tmp_path / "stats.json").read_text())["counts"]
    n_bytes, n_dense = counts["octree bytes"], counts["dense bytes"]
    assert n_dense == 3 * 32**3 * 64
    assert 64 * counts["surfels"] < n_bytes < 100 * counts["surfels"] < n_dense / 10
    rows = {line[2:].split("  ")[0]: line.split()[-2:] for line in capsys.readouterr().out.splitlines()[1:]}
    assert rows["octree size"] == [f"{n_bytes / 2**20:.1f}", "MiB"]
    assert rows["dense size"] == [f"{n_dense / 2**20:.1f}", "MiB"]


def test_picture_is_that_of_the_core(saved, tmp_path):
    assert main(["render", str(saved), "--out", str(tmp_path / "a.exr"), "--size", "30x20", *QUICK]) == 0
    scene, session = store.load(saved), Session()
    assert scene.camera is not None
    *_, film = session.films(scene, make_view(scene.camera, (30, 20)), replace(scenes.SMALL, samples=2))
    session.close()
    np.testing.assert_array_equal(pixels(tmp_path / "a.exr")[::-1], film.planes["Combined"])
    assert film.planes["Combined"][..., 0].max() > 0


def test_passes_are_layers_of_the_exr(saved, tmp_path):
    out = ("--out", str(tmp_path / "a.exr"))
    assert main(["render", str(saved), *out, "--passes", "Depth,Diffuse Color", *QUICK]) == 0
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        assert set(file.channels()) == {*"RGBA", "Depth.Z", *(f"Diffuse Color.{letter}" for letter in "RGB")}
        assert np.allclose(file.channels()["Depth.Z"].pixels[8, 12], 4)


def test_last_of_several_values_counts(saved, tmp_path):
    stats = tmp_path / "stats.json"
    main(["render", str(saved), "--out", str(tmp_path / "a.png"), "--stats", str(stats), "--samples", "9",
          "--set", "samples=1", "--set", "resolution=64", "--set", "resolution=32", "--method", "cones"])
    settings = json.loads(stats.read_text())["settings"]
    assert (settings["samples"], settings["resolution"], settings["method"]) == (1, "32", "cones")


def test_time_limit_ends_after_the_first_sample_that_exceeds_it(saved, tmp_path):
    stats = tmp_path / "stats.json"
    out = str(tmp_path / "a.png")
    main(["render", str(saved), "--out", out, "--stats", str(stats), *QUICK, "--time-limit", "1e-9"])
    assert json.loads(stats.read_text())["n_samples"] == 1


def only_line(capsys):
    """The sentence of the one line on stderr."""
    out, err = capsys.readouterr()
    (line,) = err.splitlines()
    assert line.startswith("svo_engine: error: ")
    assert not out
    return line.removeprefix("svo_engine: error: ")


@pytest.mark.parametrize(("arguments", "sentence"), [
    (["render", "none.npz"], "There is no file 'none.npz'"),
    (["render", "none.blend"], "There is no file 'none.blend'"),
    (["render", "notes.txt"], "'notes.txt' is neither a .blend nor a .npz"),
    (["render", "."], "'.' is neither a .blend nor a .npz"),
    (["render", "garbage.npz"], "'garbage.npz' is not a saved scene"),
    (["render", "blind.npz"], "The scene in 'blind.npz' has no camera"),
    (["render", "scene.npz", "--frame", "2"], "--frame is for a .blend; 'scene.npz' holds one frame"),
    (["render", "scene.npz", "--set", "none=1"], "There is no setting 'none'"),
    (["render", "scene.npz", "--samples", "0"], "Setting 'samples' is 0; it must lie between 1 and 65536"),
    (["render", "scene.npz", "--samples", "many"], "Setting 'samples' needs a value of type int, not 'many'"),
    (["render", "scene.npz", "--method", "guess"], "Setting 'method' is 'guess'"),
    (["render", "scene.npz", "--out", "a.jpg"], "Cannot write 'a.jpg': its ending must be .png or .exr"),
    (["render", "scene.npz", "--out", "garbage.npz/below.png"], "Cannot write 'garbage.npz/below.png'"),
    (["render", "scene.npz", "--out", "/proc/none/"], "Cannot write '/proc/none/scene.png'"),
    (["render", "scene.npz", "--stats", "/proc/none.json"], "Cannot write '/proc/none.json'"),
    (["extract", "scene.npz", "other.npz"], "'scene.npz' is no .blend"),
    (["extract", "none.blend", "scene.txt"], "Cannot write 'scene.txt': its ending must be .npz"),
    (["compare", "scene.npz", "--out", "here"], "'scene.npz' is no .blend"),
])
def test_mistake_is_told_in_one_line(saved, tmp_path, monkeypatch, capsys, arguments, sentence):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "garbage.npz").write_bytes(b"garbage")
    store.save(replace(store.load(saved), camera=None), tmp_path / "blind.npz")
    before = set(tmp_path.rglob("*"))
    assert main(arguments) == 1
    assert only_line(capsys).startswith(sentence)
    assert set(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(("arguments", "word"), [
    ([], "COMMAND"),
    (["paint"], "paint"),
    (["render"], "FILE"),
    (["render", "scene.npz", "--size", "10"], "'10' is no size"),
    (["render", "scene.npz", "--size", "0x10"], "'0x10' is no size"),
    (["render", "scene.npz", "--set", "samples"], "'samples' is not NAME=VALUE"),
    (["render", "scene.npz", "--frame", "1.5"], "'1.5' is no whole number"),
    (["render", "scene.npz", "--frame", "9999999999"], "'9999999999' is no whole number"),
    (["compare", "scene.blend"], "--out"),
])
def test_arguments_without_sense_exit_with_2(capsys, arguments, word):
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 2
    assert word in capsys.readouterr().err.splitlines()[-1]


def test_blend_without_blender(root, tmp_path):
    (tmp_path / "a.blend").touch()
    for arguments in (["render"], ["extract", tmp_path / "a.npz"], ["compare", "--out", tmp_path / "out"]):
        done = run(root, arguments[0], tmp_path / "a.blend", *arguments[1:])
        assert (done.returncode, done.stderr.count("\n")) == (1, 1)
        assert "pip install bpy" in done.stderr
        assert ".npz" in done.stderr


def test_missing_file_format_names_its_package(root, saved, tmp_path):
    done = run(root, "render", saved, "--out", tmp_path / "a.png", *QUICK, missing=("bpy", "PIL"))
    assert (done.returncode, done.stderr) == (1, "svo_engine: error: the module PIL is missing (pip install pillow)\n")


def test_picture_that_was_there_stays_until_there_is_a_new_one(saved, tmp_path, monkeypatch, capsys):
    def films(*_args, **_more):
        raise GpuError("The device is gone")
        yield

    monkeypatch.setattr(Session, "films", films)
    (tmp_path / "a.png").write_bytes(b"precious")
    assert main(["render", str(saved), "--out", str(tmp_path / "a.png")]) == 1
    assert only_line(capsys) == "The device is gone"
    assert (tmp_path / "a.png").read_bytes() == b"precious"


def test_interrupt_has_its_own_exit_code(saved, tmp_path, monkeypatch, capsys):
    def films(*_args, **_more):
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr(Session, "films", films)
    assert main(["render", str(saved), "--out", str(tmp_path / "a.png")]) == 130
    assert only_line(capsys) == "interrupted"


def test_info_shows_versions_and_device(capsys):
    assert main(["info"]) == 0
    shown = capsys.readouterr().out
    session = Session()
    assert all(value in shown for value in (__version__, np.__version__, *session.device_info().values()))
    session.close()


def test_info_without_a_device_fails_after_the_versions(monkeypatch, capsys):
    def device_info(_session):
        raise GpuError("OpenGL 4.3 is missing")

    monkeypatch.setattr(Session, "device_info", device_info)
    assert main(["info"]) == 1
    out, err = capsys.readouterr()
    assert __version__ in out
    assert err == "svo_engine: error: OpenGL 4.3 is missing\n"


def test_help_of_render_names_every_setting(capsys):
    with pytest.raises(SystemExit):
        main(["render", "--help"])
    shown = capsys.readouterr().out
    assert all(f"  {name}=" in shown for name in specs())
