#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes free_top_reference.csv: the motion of free tops to 40 digits, for free_top_test.cpp.

The equations of motion, w' = I^-1 ((I w) x w) and q' = 1/2 q (0, w), are integrated as they stand by Taylor series of
order 60 in fixed-point arithmetic (every number an integer multiple of 2^-BITS): no elliptic function, no principal
axes. What goes in are the doubles of the table, taken as exact. The script checks itself: energy and world angular
momentum must stay to 1e-42, and the first cases must agree to 1e-42 with a run of more digits and another order.

Usage: /usr/bin/python3 free_top_reference.py    (about three minutes on two cores)
"""
import csv
import math
import multiprocessing
import pathlib
from fractions import Fraction

from mpmath import mp, mpf

mp.dps = 60
BITS = 224
ORDER = 60
DIGITS = 40


def fixed(x, bits):
    """The exact number x (a double or a fraction) in fixed point."""
    x = Fraction(x)
    return (x.numerator << bits) // x.denominator


def convolve(a, b, n, bits):
    """Coefficient n of the product of two power series."""
    return sum(map(int.__mul__, a[: n + 1], b[n::-1])) >> bits


class Top:
    """One motion, marched in the unit of time in which the angular velocity is near 1."""

    def __init__(self, inertia, orientation, angular_velocity, bits=BITS, order=ORDER):
        self.bits, self.order = bits, order
        self.scale = Fraction(2) ** math.frexp(max(map(abs, angular_velocity)))[1]
        xx, yy, zz, xy, xz, yz = map(Fraction, inertia)
        m = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        cofactor = lambda i, j: (m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3]
                                 - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3])
        determinant = sum(m[0][j] * cofactor(0, j) for j in range(3))
        self.inertia = [[fixed(m[i][j], bits) for j in range(3)] for i in range(3)]
        self.inverse = [[fixed(cofactor(j, i) / determinant, bits) for j in range(3)] for i in range(3)]
        self.w = [fixed(Fraction(x) / self.scale, bits) for x in angular_velocity]
        self.q = [fixed(x, bits) for x in orientation]

    def times(self, matrix, v):
        return [sum(map(int.__mul__, row, v)) >> self.bits for row in matrix]

    def series(self):
        """Taylor coefficients of w and q about now."""
        bits, q = self.bits, [[x] for x in self.q]
        w, y = [[x] for x in self.w], [[x] for x in self.times(self.inertia, self.w)]
        for n in range(self.order):
            c = lambda a, b: convolve(a, b, n, bits)
            torque = [c(y[1], w[2]) - c(y[2], w[1]), c(y[2], w[0]) - c(y[0], w[2]), c(y[0], w[1]) - c(y[1], w[0])]
            twice_rate = [-c(q[1], w[0]) - c(q[2], w[1]) - c(q[3], w[2]),
                          c(q[0], w[0]) + c(q[2], w[2]) - c(q[3], w[1]),
                          c(q[0], w[1]) + c(q[3], w[0]) - c(q[1], w[2]),
                          c(q[0], w[2]) + c(q[1], w[1]) - c(q[2], w[0])]
            next_w = [x // (n + 1) for x in self.times(self.inverse, torque)]
            for a, x in zip(w, next_w):
                a.append(x)
            for a, x in zip(y, self.times(self.inertia, next_w)):
                a.append(x)
            for a, x in zip(q, twice_rate):
                a.append(x // (2 * (n + 1)))
        return w + q

    def march(self, time):
        """Goes on by `time` (exact, in the scaled unit; either sign)."""
        direction = 1 if time > 0 else -1
        left = abs(time)
        while left > 0:
            series = self.series()
            last = max(abs(a[-k]) for a in series for k in (1, 2)) or 1
            # the last term of the step: 2^-(bits - 20) of the unit
            step = Fraction(2) ** math.floor((20 - math.log2(last)) / self.order)
            step = min(step * Fraction(3, 2), left)
            h = fixed(direction * step, self.bits)
            left -= step
            values = []
            for a in series:
                value = 0
                for x in reversed(a):
                    value = (value * h >> self.bits) + x
                values.append(value)
            self.w, self.q = values[:3], values[3:]

    def state(self):
        one = mpf(1 << self.bits)
        scale = mpf(self.scale.numerator) / self.scale.denominator
        return [mpf(x) / one * scale for x in self.w], [mpf(x) / one for x in self.q]

    def invariants(self):
        """Energy and world angular momentum in the scaled unit."""
        one = mpf(1 << self.bits)
        w, q = [mpf(x) / one for x in self.w], [mpf(x) / one for x in self.q]
        y = [mpf(x) / one for x in self.times(self.inertia, self.w)]
        cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        # |q|² R y = (s² − v·v) y + 2 (v·y) v + 2 s v × y
        s, v = q[0], q[1:]
        vy, vv, c = sum(a * b for a, b in zip(v, y)), sum(a * a for a in v), cross(v, y)
        world = [(s * s - vv) * y[i] + 2 * vy * v[i] + 2 * s * c[i] for i in range(3)]
        return [sum(a * b for a, b in zip(w, y))] + world


def run(case):
    name, inertia, orientation, angular_velocity, times = case
    rows = []
    for sign in (1, -1):
        top = Top(inertia, orientation, angular_velocity)
        start, now = top.invariants(), Fraction(0)
        for t in sorted((t for t in times if t * sign > 0), key=abs):
            top.march(Fraction(t) * top.scale - now)
            now = Fraction(t) * top.scale
            drift = max(abs(a - b) for a, b in zip(start, top.invariants())) / max(map(abs, start))
            assert drift < mpf(10) ** -42, (name, t, drift)
            rows.append((name, inertia, angular_velocity, orientation, t, *top.state()))
    return rows


def check_against_more_digits(case):
    name, inertia, orientation, angular_velocity, times = case
    states = []
    for bits, order in ((BITS, ORDER), (BITS + 96, ORDER + 21)):
        top = Top(inertia, orientation, angular_velocity, bits, order)
        top.march(Fraction(max(times)) * top.scale)
        states.append(sum(top.state(), []))
    error = max(abs(a - b) for a, b in zip(*states))
    assert error < mpf(10) ** -DIGITS, (name, error)


def cases():
    turned = (0.5, -0.1, 0.7, math.sqrt(1 - 0.5**2 - 0.1**2 - 0.7**2))
    ahead = (0.3, 4.0, 25.0, 130.0, -7.0)
    diagonal = lambda *moments: (*moments, 0.0, 0.0, 0.0)
    box, symmetric_times = diagonal(0.6, 0.8, 1.0), (0.3, 5.0, 40.0, -11.0)
    # generic, both sides, every sign
    for i, w in enumerate([(3.0, 0.5, -0.9), (-3.0, 0.5, 0.9), (0.8, 0.5, 1.9), (0.8, -0.7, -1.9), (-0.3, 2.0, 1.2)]):
        yield f"generic {i}", box, turned, w, ahead
    yield "generic long", box, turned, (1.3, 0.4, 0.7), (1000.0, -400.0)
    # m_c = 0.0288 and 0.0304, either side of K = 2K', where theta series in either nome converge most slowly
    for w1 in (1.1811, 1.1822):
        yield f"K = 2K' {w1}", box, turned, (w1, 0.5, 0.9), tuple(0.7 * k for k in range(1, 13))
    yield "Hairer-Vilmart", box, (1.0, 0.0, 0.0, 0.0), (1.8 / 0.6, 0.4 / 0.8, -0.9), (10.0,)
    yield "Peters-Hsu", diagonal(0.80833333, 0.68333333, 0.14166667), (1.0, 0.0, 0.0, 0.0), (0.1, 5.0, 0.1), (1.0, 10.0)
    yield "flat, axes out of order", diagonal(1.0, 0.345, 0.653), turned, (-0.4, 1.1, 0.2), ahead
    yield "needle", diagonal(2.0, 0.001, 1.9995), turned, (0.4, 9.0, -0.7), (0.3, 9.0, 31.0, -5.0)
    yield "full matrix", (2.0, 3.0, 2.5, 0.3, -0.4, 0.2), turned, (0.7, -0.2, 1.1), ahead
    yield "full matrix, about the largest axis", (2.0, 3.0, 2.5, 0.3, -0.4, 0.2), turned, (0.1, 1.2, 0.1), ahead
    # at the given relative distance from the separatrix, which is w1² I1 (I2 − I1) = w3² I3 (I3 − I2)
    for k in (2, 4, 6, 8, 10, 12, 14, 16):
        for side in (1, -1):
            w1 = 0.9 * math.sqrt(1.0 * 0.2 / (0.6 * 0.2)) * (1 + side * 10.0**-k)
            sign = -1 if k % 4 == 0 else 1
            yield f"separatrix {side:+d}e-{k}", box, turned, (sign * w1, 0.3, 0.9), (2.0, 20.0, 47.0, 160.0, -33.0)
    for i, w in enumerate([(2.0, 0.5, 1.0), (2.0, -0.5, -1.0), (-2.0, 0.5, 1.0), (-2.0, -3.0, -1.0)]):
        yield f"separatrix exactly {i}", diagonal(3.0, 4.0, 6.0), turned, w, (1.0, 9.0, 60.0, -25.0)
    yield "separatrix of a full matrix", (2.0, 3.0, 2.5, 0.3, -0.4, 0.2), turned, (0.3, -0.4, 0.921), (2.0, 45.0, 130.0)
    # near the intermediate axis
    for k in (2, 5, 8, 11, 14):
        e = 10.0**-k
        for i, w in enumerate([(e, 1.0, 0.0), (0.0, -1.0, e), (e, 1.0, -2 * e)]):
            yield f"intermediate 1e-{k} {i}", diagonal(3.0, 5.0, 9.0), turned, w, (3.0, 90.0, 280.0, -60.0)
    yield "Dzhanibekov", diagonal(3.0, 5.0, 9.0), (1.0, 0.0, 0.0, 0.0), (0.0, 0.4, 0.01 / 9.0), (59.0, 118.0, 300.0)
    # near the stable axes
    for k in (3, 9):
        e = 10.0**-k
        yield f"smallest 1e-{k}", diagonal(3.0, 5.0, 9.0), turned, (-1.5, e, 2 * e), symmetric_times
        yield f"largest 1e-{k}", diagonal(3.0, 5.0, 9.0), turned, (e, -e, -1.5), symmetric_times
    # symmetric and nearly symmetric
    yield "oblate", diagonal(2.0, 2.0, 3.0), turned, (0.7, -0.3, 1.1), symmetric_times
    yield "prolate", diagonal(0.04, 0.04, 0.02), turned, (2.0, 4.0, -6.0), symmetric_times
    yield "prolate about 1", diagonal(1.0, 3.0, 3.0), turned, (-0.2, 1.0, 0.5), symmetric_times
    for k in (3, 6, 9, 12, 15):
        e = 10.0**-k
        yield f"oblate within 1e-{k}", diagonal(2.0, 2.0 + e, 3.0), turned, (0.7, -0.3, 1.1), symmetric_times
        yield f"prolate within 1e-{k}", diagonal(1.0, 3.0, 3.0 + e), turned, (-0.2, 1.0, 0.5), symmetric_times
        yield f"prolate within 1e-{k}, slow", diagonal(1.0, 3.0, 3.0 + e), turned, (e, 1.0, 0.5), symmetric_times
        yield f"sphere within 1e-{k}", diagonal(1.0, 1.0 + e, 1.0 + 3 * e), turned, (0.2, 1.0, 0.5), symmetric_times
    # no motion of the angular velocity
    yield "sphere", diagonal(1.5, 1.5, 1.5), turned, (0.2, -1.0, 0.5), symmetric_times
    for i, w in enumerate([(-1.1, 0.0, 0.0), (0.0, 1.1, 0.0), (0.0, 0.0, -1.1)]):
        yield f"pure spin {i}", box, turned, w, symmetric_times
    # of any size
    yield "tiny", box, turned, (1.3e-120, 0.4e-120, 0.7e-120), (0.5e120, 30e120)
    yield "huge", box, turned, (0.2e120, 0.4e120, 0.7e120), (0.5e-120, 30e-120)


def main():
    table = list(cases())
    with multiprocessing.Pool() as pool:
        pool.map(check_against_more_digits, [c for c in table if c[0] in ("Hairer-Vilmart", "separatrix +1e-14")], 1)
        rows = [row for result in pool.map(run, table, 1) for row in result]
    path = pathlib.Path(__file__).with_name("free_top_reference.csv")
    with path.open("w", newline="") as out:
        out.write("# Exact motions of free tops, 40 digits, written by tests/core/exact/free_top_reference.py: SI units, body axes,\n"
                  "# orientation body to world, scalar first; inertia, wx0 .. qz0 and t_s are doubles taken as exact.\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow("case ixx iyy izz ixy ixz iyz wx0 wy0 wz0 qw0 qx0 qy0 qz0 t_s wx wy wz qw qx qy qz".split())
        for name, inertia, w0, q0, t, w, q in rows:
            table.writerow([name.replace(",", ""), *map(repr, (*inertia, *w0, *q0, t)), *(mp.nstr(x, DIGITS) for x in w + q)])


if __name__ == "__main__":
    main()
