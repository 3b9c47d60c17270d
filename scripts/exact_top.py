# SPDX-License-Identifier: BSD-3-Clause
"""The motion of a free rigid body to 20 digits, without polhode: the Taylor series of mpmath.odefun at 30 digits.

    exact_top.py J1 J2 J3 Y1 Y2 Y3 T     prints the end of the motion: angular velocity, momentum and attitude

J (kg m²), the momentum Y = J W at the start (kg m²/s) and the angular velocity W (rad/s) in body axes, T (s); the attitude is a
quaternion (w, x, y, z), body to world, 1 at the start. Equations: J W' = J W × W, q' = q (0, W)/2.
"""
import sys

import mpmath

DIGITS = 30
mpmath.mp.dps = DIGITS


def rates(moments):
    """The right-hand side of (W, q)."""
    def of(_, y):
        w1, w2, w3, q0, q1, q2, q3 = y
        m1, m2, m3 = (j * w for j, w in zip(moments, (w1, w2, w3)))
        return [(m2 * w3 - m3 * w2) / moments[0], (m3 * w1 - m1 * w3) / moments[1], (m1 * w2 - m2 * w1) / moments[2],
                (-q1 * w1 - q2 * w2 - q3 * w3) / 2, (q0 * w1 + q2 * w3 - q3 * w2) / 2,
                (q0 * w2 + q3 * w1 - q1 * w3) / 2, (q0 * w3 + q1 * w2 - q2 * w1) / 2]
    return of


def free_top(moments, spin, attitude=(1, 0, 0, 0), start=0):
    """A function of the time t >= start: seven numbers, angular velocity in body axes and quaternion."""
    moments, spin, attitude = ([mpmath.mpf(x) for x in v] for v in (moments, spin, attitude))
    return mpmath.odefun(rates(moments), start, spin + attitude, tol=mpmath.mpf(10) ** (5 - DIGITS))


def main():
    numbers = sys.argv[1:]
    if len(numbers) != 7:
        sys.exit(__doc__)
    *given, t = map(mpmath.mpf, numbers)
    moments, momentum = given[:3], given[3:]
    end = free_top(moments, [y / j for y, j in zip(momentum, moments)])(t)
    for name, values in (("angular velocity", end[:3]), ("momentum", [j * w for j, w in zip(moments, end[:3])]),
                         ("attitude", end[3:])):
        print(name, *(mpmath.nstr(x, 17) for x in values))


if __name__ == "__main__":
    main()
