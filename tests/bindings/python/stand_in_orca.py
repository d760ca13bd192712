"""A stand-in for the part of OrcaSlicer's Python interface that slicing plugins use.

It keeps the rules that the real one states: coordinates are int64 in scaled units; what it hands out lives
while execute() runs, and until a collection is set anew. What breaks a rule fails here, while it would crash
there.
"""

from __future__ import annotations

import enum
import types
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np


class Gone(AssertionError):
    """Something was used that OrcaSlicer has let go of."""


class Live:
    """What is lent while a scope is open."""

    made: list[weakref.ref[Live]] = []

    def __init__(self, scope: list[bool]) -> None:
        self._scope = scope
        Live.made.append(weakref.ref(self))

    def _check(self) -> None:
        if not self._scope[0]:
            raise Gone(f"{type(self).__name__} was used after OrcaSlicer let go of it")


def signed_area(points: np.ndarray) -> float:
    x, y = points.astype(np.float64).T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


class Polygon(Live):
    def __init__(self, points: np.ndarray, scope: list[bool]) -> None:
        super().__init__(scope)
        self._points = points

    def as_array(self) -> np.ndarray:
        self._check()
        return self._points


class ExPolygon:
    """Of the plugin's own. The real one turns rings around where they run the wrong way; this one refuses
    them."""

    def __init__(self, contour: Any, holes: Any = None) -> None:
        self.points = [_ring(contour), *(_ring(hole) for hole in holes or [])]
        for number, ring in enumerate(self.points):
            if (signed_area(ring) > 0) != (number == 0):
                raise AssertionError(f"ring {number} runs the wrong way round")


def _ring(given: Any) -> np.ndarray:
    if not isinstance(given, np.ndarray) or given.dtype != np.int64:
        raise ValueError("polygon coordinates must be int64 (scaled coords)")
    if given.ndim != 2 or given.shape[1] != 2 or len(given) < 3:
        raise ValueError("each polygon array must have shape (N,2) with at least 3 points")
    return given.copy()


class LentExPolygon(Live):
    def __init__(self, rings: list[np.ndarray], scope: list[bool]) -> None:
        super().__init__(scope)
        self._rings = rings

    @property
    def contour(self) -> Polygon:
        self._check()
        return Polygon(self._rings[0], self._scope)

    @property
    def holes(self) -> list[Polygon]:
        self._check()
        return [Polygon(ring, self._scope) for ring in self._rings[1:]]


class SurfaceType(enum.Enum):
    stTop = 0
    stInternal = 4


class Surface(Live):
    def __init__(self, kind: SurfaceType, rings: list[np.ndarray], scope: list[bool]) -> None:
        super().__init__(scope)
        self._kind, self._rings = kind, rings

    @property
    def surface_type(self) -> SurfaceType:
        self._check()
        return self._kind

    @property
    def expolygon(self) -> LentExPolygon:
        self._check()
        return LentExPolygon(self._rings, self._scope)


class SurfaceCollection(Live):
    def __init__(self, store: Region, scope: list[bool]) -> None:
        super().__init__(scope)
        self._store = store

    @property
    def surfaces(self) -> list[Surface]:
        self._check()
        return [Surface(kind, rings, self._store.scope) for kind, rings in self._store.content]

    def set(self, expolygons: list[ExPolygon], surface_type: SurfaceType) -> None:
        self._check()
        self._store.renew([])
        self.append(expolygons, surface_type)

    def append(self, expolygons: list[ExPolygon], surface_type: SurfaceType) -> None:
        self._check()
        assert isinstance(surface_type, SurfaceType)
        added = [(surface_type, expolygon.points) for expolygon in expolygons]
        self._store.renew(self._store.content + added)


class Region:
    """What OrcaSlicer itself has of a layer's region."""

    def __init__(self, content: list[tuple[SurfaceType, list[np.ndarray]]]) -> None:
        self.content = content
        self.scope = [True]

    def renew(self, content: list[tuple[SurfaceType, list[np.ndarray]]]) -> None:
        self.scope[0] = False  # references into the collection are invalid from here on
        self.scope = [True]
        self.content = content


