# SPDX-License-Identifier: BSD-3-Clause
"""Forces of the joints at P at the end: the multipliers of the source.

    end_forces.py RESULTS... OUT.csv
"""
import csv
import pathlib
import sys

AT_P = {"k3": 14, "k4": 15, "k6": 16}  # their places in the scenario


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    *results, out = map(pathlib.Path, sys.argv[1:])
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(["integrator", "joint", "fx_N", "fy_N"])
        for folder in results:
            for run in read(folder / "runs.csv"):
                last = {row["joint"]: row for row in read(folder / "trajectories" / run["run"] / "reactions.csv")}
                lines.writerows([run["integrator"], name, last[str(k)]["fx_N"], last[str(k)]["fy_N"]] for name, k in AT_P.items())


if __name__ == "__main__":
    main()
