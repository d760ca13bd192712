"""Whole jobs into files, folders and back-ends of Python's."""

from __future__ import annotations

import signal
import tempfile
import threading
import time
import unittest
import weakref
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

import lamella
from shapes import RADIUS, ball, ball_area, ball_text, ball_values, box_text, host_recipe

BALL_VOLUME = 4 / 3 * np.pi * RADIUS**3


class Folder(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


def drawings(height: float = 0.5) -> lamella.Job:
    """A ball, of which each layer is a drawing."""
    return lamella.Recipe(ball_text(height) + '[printer]\nprofile = "svg"\none_file = false\n').build()


class Files(Folder):
    def files(self, name: str) -> dict[str, bytes]:
        found = {path.name: path.read_bytes() for path in (self.folder / name).iterdir()}
        self.assertTrue(found)
        return found

    def test_layers_go_into_a_folder_of_svgs(self) -> None:
        recipe = lamella.Recipe(box_text((6, 4, 3), 1))
        recipe["printer.profile"] = "svg"
        recipe["printer.one_file"] = False
        told: list[tuple[str, int, int]] = []
        report = recipe.build().run(
            self.folder / "box", progress=lambda what, done, total: told.append((what, done, total))
        )
        self.assertEqual((report.layers_written, report.layers_kept), (3, 0))
        self.assertAlmostEqual(report.volume, 6 * 4 * 3, delta=0.1)
        self.assertEqual(report.support_volume, 0)
        self.assertEqual(told, [("layers", 1, 3), ("layers", 2, 3), ("layers", 3, 3)])
        found = sorted((self.folder / "box").glob("*.svg"))
        self.assertEqual(len(found), 3)
        for drawing in found:
            root = ElementTree.parse(drawing).getroot()
            self.assertTrue(root.tag.endswith("svg"))
            self.assertTrue(any(element.tag.endswith("path") for element in root.iter()))

    def test_a_range_of_layers_is_that_of_the_whole(self) -> None:
        job = drawings()
        job.run(self.folder / "all")
        report = job.run(self.folder / "some", first=4, last=7)
        self.assertEqual(report.layers_written, 3)
        whole = self.files("all")
        some = {name: data for name, data in self.files("some").items() if name.endswith(".svg")}
        self.assertEqual(len(some), 3)
        for name, data in some.items():
            self.assertEqual(whole[name], data)

    def test_an_output_that_exists_is_replaced_only_by_force(self) -> None:
        job = drawings()
        output = self.folder / "ball"
        job.run(output)
        with self.assertRaisesRegex(lamella.InputError, "ball"):
            job.run(output)
        self.assertEqual(job.run(output, force=True).layers_written, 20)

    def test_a_run_that_was_stopped_is_continued(self) -> None:
        job = drawings(0.1)
        output = self.folder / "ball"
        cancel = lamella.Cancel()
        with self.assertRaises(lamella.StoppedError):
            job.run(output, cancel=cancel, progress=lambda _, done, total: done < 30 or cancel.request())
        self.assertFalse((self.folder / "ball").exists())
        report = drawings(0.1).run(output, resume=True)  # a job made anew is known again
        self.assertGreaterEqual(report.layers_kept, 30)
        self.assertEqual(report.layers_kept + report.layers_written, 100)
        self.assertGreater(report.layers_written, 0)
        drawings(0.1).run(self.folder / "whole")
        self.assertEqual(self.files("ball"), self.files("whole"))

    def test_what_progress_raises_stops_the_run(self) -> None:
        def give_up(what: str, done: int, total: int) -> None:
            if done == 3:
                raise LookupError("seen enough")

        with self.assertRaisesRegex(lamella.FaultError, "LookupError: seen enough") as caught:
            ball().run(f"{self.folder / 'ball'}@svg", progress=give_up)
        self.assertIsInstance(caught.exception.__cause__, LookupError)

    def test_outputs_that_are_none_are_told(self) -> None:
        with self.assertRaisesRegex(lamella.InputError, "no-such-printer"):
            ball().run(f"{self.folder / 'ball'}@no-such-printer")
        with self.assertRaisesRegex(lamella.CallError, "output: must be a text"):
            ball().run(None)  # type: ignore[arg-type]
        with self.assertRaisesRegex(lamella.CallError, "threads: must be a whole number"):
            ball().run(f"{self.folder / 'ball'}@svg", threads=-1)
        with self.assertRaisesRegex(lamella.CallError, "cancel: must be a Cancel, not Event"):
            ball().run(f"{self.folder / 'ball'}@svg", cancel=threading.Event())  # type: ignore[arg-type]
        with self.assertRaisesRegex(lamella.CallError, "progress: must be a function"):
            ball().run(f"{self.folder / 'ball'}@svg", progress=3)  # type: ignore[arg-type]

    def test_a_folder_that_cannot_be_made_is_a_fault(self) -> None:
        (self.folder / "file").write_text("no folder")
        with self.assertRaises(lamella.Error) as caught:
            ball().run(f"{self.folder / 'file' / 'ball'}@svg")
        self.assertIn("file", str(caught.exception))


class Stack(lamella.Backend):
    """Keeps the areas of layers."""

    def __init__(self) -> None:
        self.areas: list[float] = []
        self.layers: list[int] = []
        self.asked: list[tuple[object, ...]] = []
        self.ended = False

    def begin(self, job: lamella.JobInfo, layers: range, resume: bool, force: bool) -> int | None:
        self.asked.append((job.name, job.layer_count, layers, resume, force))
        return layers.start + len(self.areas) if resume else None

    def render(self, section: lamella.Section) -> lamella.Product:
        area = section.contours(0.005).area
        return lamella.Product((section.layer, area), area=area)

    def write(self, layer: lamella.SectionInfo, product: lamella.Product) -> None:
        rendered, area = product.data
        assert rendered == layer.layer
        self.layers.append(layer.layer)
        self.areas.append(area)

    def end(self) -> None:
        self.ended = True


class Backends(unittest.TestCase):
    def test_every_layer_comes_once_and_in_order(self) -> None:
        for threads in (1, 4):
            stack = Stack()
            report = ball(0.25).run_to(stack, threads=threads, look_ahead=7)
            self.assertEqual(stack.layers, list(range(40)))
            self.assertEqual(stack.asked, [("sphere", 40, range(40), False, False)])
            self.assertTrue(stack.ended)
            heights = -RADIUS + 0.25 * (np.arange(40) + 0.5)
            np.testing.assert_allclose(stack.areas, ball_area_of(heights), atol=0.1)
            self.assertEqual((report.layers_written, report.layers_kept), (40, 0))
            self.assertAlmostEqual(report.volume, sum(stack.areas) * 0.25, places=6)
            self.assertAlmostEqual(report.volume, BALL_VOLUME, delta=1)

    def test_a_back_end_continues_where_it_says(self) -> None:
        stack = Stack()
        cancel = lamella.Cancel()

        def stop(what: str, done: int, total: int) -> None:
            if done == 5:
                cancel.request()

        with self.assertRaises(lamella.StoppedError):
            ball().run_to(stack, cancel=cancel, progress=stop, threads=1)
        self.assertTrue(cancel.requested)
        self.assertFalse(stack.ended)
        kept = len(stack.areas)
        self.assertGreaterEqual(kept, 5)
        self.assertLess(kept, 20)
        report = ball().run_to(stack, resume=True, force=True)
        self.assertEqual(stack.asked[-1], ("sphere", 20, range(20), True, True))
        self.assertEqual((report.layers_kept, report.layers_written), (kept, 20 - kept))
        self.assertEqual(stack.layers, list(range(20)))

    def test_a_back_end_that_cannot_continue_says_so(self) -> None:
        class Areas(lamella.Backend):
            def render(self, section: lamella.Section) -> None:
                pass

            def write(self, layer: lamella.SectionInfo, product: None) -> None:
                pass

        self.assertEqual(ball().run_to(Areas()).volume, 0)
        with self.assertRaisesRegex(lamella.InputError, "cannot continue what was begun"):
            ball().run_to(Areas(), resume=True)

    def test_what_is_no_back_end_is_refused(self) -> None:
        with self.assertRaisesRegex(lamella.CallError, "backend: must be a lamella.Backend, not list"):
            ball().run_to([])  # type: ignore[arg-type]

    def test_what_any_method_raises_ends_the_run(self) -> None:
        for method in ("begin", "render", "write", "end"):
            stack = Stack()
            error = LookupError(method)

            def fail(*_: object) -> None:
                raise error

            setattr(stack, method, fail)
            with self.assertRaisesRegex(lamella.FaultError, f"LookupError: {method}") as caught:
                ball().run_to(stack)
            self.assertIs(caught.exception.__cause__, error)
            self.assertFalse(stack.ended)

    def test_a_first_layer_that_is_none_is_a_fault(self) -> None:
        for missing, said in ((99, "layer 99"), ("two", "TypeError")):
            stack = Stack()
            stack.begin = lambda *_, missing=missing: missing  # type: ignore[method-assign]
            with self.assertRaisesRegex(lamella.FaultError, said):
                ball().run_to(stack)

    def test_a_section_is_lent_until_render_returns(self) -> None:
        kept: list[lamella.Section] = []

        class Keeper(Stack):
            def render(self, section: lamella.Section) -> lamella.Product:
                kept.append(section)
                return super().render(section)

        ball().run_to(Keeper())
        self.assertEqual(len(kept), 20)
        for section in kept:
            with self.assertRaisesRegex(lamella.CallError, "this Section is closed"):
                section.contours(0.1)

    def test_products_are_let_go_whether_or_not_they_were_written(self) -> None:
        class Made:
            pass

        made: list[weakref.ref[Made]] = []

        class Maker(lamella.Backend):
            def render(self, section: lamella.Section) -> Made:
                product = Made()
                made.append(weakref.ref(product))
                return product

            def write(self, layer: lamella.SectionInfo, product: Made) -> None:
                if layer.layer == 10:
                    raise lamella.StoppedError("half of it")

        with self.assertRaises(lamella.StoppedError):
            ball().run_to(Maker(), threads=2)
        self.assertGreater(len(made), 10)
        self.assertEqual([product() for product in made if product() is not None], [])

    def test_a_function_of_python_streams_too(self) -> None:
        stack = Stack()
        host_recipe(ball_values, height=2).build().run_to(stack, threads=3)
        heights = -RADIUS + 2 * (np.arange(5) + 0.5)
        np.testing.assert_allclose(stack.areas, ball_area_of(heights), atol=0.1)


def ball_area_of(heights: np.ndarray) -> np.ndarray:
    return np.array([ball_area(z) for z in heights])


class Stopping(unittest.TestCase):
    def test_a_token_from_another_thread_stops_a_run(self) -> None:
        cancel = lamella.Cancel()
        begun = threading.Event()

        class Waiting(Stack):
            def render(self, section: lamella.Section) -> lamella.Product:
                begun.set()
                time.sleep(0.01)
                return lamella.Product((section.layer, 0))

        def stop() -> None:
            begun.wait()
            cancel.request()

        thread = threading.Thread(target=stop)
        thread.start()
        stack = Waiting()
        with self.assertRaisesRegex(lamella.StoppedError, "of 1000 layers"):
            ball(0.01).run_to(stack, cancel=cancel)
        thread.join()
        self.assertLess(len(stack.layers), 1000)

    def test_a_token_that_is_set_stops_building(self) -> None:
        recipe = lamella.Recipe(ball_text(0.05))
        recipe["support.kind"] = "pillars"  # which looks at all layers first
        with lamella.Cancel() as cancel:
            cancel.request()
            with self.assertRaises(lamella.StoppedError):
                recipe.build(cancel=cancel)

    def test_building_tells_its_progress(self) -> None:
        recipe = lamella.Recipe(ball_text(0.5))
        recipe["support.kind"] = "pillars"
        told: list[tuple[str, int, int]] = []
        recipe.build(progress=lambda *step: told.append(step))
        self.assertEqual([(done, total) for what, done, total in told if what == "supports"][-1], (20, 20))

    def test_plans_of_supports_are_kept(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            recipe = lamella.Recipe(ball_text(0.5))
            recipe["support.kind"] = "pillars"
            first = recipe.build(plans=folder)
            self.assertTrue(list(Path(folder).iterdir()))
            told: list[str] = []
            second = recipe.build(plans=folder, progress=lambda what, done, total: told.append(what))
            self.assertNotIn("supports", told)
            self.assertEqual(first.identity, second.identity)

    def test_a_token_in_use_cannot_be_closed(self) -> None:
        cancel = lamella.Cancel()
        with self.assertRaisesRegex(lamella.FaultError, "Cancel is being used by a call"):
            ball().run_to(Stack(), cancel=cancel, progress=lambda *_: cancel.close())

    def test_ctrl_c_stops_a_run_of_the_main_thread(self) -> None:
        self.assertIs(threading.current_thread(), threading.main_thread())

        class Interrupting(Stack):
            def render(self, section: lamella.Section) -> lamella.Product:
                if section.layer == 5:
                    signal.raise_signal(signal.SIGINT)
                time.sleep(0.002)
                return lamella.Product((section.layer, 0))

        stack = Interrupting()
        with self.assertRaises(KeyboardInterrupt):
            ball(0.01).run_to(stack)
        self.assertLess(len(stack.layers), 1000)
        self.assertFalse(stack.ended)

    def test_a_run_of_another_thread_is_done_there(self) -> None:
        reports: list[lamella.Report] = []
        thread = threading.Thread(target=lambda: reports.append(ball().run_to(Stack())))
        thread.start()
        thread.join()
        self.assertEqual(reports[0].layers_written, 20)


if __name__ == "__main__":
    unittest.main()