class LayerRegion(Live):
    def __init__(self, store: Region, scope: list[bool]) -> None:
        super().__init__(scope)
        self._store = store

    @property
    def slices(self) -> SurfaceCollection:
        self._check()
        return SurfaceCollection(self._store, self._scope)


class Layer(Live):
    def __init__(self, store: Sheet, scope: list[bool]) -> None:
        super().__init__(scope)
        self._store = store

    @property
    def slice_z(self) -> float:
        self._check()
        return self._store.slice_z

    @property
    def print_z(self) -> float:
        self._check()
        return self._store.print_z

    def regions(self) -> list[LayerRegion]:
        self._check()
        return [LayerRegion(region, self._scope) for region in self._store.regions]

    def make_slices(self) -> None:
        self._check()
        self._store.islands_of = [region.content for region in self._store.regions]


class Sheet:
    """What OrcaSlicer itself has of a layer; on a raft print_z lies above slice_z."""

    def __init__(self, slice_z: float, regions: list[Region], raft: float = 0.6) -> None:
        self.slice_z, self.print_z = slice_z, slice_z + raft
        self.regions = regions
        self.islands_of: list[Any] | None = None  # what make_slices() saw


class PrintObject(Live):
    def __init__(self, sheets: list[Sheet], box: tuple[int, int, int, int], scope: list[bool]) -> None:
        super().__init__(scope)
        self._sheets, self._box = sheets, box

    def layers(self) -> list[Layer]:
        self._check()
        return [Layer(sheet, self._scope) for sheet in self._sheets]

    def bounding_box(self) -> tuple[int, int, int, int]:
        self._check()
        return self._box


class Step(enum.Enum):
    posSlice = 0
    posPerimeters = 1
    psGCodePostProcess = 12


class PluginResult(enum.Enum):
    Success = 0
    Skipped = 1
    RecoverableError = 2
    FatalError = 3


class ExecutionResult:
    def __init__(self, status: PluginResult, message: str = "") -> None:
        self.status, self.message = status, message

    @staticmethod
    def success(message: str = "") -> ExecutionResult:
        return ExecutionResult(PluginResult.Success, message)

    @staticmethod
    def skipped(message: str = "") -> ExecutionResult:
        return ExecutionResult(PluginResult.Skipped, message)

    @staticmethod
    def failure(status: PluginResult, message: str) -> ExecutionResult:
        assert isinstance(status, PluginResult) and isinstance(message, str)
        return ExecutionResult(status, message)


class Context(Live):
    def __init__(
        self, step: Step, print_object: PrintObject, scope: list[bool], cancelled: Callable[[], bool]
    ) -> None:
        super().__init__(scope)
        self.step, self.object, self.cancelled = step, print_object, cancelled


class Base:
    """Of capabilities and packages."""

    config = "{}"

    def get_config(self) -> str:
        return self.config


class Orca(types.ModuleType):
    """The module `orca` with one scale."""

    def __init__(self, unit: float = 1e-6) -> None:
        super().__init__("orca")
        self.registered: list[type] = []
        self.base = Base
        self.ExecutionResult, self.PluginResult = ExecutionResult, PluginResult
        self.host = types.SimpleNamespace(ExPolygon=ExPolygon, SurfaceType=SurfaceType)
        self.slicing = types.SimpleNamespace(
            Step=Step, SlicingPipelineCapabilityBase=Base, unscale=lambda coordinate: coordinate * unit
        )

    def plugin(self, package: type) -> type:
        package().register_capabilities()
        return package

    def register_capability(self, capability: type) -> None:
        self.registered.append(capability)

    def run(
        self,
        capability: Base,
        sheets: list[Sheet],
        box: tuple[int, int, int, int],
        step: Step = Step.posSlice,
        cancelled: Callable[[], bool] = lambda: False,
    ) -> ExecutionResult:
        """execute() as OrcaSlicer calls it; all that it lends is gone afterwards."""
        scope = [True]
        print_object = PrintObject(sheets, box, scope)
        try:
            context = Context(step, print_object, scope, cancelled)
            return capability.execute(context)  # type: ignore[attr-defined]
        finally:
            scope[0] = False
            for sheet in sheets:
                for region in sheet.regions:
                    region.renew(region.content)
