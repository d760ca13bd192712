"""Jobs and their sections against closed forms."""

from __future__ import annotations

import gc
import unittest

import numpy as np

import lamella
from shapes import RADIUS, ball, ball_area, ball_text, ball_values, box_text, polygon_area


class Jobs(unittest.TestCase):
    def test_a_job_tells_what_it_is(self) -> None:
        job = ball(0.5)
        self.assertEqual((job.layer_count, job.layer_height, job.name), (20, 0.5, "sphere"))
        np.testing.assert_array_equal(job.bounds, [[-RADIUS] * 3, [RADIUS] * 3])
        self.assertRegex(job.identity, r"^[0-9a-f]{32}$")
        self.assertFalse(job.has_supports)
        self.assertAlmostEqual(job.layer_z(3), -RADIUS + 3.5 * 0.5)

    def test_a_bar_stretches_by_its_length_times_stress_over_modulus(self) -> None:
        recipe = lamella.Recipe(
            '[part]\nshape = "box"\nsize = [20, 4, 4]\n[material]\nyoung = 2000\npoisson = 0\n'
            '[[load]]\nface = "+x"\nforce = [16, 0, 0]\n[[anchor]]\nface = "-x"\n'
        )
        bar = recipe.build()
        found = bar.analyse("elements", elements=20)
        self.assertAlmostEqual(found.largest_displacement, 0.01, places=6)
        self.assertEqual((found.dimensions, found.iterations), (3, 0))
        # 64 elements along the bar are 12.8 across it: 13, that are a little narrower than long.
        self.assertAlmostEqual(bar.structure().compliance, found.compliance, places=6)
        with self.assertRaisesRegex(lamella.CallError, "model: must be one of auto, elements, law"):
            bar.analyse("beams")

    def test_bounds_are_a_copy(self) -> None:
        job = ball()
        job.bounds[:] = 0
        self.assertEqual(job.bounds[1, 0], RADIUS)

    def test_values_are_distances(self) -> None:
        points = np.random.default_rng(1).uniform(-8, 8, (200, 3))
        np.testing.assert_allclose(ball().values(points), ball_values(points), atol=1e-12)
        self.assertEqual(ball().values(np.empty((0, 3))).shape, (0,))
        with self.assertRaisesRegex(lamella.CallError, r"points: must have shape \(n, 3\), not \(3,\)"):
            ball().values([1, 2, 3])

    def test_a_layer_that_there_is_none_of_is_refused(self) -> None:
        for layer in (-1, 20):
            with self.assertRaisesRegex(lamella.CallError, "layer"):
                ball().layer_z(layer)
        for first, last in ((0, 0), (0, 21), (-1, 3), (5, 5), (20, None)):
            with self.assertRaisesRegex(lamella.CallError, "they must be from 0 up to"):
                ball().layers(first, last)

    def test_layers_come_one_by_one_at_their_heights(self) -> None:
        job = ball()
        layers = job.layers(5, 8)
        sections = [(section.layer, section.z, section.thickness) for section in layers]
        self.assertEqual(sections, [(5, -2.25, 0.5), (6, -1.75, 0.5), (7, -1.25, 0.5)])
        volume = sum(section.contours(0.01).area * section.thickness for section in ball(0.1).layers())
        self.assertAlmostEqual(volume, 4 / 3 * np.pi * RADIUS**3, delta=0.5)

    def test_what_was_made_of_a_job_outlives_it(self) -> None:
        job = ball()
        section = job.section(1)
        job.close()
        self.assertAlmostEqual(section.contours(0.01).area, ball_area(1), delta=0.1)
        with self.assertRaisesRegex(lamella.CallError, "this Job is closed"):
            job.section(1)

    def test_handles_go_with_their_objects(self) -> None:
        job = ball()
        finalizers = [job._alive, job.section(0)._alive]
        job.close()
        del job
        gc.collect()
        self.assertEqual([alive.alive for alive in finalizers], [False, False])

    def test_closing_twice_does_nothing(self) -> None:
        section = ball().section(0)
        section.close()
        section.close()
        with self.assertRaisesRegex(lamella.CallError, "this Section is closed"):
            section.contours(0.1)


