"""The OrcaSlicer plugin against a stand-in: units, places, orientation, and nothing kept."""

from __future__ import annotations

import gc
import importlib.util
import json
import sys
import tempfile
import types
import unittest
from pathlib import Path

import numpy as np

import lamella
from shapes import RADIUS, ball_area, ball_text, box_text
from stand_in_orca import Live, Orca, PluginResult, Region, Sheet, Step, SurfaceType, signed_area

PLUGIN = Path(__file__).resolve().parents[3] / "bindings" / "orcaslicer" / "lamella_slices.py"
FOAM = box_text((30, 30, 30)) + "[foam]\ncell = 3\nbeam = 0.5\n"


def load(orca: Orca) -> types.ModuleType:
    """The plugin as OrcaSlicer imports it."""
    spec = importlib.util.spec_from_file_location("lamella_slices", PLUGIN)
    plugin = importlib.util.module_from_spec(spec)
    before = sys.modules.get("orca")
    sys.modules["orca"] = orca
    paths = list(sys.path)
    try:
        spec.loader.exec_module(plugin)
    finally:
        sys.path[:] = paths
        del sys.modules["orca"]
        if before is not None:
            sys.modules["orca"] = before
    return plugin


def square(
    half: float, unit: float, middle: tuple[float, float] = (0, 0), hole: float = 0
) -> list[np.ndarray]:
    """Rings of a square, mm, in scaled coordinates."""

    def ring(h: float) -> np.ndarray:
        corners = np.array([[-h, -h], [h, -h], [h, h], [-h, h]]) + middle
        return np.rint(corners / unit).astype(np.int64)

    return [ring(half)] + ([ring(hole)[::-1].copy()] if hole else [])


def area(region: Region, unit: float) -> float:
    return sum(signed_area(ring * unit) for _, rings in region.content for ring in rings)


def middle_of(ring: np.ndarray) -> np.ndarray:
    return (ring.min(axis=0) + ring.max(axis=0)) / 2


