"""Objects of the library, owned by objects of Python."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from ctypes import c_void_p
from typing import Any, TypeVar

from ._errors import CallError

Self = TypeVar("Self", bound="Handle")


def _destroy(destroy: Callable[[c_void_p], None], pointer: c_void_p, keeps: Any) -> None:
    # `keeps` is here to live as long as the object does, in whatever order Python lets go of things.
    destroy(pointer)


class Handle:
    """An object of the library's. It is destroyed when it is closed, when a `with` ends, or by itself."""

    _shared = False  # whether several threads may use it at once

    def __init__(self, pointer: c_void_p, destroy: Callable[[c_void_p], None], keeps: Any = None) -> None:
        self._pointer = pointer
        self._uses = 0
        self._idle = threading.Condition()
        self._alive = weakref.finalize(self, _destroy, destroy, pointer, keeps)

    @contextmanager
    def _used(self) -> Iterator[c_void_p]:
        """Lends the pointer to a call, during which it cannot be closed."""
        name = type(self).__name__
        with self._idle:
            if not self._alive.alive:
                raise CallError(f"this {name} is closed; it has to be open for that")
            if self._uses > 0 and not self._shared:
                raise CallError(f"this {name} is being used by another call; each thread needs its own one")
            self._uses += 1
        try:
            yield self._pointer
        finally:
            with self._idle:
                self._uses -= 1
                self._idle.notify_all()

    def close(self) -> None:
        """Frees what it holds; closing twice does nothing."""
        with self._idle:
            if self._uses > 0:
                name = type(self).__name__
                raise CallError(f"this {name} is being used by a call, which has to return first")
            self._alive()

    def _take_back(self) -> None:
        """Closes it, waiting for calls of other threads."""
        with self._idle:
            self._idle.wait_for(lambda: self._uses == 0)
            self._alive()

    @property
    def closed(self) -> bool:
        return not self._alive.alive

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
