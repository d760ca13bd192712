"""Pixels of the plane, and what is solid along their lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from . import _abi
from ._errors import CallError

RUN_UNIT = 256  # runs are told in so many parts of a column
MOST_PIXELS = 1 << 21  # columns and rows, as the library has it


@dataclass(frozen=True)
class Raster:
    """Pixels of the plane: (x, y) is the corner of pixel (row 0, column 0), mm; the pitches lead from column
    to column and from row to row, mm, negative ones mirror. `lines` per row are looked at and their mean
    counts; 0 asks only whether a pixel's centre is solid."""

    columns: int
    rows: int
    x: float
    y: float
    pitch_x: float
    pitch_y: float
    lines: int = 4

    @staticmethod
    def over(bounds: ArrayLike, pitch: float, lines: int = 4) -> Raster:
        """Square pixels over bounds, [[x, y], [x, y]] mm as those of a section or [[x, y, z], [x, y, z]] as
        those of a job, the top row first as pictures have it. What the last pixels have too much is shared
        between both sides."""
        box = np.asarray(bounds, np.float64)
        fits = box.shape in ((2, 2), (2, 3)) and np.isfinite(box).all()
        if not (fits and (box[0, :2] < box[1, :2]).all()):
            raise CallError("bounds: must be [[x, y], [x, y]], mm, the second corner above the first")
        if not (math.isfinite(pitch) and pitch > 0):
            raise CallError(f"pitch: must be above 0 mm, not {pitch}")
        size = box[1, :2] - box[0, :2]
        columns, rows = (max(1, math.ceil(length / pitch - 1e-9)) for length in size)
        spare_x, spare_y = columns * pitch - size[0], rows * pitch - size[1]
        return Raster(
            columns, rows, box[0, 0] - spare_x / 2, box[1, 1] + spare_y / 2, pitch, -pitch, lines
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Of an array of its pixels: rows, columns."""
        return self.rows, self.columns

    @property
    def pixel_area(self) -> float:
        """mm^2"""
        return abs(self.pitch_x * self.pitch_y)

    def _struct(self) -> _abi.Raster:
        if not (1 <= self.columns <= MOST_PIXELS and 1 <= self.rows <= MOST_PIXELS):
            raise CallError(f"raster: columns and rows must be from 1 to {MOST_PIXELS}")
        try:
            return _abi.Raster(
                columns=self.columns,
                rows=self.rows,
                lines=self.lines,
                x=self.x,
                y=self.y,
                pitch_x=self.pitch_x,
                pitch_y=self.pitch_y,
            )
        except TypeError as error:
            raise CallError(
                f"raster: columns, rows and lines must be whole numbers, all others numbers: {error}"
            ) from error


class Runs(Sequence[np.ndarray]):
    """Where each line of a raster is solid. As a sequence: of each line its runs, (n, 2) int32, begin and
    end, half-open, in 1/256 of a column.

    `ends` are the runs of all lines, (n, 2); `first` of each line its first one, with one more for the end.
    """

    def __init__(self, first: np.ndarray, ends: np.ndarray) -> None:
        self.first = first
        self.ends = ends

    def __len__(self) -> int:
        return len(self.first) - 1

    def __getitem__(self, line):  # type: ignore[no-untyped-def, override]
        if isinstance(line, slice):
            return [self[i] for i in range(*line.indices(len(self)))]
        i = range(len(self))[line]
        return self.ends[self.first[i] : self.first[i + 1]]

    @property
    def length(self) -> float:
        """Of all runs, in columns."""
        return float((self.ends[:, 1] - self.ends[:, 0]).sum(dtype=np.int64)) / RUN_UNIT
