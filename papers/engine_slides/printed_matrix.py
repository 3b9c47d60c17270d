# SPDX-License-Identifier: BSD-3-Clause
"""The slides' matrix of a quaternion, as printed and transposed, along a motion.

    printed_matrix.py QUATERNION_RUN MATRIX_RUN OUT_FOLDER

The runs are trajectories of one motion: QUATERNION_RUN by q' = ½ ω q, MATRIX_RUN by R' = ω* R, with the columns r11 … r33.
OUT_FOLDER gets printed.csv and transposed.csv, the motion with the slides' matrix M of q and with Mᵀ, for `judge`; and
distances.csv: the largest |M − R| and |Mᵀ − R| (Frobenius) along it.
"""
import csv
import math
import pathlib
import sys

ENTRIES = [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
KEPT = ["t_s", "wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s"]


def printed(w, x, y, z):
    """The rotation part of "Computing the Transform Matrix", row by row, letter by letter."""
    return [2 * x * x + 2 * w * w - 1, 2 * x * y + 2 * z * w, 2 * x * z - 2 * y * w,
            2 * x * y - 2 * z * w, 2 * y * y + 2 * w * w - 1, 2 * y * z + 2 * x * w,
            2 * x * z + 2 * y * w, 2 * y * z - 2 * x * w, 2 * z * z + 2 * w * w - 1]


def transposed(m):
    return [m[3 * j + i] for i in range(3) for j in range(3)]


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def main():
    by_quaternion, by_matrix, out = map(pathlib.Path, sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    tables = {"printed": [], "transposed": []}
    apart = {"printed": 0.0, "transposed": 0.0}
    for row, other in zip(rows(by_quaternion), rows(by_matrix), strict=True):
        m = printed(*(float(row[k]) for k in ("qw", "qx", "qy", "qz")))
        r = [float(other[k]) for k in ENTRIES]
        for name, matrix in (("printed", m), ("transposed", transposed(m))):
            tables[name].append([row[k] for k in KEPT] + [repr(x) for x in matrix])
            apart[name] = max(apart[name], math.dist(matrix, r))
    for name, lines in tables.items():
        with open(out / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([KEPT + ENTRIES, *lines])
    with open(out / "distances.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([["matrix", "distance_max"], *apart.items()])


if __name__ == "__main__":
    main()
