# SPDX-License-Identifier: BSD-3-Clause
"""The error of the energy in the flight of 49 balls by semi-implicit Euler: the mean over a motion of (49 m g h v/2)².

    flight.py RESULTS OUT.csv

RESULTS holds the run whose velocities v are taken. Steps h: 1e-5 to 1e-2 s.
"""
import csv
import pathlib
import sys

BALLS, M, G = 49, 10.0, 9.81  # -, kg, m/s²
STEPS = ("1e-5", "1e-4", "1e-3", "1e-2")  # s


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def main():
    results, out = map(pathlib.Path, sys.argv[1:])
    run = next(rows(results / "runs.csv"))["run"]
    squares = [float(row["vz_m_per_s"]) ** 2 for row in rows(results / "trajectories" / run / "trajectory.csv")]
    mean = sum(squares) / len(squares)  # m²/s²
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(["dt_s", "mean_square_J2"])
        lines.writerows([h, (BALLS * M * G * float(h) / 2) ** 2 * mean] for h in STEPS)


if __name__ == "__main__":
    main()