class Plugin(unittest.TestCase):
    unit = 1e-6

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.orca = Orca(self.unit)
        self.plugin = load(self.orca)
        [capability] = self.orca.registered
        self.capability = capability()

    def config(self, recipe: str, **more: object) -> None:
        path = self.folder / "recipe.toml"
        path.write_text(recipe)
        self.capability.config = json.dumps({"recipe": str(path), **more})

    def box(self, half: float, middle: tuple[float, float] = (0, 0)) -> tuple[int, int, int, int]:
        corners = square(half, self.unit, middle)[0]
        return (*corners.min(axis=0).tolist(), *corners.max(axis=0).tolist())

    def sheet(self, z: float, half: float, hole: float = 0, middle: tuple[float, float] = (0, 0)) -> Sheet:
        return Sheet(z, [Region([(SurfaceType.stInternal, square(half, self.unit, middle, hole))])])

    def test_a_ball_becomes_its_circles_in_the_units_of_the_slicer(self) -> None:
        self.config(ball_text())
        heights = [0.5, 5, 7.5]
        sheets = [self.sheet(z, RADIUS) for z in heights]
        result = self.orca.run(self.capability, sheets, self.box(RADIUS))
        self.assertEqual(result.status, PluginResult.Success)
        self.assertEqual(result.message, "3 layers filled with the foam of sphere")
        for sheet, z in zip(sheets, heights):
            [(kind, [ring])] = sheet.regions[0].content
            self.assertIs(kind, SurfaceType.stInternal)
            self.assertEqual(ring.dtype, np.int64)
            self.assertAlmostEqual(area(sheet.regions[0], self.unit), ball_area(z - RADIUS), delta=0.5)
            np.testing.assert_allclose(
                np.hypot(*(ring * self.unit).T), np.sqrt(RADIUS**2 - (z - RADIUS) ** 2), atol=0.03
            )
            self.assertEqual(sheet.islands_of, [sheet.regions[0].content])

    def test_outlines_cut_the_foam_and_holes_stay_open(self) -> None:
        self.config(box_text((30, 30, 30)))
        sheet = self.sheet(4, 6, hole=2)
        self.orca.run(self.capability, [sheet], self.box(6))
        [(_, [outer, inner])] = sheet.regions[0].content
        self.assertAlmostEqual(signed_area(outer * self.unit), 144, delta=0.5)
        self.assertAlmostEqual(signed_area(inner * self.unit), -16, delta=0.5)

    def test_foam_is_that_of_the_section(self) -> None:
        self.config(FOAM, tolerance=0.01)
        sheet = self.sheet(4, 6)
        self.orca.run(self.capability, [sheet], self.box(6))
        section = lamella.Recipe(FOAM).build().section(4 - 15)
        contours = section.fill([[[-6, -6], [6, -6], [6, 6], [-6, 6]]], 0.01)
        self.assertGreater(len(contours), 3)
        self.assertEqual(sum(len(rings) for _, rings in sheet.regions[0].content), len(contours))
        self.assertAlmostEqual(area(sheet.regions[0], self.unit), contours.area, delta=1e-3)

    def test_the_part_lies_over_the_object_or_its_origin_does(self) -> None:
        recipe = (
            '[part]\nfield = "b"\n[[field]]\nname = "b"\nkind = "sphere"\nradius = 5\nat = [20, 7, 11]\n'
            "[layers]\nheight = 0.5\n"
        )
        middle = (3.0, -2.0)
        self.config(recipe)
        sheet = self.sheet(2, 6, middle=middle)
        self.orca.run(self.capability, [sheet], self.box(6, middle))
        [(_, [ring])] = sheet.regions[0].content
        np.testing.assert_allclose(middle_of(ring) * self.unit, middle, atol=0.05)
        self.assertAlmostEqual(area(sheet.regions[0], self.unit), ball_area(3), delta=0.5)

        self.config(recipe, align="origin")
        sheet = self.sheet(10, 30, middle=middle)
        self.orca.run(self.capability, [sheet], self.box(30, middle))
        [(_, [ring])] = sheet.regions[0].content
        np.testing.assert_allclose(middle_of(ring) * self.unit, np.add(middle, (20, 7)), atol=0.05)
        self.assertAlmostEqual(area(sheet.regions[0], self.unit), ball_area(1), delta=0.5)

    def test_regions_and_surface_types_stay_apart(self) -> None:
        self.config(box_text((30, 30, 30)))
        first = Region(
            [
                (SurfaceType.stInternal, square(1, self.unit, (-4, 0))),
                (SurfaceType.stTop, square(1.5, self.unit, (4, 0))),
                (SurfaceType.stInternal, square(2, self.unit, (0, 8))),
            ]
        )
        second, empty = Region([(SurfaceType.stTop, square(2.5, self.unit, (0, -8)))]), Region([])
        sheet = Sheet(3, [first, second, empty])
        self.orca.run(self.capability, [sheet], self.box(12))
        sizes = sorted((kind.name, round(signed_area(rings[0] * self.unit))) for kind, rings in first.content)
        self.assertEqual(sizes, [("stInternal", 4), ("stInternal", 16), ("stTop", 9)])
        self.assertEqual([kind for kind, _ in second.content], [SurfaceType.stTop])
        self.assertEqual(empty.content, [])

    def test_above_the_foam_a_layer_is_empty(self) -> None:
        self.config(ball_text())
        sheets = [self.sheet(5, RADIUS), self.sheet(11, RADIUS)]
        result = self.orca.run(self.capability, sheets, self.box(RADIUS))
        self.assertEqual(result.status, PluginResult.Success)
        self.assertEqual(sheets[1].regions[0].content, [])

    def test_nothing_is_kept_when_it_has_run(self) -> None:
        self.config(FOAM)
        Live.made.clear()
        self.orca.run(self.capability, [self.sheet(z, 6) for z in (1, 2, 3)], self.box(6))
        gc.collect()
        self.assertGreater(len(Live.made), 20)
        self.assertEqual([made() for made in Live.made if made() is not None], [])

    def test_other_steps_leave_slices_alone(self) -> None:
        self.config(FOAM)
        for step in (Step.posPerimeters, Step.psGCodePostProcess):
            sheet = self.sheet(3, 6)
            before = sheet.regions[0].content
            result = self.orca.run(self.capability, [sheet], self.box(6), step)
            self.assertEqual(result.status, PluginResult.Success)
            self.assertIs(sheet.regions[0].content, before)

    def test_without_a_recipe_slices_stay_as_they_are(self) -> None:
        self.capability.config = ""
        sheet = self.sheet(3, 6)
        before = sheet.regions[0].content
        result = self.orca.run(self.capability, [sheet], self.box(6))
        self.assertEqual(result.status, PluginResult.Skipped)
        self.assertIs(sheet.regions[0].content, before)
        self.assertEqual(self.capability.get_default_config()["recipe"], "")

    def test_cancelling_stops_and_leaves_slices_alone(self) -> None:
        self.config(FOAM)
        asked = iter([False, False])
        sheets = [self.sheet(z, 6) for z in np.linspace(1, 20, 50)]
        before = [sheet.regions[0].content for sheet in sheets]
        result = self.orca.run(self.capability, sheets, self.box(6), cancelled=lambda: next(asked, True))
        self.assertEqual(result.status, PluginResult.Skipped)
        self.assertTrue(all(sheet.regions[0].content is old for sheet, old in zip(sheets, before)))

    def test_what_is_wrong_stops_the_slicer_and_is_told(self) -> None:
        path = str(self.folder / "recipe.toml")
        for config, recipe, said in (
            ({"recipe": "/nowhere.toml"}, "", "/nowhere.toml"),
            ({"recipe": path}, '[part]\nshape = "sphere"\nradius = -1\n', "recipe.toml:3: "),
            ({"recipe": path}, ball_text() + '[support]\nkind = "pillars"\n', "leave [support] out"),
            ({"recipe": path, "align": "middle"}, FOAM, 'align must be "part" or "origin"'),
            ({"recipe": path, "tolerance": 0}, FOAM, "tolerance must be a number from 0.001 to 1 mm, not 0"),
            ({"recipe": path, "tolerance": True}, FOAM, "tolerance must be a number"),
            ({"recipe": 3}, FOAM, "recipe must be the path"),
            ({"recipes": path}, FOAM, "there is no recipes; accepted: recipe, align, tolerance"),
            ([], FOAM, "must be an object"),
            (
                {"recipe": path, "align": "origin"},
                '[part]\nfield = "b"\n[[field]]\nname = "b"\nkind = "sphere"\nradius = 5\nat = [99, 0, 0]\n'
                "[layers]\nheight = 0.5\n",
                "nothing of it lies inside the object",
            ),
        ):
            (self.folder / "recipe.toml").write_text(recipe)
            self.capability.config = json.dumps(config)
            sheet = self.sheet(3, 6)
            before = sheet.regions[0].content
            result = self.orca.run(self.capability, [sheet], self.box(6))
            self.assertEqual(result.status, PluginResult.FatalError, said)
            self.assertIn(said, result.message)
            self.assertIs(sheet.regions[0].content, before)
        self.capability.config = "{"
        self.assertIn("is no JSON", self.orca.run(self.capability, [], self.box(6)).message)

    def test_without_the_package_the_plugin_loads_and_says_what_is_missing(self) -> None:
        kept = {name: sys.modules.pop(name) for name in list(sys.modules) if name.split(".")[0] == "lamella"}
        sys.modules["lamella"] = None  # type: ignore[assignment]
        try:
            plugin = load(Orca())
        finally:
            del sys.modules["lamella"]
            sys.modules.update(kept)
        capability = plugin.LamellaSlices()
        capability.config = json.dumps({"recipe": "foam.toml"})
        result = self.orca.run(capability, [self.sheet(3, 6)], self.box(6))
        self.assertEqual(result.status, PluginResult.FatalError)
        self.assertIn("lamella", result.message)


class LargeBed(Plugin):
    """Beds beyond two metres have coarser units."""

    unit = 1e-5


if __name__ == "__main__":
    unittest.main()
