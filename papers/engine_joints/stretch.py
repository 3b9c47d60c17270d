# SPDX-License-Identifier: BSD-3-Clause
"""How far the chain has stretched at the end of each run, beside the same algebra along the vertical line alone.

    stretch.py RESULTS OUT.csv

A chain that hangs straight keeps to its line, on which the recipes are a recurrence for the heights of ten rods and a ball.
`by_hand_m` is that recurrence, `at_rest_m` the stretch at which it stands still, where that has a closed form.
"""
import csv
import math
import pathlib
import sys

GRAVITY, RODS = 9.81, 10
# method: error reduction, constraint force mixing, share of the diagonal, sweeps (0: together), relaxation
ENGINES = {"recipe_bullet_joints": (0.2, 0, 0, 10, 1), "recipe_ode_step": (0.2, 1e-10, 0, 0, 1),
           "recipe_ode_quickstep": (0.2, 1e-10, 0, 20, 1.3), "recipe_dart_joints": (0.01, 0, 1e-9, 0, 1)}


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def row_rates(v):
    return [v[0]] + [b - a for a, b in zip(v, v[1:])]


def push(v, mass, row, p):
    v[row] += p / mass[row]
    if row > 0:
        v[row - 1] -= p / mass[row - 1]


def diagonal(mass):
    return [1 / mass[0]] + [1 / a + 1 / b for a, b in zip(mass, mass[1:])]


def together(diag, mass, right):
    """The impulses by elimination: the matrix is tridiagonal, -1/m above and below the diagonal."""
    d, r = list(diag), list(right)
    for k in range(1, len(d)):
        factor = -1 / mass[k - 1] / d[k - 1]
        d[k] -= factor * (-1 / mass[k - 1])
        r[k] -= factor * r[k - 1]
    p = [0.0] * len(d)
    for k in reversed(range(len(d))):
        p[k] = (r[k] - (-1 / mass[k] * p[k + 1] if k + 1 < len(d) else 0)) / d[k]
    return p


def by_impulses(engine, iterations, mass, h, steps):
    erp, cfm, share, sweeps, relaxation = engine
    sweeps = iterations or sweeps
    diag = [a * (1 + share) + cfm / h for a in diagonal(mass)]
    v, gap = [0.0] * len(mass), [0.0] * len(mass)
    for _ in range(steps):
        v = [x - h * GRAVITY for x in v]
        right = [-u - erp / h * g for u, g in zip(row_rates(v), gap)]
        if engine[3] == 0:
            p = together(diag, mass, right)
        else:
            p, change = [0.0] * len(mass), [0.0] * len(mass)
            for _ in range(sweeps):
                for k in range(len(mass)):
                    rate = change[k] - (change[k - 1] if k else 0)
                    more = relaxation * (right[k] - rate - cfm / h * p[k]) / diag[k]
                    p[k] += more
                    push(change, mass, k, more)
        for k, impulse in enumerate(p):
            push(v, mass, k, impulse)
        gap = [g + h * u for g, u in zip(gap, row_rates(v))]
    return -sum(gap)


def soft_rate(h):
    return 2 * math.pi * min(60, 1 / (8 * h))


def by_soft_steps(mass, h, steps):
    omega = soft_rate(h)
    a1 = 4 + h * omega
    a2 = h * omega * a1
    diag = diagonal(mass)
    v, gap, p = [0.0] * len(mass), [0.0] * len(mass), [0.0] * len(mass)

    def sweep(rate, share):
        for k in range(len(mass)):
            speed = v[k] - (v[k - 1] if k else 0)
            more = -share * (speed + rate * gap[k]) / diag[k] - (1 - share) * p[k]
            p[k] += more
            push(v, mass, k, more)

    for _ in range(steps):
        for k in range(len(mass)):
            v[k] -= h * GRAVITY
        for k in range(len(mass)):
            push(v, mass, k, p[k])
        sweep(omega / a1, a2 / (1 + a2))
        gap = [g + h * u for g, u in zip(gap, row_rates(v))]
        sweep(0, 1)
    return -sum(gap)


def main():
    results, out = map(pathlib.Path, sys.argv[1:])
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(["integrator", "ball_kg", "iterations", "substeps", "stretch_m", "by_hand_m", "ratio", "at_rest_m",
                        "of_rest"])
        for run in read(results / "runs.csv"):
            method, ball, h = run["integrator"], float(run["body.10.mass"]), float(run["dt_s"])
            steps = round(float(run["t_end_s"]) / h)
            substeps = int(run.get("substeps") or (4 if method == "recipe_box2d_soft_step" else 1))
            iterations = int(run.get("iterations") or 0)
            mass = [1.0] * RODS + [ball]
            load = [(sum(mass[k:])) * GRAVITY for k in range(len(mass))]
            ends = read(results / "trajectories" / run["run"] / "trajectory.csv")[-1]  # end of the ball, the last body
            stretch = -RODS - float(ends["pz_m"])
            h /= substeps
            if method == "recipe_box2d_soft_step":
                by_hand = by_soft_steps(mass, h, steps * substeps)
                rest = sum(a * f for a, f in zip(diagonal(mass), load)) / soft_rate(h) ** 2
            elif method in ENGINES:
                by_hand = by_impulses(ENGINES[method], iterations, mass, h, steps * substeps)
                rest = sum(load) * 1e-10 * h / 0.2 if method == "recipe_ode_step" else None
            else:
                by_hand = rest = None
            lines.writerow([method, run["body.10.mass"], run.get("iterations", ""), run.get("substeps", ""), repr(stretch),
                            "" if by_hand is None else repr(by_hand), "" if not by_hand else repr(stretch / by_hand),
                            "" if rest is None else repr(rest), "" if not rest else repr(stretch / rest)])


if __name__ == "__main__":
    main()
