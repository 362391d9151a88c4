# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV files in, pages and plots out."""
