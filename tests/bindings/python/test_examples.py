"""The examples and the README's program run as they are printed, and what they say is true."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import lamella
from shapes import ball_area, ball_text

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples" / "python"


class Examples(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_python(self, *arguments: object, status: int = 0) -> str:
        """What a program says, run in a folder of its own."""
        package = str(Path(lamella.__file__).parents[1])
        done = subprocess.run(
            [sys.executable, *map(str, arguments)],
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": package, "LAMELLA_LIBRARY": lamella._abi.loaded_from},
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout if status == 0 else done.stderr

    def test_the_program_of_the_readme(self) -> None:
        text = (ROOT / "bindings" / "python" / "README.md").read_text()
        [program] = re.findall(r"```python\n(.*?)```", text, re.S)
        told = self.run_python("-c", program)
        self.assertEqual(len(re.findall(r"^-9\.\d\d mm: \d+\.\d mm2 in \d+ pieces", told, re.M)), 3)
        self.assertIn("20 layers written", told)
        self.assertTrue((self.folder / "box.svg").exists())

    def test_names_in_the_readme_are_there(self) -> None:
        text = (ROOT / "bindings" / "python" / "README.md").read_text()
        for kind, row in re.findall(r"^\| `(\w+)` \| (.*) \|$", text, re.M):
            if kind == "object":
                continue
            members = re.findall(r"`(?:\w+\.)?([a-z_]+)(?:\(.*?\))?`", row)
            for name in members:
                if name not in ("what", "recipe"):
                    self.assertTrue(hasattr(getattr(lamella, kind), name), f"{kind}.{name}")

    def test_masks_are_those_of_a_ball(self) -> None:
        (self.folder / "ball.toml").write_text(ball_text())
        asked = ("ball.toml", "--pixel", 0.05, "--every", 5, "--folder", "out")
        told = self.run_python(EXAMPLES / "masks.py", *asked)
        pictures = sorted((self.folder / "out").iterdir())
        names = [f"{layer:05}.pgm" for layer in (0, 5, 10, 15)]
        self.assertEqual([picture.name for picture in pictures], names)
        rows = re.findall(r"^ +(\d+) +(-?[\d.]+) +([\d.]+)", told, re.M)
        self.assertEqual(len(rows), 4)
        for picture, (layer, z, area) in zip(pictures, rows):
            self.assertAlmostEqual(float(z), -5 + 0.5 * (int(layer) + 0.5), places=3)
            self.assertAlmostEqual(float(area), ball_area(float(z)), delta=0.1)
            kind, size, most, pixels = picture.read_bytes().split(b"\n", 3)
            self.assertEqual((kind, size, most, len(pixels)), (b"P5", b"200 200", b"255", 40000))
            self.assertAlmostEqual(sum(pixels) / 255 * 0.05**2, float(area), delta=0.01)

    def test_masks_say_what_is_wrong(self) -> None:
        self.assertIn("nowhere.toml", self.run_python(EXAMPLES / "masks.py", "nowhere.toml", status=1))

    def test_the_bracket_is_closed_and_its_sizes_enclosed(self) -> None:
        spec = importlib.util.spec_from_file_location("graded_bracket", EXAMPLES / "graded_bracket.py")
        bracket = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(bracket)
        vertices, triangles = bracket.bracket()
        a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
        self.assertAlmostEqual((np.cross(a, b) * c).sum() / 6, (60 * 10 + 8 * 40) * 16)
        edges = {(i, j) for t in triangles for i, j in zip(t, np.roll(t, -1))}
        self.assertEqual({(j, i) for i, j in edges}, edges)
        random = np.random.default_rng(3)
        for _ in range(200):
            lower = random.uniform(-20, 50, 3)
            upper = lower + random.uniform(0, 30, 3)
            least, greatest = bracket.enclosing(lower, upper)
            values = bracket.cells(random.uniform(lower, upper, (200, 3)))
            self.assertTrue((least <= values + 1e-12).all() and (values <= greatest + 1e-12).all())

    def test_the_bracket_becomes_gcode(self) -> None:
        told = self.run_python(EXAMPLES / "graded_bracket.py", "part.gcode")
        layers, volume = map(int, re.search(r"(\d+) layers, (\d+) mm3", told).groups())
        self.assertEqual(layers, 250)
        self.assertTrue(0.1 * 14720 < volume < 0.6 * 14720, volume)
        gcode = (self.folder / "part.gcode").read_text()
        self.assertIn("G1 ", gcode)
        refused = self.run_python(EXAMPLES / "graded_bracket.py", "part@nobody", status=1)
        self.assertIn('"nobody" is unknown', refused)


if __name__ == "__main__":
    unittest.main()
