"""Functions of the program's own: fields and gradings, and what they raise."""

from __future__ import annotations

import contextlib
import gc
import io
import threading
import unittest
import weakref

import numpy as np

import lamella
from shapes import RADIUS, ball, ball_area, ball_values, host_recipe

FOAM = """
[part]
shape = "box"
size = [10, 10, 4]
[foam]
cell = "size_here"
beam = 0.25
[layers]
height = 0.5
"""


class Fields(unittest.TestCase):
    def test_a_ball_of_a_function_has_the_sections_of_the_shape(self) -> None:
        for metric in ("exact", "bound", "sign"):
            job = host_recipe(ball_values, metric).build()
            np.testing.assert_array_equal(job.bounds, ball().bounds)
            for z in (-3.1, 0.4):
                self.assertAlmostEqual(job.section(z).contours(0.01).area, ball_area(z), delta=0.1)
                raster = lamella.Raster.over(ball().section(z).bounds, 0.05, 8)
                mask = job.section(z).coverage(raster)
                area = mask.sum() / 255 * raster.pixel_area
                self.assertAlmostEqual(area, ball_area(z), delta=0.1, msg=metric)

    def test_a_function_gets_its_points_as_an_array_and_may_keep_and_change_them(self) -> None:
        kept = []

        def values(points: np.ndarray) -> np.ndarray:
            self.assertEqual((points.dtype, points.ndim, points.shape[1]), (np.float64, 2, 3))
            kept.append(points)
            found = ball_values(points)
            points[:] = 0
            return found

        contours = host_recipe(values).build().section(0).contours(0.01)
        self.assertAlmostEqual(contours.area, ball_area(0), delta=0.1)
        gc.collect()
        self.assertEqual({array.max() for array in kept}, {0})

    def test_a_field_may_be_one_of_several_that_a_text_names(self) -> None:
        recipe = lamella.Recipe(
            '[part]\nshape = "box"\nsize = [20, 20, 4]\n[layers]\nheight = 0.5\n'
            '[[field]]\nname = "hole"\nkind = "host"\n[[region]]\nfield = "hole"\nmake = "empty"\n'
        )
        recipe.add_field("hole", ball_values, [-6] * 3, [6] * 3, metric="exact", identity="ball")
        self.assertAlmostEqual(recipe.build().section(0).contours(0.005).area, 400 - ball_area(0), delta=0.2)

    def test_a_range_makes_signs_quick(self) -> None:
        """A field of which only the sign holds has to be looked at everywhere, unless it tells its range."""
        asked = {"range": 0, "values": 0}

        def values(points: np.ndarray) -> np.ndarray:
            asked["values"] += len(points)
            return ball_values(points) ** 3

        def enclose(lower: np.ndarray, upper: np.ndarray) -> tuple[float, float]:
            asked["range"] += 1
            nearest = np.clip(0, lower, upper)
            farthest = np.maximum(abs(lower), abs(upper))
            return tuple((np.hypot.reduce(p) - RADIUS) ** 3 for p in (nearest, farthest))

        areas, costs = [], []
        for given in (None, enclose):
            recipe = lamella.Recipe("[layers]\nheight = 0.5\n")
            recipe.add_field("solid", values, [-5] * 3, [5] * 3, identity="cube", range=given)
            asked["values"] = 0
            areas.append(recipe.build().section(1).contours(0.02).area)
            costs.append(asked["values"])
        self.assertAlmostEqual(areas[0], ball_area(1), delta=0.1)
        self.assertEqual(areas[1], areas[0])
        self.assertGreater(asked["range"], 0)
        self.assertLess(costs[1], costs[0] / 2)

    def test_the_identity_tells_functions_apart(self) -> None:
        def made(identity: str) -> str:
            recipe = lamella.Recipe("[layers]\nheight = 0.5\n")
            recipe.add_field("solid", ball_values, [-5] * 3, [5] * 3, identity=identity)
            return recipe.build().identity

        self.assertEqual(made("one"), made("one"))
        self.assertNotEqual(made("one"), made("other"))

    def test_what_is_no_field_is_refused(self) -> None:
        recipe = lamella.Recipe()
        for arguments, more, said in (
            (("f", 3, [-1] * 3, [1] * 3), {}, "must be a function over points, not int"),
            (("f", ball_values, [-1] * 2, [1] * 3), {}, "lower: must be x, y and z"),
            (("f", ball_values, [1] * 3, [-1] * 3), {}, "upper must lie above lower"),
            (("f", ball_values, [-1] * 3, [1] * 3), {"metric": "far"}, "one of sign, bound, exact, not"),
            (("my f", ball_values, [-1] * 3, [1] * 3), {}, "letters, digits and _"),
        ):
            with self.assertRaisesRegex(lamella.CallError, said):
                recipe.add_field(*arguments, identity="x", **more)


