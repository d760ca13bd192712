"""FreeCAD macro: a recipe's sections as wires, at a number of heights.

Copy this file into FreeCAD's folder of macros as lamella_preview.FCMacro, and make the package `lamella` of
bindings/python and its shared library known to FreeCAD's Python (see the README there). Run as a macro it
asks for a recipe; in the console, `lamella_preview.preview("foam.toml", sections=30)` does the same. One
object a height is made, in a group: closed wires in part coordinates, mm.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import FreeCAD
import numpy as np
import Part

import lamella

SECTIONS = 20


def heights(job: lamella.Job, sections: int) -> Iterator[float]:
    """In the middle of slices of equal thickness, so that no section lies in the top or the bottom."""
    lower, upper = job.bounds[:, 2].tolist()
    step = (upper - lower) / sections
    return (lower + (i + 0.5) * step for i in range(sections))


def wire(contour: np.ndarray, z: float) -> Part.Wire:
    """A contour (n, 2) as a closed wire at height z."""
    points = [FreeCAD.Vector(float(x), float(y), z) for x, y in contour]
    return Part.makePolygon([*points, points[0]])


def preview(
    path: str | os.PathLike[str], sections: int = SECTIONS, tolerance: float | None = None
) -> FreeCAD.DocumentObject:
    """Adds the sections of a recipe, or of a model that it could name, to the document; makes one if there is
    none. Contours leave the solid's border by `tolerance`, mm; None: by a thousandth of the part's size.
    Returns the group. Raises lamella.Error, which says what would be right."""
    if not isinstance(sections, int) or sections < 1:
        raise ValueError(f"sections: must be a whole number from 1 on, not {sections!r}")
    with lamella.Recipe.read(path) as recipe:
        job = recipe.build()
    if tolerance is None:
        tolerance = max(1e-3, float(np.ptp(job.bounds, axis=0).max()) / 1000)
    # All is computed before the document changes: what fails leaves it as it was.
    what = lamella.PART | lamella.SUPPORTS
    found = [(z, job.section(z).contours(tolerance, what)) for z in heights(job, sections)]
    document = FreeCAD.ActiveDocument or FreeCAD.newDocument("Lamella")
    group = document.addObject("App::DocumentObjectGroup", "Sections")
    group.Label = f"Sections of {job.name}"
    for z, contours in found:
        if len(contours) == 0:
            continue
        section = document.addObject("Part::Feature", "Section")
        section.Label = f"z = {z:.3f} mm, {contours.area:.2f} mm2"
        section.Shape = Part.makeCompound([wire(contour, z) for contour in contours])
        group.addObject(section)
    document.recompute()
    return group


def ask_and_preview() -> None:
    """As a macro: asks for a recipe and shows it."""
    import FreeCADGui
    from PySide import QtGui

    kinds = "Recipes and models (*.toml *.stl *.obj *.ply *.3mf)"
    path, _ = QtGui.QFileDialog.getOpenFileName(FreeCADGui.getMainWindow(), "Lamella", "", kinds)
    if not path:
        return
    try:
        preview(path)
    except lamella.Error as error:
        QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), "Lamella", str(error))
        return
    FreeCADGui.SendMsgToActiveView("ViewFit")


if __name__ == "__main__":
    ask_and_preview()
