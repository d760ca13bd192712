"""Recipes: what to make."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from ctypes import byref, c_double, c_void_p
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _abi
from ._abi import library
from ._call import Callback, call, coded, coded_path
from ._cancel import Cancel, stoppable
from ._errors import CallError
from ._handle import Handle
from ._job import Job
from ._memory import copied, lent
from ._progress import OnProgress, Progress, count_of_threads

Function = Callable[[np.ndarray], ArrayLike]
Enclosing = Callable[[np.ndarray, np.ndarray], tuple[float, float]]
METRICS = {"sign": 0, "bound": 1, "exact": 2}


class _Values(Callback):
    """A function over points and what encloses its values, as the library calls them."""

    def __init__(self, what: str, function: Function, range: Enclosing | None) -> None:
        super().__init__()
        if not callable(function):
            raise CallError(f"{what}: must be a function over points, not {type(function).__name__}")
        if range is not None and not callable(range):
            raise CallError(f"{what}: range must be a function over boxes, not {type(range).__name__}")
        self._what = what
        self._function = function
        self._enclosing = range
        self.values = _abi.VALUES(self._values)
        self.range = _abi.RANGE() if range is None else _abi.RANGE(self._range)

    def _values(self, _user: int, points: int, count: int, values: int) -> int:
        return self.guarded(self._fill, points, count, values)

    def _fill(self, points: int, count: int, values: int) -> None:
        # The function may keep or change its points, so they are its own.
        result = np.asarray(self._function(copied(points, (count, 3), np.float64)), np.float64)
        if result.shape != (count,):
            raise ValueError(
                f"{self._what} returned an array of shape {result.shape} for {count} points; "
                f"it must be ({count},)"
            )
        lent(values, (count,), np.float64, writable=True)[:] = result

    def _range(self, _user: int, lower: int, upper: int, least: Any, greatest: Any) -> int:
        return self.guarded(self._enclose, lower, upper, least, greatest)

    def _enclose(self, lower: int, upper: int, least: Any, greatest: Any) -> None:
        assert self._enclosing is not None
        corners = copied(lower, (3,), np.float64), copied(upper, (3,), np.float64)
        # Both are numbers before either is written.
        low, high = (float(value) for value in self._enclosing(*corners))
        least[0], greatest[0] = low, high


class Recipe(Handle):
    """What to make: sections of text, single keys, and solids and gradings of the program's own. One thread
    at a time may use it.

    `Recipe()` is empty, `Recipe(text)` has the sections of a text, `Recipe.read(path)` those of a file.
    """

    def __init__(self, text: str | None = None, name: str = "recipe") -> None:
        pointer = c_void_p()
        call(library.lamella_recipe_create, byref(pointer))
        self._own(pointer)
        if text is not None:
            self.add_text(text, name)

    def _own(self, pointer: c_void_p) -> None:
        self._callbacks: list[Callback] = []
        super().__init__(pointer, library.lamella_recipe_destroy, self._callbacks)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Recipe:
        """Reads a recipe (.toml), or takes a model (.stl, .obj, .ply, .3mf) as the part."""
        pointer = c_void_p()
        call(library.lamella_recipe_read, coded_path(path, "path"), byref(pointer))
        recipe = cls.__new__(cls)
        recipe._own(pointer)
        return recipe

    def add_text(self, text: str, name: str | os.PathLike[str] = "recipe") -> None:
        """Adds the sections of a text; what they set anew replaces what was set. `name` stands for the text
        in messages, and relative paths in it start in the folder of `name`."""
        content = coded(text, "text")
        with self._used() as pointer:
            call(library.lamella_recipe_add_text, pointer, content, len(content), coded_path(name, "name"))

    def __setitem__(self, key: str, value: Any) -> None:
        """Sets a key by its section: `recipe["foam.cell"] = 2.5`. Formulas are texts; so are scripts of
        several lines; places and sizes are sequences of numbers, and rows of numbers sequences of those."""
        with self._used() as pointer:
            call(library.lamella_recipe_set, pointer, coded(key, "key"), coded(_value_text(value, key), key))

    def add_printers(self, folder: str | os.PathLike[str] | None = None) -> None:
        """A folder of machine profiles besides the built-in ones; None: that of the user."""
        path = None if folder is None else coded_path(folder, "folder")
        with self._used() as pointer:
            call(library.lamella_recipe_add_printers, pointer, path)

    def add_field(
        self,
        name: str,
        function: Function,
        lower: ArrayLike,
        upper: ArrayLike,
        *,
        identity: str,
        metric: str = "sign",
        range: Enclosing | None = None,
    ) -> None:
        """A solid by name: where `function` is below zero, within the box from `lower` to `upper`, mm. It
        takes points, (n, 3) float64 in mm, and returns n values; several threads may call it at once, and the
        same point must get the same value each time.

        `metric` says what values tell of the distance to the surface: "exact" is the signed Euclidean
        distance, mm; "bound" changes by at most 1 per mm; of "sign" only the sign holds, which is slow unless
        there is a range. `identity` tells the function from others: by it a stopped run is known again.
        `range(lower, upper)` takes two corners of a box, (3,) each, and returns two numbers that enclose all
        values in it; they may lie further apart than they need.
        """
        if metric not in METRICS:
            raise CallError(f"metric: must be one of {', '.join(METRICS)}, not {metric!r}")
        given = _Values(f"field {name}", function, range)
        field = _abi.Field(
            metric=METRICS[metric],
            lower=_corner(lower, "lower"),
            upper=_corner(upper, "upper"),
            values=given.values,
            identity=coded(identity, "identity"),
            range=given.range,
        )
        with self._used() as pointer:
            call(library.lamella_recipe_add_field, pointer, coded(name, "name"), byref(field))
        self._callbacks.append(given)

    def add_grading(
        self,
        name: str,
        function: Function,
        least: float,
        greatest: float,
        *,
        identity: str,
        range: Enclosing | None = None,
    ) -> None:
        """A number that formulas name: `function` takes points and returns values as that of a field does,
        none below `least` or above `greatest`. Where it is the size of cells, a `range` as of a field makes
        the foam that the same formula in a text makes; without one, foams are built for all sizes everywhere,
        which is slow."""
        given = _Values(f"grading {name}", function, range)
        grading = _abi.Grading(
            least=least,
            greatest=greatest,
            values=given.values,
            identity=coded(identity, "identity"),
            range=given.range,
        )
        with self._used() as pointer:
            call(library.lamella_recipe_add_grading, pointer, coded(name, "name"), byref(grading))
        self._callbacks.append(given)

    def add_mesh(self, name: str, vertices: ArrayLike, triangles: ArrayLike) -> None:
        """A solid by name: vertices (n, 3), mm, and triangles (m, 3) of their indices, counter-clockwise seen
        from outside. Both are copied; holes are closed and mistakes mended as of a mesh file."""
        points = np.ascontiguousarray(vertices, np.float64)
        corners = np.asarray(triangles)
        if points.ndim != 2 or points.shape[1] != 3:
            raise CallError(f"vertices: must have shape (n, 3), not {points.shape}")
        if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
            raise CallError(f"triangles: must be whole numbers (n, 3), not {corners.dtype} {corners.shape}")
        if corners.size and not (0 <= corners.min() and corners.max() < len(points)):
            raise CallError(f"triangles: corners must be from 0 to {len(points) - 1}")
        corners = np.ascontiguousarray(corners, np.uint32)
        mesh = _abi.Mesh(
            vertices=points.ctypes.data,
            vertex_count=len(points),
            triangles=corners.ctypes.data,
            triangle_count=len(corners),
        )
        with self._used() as pointer:
            call(library.lamella_recipe_add_mesh, pointer, coded(name, "name"), byref(mesh))

    def build(
        self,
        threads: int = 0,
        progress: OnProgress | None = None,
        cancel: Cancel | None = None,
        plans: str | os.PathLike[str] | None = None,
    ) -> Job:
        """Makes the job; the recipe may be changed or closed then. `progress(what, done, total)` tells of
        surveys before the first layer, if the recipe needs any, from whichever thread; 0 threads are one per
        core. Plans of supports are kept in the folder `plans` for later runs."""
        callbacks = tuple(self._callbacks)
        telling = Progress(progress)
        options = _abi.BuildOptions(
            threads=count_of_threads(threads),
            progress=telling.pointer,
            plans=None if plans is None else coded_path(plans, "plans"),
        )

        def work(recipe: c_void_p, token: c_void_p) -> Job:
            options.cancel = token
            made = c_void_p()
            call(
                library.lamella_job_build,
                recipe,
                byref(options),
                byref(made),
                callbacks=(*callbacks, telling),
            )
            return Job(made, callbacks)

        with self._used() as pointer:
            return stoppable(lambda token: work(pointer, token), cancel)


def _corner(given: ArrayLike, what: str) -> Any:
    corner = np.asarray(given, np.float64)
    if corner.shape != (3,):
        raise CallError(f"{what}: must be x, y and z, mm, not an array of shape {corner.shape}")
    return (c_double * 3)(*corner)


def _value_text(value: Any, key: str) -> str:
    """A value as a flag of the command is given it."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (int, float, str)):
        return value if isinstance(value, str) else repr(value)
    if isinstance(value, Sequence) and value:
        rows = isinstance(value[0], (Sequence, np.ndarray)) and not isinstance(value[0], str)
        parts = [np.ravel(row).tolist() if rows else row for row in value]
        return (";" if rows else ",").join(_value_text(part, key) for part in parts)
    raise CallError(f"{key}: must be a number, a text, True or False, or a sequence of these, not {value!r}")
