# SPDX-License-Identifier: GPL-3.0-or-later
"""Every node of Blender's shader editor and every mode of it beside Cycles."""
