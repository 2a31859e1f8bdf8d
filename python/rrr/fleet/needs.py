"""What a fleet needs beyond the module itself."""

from __future__ import annotations

import importlib
from types import ModuleType

from rrr._rrr import Error


def needed(module: str) -> ModuleType:
    """A module of the extra `fleet`, or an error that says how to install it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.split(".")[0]
        raise Error(
            f"{package} is not installed, and a fleet needs it ({error})\nhint: pip install 'rrr[fleet]'"
        ) from error
