# SPDX-License-Identifier: BSD-3-Clause
"""Observed orders of position, velocity and reaction, from the two smallest steps of each method.

    orders.py RESULTS RIGHT OUT.csv

The error of the reaction is the largest over all steps of a run, against the run in RIGHT.
"""
import csv
import math
import pathlib
import sys


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def forces(folder, run):
    """Force of the joint by the number of the 62.5 us step."""
    rows = read(folder / "trajectories" / run / "reactions.csv")
    return {round(float(row["t_s"]) / 6.25e-5): [float(row[f"f{k}_N"]) for k in "xyz"] for row in rows}


def main():
    results, right_folder, out = map(pathlib.Path, sys.argv[1:])
    right = forces(right_folder, read(right_folder / "runs.csv")[0]["run"])
    errors = {}
    for row in read(results / "runs.csv"):
        reaction = max(math.dist(force, right[k]) for k, force in forces(results, row["run"]).items())
        key = row["integrator"], row["start_values"]
        errors.setdefault(key, {})[float(row["dt_s"])] = (float(row["position_error_max_m"]), float(row["velocity_error_max_m_per_s"]), reaction)
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(["integrator", "start_values", "order_of_position", "order_of_velocity", "order_of_reaction"])
        for key, by_step in sorted(errors.items()):
            coarse, fine = (by_step[h] for h in sorted(by_step)[1::-1])
            lines.writerow([*key, *(math.log2(a / b) for a, b in zip(coarse, fine))])


if __name__ == "__main__":
    main()
