# SPDX-License-Identifier: BSD-3-Clause
"""What a step costs beside one of DMV: right-hand sides, and wall time as it was in this run.

    step_cost.py RESULTS OUT.csv

RESULTS holds runs of each method that were carried out one after another; the least time of a method counts.
"""
import csv
import pathlib
import sys


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    results, out = map(pathlib.Path, sys.argv[1:])
    seconds = {row["run"]: float(row["wall_per_step_s"]) for row in read(results / "timings.csv")}
    cost = {}
    for row in read(results / "runs.csv"):
        mine = int(row["rhs_evaluations"]) / int(row["steps"]), seconds[row["run"]]
        cost[row["integrator"]] = min(mine, cost.get(row["integrator"], mine))
    sides, time = cost["dmv"]
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(["integrator", "right_hand_sides_over_dmv", "wall_time_over_dmv"])
        lines.writerows([name, mine / sides, wall / time] for name, (mine, wall) in cost.items())


if __name__ == "__main__":
    main()
