# SPDX-License-Identifier: GPL-3.0-or-later
"""SVO: a voxel global illumination render engine for Blender.

The package imports without bpy; only `svo_engine.blender` needs it. The frame is in `render.py`, the data that it
renders in `scene/`. `docs/architecture.md` has the picture.
"""

__version__ = "0.1.0"
