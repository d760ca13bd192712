# /// script
# requires-python = ">=3.11"
# dependencies = ["numpy"]
#
# [tool.orcaslicer.plugin]
# name = "Lamella"
# description = "Fills what is sliced with the foam of a Lamella recipe."
# author = "Lamella"
# version = "0.2.0"
# type = "slicing-pipeline"
# ///
"""OrcaSlicer plugin: fills slices with the foam of a Lamella recipe.

Once an object is sliced, every layer's outlines are filled with the recipe's section at the layer's height.
Walls, infill, supports and G-code are then OrcaSlicer's, for all printers that it knows: with "infill 100 %"
and one or two walls, the struts are printed as they are.

To install it, put this file into OrcaSlicer's folder of plugins with the folder `lamella` of bindings/python
beside it, and the shared library inside that folder (or set LAMELLA_LIBRARY). Then choose it in the process
preset, and set in its configuration:

  recipe     path of the recipe (.toml) whose foam it is; empty: slices stay as they are
  align      "part": the recipe's part lies where the object lies, middle over middle, both on the bed, as
             when both were made of the same model; "origin": the recipe's origin is the object's middle, on
             the bed
  tolerance  mm that outlines may leave the foam's border by

An object that is turned or scaled in OrcaSlicer keeps its foam as the recipe has it: foam that fills any
object is that of a part large enough, such as a box.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import orca

# OrcaSlicer asks the user about files that are opened while it slices, so the library is loaded before.
sys.path.append(os.path.dirname(os.path.abspath(__file__)))
try:
    import numpy as np

    import lamella
except ImportError as error:
    missing: ImportError | None = error  # told once it is used: OrcaSlicer lists only plugins that load
else:
    missing = None

DEFAULTS = {"recipe": "", "align": "part", "tolerance": 0.02}


class Outlines(NamedTuple):
    """A layer's outlines, copied: what OrcaSlicer hands out is gone when slices are set."""

    z: float  # mm above the bed
    regions: list[dict[Any, list[np.ndarray]]]  # of each region by surface type: polygons (n, 2), mm


class Frame(NamedTuple):
    """From an object's slices to the recipe."""

    unit: float  # mm per scaled coordinate
    shift: np.ndarray  # (3,), mm, added to a place in the object

    def to_recipe(self, polygon: Any) -> np.ndarray:
        return np.array(polygon.as_array(), np.float64) * self.unit + self.shift[:2]

    def to_object(self, points: np.ndarray) -> np.ndarray:
        return np.rint((points - self.shift[:2]) / self.unit).astype(np.int64)


class LamellaSlices(orca.slicing.SlicingPipelineCapabilityBase):
    def get_name(self) -> str:
        return "Lamella foam"

    def get_default_config(self) -> dict[str, Any]:
        return dict(DEFAULTS)

    def execute(self, ctx: Any) -> Any:
        if ctx.step != orca.slicing.Step.posSlice or ctx.object is None:
            return orca.ExecutionResult.success()
        try:
            config = read_config(self.get_config())
            if not config["recipe"]:
                return orca.ExecutionResult.skipped("no recipe is set: slices stay as they are")
            if missing is not None:
                raise ValueError(str(missing))
            return fill_object(ctx, config)
        except (ValueError, lamella_error()) as error:
            # Only what is fatal stops OrcaSlicer, and an object without its foam must not be printed.
            return orca.ExecutionResult.failure(orca.PluginResult.FatalError, str(error))


def lamella_error() -> type[Exception]:
    return ValueError if missing is not None else lamella.Error


def read_config(text: str) -> dict[str, Any]:
    """The configuration with its defaults. Raises ValueError, which says what would be right."""
    try:
        given = json.loads(text or "{}")
    except json.JSONDecodeError as error:
        raise ValueError(f"the configuration is no JSON: {error}") from error
    if not isinstance(given, dict):
        raise ValueError('the configuration must be an object, such as {"recipe": "foam.toml"}')
    config = {**DEFAULTS, **given}
    unknown = sorted(set(given) - set(DEFAULTS))
    if unknown:
        raise ValueError(f"configuration: there is no {', '.join(unknown)}; accepted: {', '.join(DEFAULTS)}")
    if not isinstance(config["recipe"], str):
        raise ValueError("configuration: recipe must be the path of a recipe")
    if config["align"] not in ("part", "origin"):
        raise ValueError(f'configuration: align must be "part" or "origin", not {config["align"]!r}')
    tolerance = config["tolerance"]
    if isinstance(tolerance, bool) or not isinstance(tolerance, (int, float)) or not 1e-3 <= tolerance <= 1:
        raise ValueError(f"configuration: tolerance must be a number from 0.001 to 1 mm, not {tolerance!r}")
    return config


