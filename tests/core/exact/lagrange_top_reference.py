#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes lagrange_top_reference.csv: motions of heavy tops and pendula to 40 digits, for lagrange_top_test.cpp.

The equations of motion, I w' = (I w) x w + m c x (R^T g) and q' = 1/2 q (0, w), are integrated as they stand by the
Taylor series of free_top_reference.py: no elliptic function, no Euler angle. The script checks itself: energy, p_phi
and p_psi must stay to 1e-42, and some cases must agree to 1e-40 with a run of more digits and another order.

Usage: /usr/bin/python3 lagrange_top_reference.py    (about three minutes on two cores)
"""
import csv
import math
import multiprocessing
import pathlib
from fractions import Fraction

from mpmath import mp, mpf

from free_top_reference import BITS, DIGITS, ORDER, Top, convolve, fixed


class HeavyTop(Top):
    def __init__(self, mass, inertia, center, gravity, orientation, angular_velocity, bits=BITS, order=ORDER):
        rate = max(max(map(abs, angular_velocity)), math.sqrt(mass * math.hypot(*center) * math.hypot(*gravity)
                                                              / min(inertia[:3])))
        super().__init__(inertia, orientation, angular_velocity, bits, order)
        self.scale = Fraction(2) ** math.frexp(rate)[1]
        self.w = [fixed(Fraction(x) / self.scale, bits) for x in angular_velocity]
        length2 = sum(Fraction(x) ** 2 for x in orientation)
        self.arm = [fixed(Fraction(mass) * Fraction(x), bits) for x in center]
        self.pull = [fixed(Fraction(x) / self.scale**2 / length2, bits) for x in gravity]

    def turned(self, p, g):
        """|q|² R^T g from the products p[i, j] of the components of q."""
        m = [[p[0, 0] + p[1, 1] - p[2, 2] - p[3, 3], 2 * (p[1, 2] - p[0, 3]), 2 * (p[1, 3] + p[0, 2])],
             [2 * (p[1, 2] + p[0, 3]), p[0, 0] + p[2, 2] - p[1, 1] - p[3, 3], 2 * (p[2, 3] - p[0, 1])],
             [2 * (p[1, 3] - p[0, 2]), 2 * (p[2, 3] + p[0, 1]), p[0, 0] + p[3, 3] - p[1, 1] - p[2, 2]]]
        return [sum(m[k][i] * g[k] for k in range(3)) for i in range(3)]

    def series(self):
        bits, q = self.bits, [[x] for x in self.q]
        w, y = [[x] for x in self.w], [[x] for x in self.times(self.inertia, self.w)]
        for n in range(self.order):
            c = lambda a, b: convolve(a, b, n, bits)
            p = {(i, j): c(q[i], q[j]) for i in range(4) for j in range(i, 4)}
            g = [x >> bits for x in self.turned(p, self.pull)]
            arm = self.arm
            weight = [arm[1] * g[2] - arm[2] * g[1], arm[2] * g[0] - arm[0] * g[2], arm[0] * g[1] - arm[1] * g[0]]
            torque = [c(y[1], w[2]) - c(y[2], w[1]), c(y[2], w[0]) - c(y[0], w[2]), c(y[0], w[1]) - c(y[1], w[0])]
            torque = [a + (b >> bits) for a, b in zip(torque, weight)]
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

    def invariants(self):
        """Twice the energy, the momentum about the vertical and |q|², in the scaled unit."""
        one = mpf(1 << self.bits)
        number = lambda v: [mpf(x) / one for x in v]
        w, q, y = number(self.w), number(self.q), number(self.times(self.inertia, self.w))
        g = self.turned({(i, j): q[i] * q[j] for i in range(4) for j in range(i, 4)}, number(self.pull))
        dot = lambda a, b: sum(x * s for x, s in zip(a, b))
        return [dot(w, y) - 2 * dot(number(self.arm), g), dot(y, g), dot(q, q)]


def run(case):
    name, mass, inertia, center, gravity, orientation, angular_velocity, times = case
    rows = []
    for sign in (1, -1):
        top = HeavyTop(*case[1:7])
        start, now = top.invariants(), Fraction(0)
        for t in sorted((t for t in times if t * sign > 0), key=abs):
            top.march(Fraction(t) * top.scale - now)
            now = Fraction(t) * top.scale
            drift = max(abs(a - b) for a, b in zip(start, top.invariants())) / max(map(abs, start))
            assert drift < mpf(10) ** -42, (name, t, drift)
            w, q = top.state()
            length = mp.sqrt(sum(mpf(x) ** 2 for x in orientation))
            rows.append((*case[:7], t, w, [x / length for x in q]))
    return rows


def check_against_more_digits(case):
    states = []
    for bits, order in ((BITS, ORDER), (BITS + 96, ORDER + 21)):
        top = HeavyTop(*case[1:7], bits, order)
        top.march(Fraction(max(case[7])) * top.scale)
        states.append(sum(top.state(), []))
    error = max(abs(a - b) for a, b in zip(*states))
    assert error < mpf(10) ** -DIGITS, (case[0], error)


def tilt(angle, azimuth=0.0):
    """A turn by `angle` about a horizontal axis, then about the vertical."""
    c, s = math.cos(angle / 2), math.sin(angle / 2)
    d, e = math.cos(azimuth / 2), math.sin(azimuth / 2)
    return (d * c, d * s, e * s, e * c)


def cases():
    diagonal = lambda *moments: (*moments, 0.0, 0.0, 0.0)
    down, top, arm = (0.0, 0.0, -9.81), diagonal(0.3, 0.3, 0.1), (0.0, 0.0, 0.5)
    turned = (0.5, -0.1, 0.7, 0.5)
    times = (0.3, 2.1, 5.0, 17.0, -4.0)
    heavy = lambda name, q, w, t=times: (name, 1.0, top, arm, down, q, w, t)
    yield heavy("cusps", tilt(0.5), (0.0, 0.0, 30.0))
    for i, w in enumerate([(1.0, -2.0, 7.0), (1.0, -2.0, -7.0), (-3.0, 0.4, 12.0), (0.7, 5.0, 0.0), (0.0, 0.0, 1.0)]):
        yield heavy(f"generic {i}", turned, w)
    yield heavy("fast", tilt(1.1, 0.4), (0.3, -0.2, 300.0), (0.3, 2.1, -1.0))
    yield ("Simo-Wong", 1.0, diagonal(5.0, 5.0, 1.0), (0.0, 0.0, 2.0), (0.0, 0.0, -10.0),
           (0.9996875162757026, 0.024997395914712332, 0.0, 0.0), (0.0, 0.0, 50.0), (1.0, 10.0))
    yield ("flat", 2.0, diagonal(0.2, 0.2, 0.4), (0.0, 0.0, 0.3), down, turned, (3.0, -2.0, -7.0), times)
    yield ("hanging", 2.0, diagonal(0.2, 0.2, 0.1), (0.0, 0.0, -0.3), down, turned, (3.0, -2.0, -7.0), times)
    yield ("about the first axis, gravity aslant", 1.5, diagonal(0.1, 0.3, 0.3), (-0.5, 0.0, 0.0), (1.0, 2.0, -9.0),
           turned, (1.0, -2.0, -3.0), times)
    yield ("nearly weightless", 1.0, top, (0.0, 0.0, 1e-9), down, turned, (1.0, -2.0, 7.0), times)
    # about the limit of a sleeping top, 24.26 rad/s
    for spin in (20.0, 24.2, 24.3, 30.0):
        for angle in (1e-3, 1e-7):
            yield heavy(f"sleeping {spin} {angle}", tilt(angle, 0.7), (0.0, 0.0, spin), (1.0, 6.0, 12.0))
    # through the vertical and past it
    yield heavy("through the top", (1.0, 0.0, 0.0, 0.0), (1.0, 2.0, 10.0))
    yield heavy("through the bottom", (0.0, 1.0, 0.0, 0.0), (1.0, 2.0, 10.0))
    for e in (1e-4, 1e-9, 1e-15):
        yield heavy(f"past the top {e}", (1.0, e, 0.0, 0.0), (1.0, 2.0, 10.0))
        yield heavy(f"past the bottom {e}", (e, 1.0, 0.0, 0.0), (1.0, 2.0, 10.0))
    # steady precession: I3 w3 p - I1 p^2 cos(tilt) = m g l, with w = (0, p sin, p cos + spin)
    for e in (0.0, 1e-12, 1e-6, 1e-3):
        angle, rate = 0.6, 2.5
        spin = (1.0 * 9.81 * 0.5 + 0.3 * rate**2 * math.cos(angle)) / (0.1 * rate)
        yield heavy(f"steady within {e}", tilt(angle), (e, rate * math.sin(angle), spin))
    # planar swings of bodies of three different moments, and the separatrix sin(angle/2) = sn
    rod = diagonal(0.3334, 0.31, 0.1)
    swing = lambda name, q, w, t=times: (name, 1.0, rod, (0.0, 0.0, -0.5), down, q, (w, 0.0, 0.0), t)
    yield swing("pendulum", tilt(1.0), 0.0)
    yield swing("pendulum from below", tilt(0.0), 4.0)
    yield swing("pendulum over the top", tilt(0.0), 14.0)
    limit = 2 * math.sqrt(9.81 * 0.5 / 0.3334)
    for e in (-1e-3, -1e-10, 1e-14, 1e-6):
        yield swing(f"pendulum near the separatrix {e}", tilt(0.0), limit * (1 + e), (0.5, 2.0, 6.0))
    yield swing("pendulum, small", tilt(1e-6), 0.0)
    yield ("disc upright on its rim", 1.0, diagonal(0.3, 0.3, 0.5), (0.5, 0.0, 0.0), (0.0, -9.81, 0.0), tilt(0.0),
           (0.0, 0.0, 1.0), times)


def main():
    table = list(cases())
    with multiprocessing.Pool() as pool:
        pool.map(check_against_more_digits, [c for c in table if c[0] in ("generic 0", "sleeping 24.2 1e-07")], 1)
        rows = [row for result in pool.map(run, table, 1) for row in result]
    path = pathlib.Path(__file__).with_name("lagrange_top_reference.csv")
    with path.open("w", newline="") as out:
        out.write("# Exact motions of heavy tops, 40 digits, written by tests/core/exact/lagrange_top_reference.py: SI units, body axes,\n"
                  "# gravity in world axes, orientation body to world, scalar first, of length 1 at the end; the start and t_s are\n"
                  "# doubles taken as exact.\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow("case mass ixx iyy izz ixy ixz iyz cx cy cz gx gy gz qw0 qx0 qy0 qz0 wx0 wy0 wz0 t_s "
                       "wx wy wz qw qx qy qz".split())
        for name, mass, inertia, center, gravity, q0, w0, t, w, q in rows:
            table.writerow([name.replace(",", ""), *map(repr, (mass, *inertia, *center, *gravity, *q0, *w0, t)),
                            *(mp.nstr(x, DIGITS) for x in w + q)])


if __name__ == "__main__":
    main()
