# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark through Blender: a tiny ladder of each renderer that runs without a GPU."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest

from svo_engine.bench import tables
from svo_engine.bench.references import Reference, load, save
from svo_engine.blender import peers
from svo_engine.cli import main
from svo_engine.errors import SvoError

SCENE = Path(__file__).resolve().parents[2] / "sample_blends/cornell_suzanne_point.blend"


def bench(out, *more):
    return main(["bench", "--scenes", str(SCENE), "--out", str(out), "--size", "16x12", "--samples", "1", "2",
                 "--reference-samples", "8", "--time-limits", "1000", "--set", "cache_resolution=32", *more])


def test_ladders_beside_cycles(tmp_path, capsys):
    assert bench(tmp_path, "--renderers", "rays", "cycles", "cycles-oidn") == 0
    rows = tables.read(tmp_path, tables.Rendered)
    assert [(row.renderer, row.rung) for row in rows] == [
        (name, rung) for name in ("rays", "cycles", "cycles-oidn") for rung in ("1 sample", "2 samples")]
    assert all(row.kind == "render" and row.size == "16x12" and row.noise > 0 for row in rows)
    by_name = {(row.renderer, row.n_samples): row for row in rows}
    assert by_name["cycles-oidn", 1].error < by_name["cycles", 1].error
    assert "gather" in tables.unpack(by_name["rays", 1].parts) and by_name["cycles", 1].parts == ""
    (reference,) = (tmp_path / "references").iterdir()
    assert len(load(reference).halves) == 2
    assert not np.array_equal(*load(reference).halves)

    before = reference.read_bytes()
    assert bench(tmp_path, "--renderers", "cycles") == 0
    assert "is there and used" in capsys.readouterr().err
    assert reference.read_bytes() == before


def test_the_noise_of_a_stored_reference_is_told_by_its_samples(tmp_path):
    made = tmp_path / "made"
    assert bench(made, "--renderers", "cycles") == 0
    (path,) = (made / "references").iterdir()
    stored = tmp_path / "stored.npz"
    save(Reference(load(path).picture), stored)
    arguments = ["bench", "--scenes", str(SCENE), "--references", str(stored), "--out", str(tmp_path / "out"),
                 "--renderers", "cycles", "--samples", "1"]
    assert main(arguments) == 0
    assert np.isnan(tables.read(tmp_path / "out", tables.Rendered)[0].noise)
    noise = []
    for n_samples in ("100", "200"):
        assert main([*arguments, "--reference-samples", n_samples]) == 0
        (row,) = tables.read(tmp_path / "out", tables.Rendered)
        noise.append(row.noise)
        assert load(tmp_path / "out/references" / f"{SCENE.stem}.npz").noise == pytest.approx(row.noise, rel=1e-5)
        assert row.error == pytest.approx(row.rel_mse - row.noise, rel=1e-4)
    assert noise[0] == pytest.approx(2 * noise[1], rel=1e-5) and noise[0] > 0


def test_data_is_kept_from_render_to_render_and_settings_come_back():
    with peers.opened(SCENE, (8, 6)) as scene:
        was = scene.render.use_persistent_data, scene.render.engine, scene.cycles.use_denoising
        with peers.renderer(scene, "cycles-oidn", "cpu") as render:
            assert render({"samples": 1}).picture.shape == (6, 8, 3)
            assert scene.render.use_persistent_data and scene.cycles.use_denoising
        assert (scene.render.use_persistent_data, scene.render.engine, scene.cycles.use_denoising) == was


def test_eevee_has_its_name_in_this_blender():
    with peers.opened(SCENE, (8, 6)) as scene, peers.renderer(scene, "eevee", "cpu"):
        assert scene.render.engine in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items
        assert "EEVEE" in scene.render.engine


def test_a_gpu_that_is_not_there_is_a_sentence():
    with (peers.opened(SCENE, (8, 6)) as scene, pytest.raises(SvoError, match="no GPU"),
          peers.renderer(scene, "cycles", "gpu")):
        pytest.skip("Cycles has a GPU here")
