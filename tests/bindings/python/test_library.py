"""Finding the shared library."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import lamella
from lamella import _abi, _library

PACKAGE = Path(lamella.__file__).parent
LIBRARY = Path(_abi.loaded_from)


def run(program: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """A fresh interpreter that has the package in `folder`."""
    kept = {name: value for name, value in os.environ.items() if name != _library.VARIABLE}
    return subprocess.run(
        [sys.executable, "-c", program],
        env={**kept, "PYTHONPATH": str(folder), **variables},
        capture_output=True,
        text=True,
    )


class Library(unittest.TestCase):
    def test_a_variable_that_leads_nowhere_is_told_with_what_would_be_right(self) -> None:
        done = run("import lamella", PACKAGE.parent, LAMELLA_LIBRARY="/nowhere/liblamella.so")
        self.assertIn("ImportError: Lamella's library cannot be loaded", done.stderr)
        self.assertIn("Set LAMELLA_LIBRARY to the path of", done.stderr)

    def test_another_library_is_refused(self) -> None:
        libc = next(Path("/").glob("lib/*/libm.so.6")) if sys.platform == "linux" else None
        self.assertIsNotNone(libc, "this test knows another library on Linux only")
        done = run("import lamella", PACKAGE.parent, LAMELLA_LIBRARY=str(libc))
        self.assertIn("is not Lamella's library", done.stderr)

    def test_it_is_found_beside_the_package(self) -> None:
        self.assertTrue(LIBRARY.is_absolute(), "the tests want LAMELLA_LIBRARY to be a whole path")
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "lamella"
            shutil.copytree(PACKAGE, copy)
            (copy / _library.FILE).symlink_to(LIBRARY.resolve())
            done = run("import lamella; print(lamella._abi.loaded_from)", Path(folder))
            self.assertEqual(done.stdout.strip(), str(copy.resolve() / _library.FILE), done.stderr)

    def test_its_soname_is_found_where_the_system_looks(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / _library.FILE).symlink_to(LIBRARY.resolve())
            done = run("import lamella; print(lamella.__version__)", PACKAGE.parent, LD_LIBRARY_PATH=folder)
            self.assertEqual(done.stdout.strip(), lamella.__version__, done.stderr)

    def test_an_interface_of_another_version_is_refused(self) -> None:
        program = (
            "import ctypes, lamella._library as found\n"
            "class Other:\n"
            "    lamella_abi_version = staticmethod(lambda: 2)\n"
            "found.load = lambda: (Other(), 'liblamella.so.2')\n"
            "import importlib, sys; del sys.modules['lamella._abi']; import lamella._abi\n"
        )
        done = run(program, PACKAGE.parent, LAMELLA_LIBRARY=str(LIBRARY))
        said = "liblamella.so.2: has version 2 of Lamella's C interface; needed: version 1"
        self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
