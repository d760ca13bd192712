"""Pixels and runs: written in place, and worth what the section is."""

from __future__ import annotations

import tracemalloc
import unittest

import numpy as np
from numpy.lib.stride_tricks import as_strided

import lamella
from shapes import RADIUS, ball, ball_area, box_text

WIDE, HIGH = 7680, 4320  # an 8K display


class Coverage(unittest.TestCase):
    def test_pixels_sum_up_to_the_area(self) -> None:
        for z in (-4, 0, 3):
            section = ball().section(z)
            raster = lamella.Raster.over(section.bounds, 0.05, lines=8)
            mask = section.coverage(raster)
            self.assertEqual((mask.shape, mask.dtype), (raster.shape, np.uint8))
            self.assertAlmostEqual(mask.sum() / 255 * raster.pixel_area, ball_area(z), delta=0.1)

    def test_pixels_lie_where_the_raster_says(self) -> None:
        section = lamella.Recipe(box_text((4, 2, 2))).build().section(0)
        mask = section.coverage(lamella.Raster(10, 6, -5, 3, 1, -1))
        expected = np.zeros((6, 10), np.uint8)
        expected[2:4, 3:7] = 255  # y from 1 down to -1, x from -2 to 2
        np.testing.assert_array_equal(mask, expected)
        half = section.coverage(lamella.Raster(10, 6, -5.5, 3, 1, -1, 4))
        np.testing.assert_allclose(half[2, [3, 4, 6, 7]], [127.5, 255, 255, 127.5], atol=1)
        centres = section.coverage(lamella.Raster(10, 6, -5.25, 3, 1, -1, 0))
        self.assertEqual(set(np.unique(centres)), {0, 255})
        self.assertEqual((centres > 0).sum(), 8)

    def test_negative_pitches_mirror(self) -> None:
        recipe = lamella.Recipe(
            '[[field]]\nname = "b"\nkind = "box"\nsize = [2, 2, 2]\nat = [2, 1, 0]\n[layers]\nheight = 0.5\n'
        )
        section = recipe.build().section(0)
        mask = section.coverage(lamella.Raster(80, 60, -4, -3, 0.1, 0.1))
        across = section.coverage(lamella.Raster(80, 60, 4, -3, -0.1, 0.1))
        down = section.coverage(lamella.Raster(80, 60, -4, 3, 0.1, -0.1))
        self.assertGreater(mask.sum(), 0)
        np.testing.assert_array_equal(across, mask[:, ::-1])
        np.testing.assert_array_equal(down, mask[::-1])

    def test_an_8k_mask_is_written_into_the_array_that_is_given(self) -> None:
        section = ball().section(0)
        raster = lamella.Raster(WIDE, HIGH, -WIDE * 0.001, HIGH * 0.001, 0.002, -0.002, 4)
        own = np.full((HIGH, WIDE), 7, np.uint8)
        address = own.ctypes.data
        tracemalloc.start()
        mask = section.coverage(raster, out=own)
        most = tracemalloc.get_traced_memory()[1]  # numpy tells it of every array
        tracemalloc.stop()
        self.assertIs(mask, own)
        self.assertTrue(np.shares_memory(mask, own))
        self.assertEqual(own.ctypes.data, address)
        self.assertLess(most, 1 << 20)
        self.assertEqual((own[0, 0], own[HIGH // 2, WIDE // 2]), (0, 255))
        inside = (2 * RADIUS) ** 2 * np.pi / 4
        # The display is 15.36 mm by 8.64 mm: it cuts the ball's ends off.
        cut = HIGH * 0.001
        lost = 2 * (RADIUS**2 * np.arccos(cut / RADIUS) - cut * np.sqrt(RADIUS**2 - cut**2))
        self.assertAlmostEqual(own.sum(dtype=np.int64) / 255 * raster.pixel_area, inside - lost, delta=0.01)

    def test_a_part_of_a_larger_picture_is_written_and_nothing_beside_it(self) -> None:
        section = ball().section(0)
        raster = lamella.Raster.over(section.bounds, 0.1)
        plate = np.full((200, 300), 9, np.uint8)
        place = plate[20 : 20 + raster.rows, 50 : 50 + raster.columns]
        self.assertIs(section.coverage(raster, out=place), place)
        np.testing.assert_array_equal(place, section.coverage(raster))
        beside = plate.copy()
        beside[20 : 20 + raster.rows, 50 : 50 + raster.columns] = 9
        self.assertEqual(set(np.unique(beside)), {9})

    def test_arrays_that_cannot_take_a_mask_are_refused(self) -> None:
        section = ball().section(0)
        raster = lamella.Raster(40, 30, -2, -1, 0.1, 0.1)
        frozen = np.zeros((30, 40), np.uint8)
        frozen.flags.writeable = False
        for out, said in (
            (np.zeros((40, 30), np.uint8), r"uint8 \(30, 40\) \(rows, columns\), not uint8 \(40, 30\)"),
            (np.zeros((30, 40)), "not float64"),
            ([[0] * 40] * 30, "not list"),
            (frozen, "must be writable"),
            (np.zeros((40, 30), np.uint8).T, "side by side"),
            (np.zeros((30, 80), np.uint8)[:, ::2], "side by side"),
            (np.zeros((30, 40), np.uint8)[::-1], "one behind the other"),
            (as_strided(np.zeros(100, np.uint8), (30, 40), (2, 1)), "one behind the other"),
        ):
            with self.assertRaisesRegex(lamella.CallError, said):
                section.coverage(raster, out=out)

    def test_one_row_and_one_column_are_masks_too(self) -> None:
        section = ball().section(0)
        row = section.coverage(lamella.Raster(100, 1, -5, -0.05, 0.1, 0.1))
        column = section.coverage(lamella.Raster(1, 100, -0.05, -5, 0.1, 0.1))
        self.assertEqual((row.shape, column.shape), ((1, 100), (100, 1)))
        self.assertEqual((row > 0).sum(), 100)
        self.assertEqual((column > 0).sum(), 100)

    def test_rasters_that_are_none_are_refused(self) -> None:
        section = ball().section(0)
        for raster, said in (
            (lamella.Raster(0, 5, 0, 0, 1, 1), "columns and rows must be from 1"),
            (lamella.Raster(5, -5, 0, 0, 1, 1), "columns and rows must be from 1"),
            (lamella.Raster(5, 5, 0, 0, 0, 1), "pitches"),
            (lamella.Raster(5, 5, float("nan"), 0, 1, 1), "finite"),
            (lamella.Raster(5, 5, 0, 0, 1, 1, -1), "lines must be from 0"),
            (lamella.Raster(5.5, 5, 0, 0, 1, 1), "must be whole numbers"),  # type: ignore[arg-type]
        ):
            with self.assertRaisesRegex(lamella.CallError, said):
                section.coverage(raster)

    def test_a_raster_over_bounds_holds_them(self) -> None:
        raster = lamella.Raster.over([[-1, -2], [1.05, 2]], 0.5)
        self.assertEqual(raster.shape, (8, 5))
        self.assertAlmostEqual(raster.x, -1 - 0.225)
        self.assertAlmostEqual(raster.y, 2)
        for bounds in (None, [1, 2], [[0, 0], [0, 1]], [[2, 2], [1, 1]]):
            with self.assertRaisesRegex(lamella.CallError, "bounds: must be"):
                lamella.Raster.over(bounds, 0.1)
        with self.assertRaisesRegex(lamella.CallError, "pitch: must be above 0 mm, not 0"):
            lamella.Raster.over([[0, 0], [1, 1]], 0)


class Runs(unittest.TestCase):
    def test_runs_are_chords(self) -> None:
        section = ball().section(3)
        raster = lamella.Raster(200, 100, -5, -5, 0.05, 0.1, 3)
        runs = section.runs(raster)
        self.assertEqual(len(runs), 300)
        radius = np.sqrt(RADIUS**2 - 9)
        for line in range(300):
            y = -5 + (line + 0.5) * 0.1 / 3
            chord = 2 * np.sqrt(max(radius**2 - y**2, 0))
            found = runs[line]
            self.assertEqual(found.shape[1], 2)
            self.assertAlmostEqual((found[:, 1] - found[:, 0]).sum() / 256 * 0.05, chord, delta=0.001)
        self.assertAlmostEqual(runs.length * 0.05 * 0.1 / 3, ball_area(3), delta=0.1)
        self.assertEqual(len(runs[140:160]), 20)

    def test_where_there_is_nothing_lines_are_empty(self) -> None:
        runs = ball().section(9).runs(lamella.Raster(20, 10, -5, -5, 0.5, 1, 1))
        self.assertEqual((len(runs), runs.ends.shape, runs.length), (10, (0, 2), 0))


if __name__ == "__main__":
    unittest.main()
