# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tests.golden.refresh`: render the kept pictures anew, on Mesa's software renderer.

Do so in a commit that says why they changed, after a look at them: each is written to out/ as .png too.
"""

from __future__ import annotations

import sys

from svo_engine.render import Session

from . import pictures


def main() -> int:
    """Write every picture."""
    session = Session()
    renderer = session.device_info()["renderer"]
    if pictures.RENDERER not in renderer:
        print(f"The pictures are those of {pictures.RENDERER}, and this is {renderer}", file=sys.stderr)
        return 1
    out = pictures.FOLDER.parents[1] / "out"
    out.mkdir(exist_ok=True)
    for name in pictures.SETTINGS:
        film = pictures.render(session, name)
        film.save(pictures.FOLDER / f"{name}.npz")
        film.save(out / f"golden_{name}.png")
        print(out / f"golden_{name}.png")
    session.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
