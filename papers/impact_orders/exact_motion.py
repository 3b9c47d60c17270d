# SPDX-License-Identifier: BSD-3-Clause
"""The exact motions of the two scenarios of this folder, without polhode, with mpmath at 30 digits.

    exact_motion.py OUT_DIR

sprung_ball.csv, tumbling_box.csv in OUT_DIR: the time of each impact (s) in the first rows, then the state at the end, as
columns and units of a trajectory.csv have it.

Between impacts the mass centre swings or falls, in closed form, and the attitude is that of a free top: the Taylor series of
scripts/exact_top.py. An impact is a root of the height of the lowest point over the floor. At it, with the arm r from the mass
centre to the point that touches, the impulse along the floor's normal n (up) is
  j = −(1 + e) n·(v + ω × r) / (1/m + (r × n)·I⁻¹(r × n)),   e = 1.
"""
import csv
import pathlib
import sys
import tomllib

import mpmath
from mpmath import mpf

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from exact_top import DIGITS, free_top  # noqa: E402

NORMAL = (0, 0, 1)
SCAN = mpf("0.01")  # s: the height is looked at so often; the first sign change is refined


def number(x):
    """The decimal number that the file shows, to 30 digits."""
    return mpf(repr(x))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return mpmath.fsum(x * y for x, y in zip(a, b))


def turned(q, v, sign=1):
    """q v q*, with the sign −1 q* v q: from body to world axes, and back."""
    n, u = dot(q, q), [sign * x for x in q[1:]]
    uv = cross(u, v)
    uuv = cross(u, uv)
    return [v[i] + 2 * (q[0] * uv[i] + uuv[i]) / n for i in range(3)]


class Body:
    """A body of a scenario file over a floor at z = 0."""

    def __init__(self, file):
        with open(file, "rb") as opened:
            scene = tomllib.load(opened)
        body = scene["body"][0]
        self.t_end = number(scene["t_end"])
        self.g = -number(scene["gravity"][2])
        self.m = number(body["mass"])
        self.k = number(scene["force"][0]["stiffness"]) if "force" in scene else None
        shape = body["shape"]
        if shape["kind"] == "sphere":
            self.radius, self.corners = number(shape["radius"]), [[mpf(0)] * 3]
        else:
            a, b, c = (number(edge) for edge in shape["size"])
            self.radius = mpf(0)
            self.corners = [[i * a / 2, j * b / 2, k * c / 2] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
            self.moments = [self.m * (b * b + c * c) / 12, self.m * (a * a + c * c) / 12, self.m * (a * a + b * b) / 12]
        if "inertia" in body:
            self.moments = [number(x) for x in body["inertia"]]
        self.x = [number(x) for x in body["position"]]
        self.v = [number(x) for x in body.get("velocity", [0.0] * 3)]
        self.spin = [number(x) for x in body["angular_velocity"]]
        self.q = [mpf(1), mpf(0), mpf(0), mpf(0)]
        self.t = mpf(0)

    def centre(self, t):
        """Position and velocity t after the last impact."""
        g = [mpf(0), mpf(0), -self.g]
        if self.k is None:
            return [self.x[i] + self.v[i] * t + g[i] * t * t / 2 for i in range(3)], [self.v[i] + g[i] * t for i in range(3)]
        rate = mpmath.sqrt(self.k / self.m)
        c, s, rest = mpmath.cos(rate * t), mpmath.sin(rate * t), [a * self.m / self.k for a in g]
        return ([rest[i] + (self.x[i] - rest[i]) * c + self.v[i] / rate * s for i in range(3)],
                [self.v[i] * c - (self.x[i] - rest[i]) * rate * s for i in range(3)])

    def heights(self, top, t):
        """Heights of the corners over the floor, and the arms in world axes."""
        z = self.centre(t)[0][2] - self.radius
        q = top(t)[3:]
        arms = [turned(q, corner) for corner in self.corners]
        return [z + arm[2] for arm in arms], arms

    def next_impact(self, top):
        """Time until the next impact, s, and the number of the corner; None if there is none before the end."""
        t, left = SCAN, self.t_end - self.t
        while t < left + SCAN:
            heights = self.heights(top, min(t, left))[0]
            lowest = min(range(len(heights)), key=heights.__getitem__)
            if heights[lowest] < 0:
                root = mpmath.findroot(lambda s: self.heights(top, s)[0][lowest], (t - SCAN, min(t, left)), solver="anderson",
                                       tol=mpf(10) ** (4 - 2 * DIGITS))
                others = sorted(self.heights(top, root)[0])
                assert len(others) == 1 or others[1] > mpf("1e-3"), "two corners touch at nearly the same time"
                return root, lowest
            t += SCAN
        return None

    def advance(self, top, t):
        self.x, self.v = self.centre(t)
        end = top(t)
        self.spin, self.q = end[:3], end[3:]
        self.t += t

    def bounce(self, corner):
        """The impact at a corner."""
        arm = turned(self.q, self.corners[corner])
        arm[2] -= self.radius
        w = turned(self.q, self.spin)
        across = turned(self.q, cross(arm, NORMAL), -1)
        turn = [across[i] / self.moments[i] for i in range(3)]  # body axes
        speed = self.v[2] + cross(w, arm)[2]
        assert speed < 0
        impulse = -2 * speed / (1 / self.m + dot(across, turn))
        self.v[2] += impulse / self.m
        self.spin = [self.spin[i] + impulse * turn[i] for i in range(3)]

    def run(self):
        """To the end; the times of the impacts, s."""
        impacts = []
        while True:
            top = free_top(self.moments, self.spin, self.q)
            found = self.next_impact(top)
            if not found:
                self.advance(top, self.t_end - self.t)
                return impacts
            self.advance(top, found[0])
            impacts.append(self.t)
            self.bounce(found[1])


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for name in ("sprung_ball", "tumbling_box"):
        body = Body(HERE / f"{name}.toml")
        impacts = body.run()
        row = dict(zip(("px_m", "py_m", "pz_m"), body.x)) | dict(zip(("qw", "qx", "qy", "qz"), body.q))
        row |= dict(zip(("vx_m_per_s", "vy_m_per_s", "vz_m_per_s"), body.v))
        row |= dict(zip(("wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s"), turned(body.q, body.spin)))
        row |= {f"impact_{k}_s": t for k, t in enumerate(impacts, start=1)}
        with open(out / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            lines = csv.writer(file, lineterminator="\n")
            lines.writerow(row)
            lines.writerow(mpmath.nstr(x, 20) for x in row.values())


if __name__ == "__main__":
    main()
