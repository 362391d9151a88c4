# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark: run time against error, beside Cycles and EEVEE; the thesis's tables; how times grow.

Measuring and reporting are two steps with CSV files between them, so that what one machine measured another reports.
Measuring needs the core alone (numpy and moderngl); only renders through Blender need bpy, in `blender/peers.py`,
and only `report/` needs libraries. No part of the extension's zip.
"""
