"""Calls into the library: each has a context, and what fails becomes an exception."""

from __future__ import annotations

import os
import threading
import weakref
from collections.abc import Callable, Iterable
from ctypes import byref, c_void_p
from typing import Any

from . import _abi
from ._abi import library
from ._errors import CallError, Error, FaultError, by_status


class _Context:
    """What a thread needs to call; gone with it."""

    def __init__(self) -> None:
        pointer = c_void_p()
        status = library.lamella_context_create(_abi.VERSION, byref(pointer))
        if status != _abi.OK:
            raise by_status.get(status, FaultError)("no context could be made for this thread")
        self.pointer = pointer
        weakref.finalize(self, library.lamella_context_destroy, pointer)


class _Idle(threading.local):
    """A thread's contexts that no call is using: a callback's calls are made while the outer one still runs,
    and need another one."""

    def __init__(self) -> None:
        self.contexts: list[_Context] = []


_idle = _Idle()


class _Underway:
    """A call that has not returned yet, and what a callback of its raised first."""

    def __init__(self) -> None:
        self.thread = threading.get_ident()
        self.raised: BaseException | None = None


class Callback:
    """A function of Python's that the library calls. What it raises comes out of the call that ran it."""

    def __init__(self) -> None:
        self._calls: list[_Underway] = []  # those that may run it; appending and removing need no lock

    def enter(self, call: _Underway) -> None:
        self._calls.append(call)

    def leave(self, call: _Underway) -> None:
        self._calls.remove(call)

    def guarded(self, work: Callable[..., None], *arguments: Any) -> int:
        """Does the work of a callback; returns the status for the library."""
        try:
            work(*arguments)
            return _abi.OK
        except BaseException as error:
            self._hand_over(error)
            if isinstance(error, Error):
                return error.status
            return FaultError.status if isinstance(error, Exception) else _abi.STOPPED

    def _hand_over(self, error: BaseException) -> None:
        """To the innermost call of this thread. A thread of the library's own has none: then whichever call
        this fails has to raise it, and no other one looks."""
        calls = list(self._calls)
        mine = [call for call in calls if call.thread == threading.get_ident()]
        for call in mine[-1:] or calls:
            if call.raised is None:
                call.raised = error


def coded(given: object, what: str) -> bytes:
    """Text for the library."""
    if not isinstance(given, str):
        raise CallError(f"{what}: must be a text, not {type(given).__name__}")
    if "\0" in given:
        raise CallError(f"{what}: must not hold a character of value 0")
    try:
        return given.encode("utf-8", "surrogateescape")  # which is how Python writes paths that are no UTF-8
    except UnicodeEncodeError as error:
        raise CallError(f"{what}: is no text that UTF-8 could write: {error}") from error


def coded_path(given: str | os.PathLike[str], what: str) -> bytes:
    """A path for the library."""
    return coded(os.fspath(given) if isinstance(given, os.PathLike) else given, what)


def call(function: Callable[..., int], *arguments: Any, callbacks: Iterable[Callback] = ()) -> None:
    """Calls a function that takes a context and returns a status; `callbacks` are those that it may run."""
    underway = _Underway()
    context = _idle.contexts.pop() if _idle.contexts else _Context()
    for callback in callbacks:
        callback.enter(underway)
    try:
        status = function(context.pointer, *arguments)
        if status != _abi.OK:
            _fail(context, underway.raised)
    finally:
        for callback in callbacks:
            callback.leave(underway)
        _idle.contexts.append(context)


def _fail(context: _Context, raised: BaseException | None) -> None:
    if raised is not None and not isinstance(raised, Exception):
        raise raised  # an interrupt or an exit passes through as what it is
    told = _abi.Error()
    library.lamella_last_error(context.pointer, byref(told))
    message = (told.message or b"").decode(errors="replace")
    if raised is not None:
        message += f": {type(raised).__name__}: {raised}"
    path = (told.path or b"").decode(errors="replace")
    raise by_status.get(told.status, FaultError)(message, path or None, told.line or None) from raised
