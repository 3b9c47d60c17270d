# SPDX-License-Identifier: BSD-3-Clause
"""Algorithm 2 of the report with three readings of the vertex v in `v · norm < 0`, on cubes whose overlap is known.

    face_points.py OUT.csv

A is the unit cube at (3, 2, 1), B one parallel to it, its centre on a grid of 20³ displacements below 1 m along each axis,
so that all pairs overlap. OUT.csv has how many of them the algorithm calls touching: with v from the origin of the world,
from the centre of A, and from a point of the face.
"""
import itertools
import pathlib
import sys

CENTRE = (3.0, 2.0, 1.0)
FACES = [(axis, sign) for axis in range(3) for sign in (1, -1)]
CORNERS = list(itertools.product((-0.5, 0.5), repeat=3))
SHIFTS = [(2 * k - 19) / 20 for k in range(20)]


def touching(b, origin_of):
    """Algorithm 2: no face of A has all vertices of B outside; origin_of(face) is where v begins."""
    for axis, sign in FACES:
        start = origin_of((axis, sign))
        if not any(sign * (b[axis] + corner[axis] - start[axis]) < 0 for corner in CORNERS):
            return False
    return True


def on_face(face):
    axis, sign = face
    return [c + (0.5 * sign if i == axis else 0) for i, c in enumerate(CENTRE)]


def main():
    out = pathlib.Path(sys.argv[1])
    out.parent.mkdir(parents=True, exist_ok=True)
    grid = [tuple(c + d for c, d in zip(CENTRE, shift)) for shift in itertools.product(SHIFTS, repeat=3)]
    lines = ["v_from,overlapping,called_touching"]
    for name, origin_of in (("world", lambda face: (0, 0, 0)), ("centre of A", lambda face: CENTRE), ("face", on_face)):
        lines.append(f"{name},{len(grid)},{sum(touching(b, origin_of) for b in grid)}")
    out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
