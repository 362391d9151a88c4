# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of the sky, computed on the host as tables from which shaders read: numpy only."""
