"""A job at one height: pixels, runs and contours."""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterable, Sequence
from ctypes import byref, c_void_p
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from . import _abi
from ._abi import library
from ._call import Callback, call
from ._contours import Contours
from ._errors import CallError
from ._handle import Handle
from ._memory import copied
from ._raster import Raster, Runs


class What(enum.IntFlag):
    """Of what a section tells; may be added."""

    PART = 1
    SUPPORTS = 2


PART = What.PART
SUPPORTS = What.SUPPORTS


@dataclass(frozen=True, eq=False)
class SectionInfo:
    """What a section says of itself."""

    layer: int  # -1 where it was cut at a height
    z: float  # mm
    thickness: float  # of a layer, mm
    bounds: np.ndarray | None  # (2, 2), mm: holds part and supports; None where there is neither


def section_info(told: _abi.SectionInfo) -> SectionInfo:
    bounds = np.array([told.lower[:], told.upper[:]])
    return SectionInfo(told.layer, told.z, told.thickness, bounds if (bounds[0] <= bounds[1]).all() else None)


class Section(Handle):
    """A job at one height, made by `Job.section` and `Job.layers`. One thread at a time may use it."""

    def __init__(
        self,
        pointer: c_void_p,
        destroy: Callable[[c_void_p], None],
        callbacks: Sequence[Callback],
    ) -> None:
        super().__init__(pointer, destroy, callbacks)
        self._callbacks = callbacks
        told = _abi.SectionInfo()
        with self._used() as used:
            call(library.lamella_section_info_get, used, byref(told))
        self.info = section_info(told)

    @property
    def layer(self) -> int:
        """-1 where it was cut at a height."""
        return self.info.layer

    @property
    def z(self) -> float:
        """mm in part coordinates"""
        return self.info.z

    @property
    def thickness(self) -> float:
        """Of a layer, mm."""
        return self.info.thickness

    @property
    def bounds(self) -> np.ndarray | None:
        """A rectangle that holds part and supports, (2, 2), mm; None where there is neither."""
        return self.info.bounds

    def contours(self, tolerance: float, what: What = PART) -> Contours:
        """Contours that leave the solid's border by at most `tolerance`, mm."""
        return self._contours(library.lamella_section_contours, int(what), float(tolerance))

    def fill(self, polygons: Iterable[ArrayLike], tolerance: float, what: What = PART) -> Contours:
        """What of the section lies inside polygons, each (n, 2), mm: they are filled with the job's foam.
        What lies in an odd number of them is inside."""
        inside = [_polygon(polygon, i) for i, polygon in enumerate(polygons)]
        first = np.cumsum([0, *map(len, inside)], dtype=np.uintp)
        points = np.concatenate(inside) if inside else np.empty((0, 2))
        given = _abi.Polygons(count=len(inside), first=first.ctypes.data, points=points.ctypes.data)
        return self._contours(library.lamella_section_fill, int(what), byref(given), float(tolerance))

    def _contours(self, function: Callable[..., int], *arguments: object) -> Contours:
        made = c_void_p()
        with self._used() as pointer:
            call(function, pointer, *arguments, byref(made), callbacks=self._callbacks)
        try:
            view = _abi.ContoursView()
            call(library.lamella_contours_view_get, made, byref(view))
            first = copied(view.first, (view.count + 1,), np.uintp).astype(np.intp)
            points = copied(view.points, (int(first[-1]), 2), np.float64)
            return Contours(first, points, copied(view.parent, (view.count,), np.int32), view.area)
        finally:
            library.lamella_contours_destroy(made)

    def coverage(self, raster: Raster, what: What = PART, out: np.ndarray | None = None) -> np.ndarray:
        """How much of each pixel is solid, 0 to 255: (rows, columns) uint8. Where `out` is given, it is
        written in place and returned; its rows may lie apart, as those of a part of a larger picture."""
        grid = raster._struct()
        if out is None:
            out = np.empty(raster.shape, np.uint8)
        _check_mask(out, raster)
        stride = out.strides[0] if raster.rows > 1 else 0
        with self._used() as pointer:
            call(
                library.lamella_section_coverage,
                pointer,
                int(what),
                byref(grid),
                out.ctypes.data,
                stride,
                callbacks=self._callbacks,
            )
        return out

    def runs(self, raster: Raster, what: What = PART) -> Runs:
        """Where each line of the raster is solid; `raster.lines` per row."""
        made = c_void_p()
        grid = raster._struct()
        with self._used() as pointer:
            call(
                library.lamella_section_runs,
                pointer,
                int(what),
                byref(grid),
                byref(made),
                callbacks=self._callbacks,
            )
        try:
            view = _abi.RunsView()
            call(library.lamella_runs_view_get, made, byref(view))
            first = copied(view.first, (view.line_count + 1,), np.uintp).astype(np.intp)
            return Runs(first, copied(view.ends, (int(first[-1]), 2), np.int32))
        finally:
            library.lamella_runs_destroy(made)


def _polygon(given: ArrayLike, number: int) -> np.ndarray:
    try:
        polygon = np.ascontiguousarray(given, np.float64)
    except (TypeError, ValueError) as error:
        raise CallError(f"polygons: {number} is no array of numbers: {error}") from error
    if polygon.ndim != 2 or polygon.shape[1] != 2:
        raise CallError(f"polygons: {number} has shape {polygon.shape}; it must be (n, 2), x and y of points")
    return polygon


def _check_mask(out: np.ndarray, raster: Raster) -> None:
    if not isinstance(out, np.ndarray) or out.dtype != np.uint8 or out.shape != raster.shape:
        told = f"{out.dtype} {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise CallError(f"out: must be a numpy array of uint8 {raster.shape} (rows, columns), not {told}")
    if not out.flags.writeable:
        raise CallError("out: must be writable")
    if (raster.columns > 1 and out.strides[1] != 1) or (raster.rows > 1 and out.strides[0] < raster.columns):
        raise CallError(
            "out: pixels of a row must lie side by side and rows one behind the other, as in C; "
            f"strides are {out.strides}"
        )
