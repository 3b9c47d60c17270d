# SPDX-License-Identifier: BSD-3-Clause
"""The orders at which the errors at the end fall, by scenario, method, response and timing of impacts.

    orders.py EXACT_DIR OUT_DIR RESULTS [RESULTS ...]

EXACT_DIR is that of exact_motion.py, RESULTS are folders of studies. In OUT_DIR:
errors.csv   each run: step or tolerance, error of the position (m), the attitude (rad), the time of the first impact (s) and the
             energy (J)
cost.csv     right-hand sides with located impacts over those with impacts at steps, at h = COST_STEP
orders.csv   each method: the slopes of these errors against the step (tolerance) by least squares through the logarithms, the
             errors at the smallest one, and the right-hand sides there

With located impacts the slope is that over the POINTS smallest steps whose errors are above rounding. An impact that is answered at
a step is late by a part of the step, which jumps from one step to the next. There the slope is that of the root mean squares over
octaves of steps, and the error at the smallest step is that of the smallest octave.
"""
import csv
import itertools
import math
import pathlib
import sys

import numpy

ROUNDING = {"position": 1e-11, "attitude": 1e-11, "first_impact": 1e-12, "energy": 1e-11}  # m, rad, s, J
POINTS = 7
COST_STEP = 0.01  # s


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def numbers(row, names):
    return numpy.array([float(row[name]) for name in names])


def angle(p, q):
    """Between the attitudes of two quaternions, rad."""
    p, q = p / numpy.linalg.norm(p), q / numpy.linalg.norm(q)
    return 4 * math.asin(min(1.0, min(numpy.linalg.norm(p - q), numpy.linalg.norm(p + q)) / 2))


def errors_of(run, results, exact):
    places, turns = ("px_m", "py_m", "pz_m"), ("qw", "qx", "qy", "qz")
    *_, end = (row for row in rows(results / "trajectories" / run["run"] / "trajectory.csv") if row["body"] == "0")
    errors = {"position": float(numpy.linalg.norm(numbers(end, places) - numbers(exact, places))),
              "attitude": angle(numbers(end, turns), numbers(exact, turns))}
    errors["energy"] = float(run["energy_change_max_J"])
    if run["first_impact_s"]:
        errors["first_impact"] = abs(float(run["first_impact_s"]) - float(exact["impact_1_s"]))
    return errors


def octaves(points):
    """Root mean squares of the errors of each octave of steps, at the geometric mean of its steps."""
    smallest = points[0][0]
    for _, octave in itertools.groupby(points, key=lambda point: int(math.log2(point[0] / smallest) + 1e-9)):
        steps, errors = zip(*octave)
        yield math.exp(sum(map(math.log, steps)) / len(steps)), math.sqrt(sum(e * e for e in errors) / len(errors))


def slope(points):
    """The order, empty for fewer than three points."""
    if len(points) < 3:
        return ""
    return float(numpy.polyfit(*numpy.log(numpy.array(points)).T, 1)[0])


def order_cells(curve, name, located):
    points = [(size, errors[name]) for size, errors, _ in curve if name in errors]
    if not located:
        points = list(octaves(points))
    fitted = [point for point in points if point[1] > ROUNDING[name]][:POINTS if located else None]
    return [slope(fitted), len(fitted), points[0][1] if points else ""]


def write(path, head, lines):
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(head)
        table.writerows(lines)


def main():
    exact_folder, out, *studies = map(pathlib.Path, sys.argv[1:])
    out.mkdir(parents=True, exist_ok=True)
    curves, exact = {}, {}
    for results in studies:
        for run in rows(results / "runs.csv"):
            if run["status"] != "ok":
                continue
            scenario = run["scenario"]
            if scenario not in exact:
                exact[scenario] = next(rows(exact_folder / f"{scenario}.csv"))
            key = scenario, run["integrator"], run["response"], run["impact_timing"], "step" if run["dt_s"] else "tolerance"
            curves.setdefault(key, []).append((float(run["dt_s"] or run["tolerance"]), errors_of(run, results, exact[scenario]),
                                               int(run["rhs_evaluations"])))
    for curve in curves.values():
        curve.sort(key=lambda point: point[0])
    kinds = ["scenario", "integrator", "response", "impact_timing", "against"]
    write(out / "errors.csv", [*kinds, "size", *(f"{name}_error" for name in ROUNDING)],
          [[*key, size, *(errors.get(name, "") for name in ROUNDING)] for key in sorted(curves) for size, errors, _ in curves[key]])
    write(out / "orders.csv",
          [*kinds, "runs", *(f"{name}_{what}" for name in ROUNDING for what in ("order", "points", "error"))],
          [[*key, len(curve), *itertools.chain(*(order_cells(curve, name, key[3] == "event_located") for name in ROUNDING))]
           for key, curve in sorted(curves.items())])
    sides = {key: count for key, curve in curves.items() for size, _, count in curve if key[4] == "step" and size == COST_STEP}
    pairs = [(key, key[:3] + ("time_stepping",) + key[4:]) for key in sorted(sides) if key[3] == "event_located"]
    write(out / "cost.csv", ["scenario", "integrator", "located_over_at_steps"],
          [[*key[:2], sides[key] / sides[other]] for key, other in pairs if other in sides])


if __name__ == "__main__":
    main()
