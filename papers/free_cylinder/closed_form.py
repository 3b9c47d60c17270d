# SPDX-License-Identifier: BSD-3-Clause
"""The largest distance of each run from the closed form of the free cylinder.

    closed_form.py RESULTS OUT.csv

With y0 = J Ω0 and s = (I1 − I3) Ω3/I1 the attitude is Q = exp(t y0/I1) Rot(e3, s t), and Ω turns about axis 3 by −s t.
attitude_distance_max_rad: largest angle between the attitude and Q; angular_velocity_distance_max: largest |Ω − exact|, rad/s.
"""
import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from paper_quantities import SPIN, rows, to_body  # noqa: E402

I1, I3 = 0.04, 0.02  # kg m²
OMEGA = (2.0, 4.0, 6.0)  # rad/s, body axes
S = (I1 - I3) * OMEGA[2] / I1  # rad/s
RATE = [OMEGA[0], OMEGA[1], I3 / I1 * OMEGA[2]]  # rad/s: y0/I1


def product(p, q):
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def attitude(t):
    rate = math.hypot(*RATE)
    half = rate * t / 2
    precession = (math.cos(half), *(math.sin(half) * r / rate for r in RATE))
    return product(precession, (math.cos(S * t / 2), 0.0, 0.0, math.sin(S * t / 2)))


def angular_velocity(t):
    c, s = math.cos(S * t), math.sin(S * t)
    return OMEGA[0] * c + OMEGA[1] * s, OMEGA[1] * c - OMEGA[0] * s, OMEGA[2]


def distances(row):
    t, w, *vector = (float(row[k]) for k in ("t_s", "qw", "qx", "qy", "qz"))
    turn = product((w, *(-x for x in vector)), attitude(t))
    return 2 * math.atan2(math.hypot(*turn[1:]), abs(turn[0])), math.dist(to_body(row, SPIN), angular_velocity(t))


def main():
    results, out = map(pathlib.Path, sys.argv[1:])
    out.parent.mkdir(parents=True, exist_ok=True)
    with open(out, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(["integrator", "dt_s", "attitude_distance_max_rad", "angular_velocity_distance_max"])
        for run in rows(results / "runs.csv"):
            of = map(distances, rows(results / "trajectories" / run["run"] / "trajectory.csv"))
            lines.writerow([run["integrator"], run["dt_s"], *map(max, zip(*of))])


if __name__ == "__main__":
    main()
