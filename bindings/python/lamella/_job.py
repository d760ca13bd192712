"""Jobs: recipes made."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from ctypes import byref, c_double, c_void_p
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from . import _abi
from ._abi import library
from ._backend import Backend, HostBackend
from ._call import Callback, call, coded_path
from ._cancel import Cancel, stoppable
from ._errors import CallError
from ._handle import Handle
from ._job_info import JobInfo, job_info
from ._progress import OnProgress, Progress, count_of_threads
from ._section import Section
from ._structure import MODELS, Structure, structure


@dataclass(frozen=True)
class Report:
    """What a run did."""

    layers_written: int
    layers_kept: int  # found finished when it was resumed
    volume: float  # material of the part in the layers written, mm^3
    support_volume: float  # of its supports, mm^3


class Job(Handle):
    """A recipe made, by `Recipe.build`. It never changes, and any number of threads may use it at once."""

    _shared = True

    def __init__(self, pointer: c_void_p, callbacks: Sequence[Callback]) -> None:
        super().__init__(pointer, library.lamella_job_destroy, callbacks)
        self._callbacks = callbacks
        told = _abi.JobInfo()
        with self._used() as used:
            call(library.lamella_job_info_get, used, byref(told))
            self.info: JobInfo = job_info(told)

    @property
    def layer_count(self) -> int:
        return self.info.layer_count

    @property
    def bounds(self) -> np.ndarray:
        """Of part and supports, (2, 3), mm; the bed lies at the lower z."""
        return self.info.bounds.copy()

    @property
    def layer_height(self) -> float:
        """Of the first layer, mm."""
        return self.info.layer_height

    def height_of(self, layer: int) -> float:
        """How high a layer is, mm."""
        height = c_double()
        with self._used() as pointer:
            call(library.lamella_job_layer_height, pointer, layer, byref(height))
        return height.value

    @property
    def has_supports(self) -> bool:
        return self.info.has_supports

    @property
    def name(self) -> str:
        """Of the part."""
        return self.info.name

    @property
    def identity(self) -> str:
        """32 digits: jobs that share them make the same layers."""
        return self.info.identity

    def layer_z(self, layer: int) -> float:
        """The height at which a layer is cut, half-way up: mm in part coordinates."""
        z = c_double()
        with self._used() as pointer:
            call(library.lamella_job_layer_z, pointer, layer, byref(z))
        return z.value

    def values(self, points: ArrayLike) -> np.ndarray:
        """The part's field at points (n, 3), mm: (n,), below zero inside."""
        places = np.ascontiguousarray(points, np.float64)
        if places.ndim != 2 or places.shape[1] != 3:
            raise CallError(f"points: must have shape (n, 3), not {places.shape}")
        values = np.empty(len(places))
        with self._used() as pointer:
            call(
                library.lamella_job_values,
                pointer,
                places.ctypes.data,
                len(places),
                values.ctypes.data,
                callbacks=self._callbacks,
            )
        return values

    def structure(self) -> Structure:
        """How the part bears its loads: the result of the search that `[optimize]` asks for, or an analysis
        where there was none.
        """
        told = _abi.Structure()
        with self._used() as pointer:
            call(library.lamella_job_structure, pointer, None, byref(told), callbacks=self._callbacks)
        return structure(told)

    def analyse(
        self, model: str = "auto", *, elements: int = 0, threads: int = 0, cancel: Cancel | None = None
    ) -> Structure:
        """Analyses the part under the recipe's loads. Model "elements" takes the elements inside it, "law" the
        foam's, "auto" the law if it is known. `elements` along the longest side, 0: as many as usual.
        """
        if model not in MODELS:
            raise CallError(f"model: must be one of {', '.join(MODELS)}, not {model!r}")
        options = _abi.AnalysisOptions(
            model=MODELS.index(model), elements=elements, threads=count_of_threads(threads)
        )
        told = _abi.Structure()

        def work(job: c_void_p, token: c_void_p) -> None:
            options.cancel = token
            call(
                library.lamella_job_structure, job, byref(options), byref(told), callbacks=self._callbacks
            )

        with self._used() as pointer:
            stoppable(lambda token: work(pointer, token), cancel)
        return structure(told)

    def section(self, z: float) -> Section:
        """Cuts the job at any height, mm in part coordinates."""
        return self._cut(library.lamella_section_open, float(z))

    def layers(self, first: int = 0, last: int | None = None) -> Iterator[Section]:
        """Sections of the layers from `first` up to, not including, `last`, each cut when it is asked for."""
        begin, end = self._range(first, last)
        return (self._cut(library.lamella_section_open_layer, layer) for layer in range(begin, end))

    def _cut(self, opens: Callable[..., int], where: float) -> Section:
        made = c_void_p()
        with self._used() as pointer:
            call(opens, pointer, where, byref(made), callbacks=self._callbacks)
        return Section(made, library.lamella_section_destroy, self._callbacks)

    def run(
        self,
        output: str | os.PathLike[str],
        *,
        resume: bool = False,
        force: bool = False,
        first: int = 0,
        last: int | None = None,
        threads: int = 0,
        look_ahead: int = 0,
        progress: OnProgress | None = None,
        cancel: Cancel | None = None,
    ) -> Report:
        """Streams layers to a file or folder, as `lamella slice -o` does: PATH, or PATH@PROFILE for another
        machine than the recipe's. `resume` continues an unfinished output of the same job, `force` replaces
        one that exists. Layers go from `first` up to, not including, `last`; at most `look_ahead` are in
        flight, 0: two per thread. `progress("layers", done, total)` is called after each one, from whichever
        thread.

        A run that is stopped or fails leaves what it has under an unfinished name, for `resume`.
        """
        path = coded_path(output, "output")
        return self._stream(
            lambda pointer, options, report, callbacks: call(
                library.lamella_run, pointer, path, options, report, callbacks=callbacks
            ),
            (),
            resume=resume,
            force=force,
            layers=self._range(first, last),
            threads=threads,
            look_ahead=look_ahead,
            progress=progress,
            cancel=cancel,
        )

    def run_to(
        self,
        backend: Backend,
        *,
        resume: bool = False,
        force: bool = False,
        first: int = 0,
        last: int | None = None,
        threads: int = 0,
        look_ahead: int = 0,
        progress: OnProgress | None = None,
        cancel: Cancel | None = None,
    ) -> Report:
        """Streams layers to a back-end of the program's own; all else is as of `run`."""
        host = HostBackend(backend, self._callbacks)
        return self._stream(
            lambda pointer, options, report, callbacks: call(
                library.lamella_run_backend,
                pointer,
                byref(host.struct),
                options,
                report,
                callbacks=callbacks,
            ),
            (host,),
            resume=resume,
            force=force,
            layers=self._range(first, last),
            threads=threads,
            look_ahead=look_ahead,
            progress=progress,
            cancel=cancel,
        )

    def _stream(
        self,
        start: Callable[..., None],
        own: tuple[Callback, ...],
        *,
        resume: bool,
        force: bool,
        layers: tuple[int, int],
        threads: int,
        look_ahead: int,
        progress: OnProgress | None,
        cancel: Cancel | None,
    ) -> Report:
        telling = Progress(progress)
        options = _abi.RunOptions(
            threads=count_of_threads(threads),
            look_ahead=count_of_threads(look_ahead, "look_ahead"),
            first=layers[0],
            last=layers[1],
            flags=(_abi.RESUME if resume else 0) | (_abi.FORCE if force else 0),
            progress=telling.pointer,
        )
        report = _abi.RunReport()

        def work(job: c_void_p, token: c_void_p) -> None:
            options.cancel = token
            start(job, byref(options), byref(report), (*self._callbacks, *own, telling))

        with self._used() as pointer:
            stoppable(lambda token: work(pointer, token), cancel)
        return Report(report.layers_written, report.layers_kept, report.volume, report.support_volume)

    def _range(self, first: int, last: int | None) -> tuple[int, int]:
        """Checked here, as 0 and 0 would stand for all layers."""
        end = self.layer_count if last is None else last
        if not 0 <= first < end <= self.layer_count:
            raise CallError(
                f"layers {first} to {end} are none of the {self.layer_count} that there are; "
                f"they must be from 0 up to, not including, {self.layer_count}"
            )
        return first, end
