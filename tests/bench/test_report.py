# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables go through files unchanged, and pages say what is in them."""

from __future__ import annotations

import math

import pytest

from svo_engine.bench import host, tables
from svo_engine.bench.tables import Edited, Rendered, Scaled, Skipped, Timed, Watched
from svo_engine.bench.verdicts import verdicts
from svo_engine.errors import SvoError

pytest.importorskip("matplotlib")
from svo_engine.bench import report
from svo_engine.bench.report.markdown import number

NAN = math.nan


def rendered(renderer, n, seconds, error, kind="render"):
    error = float(f"{error:.6g}")  # as many digits as tables have
    return Rendered("box", "8x6", "card", kind, renderer, f"{n} samples", n, seconds, seconds, seconds, 3,
                    "gather 3; octree 1.5", 1024, 0.5, error, error, NAN, 0.01, NAN)


# Ours: error 1e-3 / t; the peer: 1e-3 / t^2. They meet at 1 s
LADDER = [*(rendered("rays", n, t, 1e-3 / t) for n, t in ((1, 0.1), (100, 10.0))),
          rendered("rays", 1, 0.01, 1e-2, kind="camera"),
          *(rendered("cycles-oidn", n, t, 1e-3 / t**2) for n, t in ((1, 0.1), (100, 10.0)))]
EDITS = [Edited("box", "8x6", "card", "rays", "lamp moved", 0.05, 0.03, 0.02, 0, 3, "cache 12")]
WATCHED = [Watched("box", "8x6", "card", "lamp moved", 0.04, 0.5, 0.002, 0.007, 0, 3),
           Watched("box", "8x6", "card", "F12", NAN, 0.6, NAN, 0.006, 1, 3)]
SKIPPED = [Skipped("light", has_it, skips, "8x6", "card", 0.02, 0.01, 3, skips, 2**20, 40, 96, 48, 24,
                   *[0 if skips else 5] * 5)
           for has_it in (True, False) for skips in (True, False)]
TIMES = [*(Timed("box", 5000, "card", what, n, 7, 0.5, 1.0, 3, "voxelize/mark 0.5")
           for n in (64, 128) for what in ("occupancy", "voxels")),
         Timed("box", 5000, "card", "whole frame", 128, 0, 2.0, 3.0, 3, "gather 2"),
         *(Timed(f"ball {n}", n, "card", "voxels", 128, 7, n / 1e3, 1.0, 3, "") for n in (1000, 10000))]
SCALES = [Scaled("triangles", "card", float(n), n / 1e3, 3, f"bvh/sort {n / 2}; gather/rays 1e-6", 10 * n)
          for n in (10, 100, 1000, 10000)]
TABLES = {Rendered: LADDER, Edited: EDITS, Watched: WATCHED, Skipped: SKIPPED, Timed: TIMES, Scaled: SCALES}


@pytest.fixture
def folder(tmp_path):
    for kind, rows in TABLES.items():
        tables.write(tmp_path / "data/machine", kind, rows)
    host.write(tmp_path / "data/machine", "card")
    return tmp_path


def as_text(rows):
    return [str(row) for row in rows]  # nan is not equal to itself


def test_tables_come_back_as_they_were(folder):
    for kind, rows in TABLES.items():
        assert as_text(tables.read(folder / "data/machine", kind)) == as_text(rows)
    assert tables.read(folder, Rendered) == []


def test_what_others_measured_stands_in_a_file_beside(folder):
    tables.write(folder / "x", Rendered, LADDER[:1])
    (folder / "x/ladder.csv").rename(folder / "data/machine/ladder_peers.csv")
    assert len(tables.read(folder / "data/machine", Rendered)) == len(LADDER) + 1


@pytest.mark.parametrize("text", ["scene,size\nbox,8x6\n", "x\n1\n"])
def test_a_file_that_is_no_table_is_named(tmp_path, text):
    (tmp_path / "ladder.csv").write_text(text)
    with pytest.raises(SvoError, match=r"ladder\.csv"):
        tables.read(tmp_path, Rendered)


def test_parts_are_packed_and_added_by_stage():
    parts = {"gather/rays": 1.25, "read back": 0.5, "gather/sort": 2.0}
    assert tables.unpack(tables.pack(parts)) == parts
    assert tables.stages(parts) == {"gather": 3.25, "read back": 0.5}
    assert tables.unpack("") == {}


def test_verdict_of_a_ladder():
    (found,) = verdicts(LADDER)
    assert (found.scene, found.peer) == ("box", "cycles-oidn")
    assert found.crossing == pytest.approx(1)
    assert found.by_error == pytest.approx([10, 0.1])
    assert found.by_time == pytest.approx([1, 0])  # quicker than our first picture we are not; 1e-5 we never reach
    assert "crossover at 1 s" in found.sentence() and "(1 of 2 rungs)" in found.sentence()


def test_a_frame_that_redoes_less_counts_for_no_verdict():
    assert not list(verdicts([row for row in LADDER if row.kind == "camera" or row.renderer != "rays"]))


def test_pages_and_plots(folder):
    pages = report.write(folder)
    assert [page.name for page in pages] == ["speed.md", "edits.md", "skipping.md", "thesis.md", "scaling.md"]
    speed, edits, skipping, thesis, scaling = (page.read_text() for page in pages)
    assert "crossover at 1 s" in speed and "| rays | 1 samples | 1 | 100 ms | 3 |" in speed
    assert "noise is not known" in speed
    assert "| lamp moved | 50.0 | 30.0 | 20.0 | 1.50 | 0 | 3 | cache 12.0 |" in edits
    assert "| lamp moved | 40.0 | 500 | 2.00 | 7.00 | 0 |" in edits and "| F12 | - | 600 | - | 6.00 | 1 |" in edits
    assert "| **light**: without, all | 20.0 | 10.0 | 1.00 | no | 40 | 96 | 48 | 24 | 5 | 5 | 5 | 5 | 5 |" in skipping
    assert "box: 0 steps of specular paths, 0 invocations" in skipping
    assert "| 128 | 0.500 | 1.00 | 0.500 | 1.00 | 9.50 | 0.300 | 7 |" in thesis and "to the power 1.00" in thesis
    assert "| bvh | 1.00 | 1.00 |" in scaling and "| memory | 1.00 | 1.00 |" in scaling and "gather" not in scaling
    for name in ("machine_box_8x6.png", "machine_scaling.png"):
        assert (folder / name).read_bytes().startswith(b"\x89PNG")
        assert name in speed + scaling


def test_the_same_tables_give_the_same_files(folder):
    report.write(folder)
    first = {path.name: path.read_bytes() for path in folder.glob("*.*")}
    report.write(folder)
    assert first == {path.name: path.read_bytes() for path in folder.glob("*.*")}


def test_nothing_to_report_is_a_sentence(tmp_path):
    with pytest.raises(SvoError, match="There are no tables"):
        report.write(tmp_path)


def test_the_committed_tables_can_be_read(root):
    folders = [path for path in (root / "docs/benchmarks/data").iterdir() if path.is_dir()]
    assert folders
    for path in folders:
        assert any(tables.read(path, kind) for kind in tables.FILES)


@pytest.mark.parametrize(("value", "text"), [(0, "0"), (NAN, "-"), (1234.5, "1,234"), (0.00012345, "0.000123"),
                                             (2.0, "2.00"), (0.9999, "1.00"), (-0.5, "-0.500")])
def test_numbers(value, text):
    assert number(value) == text
