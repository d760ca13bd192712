#!/usr/bin/env python3
"""A bracket whose foam is dense where it is loaded: cell sizes from a numpy function, and G-code of it.

python3 graded_bracket.py bracket.gcode

The bracket is an L, screwed to a wall at its back and loaded at the end of its arm. Sizes follow the bending
moment along the arm: small cells at the corner, large ones at the tip.
"""

from __future__ import annotations

import sys

import numpy as np

import lamella

RECIPE = """
[foam]
cell = "cells"      # the grading that add_grading() gives
beam = 0.45

[skin]
thickness = 0.9

[layers]
height = 0.2

[printer]
profile = "marlin"
"""
OUTLINE = np.array([(0, 0), (60, 0), (60, 10), (8, 10), (8, 50), (0, 50)], float)  # x and z, mm
FACE = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)])  # the L as triangles, counter-clockwise
WIDTH = 16.0  # along y, mm
FINE, COARSE = 3.0, 7.0  # mm
REACH = 60.0  # mm, from the wall to the load


def bracket() -> tuple[np.ndarray, np.ndarray]:
    """The L drawn out along y: vertices (12, 3), mm, and triangles, counter-clockwise seen from outside."""
    count = len(OUTLINE)
    vertices = np.array([(x, y, z) for y in (-WIDTH / 2, WIDTH / 2) for x, z in OUTLINE])
    front = np.arange(count)
    behind, ahead = front + count, np.roll(front, -1)
    sides = [(front, behind, ahead + count), (front, ahead + count, ahead)]
    walls = [np.stack(side, axis=1) for side in sides]
    return vertices, np.concatenate([FACE, FACE[:, ::-1] + count, *walls])


def cells(points: np.ndarray) -> np.ndarray:
    """Mean diameter of cells, mm: the moment falls from the corner to the tip, and up the plate."""
    distance = np.hypot(points[:, 0], np.maximum(points[:, 2] - 10, 0))
    return FINE + (COARSE - FINE) * np.clip(distance / REACH, 0, 1)


def enclosing(lower: np.ndarray, upper: np.ndarray) -> tuple[float, float]:
    """The sizes in a box. They grow along x and z, so its corners have the least and the greatest; x may be
    below zero, beside the part."""
    nearest = np.array([np.clip(0, lower[0], upper[0]), 0, lower[2]])
    farthest = np.array([max(abs(lower[0]), abs(upper[0])), 0, upper[2]])
    least, greatest = cells(np.array([nearest, farthest]))
    return least, greatest


def main(output: str) -> None:
    recipe = lamella.Recipe(RECIPE, "graded_bracket.py")
    recipe.add_mesh("bracket", *bracket())
    # Whoever changes the function changes its name, too: by it stopped runs are known again.
    recipe.add_grading("cells", cells, FINE, COARSE, range=enclosing, identity="moment of an L, 1")
    job = recipe.build()

    def tell(what: str, done: int, total: int) -> None:
        print(f"\r{what}: {done} of {total}", end="", file=sys.stderr)

    report = job.run(output, force=True, progress=tell)
    print(file=sys.stderr)
    print(f"{output}: {report.layers_written} layers, {report.volume:.0f} mm3 of plastic")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:] or ["bracket.gcode"])
    except lamella.Error as error:
        sys.exit(f"{error}")
