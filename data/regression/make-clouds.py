#!/usr/bin/env python3
"""Makes the clouds of this folder with `knead make`: python3 make-clouds.py path/to/knead

What `knead make` has no shape for comes from one that it has: a bar made thinner, a tube that lost two rings.
Points that are left out change nothing in the others.
"""

import os
import struct
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def make(knead, name, shape, points, *options):
    path = os.path.join(HERE, name)
    command = [knead, "make", shape, "--points", str(points), "--seed", "4", *options, "--out", path]
    subprocess.run(command, check=True)
    return path


def change(path, change_point):
    """Rewrites a binary PLY of floats: change_point gets a point's list and gives it changed, or None."""
    with open(path, "rb") as file:
        header, _, body = file.read().partition(b"end_header\n")
    record = struct.Struct(f"<{header.count(b'property float')}f")
    points = [change_point(list(point)) for point in record.iter_unpack(body)]
    points = [point for point in points if point is not None]
    lines = [
        b"element vertex %d" % len(points) if line.startswith(b"element vertex") else line
        for line in header.splitlines()
    ]
    with open(path, "wb") as file:
        file.write(b"\n".join(lines) + b"\nend_header\n")
        for point in points:
            file.write(record.pack(*point))


def half_as_thick(point):
    return [0.5 * point[0], 0.5 * point[1], *point[2:]]


def without_two_rings(point):
    """The lower gap is 3 spacings wide, which is bridged, the upper one 10, which is too far."""
    return None if 0.1 < point[2] < 0.35 or 1.4 < point[2] < 2.2 else point


def main(knead):
    make(knead, "bar.ply", "bar", 2000)
    make(knead, "tube.ply", "cylinder", 2000)
    make(knead, "noisy.ply", "cylinder", 2000, "--noise", "0.5", "--outliers", "0.03")
    make(knead, "sheet.ply", "plane", 2000)
    make(knead, "solid.ply", "solid-bar", 2000)
    make(knead, "creature.ply", "creature", 2000, "--noise", "0.1", "--outliers", "0")
    change(make(knead, "long-solid.ply", "solid-bar", 2000), half_as_thick)
    change(make(knead, "parts.ply", "cylinder", 2500), without_two_rings)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(os.path.abspath(sys.argv[1]))
