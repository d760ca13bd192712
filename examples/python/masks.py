#!/usr/bin/env python3
"""Masks of a job's layers as numpy arrays: statistics of each, and pictures that any viewer shows (.pgm).

    python3 masks.py sphere_foam.toml --pixel 0.05 --every 20 --folder masks
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

import lamella


def write_pgm(path: Path, mask: np.ndarray) -> None:
    rows, columns = mask.shape
    path.write_bytes(b"P5\n%d %d\n255\n" % (columns, rows) + mask.tobytes())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recipe", help="a recipe (.toml) or a model (.stl, .obj, .ply, .3mf)")
    parser.add_argument("--pixel", type=float, default=0.05, help="mm")
    parser.add_argument("--every", type=int, default=1, help="of so many layers one is looked at")
    parser.add_argument("--folder", type=Path, help="where pictures go; without it there are none")
    asked = parser.parse_args()
    if asked.every < 1:
        parser.error("--every must be 1 or more")
    if asked.folder is not None:
        asked.folder.mkdir(parents=True, exist_ok=True)

    job = lamella.Recipe.read(asked.recipe).build()
    raster = lamella.Raster.over(job.bounds, asked.pixel)
    mask = np.empty(raster.shape, np.uint8)  # one for all layers: each is written over the last
    volume = 0.0
    print(" layer     z, mm  area, mm2   grey")
    for layer in range(0, job.layer_count, asked.every):
        with job.section(job.layer_z(layer)) as section:
            section.coverage(raster, out=mask)
            area = mask.sum(dtype=np.int64) / 255 * raster.pixel_area
            grey = np.count_nonzero((mask > 0) & (mask < 255)) / mask.size
            print(f"{layer:6} {section.z:9.3f} {area:10.2f} {grey:6.1%}")
        volume += area * job.layer_height * asked.every
        if asked.folder is not None:
            write_pgm(asked.folder / f"{layer:05}.pgm", mask)
    print(f"{job.name}: about {volume:.1f} mm3 in {job.layer_count} layers")


if __name__ == "__main__":
    try:
        main()
    except lamella.Error as error:
        sys.exit(f"{error}")
