"""Many threads at one job, each with sections of its own."""

from __future__ import annotations

import gc
import resource
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import lamella
from shapes import ball, ball_area, ball_text, ball_values, host_recipe

FOAM = ball_text(0.25) + "[foam]\ncell = 2\nbeam = 0.3\n"


class Threads(unittest.TestCase):
    def test_threads_get_the_bytes_that_one_gets(self) -> None:
        job = lamella.Recipe(FOAM).build()
        raster = lamella.Raster.over(job.bounds, 0.05)
        alone = [section.coverage(raster) for section in job.layers()]

        def mask(layer: int) -> np.ndarray:
            with job.section(job.layer_z(layer)) as section:
                return section.coverage(raster)

        with ThreadPoolExecutor(4) as pool:
            together = list(pool.map(mask, range(job.layer_count)))
        np.testing.assert_array_equal(together, alone)

    def test_threads_ask_functions_of_python_at_once(self) -> None:
        job = host_recipe(ball_values).build()
        heights = np.linspace(-4.5, 4.5, 20)
        with ThreadPoolExecutor(4) as pool:
            areas = list(pool.map(lambda z: job.section(z).contours(0.05).area, heights))
        np.testing.assert_allclose(areas, [ball_area(z) for z in heights], atol=0.6)

    def test_each_thread_has_its_own_errors(self) -> None:
        def wrong(number: int) -> bool:
            try:
                lamella.Recipe()[f"no.key{number}"] = 1
            except lamella.InputError as error:
                return f"no.key{number}:" in str(error)
            return False

        with ThreadPoolExecutor(8) as pool:
            self.assertTrue(all(pool.map(wrong, range(400))))

    def test_a_section_of_another_thread_in_use_is_refused_not_shared(self) -> None:
        inside, leave = threading.Event(), threading.Event()

        def values(points: np.ndarray) -> np.ndarray:
            if inside.is_set() or threading.current_thread() is not threading.main_thread():
                inside.set()
                leave.wait(10)
            return ball_values(points)

        section = host_recipe(values).build().section(0)
        thread = threading.Thread(target=lambda: section.contours(0.1))
        thread.start()
        inside.wait(10)
        try:
            with self.assertRaisesRegex(lamella.CallError, "being used by another call"):
                section.contours(0.1)
            with self.assertRaisesRegex(lamella.CallError, "has to return first"):
                section.close()
        finally:
            leave.set()
            thread.join()
        self.assertAlmostEqual(section.contours(0.01).area, ball_area(0), delta=0.1)


class Leaks(unittest.TestCase):
    def test_memory_does_not_grow_with_what_was_made_and_let_go(self) -> None:
        shape, tall = ball(), lamella.Raster(10, 2000, -5, -5, 1, 0.005)

        def work(times: int) -> None:
            for i in range(times):
                recipe = host_recipe(ball_values)
                job = recipe.build()
                section = job.section(i * 1e-3)
                section.contours(0.1)
                shape.section(i * 1e-3).runs(tall)
                section.fill([np.random.default_rng(i).uniform(-4, 4, (20 + i, 2))], 0.2)
                job.values(np.zeros((1 + i, 3)))
                with self.assertRaises(lamella.InputError):
                    recipe["no.key"] = "x" * 10000
            gc.collect()

        work(20)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        work(100)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        self.assertLess(grown, 2000, "KiB")


if __name__ == "__main__":
    unittest.main()
