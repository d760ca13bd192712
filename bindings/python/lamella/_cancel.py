"""Stopping long work, by a token or by Ctrl-C."""

from __future__ import annotations

import threading
from collections.abc import Callable
from ctypes import byref, c_void_p
from typing import TypeVar

from ._abi import library
from ._call import call
from ._errors import CallError
from ._handle import Handle

Result = TypeVar("Result")
SIGNALS_AT_LEAST_EVERY = 0.2  # s: one that another thread took does not wake the main thread


class Cancel(Handle):
    """A token that stops the work it is given to, which then raises `StoppedError`."""

    _shared = True

    def __init__(self) -> None:
        pointer = c_void_p()
        call(library.lamella_cancel_create, byref(pointer))
        super().__init__(pointer, library.lamella_cancel_destroy)
        self._requested = False

    def request(self) -> None:
        """Asks all work that has this token to stop. From any thread or signal handler; for good."""
        with self._used() as pointer:
            self._requested = True
            library.lamella_cancel_request(pointer)

    @property
    def requested(self) -> bool:
        return self._requested


def stoppable(work: Callable[[c_void_p], Result], cancel: Cancel | None) -> Result:
    """Does long work with a token. In the main thread Ctrl-C requests it: signals are handled only where
    Python runs, so another thread does the work and the main thread waits."""
    if cancel is not None and not isinstance(cancel, Cancel):
        raise CallError(f"cancel: must be a Cancel, not {type(cancel).__name__}")
    token = Cancel() if cancel is None else cancel
    with token._used() as pointer:
        if threading.current_thread() is not threading.main_thread():
            return work(pointer)
        return _waited_for(lambda: work(pointer), token)


def _waited_for(work: Callable[[], Result], token: Cancel) -> Result:
    done = threading.Event()
    results: list[Result] = []
    failures: list[BaseException] = []

    def run() -> None:
        try:
            results.append(work())
        except BaseException as error:
            failures.append(error)
        finally:
            done.set()

    threading.Thread(target=run, name="lamella").start()
    interrupt: BaseException | None = None
    while not done.is_set():
        try:
            done.wait(SIGNALS_AT_LEAST_EVERY)
        except BaseException as error:  # what a signal handler raised
            interrupt = interrupt or error
            token.request()
    if interrupt is not None:
        raise interrupt
    if failures:
        raise failures.pop()
    return results.pop()