class Contours(unittest.TestCase):
    def test_a_ball_has_circles(self) -> None:
        for z in (-4, 0, 2.5):
            contours = ball().section(z).contours(0.005)
            self.assertEqual((len(contours), contours.parents.tolist()), (1, [-1]))
            radius = np.hypot(*contours[0].T)
            np.testing.assert_allclose(radius, np.sqrt(RADIUS**2 - z**2), atol=0.005)
            self.assertAlmostEqual(contours.area, ball_area(z), delta=0.1)

    def test_above_the_part_there_is_nothing(self) -> None:
        section = ball().section(2 * RADIUS)
        contours = section.contours(0.01)
        self.assertEqual((len(contours), contours.area, contours.islands()), (0, 0, []))
        self.assertIsNone(section.bounds)

    def test_shells_have_holes_and_what_lies_in_holes_is_an_island(self) -> None:
        recipe = lamella.Recipe(
            '[[field]]\nname = "rings"\nbounds = [[-9, -9, -2], [9, 9, 2]]\n'
            'formula = "max(-cos(hypot(x, y) * pi / 2), hypot(x, y) - 10)"\n[layers]\nheight = 0.5\n'
        )
        # Below zero for radii below 1, from 3 to 5 and from 7 to 9: a disc in two rings.
        contours = recipe.build().section(0).contours(0.01)
        islands = contours.islands()
        areas = sorted((polygon_area(outer), list(map(polygon_area, holes))) for outer, holes in islands)
        for (outer, holes), (large, small) in zip(areas, ((1, 0), (5, 3), (9, 7))):
            self.assertAlmostEqual(outer, np.pi * large**2, delta=0.5)
            np.testing.assert_allclose(holes, [-np.pi * small**2] if small else [], atol=0.5)
        self.assertEqual(len(areas), 3)
        self.assertAlmostEqual(contours.area, np.pi * (1 + 25 - 9 + 81 - 49), delta=1)
        self.assertAlmostEqual(sum(map(polygon_area, contours)), contours.area, places=6)

    def test_contours_belong_to_the_program(self) -> None:
        contours = ball().section(0).contours(0.01)
        kept = contours[0].copy()
        gc.collect()
        ball().section(1).contours(0.01)
        np.testing.assert_array_equal(contours[0], kept)
        contours[0][:] = 0

    def test_a_tolerance_that_is_none_is_refused(self) -> None:
        for tolerance in (0, -1, float("nan")):
            with self.assertRaisesRegex(lamella.CallError, "tolerance: must be from"):
                ball().section(0).contours(tolerance)

    def test_supports_are_told_apart(self) -> None:
        recipe = lamella.Recipe(ball_text(0.25))
        recipe["support.kind"] = "pillars"
        recipe["support.lift"] = 2
        job = recipe.build()
        self.assertTrue(job.has_supports)
        below = job.section(-RADIUS - 1)
        self.assertEqual(below.contours(0.01).area, 0)
        supports = below.contours(0.01, lamella.SUPPORTS).area
        self.assertGreater(supports, 0)
        self.assertEqual(below.contours(0.01, lamella.PART | lamella.SUPPORTS).area, supports)
        self.assertLess(job.bounds[0, 2], -RADIUS - 1)
        with self.assertRaisesRegex(lamella.CallError, "neither part, nor supports, nor both"):
            below.contours(0.01, 4)  # type: ignore[arg-type]


class Fill(unittest.TestCase):
    def test_polygons_cut_what_they_hold(self) -> None:
        section = lamella.Recipe(box_text((20, 20, 4))).build().section(0)
        square = np.array([[-15, -15], [5, -15], [5, 5], [-15, 5]])
        hole = [[-2, -2], [2, -2], [2, 2], [-2, 2]]
        contours = section.fill([square, hole], 0.005)
        self.assertAlmostEqual(contours.area, 15 * 15 - 16, delta=0.1)
        [(outer, holes)] = contours.islands()
        self.assertGreater(polygon_area(outer), 0)
        self.assertAlmostEqual(polygon_area(holes[0]), -16, delta=0.1)

    def test_contours_can_be_filled(self) -> None:
        small, large = ball().section(3), ball().section(0)
        self.assertAlmostEqual(large.fill(small.contours(0.005), 0.005).area, ball_area(3), delta=0.2)

    def test_no_polygons_hold_nothing(self) -> None:
        self.assertEqual(len(ball().section(0).fill([], 0.01)), 0)

    def test_what_is_no_polygon_is_refused_by_its_number(self) -> None:
        square = [[0, 0], [1, 0], [1, 1]]
        with self.assertRaisesRegex(lamella.CallError, r"polygons: 1 has shape \(2, 3\)"):
            ball().section(0).fill([square, [[0, 0, 0], [1, 1, 1]]], 0.01)
        with self.assertRaisesRegex(lamella.CallError, "polygons: 0 is no array of numbers"):
            ball().section(0).fill([[[0, 0], [1]]], 0.01)
        with self.assertRaisesRegex(lamella.CallError, "not finite"):
            ball().section(0).fill([[[0, 0], [1, 0], [float("nan"), 1]]], 0.01)


if __name__ == "__main__":
    unittest.main()
