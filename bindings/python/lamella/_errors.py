"""What goes wrong, as exceptions."""

from __future__ import annotations


class Error(Exception):
    """A call that failed; the message says what was wrong and what would be right.

    `path` and `line` (from 1) tell the place in a recipe; None where it is not about one.
    """

    status = 3  # as the library and the command's exit codes have it

    def __init__(self, message: str, path: str | None = None, line: int | None = None) -> None:
        super().__init__(message)
        self.path = path
        self.line = line


class ConstraintError(Error):
    """A stated constraint does not hold."""

    status = 1


class InputError(Error):
    """A file, a key or a value is wrong; of a recipe's mistakes the message has a line each."""

    status = 2


class FaultError(Error):
    """The disk is full, the printer is gone, a callback failed (which then is the `__cause__`)."""

    status = 3


class CallError(Error, ValueError):
    """A number, a shape or an object that no call should have."""

    status = 4


class OutOfMemoryError(FaultError, MemoryError):
    """There is not enough memory."""

    status = 5


class StoppedError(Error):
    """A `Cancel` was requested, or a callback raised this one."""

    status = 130


_kinds = (ConstraintError, InputError, FaultError, CallError, OutOfMemoryError, StoppedError)
by_status: dict[int, type[Error]] = {kind.status: kind for kind in _kinds}