def fill_object(ctx: Any, config: dict[str, Any]) -> Any:
    """Fills all layers of the object that is being sliced."""

    def stop_if_asked(*_: object) -> None:
        if ctx.cancelled():
            raise lamella.StoppedError("slicing was cancelled")

    try:
        job = lamella.Recipe.read(config["recipe"]).build(progress=stop_if_asked)
        if job.has_supports:
            raise ValueError(
                f"{config['recipe']}: has supports, which are OrcaSlicer's here; leave [support] out"
            )
        frame = frame_of(ctx.object, job, config["align"])
        layers = ctx.object.layers()
        outlines = [outlines_of(layer, frame) for layer in layers]
        filled = list(fill_layers(job, outlines, config["tolerance"], stop_if_asked))
    except lamella.StoppedError:
        return orca.ExecutionResult.skipped("slicing was cancelled")
    if not any(islands for regions in filled for region in regions for islands in region.values()):
        raise ValueError(
            f"{config['recipe']}: nothing of it lies inside the object; its bounds are "
            f"{job.bounds.tolist()} mm, those of the object there "
            f"{object_bounds(ctx.object, frame).tolist()} mm; they must overlap"
        )
    for layer, regions in zip(layers, filled):
        put(layer, regions, frame)
    return orca.ExecutionResult.success(f"{len(layers)} layers filled with the foam of {job.name}")


def frame_of(print_object: Any, job: lamella.Job, align: str) -> Frame:
    unit = orca.slicing.unscale(1)  # which differs from bed to bed
    low_x, low_y, high_x, high_y = print_object.bounding_box()
    middle = np.array([(low_x + high_x) / 2, (low_y + high_y) / 2, 0]) * unit
    lower, upper = job.bounds
    place = np.append((lower + upper)[:2] / 2, lower[2]) if align == "part" else np.zeros(3)
    return Frame(unit, place - middle)


def object_bounds(print_object: Any, frame: Frame) -> np.ndarray:
    box = np.array(print_object.bounding_box(), np.float64).reshape(2, 2) * frame.unit
    return box + frame.shift[:2]


def outlines_of(layer: Any, frame: Frame) -> Outlines:
    regions = []
    for region in layer.regions():
        by_type: dict[Any, list[np.ndarray]] = {}
        for surface in region.slices.surfaces:
            rings = [surface.expolygon.contour, *surface.expolygon.holes]
            by_type.setdefault(surface.surface_type, []).extend(frame.to_recipe(ring) for ring in rings)
        regions.append(by_type)
    return Outlines(layer.slice_z + frame.shift[2], regions)


Islands = list[tuple["np.ndarray", list["np.ndarray"]]]


def fill_layers(
    job: lamella.Job, outlines: list[Outlines], tolerance: float, stop_if_asked: Any
) -> Iterator[list[dict[Any, Islands]]]:
    """What is solid of each layer, on all cores."""

    def fill(layer: Outlines) -> list[dict[Any, Islands]]:
        with job.section(layer.z) as section:
            return [
                {kind: section.fill(polygons, tolerance).islands() for kind, polygons in by_type.items()}
                for by_type in layer.regions
            ]

    pool = ThreadPoolExecutor(os.cpu_count())
    try:
        for islands in pool.map(fill, outlines):
            stop_if_asked()
            yield islands
    finally:
        pool.shutdown(cancel_futures=True)


def put(layer: Any, regions: list[dict[Any, Islands]], frame: Frame) -> None:
    for region, by_type in zip(layer.regions(), regions):
        for number, (kind, islands) in enumerate(by_type.items()):
            expolygons = [
                orca.host.ExPolygon(frame.to_object(outer), [frame.to_object(hole) for hole in holes])
                for outer, holes in islands
            ]
            if number == 0:
                region.slices.set(expolygons, kind)
            else:
                region.slices.append(expolygons, kind)
    layer.make_slices()


@orca.plugin
class LamellaPackage(orca.base):
    def register_capabilities(self) -> None:
        orca.register_capability(LamellaSlices)
