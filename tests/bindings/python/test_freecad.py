"""The FreeCAD macro against a stand-in that records what was made."""

from __future__ import annotations

import importlib.util
import runpy
import sys
import tempfile
import types
import unittest
from pathlib import Path
from typing import Any

import numpy as np

import lamella
from shapes import RADIUS, ball_area, ball_text, polygon_area

MACRO = Path(__file__).resolve().parents[3] / "bindings" / "freecad" / "lamella_preview.py"


class Vector(tuple):
    def __new__(cls, x: float, y: float, z: float) -> Vector:
        assert all(type(value) is float for value in (x, y, z)), "FreeCAD takes floats of Python's"
        return super().__new__(cls, (x, y, z))


class Object:
    def __init__(self, kind: str, name: str) -> None:
        self.TypeId, self.Name, self.Label = kind, name, name
        self.Shape: Any = None
        self.Group: list[Object] = []

    def addObject(self, other: Object) -> None:
        assert self.TypeId == "App::DocumentObjectGroup"
        self.Group.append(other)


class Document:
    def __init__(self) -> None:
        self.objects: list[Object] = []
        self.recomputed = False

    def addObject(self, kind: str, name: str) -> Object:
        assert kind in ("Part::Feature", "App::DocumentObjectGroup")
        self.objects.append(Object(kind, name))
        return self.objects[-1]

    def recompute(self) -> None:
        self.recomputed = True


class FreeCAD(types.ModuleType):
    Vector = Vector
    DocumentObject = Object

    def __init__(self) -> None:
        super().__init__("FreeCAD")
        self.ActiveDocument: Document | None = None

    def newDocument(self, name: str) -> Document:
        self.ActiveDocument = Document()
        return self.ActiveDocument


class Part(types.ModuleType):
    Wire = list

    @staticmethod
    def makePolygon(points: list[Vector]) -> list[Vector]:
        assert len(points) > 3 and all(isinstance(point, Vector) for point in points)
        return points

    @staticmethod
    def makeCompound(shapes: list[list[Vector]]) -> list[list[Vector]]:
        assert shapes
        return shapes


class Gui(types.ModuleType):
    """FreeCADGui and the dialogs of PySide's QtGui."""

    def __init__(self, chosen: str) -> None:
        super().__init__("FreeCADGui")
        self.sent: list[str] = []
        self.warnings: list[str] = []
        self.getMainWindow = lambda: None
        self.SendMsgToActiveView = self.sent.append
        self.QtGui = types.SimpleNamespace(
            QFileDialog=types.SimpleNamespace(getOpenFileName=lambda *_: (chosen, "")),
            QMessageBox=types.SimpleNamespace(warning=lambda _, title, text: self.warnings.append(text)),
        )


class Macro(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.recipe = Path(folder.name) / "ball.toml"
        self.recipe.write_text(ball_text())
        self.app = FreeCAD()
        self.put(FreeCAD=self.app, Part=Part("Part"))
        spec = importlib.util.spec_from_file_location("lamella_preview", MACRO)
        self.macro = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.macro)

    def put(self, **modules: types.ModuleType) -> None:
        for name, module in modules.items():
            sys.modules[name] = module
            self.addCleanup(sys.modules.pop, name)

    def test_sections_are_closed_wires_at_equal_steps(self) -> None:
        group = self.macro.preview(str(self.recipe), sections=5, tolerance=0.005)
        document = self.app.ActiveDocument
        self.assertTrue(document.recomputed)
        self.assertEqual(group.Label, "Sections of sphere")
        self.assertEqual(len(group.Group), 5)
        self.assertEqual(len(document.objects), 6)
        for section, z in zip(group.Group, (-4, -2, 0, 2, 4)):
            [ring] = section.Shape
            points = np.array(ring)
            self.assertEqual(ring[0], ring[-1])
            np.testing.assert_allclose(points[:, 2], z)
            self.assertAlmostEqual(polygon_area(points[:-1, :2]), ball_area(z), delta=0.2)
            self.assertRegex(section.Label, rf"^z = {z}\.000 mm, \d+\.\d\d mm2$")

    def test_foam_has_a_wire_for_each_contour(self) -> None:
        self.recipe.write_text(ball_text() + "[foam]\ncell = 3\nbeam = 0.4\n")
        group = self.macro.preview(self.recipe, sections=2)
        job = lamella.Recipe.read(self.recipe).build()
        self.assertEqual(
            [len(section.Shape) for section in group.Group],
            [len(job.section(z).contours(2 * RADIUS / 1000)) for z in (-RADIUS / 2, RADIUS / 2)],
        )

    def test_it_is_added_to_the_document_that_is_open(self) -> None:
        document = self.app.newDocument("mine")
        self.macro.preview(self.recipe, sections=1)
        self.assertIs(self.app.ActiveDocument, document)
        self.assertEqual(len(document.objects), 2)

    def test_what_fails_leaves_the_document_as_it_was(self) -> None:
        document = self.app.newDocument("mine")
        with self.assertRaisesRegex(lamella.InputError, "nowhere.toml"):
            self.macro.preview("/nowhere.toml")
        with self.assertRaisesRegex(lamella.CallError, "tolerance"):
            self.macro.preview(self.recipe, tolerance=-1.0)
        for sections in (0, 2.5):
            with self.assertRaisesRegex(ValueError, "sections: must be a whole number from 1 on"):
                self.macro.preview(self.recipe, sections=sections)
        self.assertEqual(document.objects, [])

    def run_as_macro(self, chosen: str) -> Gui:
        gui = Gui(chosen)
        side = types.ModuleType("PySide")
        side.QtGui = gui.QtGui  # type: ignore[attr-defined]
        self.put(FreeCADGui=gui, PySide=side)
        runpy.run_path(str(MACRO), run_name="__main__")
        return gui

    def test_as_a_macro_it_asks_for_a_recipe_and_fits_the_view(self) -> None:
        gui = self.run_as_macro(str(self.recipe))
        self.assertEqual((gui.sent, gui.warnings), (["ViewFit"], []))
        self.assertEqual(len(self.app.ActiveDocument.objects), 21)

    def test_a_dialog_that_is_left_does_nothing(self) -> None:
        gui = self.run_as_macro("")
        self.assertEqual((gui.sent, gui.warnings, self.app.ActiveDocument), ([], [], None))

    def test_a_mistake_in_the_recipe_is_shown_with_its_line(self) -> None:
        self.recipe.write_text('[part]\nshape = "sphere"\nradius = -1\n')
        gui = self.run_as_macro(str(self.recipe))
        self.assertEqual(gui.sent, [])
        self.assertIn("ball.toml:3: ", gui.warnings[0])


if __name__ == "__main__":
    unittest.main()
