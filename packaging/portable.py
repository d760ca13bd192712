#!/usr/bin/env python3
"""Makes lamella-VERSION-linux-MACHINE.tar.gz: the command with its libraries, to be unpacked anywhere.

It runs on every system with glibc 2.36 or later. Without OpenImageIO: pictures are PNG.
"""
import argparse
import gzip
import os
import pathlib
import shutil
import tarfile
import tempfile

import project
from bundle import TRIPLETS, Bundle, set_runpath

MACHINES = {"amd64": "x86_64", "arm64": "aarch64", "armhf": "armv7l"}


def reset(entry):
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = "root"
    entry.mtime = int(os.environ.get("SOURCE_DATE_EPOCH", entry.mtime))
    return entry


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--stage", "--arch", "--output"):
        parser.add_argument(name, required=True)
    asked = parser.parse_args()
    stage = pathlib.Path(asked.stage)
    title = f"lamella-{project.version()}-linux-{MACHINES[asked.arch]}"
    with tempfile.TemporaryDirectory() as scratch:
        top = pathlib.Path(scratch) / title
        (top / "bin").mkdir(parents=True)
        shutil.copy(stage / "bin/lamella", top / "bin/lamella")
        bundle = Bundle(asked.arch)
        bundle.need(top / "bin/lamella")
        bundle.copy_to(top / "lib")
        set_runpath(top / "bin/lamella", "$ORIGIN/../lib")
        bundle.copy_licences_to(top / "share/doc/lamella/libraries")
        for part in ("man", "bash-completion", "zsh", "fish", "lamella", "doc/lamella"):
            shutil.copytree(stage / "share" / part, top / "share" / part, dirs_exist_ok=True)
        # For menus of other systems, and for the Flatpak.
        for file in (*(stage / "share").glob("applications/*.desktop"), *(stage / "share").glob("metainfo/*.xml"),
                     *(stage / "share").glob("icons/hicolor/scalable/apps/*.svg")):
            (top / "share/lamella/desktop").mkdir(exist_ok=True)
            shutil.copy(file, top / "share/lamella/desktop")
        shutil.copy(project.ROOT / "LICENSE", top / "LICENSE")
        target = pathlib.Path(asked.output) / f"{title}.tar.gz"
        with open(target, "wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
            with tarfile.open(fileobj=packed, mode="w") as archive:
                archive.add(top, title, filter=reset)


if __name__ == "__main__":
    main()
