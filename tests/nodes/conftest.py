# SPDX-License-Identifier: GPL-3.0-or-later
"""The tests' one context."""

from tests.on_gpu import device, pytest_pyfunc_call, session

__all__ = ["device", "pytest_pyfunc_call", "session"]
