"""What the package believes of lamella.h is what stands there."""

from __future__ import annotations

import ctypes
import re
import unittest
from pathlib import Path

from lamella import _abi, _errors, _recipe, _section

HEADER = Path(__file__).resolve().parents[3] / "bindings" / "lamella.h"
SCALARS = {
    "int32_t": ctypes.c_int32,
    "uint32_t": ctypes.c_uint32,
    "size_t": ctypes.c_size_t,
    "double": ctypes.c_double,
}
STRUCTS = {
    "error": _abi.Error,
    "field": _abi.Field,
    "grading": _abi.Grading,
    "mesh": _abi.Mesh,
    "build_options": _abi.BuildOptions,
    "job_info": _abi.JobInfo,
    "structure": _abi.Structure,
    "analysis_options": _abi.AnalysisOptions,
    "section_info": _abi.SectionInfo,
    "raster": _abi.Raster,
    "runs_view": _abi.RunsView,
    "contours_view": _abi.ContoursView,
    "polygons": _abi.Polygons,
    "run_options": _abi.RunOptions,
    "run_report": _abi.RunReport,
    "product": _abi.Product,
    "backend": _abi.Backend,
}
POINTER = ctypes.sizeof(ctypes.c_void_p)


def declarations() -> str:
    return re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)


def members(body: str) -> list[tuple[str, int]]:
    """Names and sizes of a struct's members."""
    found = []
    for declaration in filter(None, (" ".join(part.split()) for part in body.split(";"))):
        function = re.match(r".*\(\*(\w+)\)\(.*\)$", declaration)
        if function:
            found.append((function[1], POINTER))
            continue
        kind, names = re.match(r"((?:const )?\w+\*?) (.*)$", declaration).groups()
        for name in names.split(","):
            word, count = re.match(r"\s*(\w+)(?:\[(\d+)\])?$", name).groups()
            pointer = kind.endswith("*") or kind in ("lamella_on_progress", "lamella_range")
            size = POINTER if pointer else ctypes.sizeof(SCALARS[kind])
            found.append((word, size * int(count or 1)))
    return found


def parameters(text: str) -> list[str]:
    return [] if text.strip() in ("", "void") else [" ".join(part.split()) for part in text.split(",")]


class Header(unittest.TestCase):
    def test_structs_have_the_members_of_the_header(self) -> None:
        bodies = dict(re.findall(r"typedef struct lamella_(\w+) \{(.*?)\} lamella_\1;", declarations(), re.S))
        self.assertEqual(set(bodies) - set(STRUCTS), {"plugin", "printer"})  # for plugins, not programs
        for name, struct in STRUCTS.items():
            mine = [(field, ctypes.sizeof(kind)) for field, kind in struct._fields_]
            self.assertEqual(mine, members(bodies[name]), name)

    def test_functions_take_and_return_what_the_header_says(self) -> None:
        found = re.findall(r"LAMELLA_API ([\w ]+\*?)\s*lamella_(\w+)\((.*?)\);", declarations(), re.S)
        self.assertEqual({name for _, name, _ in found}, set(_abi._signatures))
        for result, name, text in found:
            returned, taken = _abi._signatures[name]
            expected = {"void": None, "const char*": ctypes.c_char_p}.get(
                result.strip(), SCALARS.get(result.strip())
            )
            self.assertIs(returned, expected, name)
            self.assertEqual(len(taken), len(parameters(text)), name)
            for kind, parameter in zip(taken, parameters(text)):
                scalar = None if "*" in parameter else SCALARS[parameter.split()[0]]
                if scalar is None:
                    self.assertEqual(ctypes.sizeof(kind), POINTER, f"{name}: {parameter}")
                    self.assertIn("*", parameter, name)
                else:
                    self.assertIs(kind, scalar, f"{name}: {parameter}")

    def test_callbacks_take_as_many_parameters_as_the_header_says(self) -> None:
        body = re.search(r"typedef struct lamella_backend \{(.*?)\}", declarations(), re.S)[1]
        kinds = {name: kind for name, kind in _abi.Backend._fields_ if hasattr(kind, "_argtypes_")}
        found = re.findall(r"\(\*(\w+)\)\((.*?)\);", body, re.S)
        self.assertEqual({name for name, _ in found}, set(kinds))
        for name, text in found:
            self.assertEqual(len(kinds[name]._argtypes_), len(parameters(text)), name)
        for kind, name in ((_abi.RANGE, "range"), (_abi.PROGRESS, "on_progress")):
            text = re.search(rf"typedef int32_t \(\*lamella_{name}\)\((.*?)\);", declarations(), re.S)[1]
            self.assertEqual(len(kind._argtypes_), len(parameters(text)), name)

    def test_numbers_are_those_of_the_header(self) -> None:
        text = declarations()
        numbers = {name: int(value) for name, value in re.findall(r"LAMELLA_(\w+) = (\d+)", text)}
        self.assertEqual(int(re.search(r"LAMELLA_ABI_VERSION (\d+)u", text)[1]), _abi.VERSION)
        for name, value in (("RESUME", _abi.RESUME), ("FORCE", _abi.FORCE), ("OK", _abi.OK)):
            self.assertEqual(numbers[name], value)
        for name, error in (
            ("VIOLATED", _errors.ConstraintError),
            ("BAD_INPUT", _errors.InputError),
            ("FAULT", _errors.FaultError),
            ("BAD_CALL", _errors.CallError),
            ("OUT_OF_MEMORY", _errors.OutOfMemoryError),
            ("STOPPED", _errors.StoppedError),
        ):
            self.assertEqual(numbers[name], error.status)
        for name, value in _recipe.METRICS.items():
            self.assertEqual(numbers[name.upper()], value)
        for what in _section.What:
            self.assertEqual(numbers[what.name], what)


if __name__ == "__main__":
    unittest.main()
