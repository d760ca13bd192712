#!/usr/bin/env python3
"""Makes a wheel: the Python package with liblamella and the libraries that it needs inside.

The package calls the library by ctypes, so one wheel serves every Python 3. It needs glibc 2.36 or later.
"""
import argparse
import base64
import hashlib
import os
import pathlib
import shutil
import tempfile
import time
import zipfile

import project
from bundle import TRIPLETS, Bundle, set_runpath

PLATFORMS = {"amd64": "manylinux_2_36_x86_64", "arm64": "manylinux_2_36_aarch64", "armhf": "manylinux_2_36_armv7l"}


def metadata(table, version):
    readme = (project.ROOT / "bindings/python" / table["readme"]).read_text(encoding="utf-8")
    lines = ["Metadata-Version: 2.1", f"Name: {table['name']}", f"Version: {version}",
             f"Summary: {table['description']}", f"License: {table['license']['text']}",
             f"Requires-Python: {table['requires-python']}", *(f"Requires-Dist: {x}" for x in table["dependencies"]),
             "Description-Content-Type: text/markdown"]
    return "\n".join(lines) + "\n\n" + readme


def write_wheel(folder, path):
    """Zips the folder; the last entry of a wheel is a table of the others."""
    date = time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())))[:6]
    record = next(folder.glob("*.dist-info")) / "RECORD"
    rows = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        def add(name, content, mode):
            entry = zipfile.ZipInfo(name, date)
            entry.external_attr = mode << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
        for file in sorted(folder.rglob("*")):
            if not file.is_file():
                continue
            name, content = file.relative_to(folder).as_posix(), file.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            rows.append(f"{name},sha256={digest},{len(content)}\n")
            add(name, content, 0o100755 if ".so" in file.name else 0o100644)
        name = record.relative_to(folder).as_posix()
        add(name, "".join(rows) + f"{name},,\n", 0o100644)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--stage", "--arch", "--output"):
        parser.add_argument(name, required=True)
    asked = parser.parse_args()
    table, version = project.python_project(), project.version()
    if table["version"] != version:
        raise SystemExit(f"bindings/python/pyproject.toml says version {table['version']}, CMakeLists.txt {version}")
    tag = f"py3-none-{PLATFORMS[asked.arch]}"
    with tempfile.TemporaryDirectory() as scratch:
        top = pathlib.Path(scratch)
        package = top / "lamella"
        shutil.copytree(project.ROOT / "bindings/python/lamella", package, ignore=shutil.ignore_patterns("__pycache__"))
        library = package / "liblamella.so.1"
        shutil.copy(pathlib.Path(asked.stage) / "lib" / TRIPLETS[asked.arch] / "liblamella.so.1", library)
        bundle = Bundle(asked.arch)
        bundle.need(library)
        bundle.copy_to(top / "lamella.libs")
        set_runpath(library, "$ORIGIN/../lamella.libs")
        info = top / f"lamella-{version}.dist-info"
        bundle.copy_licences_to(info / "licenses/libraries")
        shutil.copy(project.ROOT / "LICENSE", info / "licenses/LICENSE")
        (info / "METADATA").write_text(metadata(table, version), encoding="utf-8")
        (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: lamella\nRoot-Is-Purelib: false\nTag: {tag}\n",
                                    encoding="utf-8")
        write_wheel(top, pathlib.Path(asked.output) / f"lamella-{version}-{tag}.whl")


if __name__ == "__main__":
    main()
