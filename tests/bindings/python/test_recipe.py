"""Recipes: text, keys, files, meshes, and what is said when they are wrong."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

import numpy as np

import lamella
from shapes import RADIUS, ball_area, ball_text, box_text


class Recipes(unittest.TestCase):
    def test_keys_texts_and_files_make_the_same_job(self) -> None:
        by_text = lamella.Recipe(ball_text()).build()
        by_keys = lamella.Recipe()
        by_keys["part.shape"] = "sphere"
        by_keys["part.radius"] = RADIUS
        by_keys["layers.height"] = np.float64(0.5)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "ball.toml"
            path.write_text(ball_text())
            by_file = lamella.Recipe.read(path).build()
        identities = {job.identity for job in (by_text, by_keys.build(), by_file)}
        self.assertEqual(len(identities), 1)

    def test_a_key_comes_before_what_the_text_says(self) -> None:
        recipe = lamella.Recipe(ball_text())
        recipe["part.radius"] = 3
        np.testing.assert_allclose(recipe.build().bounds, [[-3] * 3, [3] * 3])

    def test_values_of_every_kind(self) -> None:
        recipe = lamella.Recipe()
        recipe["part.shape"] = "box"
        recipe["part.size"] = np.array([24, 26, 8])
        recipe["foam.kind"] = "k-nearest"
        recipe["foam.cell"] = "2 + 0.1*z"
        recipe["foam.beam"] = 0.4
        recipe["foam.stretch"] = (1, "1 + 0.01*x", 2.5)
        recipe["foam.drop_islands"] = False
        recipe["layers.height"] = 0.5
        recipe["foam.seed"] = np.int64(7)
        job = recipe.build()
        np.testing.assert_allclose(job.bounds, [[-12, -13, -4], [12, 13, 4]])

    def test_rows_of_numbers(self) -> None:
        recipe = lamella.Recipe(box_text((30, 20, 4)))
        recipe["printer.dowel_at"] = [[-6, 2], (6, 4)]
        contours = recipe.build().section(0).contours(0.01)
        middles = sorted(contour.mean(axis=0).round(1).tolist() for contour in contours)
        self.assertEqual(middles, [[-6, 2], [0, 0], [6, 4]])

    def test_a_value_of_no_kind_is_refused_by_its_key(self) -> None:
        with self.assertRaisesRegex(lamella.CallError, r"foam\.cell: must be a number, a text"):
            lamella.Recipe()["foam.cell"] = None

    def test_a_key_that_there_is_none_of_is_an_input_error_at_once(self) -> None:
        with self.assertRaisesRegex(lamella.InputError, r"foam\.cells") as caught:
            lamella.Recipe()["foam.cells"] = 2
        self.assertIsNone(caught.exception.line)

    def test_mistakes_of_a_text_have_a_path_and_a_line(self) -> None:
        recipe = lamella.Recipe('[part]\nshape = "sphere"\nradius = -4\n', "wrong.toml")
        with self.assertRaises(lamella.InputError) as caught:
            recipe.build()
        self.assertEqual((caught.exception.path, caught.exception.line), ("wrong.toml", 3))
        self.assertIn("radius", str(caught.exception))

    def test_a_text_that_is_no_toml_has_a_line_and_leaves_the_recipe_as_it_was(self) -> None:
        recipe = lamella.Recipe(ball_text())
        with self.assertRaises(lamella.InputError) as caught:
            recipe.add_text("[part]\nradius = = 2\n", "worse.toml")
        self.assertEqual((caught.exception.path, caught.exception.line), ("worse.toml", 2))
        self.assertEqual(recipe.build().identity, lamella.Recipe(ball_text()).build().identity)

    def test_a_later_text_replaces_what_was_set(self) -> None:
        recipe = lamella.Recipe(ball_text())
        recipe.add_text("[part]\nradius = 2\n")
        self.assertEqual(recipe.build().bounds[1, 2], 2)

    def test_paths_in_a_text_start_in_the_folder_of_its_name(self) -> None:
        models = Path(__file__).resolve().parents[3] / "examples" / "models"
        text = '[part]\nmesh = "koala_mm.obj"\n[layers]\nheight = 1\n'
        recipe = lamella.Recipe(text, str(models / "any.toml"))
        self.assertEqual(recipe.build().name, "koala_mm")

    def test_a_file_that_there_is_none_of_is_named(self) -> None:
        with self.assertRaisesRegex(lamella.InputError, "nowhere.toml"):
            lamella.Recipe.read("/nowhere.toml")

    def test_texts_that_c_cannot_hold_are_refused(self) -> None:
        with self.assertRaisesRegex(lamella.CallError, "character of value 0"):
            lamella.Recipe.read("a\0b")
        with self.assertRaisesRegex(lamella.CallError, "text: must be a text, not bytes"):
            lamella.Recipe().add_text(b"[part]")  # type: ignore[arg-type]

    def test_a_recipe_may_change_after_its_job_was_made(self) -> None:
        with lamella.Recipe(ball_text()) as recipe:
            job = recipe.build()
            recipe["part.radius"] = 1
        self.assertTrue(recipe.closed)
        self.assertAlmostEqual(job.section(0).contours(0.01).area, ball_area(0), delta=0.1)
        with self.assertRaisesRegex(lamella.CallError, "this Recipe is closed"):
            recipe.build()

    def test_an_own_machine_is_found_in_the_folder_that_was_added(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "cellar.toml").write_text('based_on = "generic-8k"\n[printer]\nexposure = 1.9\n')
            recipe = lamella.Recipe(ball_text())
            recipe["printer.profile"] = "cellar"
            with self.assertRaisesRegex(lamella.InputError, "cellar"):
                recipe.build()
            recipe.add_printers(folder)
            self.assertEqual(recipe.build().layer_count, 20)


class Meshes(unittest.TestCase):
    def test_a_tetrahedron_has_the_sections_of_a_tetrahedron(self) -> None:
        recipe = lamella.Recipe("[layers]\nheight = 0.5\n")
        corners = [[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6]]
        recipe.add_mesh("corner", corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
        job = recipe.build()
        for z in (0.75, 2.0, 4.25):
            self.assertAlmostEqual(job.section(z).contours(0.005).area, (6 - z) ** 2 / 2, delta=0.02)

    def test_meshes_that_are_none_are_refused(self) -> None:
        recipe = lamella.Recipe()
        points = np.zeros((4, 3))
        for triangles, said in (
            ([[0, 1, 4]], "corners must be from 0 to 3"),
            ([[0, 1, -1]], "corners must be from 0 to 3"),
            ([[0.0, 1.0, 2.0]], "must be whole numbers"),
            ([0, 1, 2], r"must be whole numbers \(n, 3\)"),
        ):
            with self.assertRaisesRegex(lamella.CallError, said):
                recipe.add_mesh("m", points, triangles)
        with self.assertRaisesRegex(lamella.CallError, r"vertices: must have shape \(n, 3\)"):
            recipe.add_mesh("m", points[:, :2], [[0, 1, 2]])

    def test_a_box_as_a_mesh_is_the_box_as_a_shape(self) -> None:
        corners = np.array([[x, y, z] for x in (-2, 2) for y in (-3, 3) for z in (-1, 1)], np.float32)
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], np.uint8)
        recipe = lamella.Recipe("[layers]\nheight = 0.5\n")
        recipe.add_mesh("block", corners, triangles)
        raster = lamella.Raster(100, 100, -4, -4, 0.08, 0.08, 8)
        np.testing.assert_array_equal(
            recipe.build().section(0.3).coverage(raster),
            lamella.Recipe(box_text((4, 6, 2))).build().section(0.3).coverage(raster),
        )


if __name__ == "__main__":
    unittest.main()
