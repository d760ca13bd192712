"""Options that building and running share."""

from __future__ import annotations

from collections.abc import Callable

from . import _abi
from ._call import Callback
from ._errors import CallError

OnProgress = Callable[[str, int, int], object]


class Progress(Callback):
    """Tells a function how far the work is."""

    def __init__(self, function: OnProgress | None) -> None:
        super().__init__()
        if function is not None and not callable(function):
            raise CallError(
                f"progress: must be a function of what, done and total, not {type(function).__name__}"
            )
        self._function = function
        self.pointer = _abi.PROGRESS() if function is None else _abi.PROGRESS(self._called)

    def _called(self, _user: int, what: bytes, done: int, total: int) -> int:
        return self.guarded(self._tell, what, done, total)

    def _tell(self, what: bytes, done: int, total: int) -> None:
        if self._function is not None:
            self._function(what.decode(), done, total)


def count_of_threads(given: int, what: str = "threads") -> int:
    if not isinstance(given, int) or given < 0:
        raise CallError(f"{what}: must be a whole number, 0 for what is usual, not {given!r}")
    return given
