"""Closed polygons of a section."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


class Contours(Sequence[np.ndarray]):
    """Closed polygons that never cross: outer ones counter-clockwise, holes clockwise. As a sequence: (n, 2)
    float64, mm, the first point not repeated.

    `parents` is the contour directly about each one, -1 where there is none, (len,) int32; `area` that of
    all, holes taken off, mm^2.
    """

    def __init__(self, first: np.ndarray, points: np.ndarray, parents: np.ndarray, area: float) -> None:
        self.parents = parents
        self.area = area
        self._polygons = np.split(points, first[1:-1]) if len(first) > 1 else []

    def __len__(self) -> int:
        return len(self._polygons)

    def __getitem__(self, index):  # type: ignore[no-untyped-def, override]
        return self._polygons[index]

    def islands(self) -> list[tuple[np.ndarray, list[np.ndarray]]]:
        """What hangs together: each outer contour with the holes directly inside it."""
        holes: dict[int, list[np.ndarray]] = {}
        is_hole = [False] * len(self)
        for i in self._outside_in():
            parent = int(self.parents[i])
            is_hole[i] = parent >= 0 and not is_hole[parent]
            if is_hole[i]:
                holes.setdefault(parent, []).append(self[i])
        return [(self[i], holes.get(i, [])) for i in range(len(self)) if not is_hole[i]]

    def _outside_in(self) -> list[int]:
        """Indices, each behind that of its parent."""

        def depth(i: int) -> int:
            deep = 0
            while self.parents[i] >= 0:
                i, deep = self.parents[i], deep + 1
            return deep

        return sorted(range(len(self)), key=depth)
