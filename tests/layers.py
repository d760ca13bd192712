#!/usr/bin/env python3
"""Checks the order of the source folders: no include goes upward, no type has one name in two headers, and no code
asks for a back-end by its name.

Usage: tests/layers.py [checkout]. A folder may include itself and those above it in the list below.
"""
import collections
import pathlib
import re
import sys

ORDER = """
engine/base engine/runs engine/field engine/solids engine/formula engine/contours engine/mesh engine/layers
engine/morphology engine/io engine/checks engine/surveys
procedural/grading procedural/volume procedural/voronoi procedural/scaffold procedural/foam procedural/skin
procedural/elasticity procedural/optimization procedural/appearance procedural/texture procedural/orientation procedural/elements
procedural/pattern procedural/lattice
printers/common printers/polygons printers/readers printers/archive printers/toolpath printers/masks printers/vector
printers/gcode printers/serial printers
recipe/pieces recipe recipe/keys recipe/inputs recipe/layering recipe/build recipe/placement recipe/structure recipe/output
bindings
hosts/transfer hosts
app/console app/ranks app/charts app/reports app/http app/jobs app/server app/help app/commands
""".split()
# Folders that never include each other, though one stands above the other in the list.
APART = [("procedural", "printers")]
# recipe/ names kinds that recipe/build makes, and recipe/build reads what recipe/ holds; the body that it builds may be
# one that recipe/structure optimises.
TOGETHER = {"recipe", "recipe/keys", "recipe/inputs", "recipe/build", "recipe/placement", "recipe/structure"}
MODULES = {"engine/io/modules": "engine/io", "app/ranks/modules": "app/ranks"}
MOST_SOURCES = 45

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
root = root if root.is_dir() else root.parent.parent
level = {folder: i for i, folder in enumerate(ORDER)}
faults = []
types = collections.defaultdict(set)
for top in sorted({folder.split("/")[0] for folder in ORDER}):
    count = collections.Counter()
    for path in sorted((root / top).rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        name = path.relative_to(root).as_posix()
        folder = MODULES.get(path.parent.relative_to(root).as_posix(), path.parent.relative_to(root).as_posix())
        count[folder] += 1
        if folder not in level:
            faults.append(f"{name}: the folder {folder} has no place in the order of tests/layers.py")
            continue
        text = path.read_text(encoding="utf-8")
        for number, line in enumerate(text.splitlines(), 1):
            if re.search(r'\bbackend\b\)? *[!=]= *"', line):
                faults.append(f"{name}:{number}: compares a back-end's name; say it in the back-end's row (printers/registry.cpp)")
            include = re.match(r'#include "([^"]+)/[^/"]+"', line)
            if include and include[1] in level:
                other = include[1]
                if level[other] > level[folder] and not {folder, other} <= TOGETHER:
                    faults.append(f"{name}:{number}: {folder} includes {other}, which stands above it")
                for a, b in APART:
                    if {folder.split("/")[0], other.split("/")[0]} == {a, b}:
                        faults.append(f"{name}:{number}: {folder} includes {other}: {a}/ and {b}/ never include each other")
            elif include and include[1].split("/")[0] in {folder.split("/")[0] for folder in ORDER}:
                faults.append(f"{name}:{number}: includes {include[1]}, which has no place in the order")
            defined = re.match(r"(?:struct|class|enum class) (\w+)(?: final)?(?: : [^;]*)?(?: \{.*)?$", line)
            if defined and path.suffix == ".h" and name != "bindings/lamella.h":
                types[defined[1]].add(name)
    faults += [f"{folder}: {n} sources; more than {MOST_SOURCES} is a folder that needs folders"
               for folder, n in count.items() if n > MOST_SOURCES]
for name, places in sorted(types.items()):
    if len(places) > 1:
        faults.append(f"type {name} is defined in several headers: {', '.join(sorted(places))}")
print("\n".join(faults) or f"layers: {len(ORDER)} folders, no include goes upward, {len(types)} types named once")
sys.exit(1 if faults else 0)
