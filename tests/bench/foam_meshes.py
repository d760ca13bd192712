"""Meshes of a foam for programs that slice meshes: binary STL.

    foam_meshes.py beams FOAM.csv OUT.stl           one closed capsule a beam (lamella dump beams); they intersect
    foam_meshes.py surface STACK MM OUT.stl         one closed surface, by marching cubes of a stack of masks whose
                                                    pixels and layers are MM large
"""
import sys
from pathlib import Path

import numpy as np

SIDES, RINGS = 12, 3  # of a capsule: round it, and over each end


def write_stl(path, triangles):
    records = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    records["corners"] = triangles
    with open(path, "wb") as out:
        out.write(b"foam".ljust(80))
        out.write(np.uint32(len(triangles)).tobytes())
        out.write(records.tobytes())


def capsule(a, ra, b, rb):
    axis = b - a
    axis /= np.linalg.norm(axis)
    side = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.9 else [0, 1, 0])
    side /= np.linalg.norm(side)
    turns = 2 * np.pi * np.arange(SIDES) / SIDES
    round_it = np.cos(turns)[:, None] * side + np.sin(turns)[:, None] * np.cross(axis, side)
    rings = []
    for at, radius, lifts in ((a, ra, np.linspace(-90, 0, RINGS + 1)[1:]), (b, rb, np.linspace(0, 90, RINGS + 1)[:-1])):
        for lift in np.radians(lifts):
            rings.append(at + radius * (np.cos(lift) * round_it + np.sin(lift) * axis))
    ends = a - ra * axis, b + rb * axis
    triangles = []
    for i in range(SIDES):
        j = (i + 1) % SIDES
        triangles.append((ends[0], rings[0][j], rings[0][i]))
        triangles.append((ends[1], rings[-1][i], rings[-1][j]))
        for low, high in zip(rings, rings[1:]):
            triangles.append((low[i], low[j], high[j]))
            triangles.append((low[i], high[j], high[i]))
    return triangles


def beams(source, target):
    rows = np.loadtxt(source, delimiter=",")
    triangles = [t for r in rows if not np.allclose(r[0:3], r[4:7]) for t in capsule(r[0:3], r[3], r[4:7], r[7])]
    write_stl(target, np.array(triangles))


def surface(stack, pitch, target):
    from skimage import io, measure

    masks = [io.imread(page, as_gray=True) for page in sorted(Path(stack).glob("*.png"))]
    volume = np.pad(np.stack(masks).astype(np.float32), 1)
    corners, faces, _, _ = measure.marching_cubes(volume, volume.max() / 2, spacing=(pitch,) * 3)
    # z first in the volume, and rows of masks run down: exchanging x and z turns the surface inside out.
    write_stl(target, corners[:, ::-1][faces][:, ::-1])


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "beams":
        beams(sys.argv[2], sys.argv[3])
    elif len(sys.argv) == 5 and sys.argv[1] == "surface":
        surface(sys.argv[2], float(sys.argv[3]), sys.argv[4])
    else:
        sys.exit(__doc__)