class Gradings(unittest.TestCase):
    raster = lamella.Raster(200, 200, -5, -5, 0.05, 0.05)

    def recipe(self, formula: str | None = None, text: str = FOAM) -> lamella.Recipe:
        recipe = lamella.Recipe(text)
        if formula is not None:
            recipe.add_text(f'[[grading]]\nname = "size_here"\nkind = "formula"\nformula = "{formula}"\n')
        return recipe

    def same_layers(self, told: lamella.Recipe, computed: lamella.Recipe) -> None:
        for by_formula, by_function in zip(told.build().layers(), computed.build().layers(), strict=True):
            mask = by_formula.coverage(self.raster)
            self.assertGreater(mask.sum(), 0)
            np.testing.assert_array_equal(by_function.coverage(self.raster), mask)

    def test_a_grading_of_a_function_makes_the_layers_of_the_same_formula(self) -> None:
        beams = FOAM.replace('"size_here"', "2").replace("0.25", '"size_here"')
        computed = self.recipe(text=beams)
        computed.add_grading("size_here", lambda p: 0.3 + 0.02 * p[:, 0], 0.2, 0.4, identity="along x")
        self.same_layers(self.recipe("0.3 + 0.02 * x", beams), computed)

    def test_and_of_cells_where_it_tells_its_range(self) -> None:
        computed = self.recipe()
        computed.add_grading(
            "size_here",
            lambda p: 2 + 0.125 * p[:, 0],
            1,
            3,
            identity="along x",
            range=lambda lower, upper: (2 + 0.125 * lower[0], 2 + 0.125 * upper[0]),
        )
        self.same_layers(self.recipe("2 + 0.125 * x"), computed)

    def test_walls_are_asked_for_at_many_points_at_once(self) -> None:
        walls = (
            '[part]\nshape = "box"\nsize = [8, 8, 2]\n[foam]\nkind = "gyroid"\ncell = 3\nwall = "size_here"\n'
            "[layers]\nheight = 0.5\n"
        )
        asked: list[int] = []

        def values(points: np.ndarray) -> np.ndarray:
            asked.append(len(points))
            return 0.4 + 0.02 * points[:, 0]

        computed = self.recipe(text=walls)
        computed.add_grading("size_here", values, 0.2, 0.6, identity="along x")
        self.same_layers(self.recipe("0.4 + 0.02 * x", walls), computed)
        section = computed.build().section(0)
        asked.clear()
        section.coverage(self.raster)
        self.assertGreater(sum(asked), 50 * len(asked))

    def test_another_function_makes_other_layers(self) -> None:
        told = self.recipe("2 + 0.125 * x").build()
        other = self.recipe()
        other.add_grading(
            "size_here",
            lambda p: 2 - 0.125 * p[:, 0],
            1,
            3,
            identity="back",
            range=lambda lower, upper: (2 - 0.125 * upper[0], 2 - 0.125 * lower[0]),
        )
        masks = [job.section(0).coverage(self.raster) for job in (told, other.build())]
        self.assertFalse(np.array_equal(*masks))

    def test_a_range_that_is_none_is_told(self) -> None:
        for given, said in (
            (lambda lower, upper: (3, 1), "range that is none"),
            (lambda lower, upper: 3, "TypeError"),
            (lambda lower, upper: ("low", "high"), "could not convert"),
        ):
            recipe = self.recipe()
            recipe.add_grading("size_here", ball_values, 1, 3, identity="x", range=given)
            with self.assertRaisesRegex(lamella.FaultError, said):
                recipe.build().section(0).contours(0.1)
        with self.assertRaisesRegex(lamella.CallError, "range must be a function over boxes, not tuple"):
            self.recipe().add_grading("g", ball_values, 1, 3, identity="x", range=(1, 3))

    def test_limits_that_are_none_are_refused(self) -> None:
        with self.assertRaisesRegex(lamella.CallError, "greatest must be at least `least`"):
            lamella.Recipe().add_grading("g", ball_values, 2, 1, identity="g")


