# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.house`: print every breach of the rules of the house; the exit code says whether there is one."""

from __future__ import annotations

import sys
from pathlib import Path

from svo_engine.scene import layouts

from . import glslang, layers, programs, references, shaders, text

ROOT = Path(__file__).resolve().parents[2]


def main() -> int:
    """Check the whole tree."""
    committed = (ROOT / "shaders/lib/layouts.glsl").read_text()
    found = [*layers.breaches(ROOT), *shaders.breaches(ROOT), *text.breaches(ROOT), *references.breaches(ROOT),
             *programs.breaches(ROOT), *shaders.layout_breaches(layouts.glsl(), committed)]
    if glslang.is_here():
        found += glslang.breaches(ROOT)
    else:
        print(glslang.MISSING)
    print("\n".join(found) or "The house is in order.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
