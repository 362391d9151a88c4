# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules for programs hold in this tree, and each of them catches a breach."""

from __future__ import annotations

from pathlib import Path

import pytest

from svo_engine.passes.programs import all_programs
from svo_engine.passes.variants import VARIANTS
from tools.house import programs

ENTRY = "a/x.comp.glsl"
BLOCK = "layout(std430) buffer B{0} {{ uint b{0}[]; }};\n"


@pytest.fixture
def house(tmp_path) -> Path:
    """A tree without a breach."""
    write(tmp_path, "shaders/bind/trace.glsl", "const bool IS_FLAT = false;\n")
    write(tmp_path, "shaders/bind/through.glsl", '#include "bind/trace.glsl"\n')
    for name in programs.MATERIALS:
        write(tmp_path, f"shaders/{name}", "// materials\n")
    write(tmp_path, "shaders/lib/layouts.glsl", "const uint KIND = 0u;\n")
    write(tmp_path, f"shaders/{ENTRY}", '#include "bind/through.glsl"\n' + "".join(map(BLOCK.format, range(16))))
    write(tmp_path, programs.VARIANTS, 'VARIANTS = {\n    "IS_FLAT": "a third "\n               "quicker",\n}\n')
    write(tmp_path, "svo_engine/a.py", 'FLAT = {"IS_FLAT": True, "KIND": 0}\n')
    return tmp_path


def write(root: Path, name: str, text: str) -> None:
    (root / name).parent.mkdir(parents=True, exist_ok=True)
    (root / name).write_text(text)


def test_the_tree_keeps_the_rules(root):
    assert programs.breaches(root) == []


def test_all_constants_of_all_programs_have_a_reason():
    set_ = {name for is_software in (False, True) for _, given in all_programs(is_software) for name in given}
    assert set_ == VARIANTS.keys()


def test_a_house_without_breaches_has_none(house):
    assert programs.breaches(house) == []


@pytest.mark.parametrize("name", programs.MATERIALS)
def test_a_program_that_traces_and_knows_materials_is_caught(house, name):
    write(house, f"shaders/{ENTRY}", f'#include "bind/through.glsl"\n#include "{name}"\n')
    (sentence,) = programs.breaches(house)
    assert sentence.startswith(f"shaders/{ENTRY}:1: traces rays") and name in sentence


def test_a_program_that_knows_materials_alone_passes(house):
    write(house, f"shaders/{ENTRY}", "".join(f'#include "{name}"\n' for name in programs.MATERIALS))
    assert programs.breaches(house) == []


def test_too_many_storage_blocks_are_caught(house):
    write(house, f"shaders/{ENTRY}", "".join(map(BLOCK.format, range(17))))
    (sentence,) = programs.breaches(house)
    assert sentence == f"shaders/{ENTRY}:1: has 17 storage blocks; there may be 16"


def test_a_constant_that_is_set_without_a_reason_is_caught_at_its_line(house):
    write(house, "shaders/lib/y.glsl", "const int N_LAMPS = 0;\n")
    assert programs.breaches(house) == []
    write(house, "svo_engine/b.py", 'def f(n):\n    return {"IS_FLAT": True, "N_LAMPS": n}\n')
    (sentence,) = programs.breaches(house)
    assert sentence.startswith("svo_engine/b.py:2: sets the constant 'N_LAMPS'")


@pytest.mark.parametrize(("text", "blamed"), [
    ('VARIANTS = {"IS_FLAT": " "}\n', "needs a reason"),
    ('VARIANTS = {"IS_FLAT": "quick", "GONE": "quick"}\n', "'GONE' is no constant"),
    ("OTHER = {}\n", "sets the constant 'IS_FLAT'"),
])
def test_a_list_that_does_not_fit_is_caught(house, text, blamed):
    write(house, programs.VARIANTS, text)
    (sentence,) = programs.breaches(house)
    assert blamed in sentence
