#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes kepler_motion_reference.csv and linear_motion_reference.csv to 40 digits, for path_test.cpp.

Kepler's r'' = -mu r/|r|^3 is integrated as it stands by Taylor series; the energy must stay to 1e-44. The linear
oscillator x'' + 2 gamma x' + w^2 x = 1 comes from the matrix exponential. Doubles go in and are taken as exact.

Usage: /usr/bin/python3 path_reference.py    (a few minutes)
"""
import csv
import math
import pathlib

from mpmath import expm, matrix, mp, mpf

mp.dps = 60
ORDER = 50
DIGITS = 40
HERE = pathlib.Path(__file__)


def kepler_series(mu, r, v):
    """Taylor coefficients of the position: r'' = -mu u r with u = (r.r)^(-3/2), from s u' = -3/2 s' u."""
    p, rate, s, u = [[x] for x in r], [[x] for x in v], [sum(x * x for x in r)], []
    u.append(s[0] ** mpf(-1.5))
    for n in range(ORDER):
        for x, y in zip(p, rate):
            x.append(y[n] / (n + 1))
        for x, y in zip(p, rate):
            y.append(-mu * sum(u[k] * x[n - k] for k in range(n + 1)) / (n + 1))
        s.append(sum(x[k] * x[n + 1 - k] for x in p for k in range(n + 2)))
        m = n + 1
        u.append(sum((mpf(-1.5) * k - (m - k)) * s[k] * u[m - k] for k in range(1, m + 1)) / (m * s[0]))
    return p, rate


def kepler(mu, r, v, t):
    mu, r, v, left = mpf(mu), [mpf(x) for x in r], [mpf(x) for x in v], mpf(t)
    energy = lambda: sum(x * x for x in v) / 2 - mu / mp.sqrt(sum(x * x for x in r))
    scale, start = sum(x * x for x in v) + mu / mp.sqrt(sum(x * x for x in r)), energy()
    while left != 0:
        p, rate = kepler_series(mu, r, v)
        size = lambda k: max(max(abs(x[k]) for x in p) / max(map(abs, r)), max(abs(x[k]) for x in rate) / max(map(abs, v)))
        step = min((mpf(10) ** -56 / size(k)) ** (mpf(1) / k) for k in (ORDER - 1, ORDER))
        step = mp.sign(left) * min(step, abs(left))
        left -= step
        r, v = [mp.polyval(x[::-1], step) for x in p], [mp.polyval(x[::-1], step) for x in rate]
        scale = max(scale, sum(x * x for x in v))
    assert abs(energy() - start) < scale * mpf(10) ** -44, (r, v, t)
    return r, v


def kepler_cases():
    for e in (0.0, 1e-12, 1e-6, 0.1, 0.5, 0.9, 0.999, 1 - 1e-6, 1 - 1e-12, 1.0, 1 + 1e-12, 1 + 1e-6, 1.001, 1.5, 10.0, 1e4):
        # from the pericentre at distance 1, inclined
        speed = math.sqrt(1 + e)
        for t in (0.1, 1.7, 30.0, -4.0) + ((200.0,) if e < 0.95 else ()):
            yield f"pericentre e = {e}", 1.0, (0.0, 0.8, 0.6), (speed, 0.0, 0.0), t
    for e in (1e-9, 0.5, 0.99, 0.9999):
        # from the apocentre, and back past the pericentre
        speed = math.sqrt((1 - e))
        half = math.pi * (1 + e) ** -1.5
        for t in (0.5 * half, half, 1.01 * half, 1.9 * half):
            yield f"apocentre e = {e}", 1.0, (1.0, 0.0, 0.0), (0.0, -0.6 * speed, 0.8 * speed), t
    for v in ((0.3, -0.2, 0.9), (1.4, 0.1, 0.0), (-1.41, 0.01, 0.02), (3.0, 0.1, -0.1), (-3.0, 0.1, -0.1)):
        for t in (0.4, 3.0, -2.0, 25.0):
            yield f"aslant {v}".replace(",", ""), 1.3, (1.0, -0.4, 0.2), v, t
    for v in ((0.2, 0.0, 0.0), (1.5, 0.0, 0.0), (3.0, 0.0, 0.0)):
        for t in (0.3, 0.9):
            yield f"on a line {v[0]}", 1.0, (1.0, 0.0, 0.0), v, t
    yield "the earth", 1.32712440018e20, (1.4709e11, 0.0, 0.0), (0.0, 3.029e4, 0.0), 1e8


def linear_cases():
    for stiffness in (0.0, 1e-12, 1e-4, 0.3, 1.0, 1.0000001, 50.0):
        for damping in (0.0, 1e-9, 1e-3, 0.7, 2.0, 2.0000001, 30.0):
            for t in (1e-3, 0.4, 1.1, 3.0, 20.0, 400.0):
                if damping * t < 1000:
                    yield stiffness, damping, t


def write(name, meaning, header, rows):
    with HERE.with_name(name).open("w", newline="") as out:
        out.write(f"# {meaning}, 40 digits, written by tests/core/exact/{HERE.name}; the start and t_s are doubles taken as exact.\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(header.split())
        table.writerows(rows)


def main():
    digits = lambda numbers: [mp.nstr(x, DIGITS) for x in numbers]
    rows = []
    for name, mu, r0, v0, t in kepler_cases():
        r, v = kepler(mu, r0, v0, t)
        rows.append((name, *map(repr, (mu, *r0, *v0, t)), *digits(r + v)))
    write("kepler_motion_reference.csv", "Exact motions r'' = -mu r/|r|^3", "case mu x0 y0 z0 vx0 vy0 vz0 t_s x y z vx vy vz", rows)
    rows = []
    for stiffness, damping, t in linear_cases():
        a = matrix([[0, 1, 0], [-mpf(stiffness), -mpf(damping), 1], [0, 0, 0]]) * mpf(t)
        mp.dps = 60 + int(max(0, t * damping))
        e = expm(a)
        mp.dps = 60
        rows.append((*map(repr, (stiffness, damping, t)), *digits(+x for x in (e[0, 1], e[0, 2], e[1, 1]))))
    write("linear_motion_reference.csv", "Responses of x'' + 2 gamma x' + w^2 x = a to a velocity and to an acceleration",
          "w2 two_gamma t_s by_velocity by_acceleration rate_by_velocity", rows)


if __name__ == "__main__":
    main()