class Raised(unittest.TestCase):
    """What a function raises comes out of the call that ran it, and is printed nowhere."""

    def setUp(self) -> None:
        self.printed = io.StringIO()
        printed = contextlib.redirect_stderr(self.printed)
        printed.__enter__()
        self.addCleanup(lambda: self.assertEqual(self.printed.getvalue(), ""))
        self.addCleanup(printed.__exit__, None, None, None)

    def failing(self) -> tuple[lamella.Job, list[BaseException]]:
        """A job of a ball whose function raises what is put into the list."""
        errors: list[BaseException] = []

        def values(points: np.ndarray) -> np.ndarray:
            if errors:
                raise errors[0]
            return ball_values(points)

        return host_recipe(values).build(), errors

    def test_out_of_everything_that_asks_for_values(self) -> None:
        job, errors = self.failing()
        section = job.section(0)
        errors.append(KeyError("lost"))
        raster = lamella.Raster(40, 40, -5, -5, 0.25, 0.25)
        for ask in (
            lambda: job.values([[0, 0, 0]]),
            lambda: section.contours(0.05),
            lambda: section.coverage(raster),
            lambda: section.runs(raster),
            lambda: section.fill([[[-1, -1], [1, -1], [0, 1]]], 0.05),
        ):
            with self.assertRaisesRegex(lamella.FaultError, "KeyError: 'lost'") as caught:
                ask()
            self.assertIs(caught.exception.__cause__, errors[0])
        errors.clear()
        self.assertAlmostEqual(section.contours(0.01).area, ball_area(0), delta=0.1)

    def test_out_of_threads_of_the_library(self) -> None:
        job, errors = self.failing()
        errors.append(ArithmeticError("in a thread"))

        class Areas(lamella.Backend):
            def render(self, section: lamella.Section) -> float:
                return section.contours(0.05).area

            def write(self, layer: lamella.SectionInfo, product: float) -> None:
                pass

        with self.assertRaises(lamella.FaultError) as caught:
            job.run_to(Areas(), threads=3)
        inner = caught.exception.__cause__
        self.assertIsInstance(inner, lamella.FaultError)
        self.assertIs(inner.__cause__, errors[0])

    def test_out_of_building(self) -> None:
        recipe = lamella.Recipe(FOAM)
        recipe["foam.drop_islands"] = True  # a survey that looks at layers

        def values(points: np.ndarray) -> np.ndarray:
            raise ZeroDivisionError("no size")

        recipe.add_grading("size_here", values, 1, 3, identity="g")
        with self.assertRaisesRegex(lamella.FaultError, "ZeroDivisionError: no size") as caught:
            recipe.build()
        self.assertIsInstance(caught.exception.__cause__, ZeroDivisionError)

    def test_only_out_of_the_call_that_failed(self) -> None:
        job, errors = self.failing()
        good = ball()
        errors.append(KeyError("lost"))
        failures: list[str] = []

        def others() -> None:
            for _ in range(50):
                good.section(0).contours(0.1)
                failures.extend([] if good.values([[0, 0, 0]])[0] < 0 else ["wrong"])

        thread = threading.Thread(target=others)
        thread.start()
        for _ in range(50):
            with self.assertRaises(lamella.FaultError):
                job.values([[0, 0, 0]])
        thread.join()
        self.assertEqual(failures, [])

    def test_values_of_a_wrong_shape_are_told(self) -> None:
        for result, said in (
            (lambda p: np.zeros((len(p), 2)), r"must be \(1,\)"),
            (lambda p: 3.0, r"shape \(\) for 1 points"),
            (lambda p: None, "TypeError|ValueError"),
            (lambda p: ["a"] * len(p), "could not convert"),
        ):
            job = host_recipe(result).build()
            with self.assertRaisesRegex(lamella.FaultError, said):
                job.values([[0, 0, 0]])

    def test_an_error_of_the_package_keeps_its_kind(self) -> None:
        job, errors = self.failing()
        for error in (lamella.StoppedError("enough"), lamella.InputError("not so")):
            errors[:] = [error]
            with self.assertRaises(type(error)) as caught:
                job.values([[0, 0, 0]])
            self.assertIs(caught.exception.__cause__, error)

    def test_an_interrupt_passes_through_as_what_it_is(self) -> None:
        job, errors = self.failing()
        errors.append(KeyboardInterrupt())
        with self.assertRaises(KeyboardInterrupt):
            job.values([[0, 0, 0]])

    def test_a_function_may_call_the_library(self) -> None:
        inner = ball()
        wrong = lamella.Recipe()

        def values(points: np.ndarray) -> np.ndarray:
            with self.assertRaises(lamella.InputError):
                wrong["no.key"] = 1  # an error of its own, in a context of its own
            return inner.values(points)

        job = host_recipe(values).build()
        self.assertAlmostEqual(job.section(0).contours(0.05).area, ball_area(0), delta=0.5)

    def test_a_section_is_not_used_twice_at_once(self) -> None:
        sections: list[lamella.Section] = []

        def values(points: np.ndarray) -> np.ndarray:
            if sections:
                sections[0].contours(0.1)
            return ball_values(points)

        job = host_recipe(values).build()
        section = job.section(0)
        sections.append(section)
        with self.assertRaisesRegex(lamella.FaultError, "is being used by another call") as caught:
            section.contours(0.1)
        self.assertIsInstance(caught.exception.__cause__, lamella.CallError)


class Lifetimes(unittest.TestCase):
    def test_functions_live_as_long_as_what_was_made_with_them(self) -> None:
        class Ball:
            def __call__(self, points: np.ndarray) -> np.ndarray:
                return ball_values(points)

        function = Ball()
        alive = weakref.ref(function)
        recipe = host_recipe(function)
        del function
        job = recipe.build()
        recipe.close()
        del recipe
        gc.collect()
        self.assertIsNotNone(alive())
        section = job.section(0)
        del job
        gc.collect()
        self.assertIsNotNone(alive())
        self.assertAlmostEqual(section.contours(0.01).area, np.pi * RADIUS**2, delta=0.1)
        del section
        gc.collect()
        self.assertIsNone(alive())


if __name__ == "__main__":
    unittest.main()
