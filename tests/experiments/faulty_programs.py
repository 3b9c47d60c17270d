# SPDX-License-Identifier: BSD-3-Clause
"""A small program of one rigid body with faults to choose from, independent of the code that is tested, and its files.

Quaternions are (w, x, y, z), body to world. The body turns about its mass centre, or about its pivot under gravity.
"""
import csv
import math
import pathlib
import tomllib

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "experiments" / "scenarios"


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def product(a, b):
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def unit(q):
    size = math.sqrt(sum(x * x for x in q))
    return [x / size for x in q]


def matrix(q):
    w, x, y, z = unit(q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def to_world(q, v):
    return [sum(r * x for r, x in zip(row, v)) for row in matrix(q)]


def to_body(q, v):
    r = matrix(q)
    return [sum(r[k][i] * v[k] for k in range(3)) for i in range(3)]


class Body:
    """The only body of a built-in scenario, with a principal inertia."""

    def __init__(self, scenario):
        with open(SCENARIOS / (scenario + ".toml"), "rb") as file:
            text = tomllib.load(file)
        (body,) = text["body"]
        self.inertia = list(body["inertia"])
        self.start = list(body.get("orientation", [1.0, 0.0, 0.0, 0.0]))
        omega = list(body["angular_velocity"])
        self.omega = omega if body.get("angular_velocity_frame") == "body" else to_body(self.start, omega)
        self.center = body.get("center_of_mass", [0, 0, 0])
        self.weight = [body["mass"] * g for g in text.get("gravity", [0, 0, 0])]

    def torque(self, q):
        """In body axes, about the pivot, which of a free body is its mass centre."""
        return cross(self.center, to_body(q, self.weight))


def motion(body, step, rows, every=1, method="rk4", gyroscopic=1, inertia=(1, 1, 1), frame="right", turning=1):
    """The times and (q, ω in world axes) of each `every`-th step, with q and Ω in body axes as the program's state.

    gyroscopic: the factor of Ω × IΩ; inertia: factors of the moments; frame "unturned": a program that takes its ω for one
    in world axes and does not turn the inertia; turning: the factor of ω in q̇; method "rk4", "explicit" or "semi": Euler's.
    """
    moments = [a * b for a, b in zip(body.inertia, inertia)]

    def spin_up(q, w):
        momentum = [a * b for a, b in zip(moments, w)]
        torque = to_world(q, body.torque(q)) if frame == "unturned" else body.torque(q)
        return [(t - gyroscopic * c) / m for t, c, m in zip(torque, cross(w, momentum), moments)]

    def turn(q, w):
        rate = product([0, *w], q) if frame == "unturned" else product(q, [0, *w])
        return [turning * x / 2 for x in rate]

    def rates(y):
        return turn(y[:4], y[4:]) + spin_up(y[:4], y[4:])

    def moved(y, by, h):
        return [a + h * b for a, b in zip(y, by)]

    y = [*body.start, *body.omega]
    result = []
    for k in range(rows * every + 1):
        if k % every == 0:
            q = unit(y[:4])
            result.append((k * step, q, y[4:] if frame == "unturned" else to_world(q, y[4:])))
        if method == "explicit":
            y = moved(y, rates(y), step)
        elif method == "semi":
            w = moved(y[4:], spin_up(y[:4], y[4:]), step)
            y = moved(y[:4], turn(y[:4], w), step) + w
        else:
            a = rates(y)
            b = rates(moved(y, a, step / 2))
            c = rates(moved(y, b, step / 2))
            d = rates(moved(y, c, step))
            y = [x + step / 6 * (p + 2 * (r + s) + t) for x, p, r, s, t in zip(y, a, b, c, d)]
        y[:4] = unit(y[:4])
    return result


def write(path, rows, orientation="quaternion", order=(0, 1, 2, 3), transposed=False, body_axes=False, unit_of_rate=1,
          delay=0, clock=1, digits=17, flips=False):
    """A file as judge reads it; the options are how it is written wrongly, `digits` how coarsely, and `flips` turns the
    signs of every third quaternion, which is the same attitude."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        names = ["qw", "qx", "qy", "qz"]
        if orientation == "matrix":
            names = [f"r{i}{j}" for i in "123" for j in "123"]
        writer.writerow(["t_s", *names, "wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s"])
        for k, (t, q, w) in enumerate(rows):
            if t * clock + delay < 0:
                continue
            sign = -1 if flips and k % 3 == 1 else 1
            rate = [x * unit_of_rate for x in (to_body(q, w) if body_axes else w)]
            turned = [q[0], -q[1], -q[2], -q[3]] if transposed else q
            if orientation == "matrix":
                cells = [x for row in matrix(turned) for x in row]
            else:
                cells = [sign * turned[i] for i in order]
            writer.writerow([f"{x:.{digits}g}" for x in [t * clock + delay, *cells, *rate]])
