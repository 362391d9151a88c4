# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m svo_engine`: see `cli/`."""

import sys

from .cli import main

sys.exit(main())
