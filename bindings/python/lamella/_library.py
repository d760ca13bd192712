"""Where Lamella's shared library lies."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import sys
from collections.abc import Iterator
from pathlib import Path

VARIABLE = "LAMELLA_LIBRARY"
if sys.platform == "win32":
    FILE = "lamella.dll"
elif sys.platform == "darwin":
    FILE = "liblamella.1.dylib"
else:
    FILE = "liblamella.so.1"


def _places() -> Iterator[str]:
    """What to load, the first that can be loaded; the system's own search comes last."""
    beside = Path(__file__).resolve().parent / FILE
    if beside.exists():
        yield str(beside)
    yield FILE
    # Asked only where the loader did not find it by itself: on some systems this runs other programs.
    found = ctypes.util.find_library("lamella")
    if found is not None:
        yield found


def load() -> tuple[ctypes.CDLL, str]:
    """The library and what it was found as. Where the variable is set, nothing else is tried."""
    asked = os.environ.get(VARIABLE)
    failures = []
    for place in [asked] if asked else _places():
        try:
            return ctypes.CDLL(place), place
        except OSError as error:
            failures.append(str(error))
    raise ImportError(
        f"Lamella's library cannot be loaded: {'; '.join(failures)}. "
        f"Set {VARIABLE} to the path of {FILE}, or install it where the system looks for libraries."
    )
