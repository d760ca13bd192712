"""Back-ends of the program's own: where the layers of a run go."""

from __future__ import annotations

import abc
import itertools
from collections.abc import Sequence
from ctypes import c_void_p
from dataclasses import dataclass
from typing import Any

from . import _abi
from ._call import Callback
from ._errors import CallError, InputError
from ._job_info import JobInfo, job_info
from ._section import Section, SectionInfo, section_info


@dataclass(frozen=True)
class Product:
    """What `Backend.render` made of a layer, with areas for the run's report where they are known."""

    data: Any
    area: float = 0.0  # solid area of the part, mm^2
    support_area: float = 0.0  # of its supports, mm^2


class Backend(abc.ABC):
    """Where layers go. What a method raises ends the run and is the `__cause__` of its error; a
    `StoppedError` stops it."""

    def begin(self, job: JobInfo, layers: range, resume: bool, force: bool) -> int | None:
        """Before the first of the layers. Where the run is resumed, returns the first one that is not there
        yet; None stands for the first of all."""
        if resume:
            raise InputError("this back-end cannot continue what was begun; accepted: a new run")
        return None

    @abc.abstractmethod
    def render(self, section: Section) -> Any:
        """Computes what will be written of a layer: several threads at once, layers in any order. The section
        is lent until this returns. Returns anything, or a `Product`."""

    @abc.abstractmethod
    def write(self, layer: SectionInfo, product: Any) -> None:
        """Writes what `render` returned for a layer: one layer at a time, in order, by whichever thread."""

    def end(self) -> None:
        """After the last layer, when all went well."""


class HostBackend(Callback):
    """A back-end as the library calls it."""

    def __init__(self, backend: Backend, callbacks: Sequence[Callback]) -> None:
        super().__init__()
        if not isinstance(backend, Backend):
            raise CallError(f"backend: must be a lamella.Backend, not {type(backend).__name__}")
        self._backend = backend
        self._callbacks = callbacks  # of the job, which sections run
        self._products: dict[int, Any] = {}  # that the library holds, by what it knows them as
        self._names = itertools.count(1)
        self.struct = _abi.Backend(
            begin=_abi.BEGIN(self._begin),
            render=_abi.RENDER(self._render),
            write=_abi.WRITE(self._write),
            end=_abi.END(self._end),
            drop=_abi.DROP(self._drop),
        )

    def _begin(self, _user: int, job: Any, first: int, last: int, flags: int, missing: Any) -> int:
        return self.guarded(self._do_begin, job, range(first, last), flags, missing)

    def _do_begin(self, job: Any, layers: range, flags: int, missing: Any) -> None:
        resume, force = bool(flags & _abi.RESUME), bool(flags & _abi.FORCE)
        found = self._backend.begin(job_info(job.contents), layers, resume, force)
        missing[0] = layers.start if found is None else found

    def _render(self, _user: int, _context: int, section: int, product: Any) -> int:
        return self.guarded(self._do_render, section, product)

    def _do_render(self, pointer: int, product: Any) -> None:
        # The library's own: taken back when this returns, not destroyed.
        section = Section(c_void_p(pointer), lambda pointer: None, self._callbacks)
        try:
            made = self._backend.render(section)
        finally:
            section._take_back()
        if isinstance(made, Product):
            product.contents.area, product.contents.support_area = made.area, made.support_area
        name = next(self._names)
        self._products[name] = made
        product.contents.data = name

    def _write(self, _user: int, layer: Any, product: Any) -> int:
        return self.guarded(self._do_write, layer, product)

    def _do_write(self, layer: Any, product: Any) -> None:
        made = self._products[product.contents.data]
        self._backend.write(section_info(layer.contents), made)

    def _end(self, _user: int) -> int:
        return self.guarded(self._backend.end)

    def _drop(self, _user: int, data: int) -> None:
        self._products.pop(data, None)
