"""The library's memory as numpy arrays."""

from __future__ import annotations

from typing import Any

import numpy as np


class _Lent:
    """Memory that numpy looks at where it lies."""

    def __init__(self, address: int, shape: tuple[int, ...], kind: str, read_only: bool) -> None:
        self.__array_interface__ = {
            "version": 3,
            "data": (address, read_only),
            "shape": shape,
            "typestr": kind,
        }


def lent(address: int | None, shape: tuple[int, ...], dtype: Any, writable: bool = False) -> np.ndarray:
    """An array over memory that is not ours: to be read or written at once, never to be handed out."""
    if address is None or 0 in shape:
        return np.empty(shape, dtype)
    return np.asarray(_Lent(address, shape, np.dtype(dtype).str, not writable))


def copied(address: int | None, shape: tuple[int, ...], dtype: Any) -> np.ndarray:
    """An array of our own with what lies there."""
    return lent(address, shape, dtype).copy()
