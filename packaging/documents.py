#!/usr/bin/env python3
"""Writes what names the version: changelogs in the forms of Debian and AppStream, and the Flatpak's manifest.

The date is that of SOURCE_DATE_EPOCH, else that of the last commit, so that equal sources make equal packages.
"""
import argparse
import email.utils
import gzip
import os
import pathlib
import subprocess
import time

HERE = pathlib.Path(__file__).resolve().parent


def source_date():
    if date := os.environ.get("SOURCE_DATE_EPOCH"):
        return int(date)
    said = subprocess.run(["git", "-C", HERE, "log", "-1", "--format=%ct"], capture_output=True, text=True)
    return int(said.stdout) if said.returncode == 0 else int((HERE.parent / "CHANGELOG.md").stat().st_mtime)


def write_gzip(path, text):
    with open(path, "wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
        packed.write(text.encode())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--version", "--app-id", "--maintainer", "--output"):
        parser.add_argument(name, required=True)
    asked = parser.parse_args()
    output = pathlib.Path(asked.output)
    output.mkdir(parents=True, exist_ok=True)
    date = source_date()
    write_gzip(output / "changelog.gz", (HERE.parent / "CHANGELOG.md").read_text(encoding="utf-8"))
    write_gzip(output / "changelog.Debian.gz",
               f"lamella ({asked.version}-1) stable; urgency=medium\n\n"
               f"  * Lamella {asked.version}; changelog.gz says what is new.\n\n"
               f" -- {asked.maintainer}  {email.utils.formatdate(date)}\n")
    day = time.strftime("%Y-%m-%d", time.gmtime(date))
    for name in (f"desktop/{asked.app_id}.metainfo.xml", f"flatpak/{asked.app_id}.yaml"):
        text = (HERE / name).read_text(encoding="utf-8").replace("@VERSION@", asked.version).replace("@DATE@", day)
        (output / pathlib.Path(name).name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
