# SPDX-License-Identifier: BSD-3-Clause
"""What explicit Euler adds to the energy of a free body, beside theory: h²/2 Ω̇ᵀ J Ω̇ at every step.

    energy_gain.py TRAJECTORY I1 I2 I3 OUT.csv

TRAJECTORY has every step of a body in body axes (--angular-state velocity_body). OUT.csv has the gain of the whole run in J and
over the sum of theory's, and the largest difference of one step in parts of the energy.
"""
import csv
import math
import pathlib
import sys


def to_body(q, v):
    """q* v q / |q|²."""
    w, *u = q
    n = w * w + sum(x * x for x in u)
    u = [-x for x in u]
    uv = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    uuv = [u[1] * uv[2] - u[2] * uv[1], u[2] * uv[0] - u[0] * uv[2], u[0] * uv[1] - u[1] * uv[0]]
    return [v[i] + 2 * (w * uv[i] + uuv[i]) / n for i in range(3)]


def main():
    trajectory, *moments, out = sys.argv[1:]
    moments = [float(m) for m in moments]
    energies, gains, before = [], [], None
    with open(trajectory, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            o = to_body([float(row[k]) for k in ("qw", "qx", "qy", "qz")],
                        [float(row[k]) for k in ("wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s")])
            energies.append(sum(m * x * x for m, x in zip(moments, o)) / 2)
            if before:
                h = float(row["t_s"]) - before[0]
                gains.append(h * h / 2 * sum(m * x * x for m, x in zip(moments, before[1])))
            y = [m * x for m, x in zip(moments, o)]
            torque = [y[1] * o[2] - y[2] * o[1], y[2] * o[0] - y[0] * o[2], y[0] * o[1] - y[1] * o[0]]
            before = float(row["t_s"]), [x / m for m, x in zip(moments, torque)]
    worst = max(abs(b - a - gain) for a, b, gain in zip(energies, energies[1:], gains)) / energies[0]
    gain = energies[-1] - energies[0]
    path = pathlib.Path(out)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"steps,gain_J,gain_over_theory,step_difference_max_rel\n"
                    f"{len(gains)},{gain!r},{gain / math.fsum(gains)!r},{worst!r}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
