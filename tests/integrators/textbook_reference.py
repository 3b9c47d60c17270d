#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes textbook_reference.csv: ten steps of each textbook scheme in every formulation, for textbook_test.cpp.

One free body (off-diagonal inertia too) under gravity, an off-centre damped spring and a torque fixed in the body, with
steps large enough that every orientation leaves its manifold. The equations are those of the design, in 50 digits:

  orientation   R of a quaternion: normalized, R v = q v q^-1; stored, 1 - 2 (y^2 + z^2) ... with q as it is; R as stored
  kinematics    q' = 1/2 w q or 1/2 q W, R' = w* R or R W*, with W the angular velocity in body axes; p' = v
  world velocity   w' = R I^-1 R^T (torque - w x R I R^T w)     body velocity   W' = I^-1 (R^T torque - W x I W)
  world momentum   L' = torque, w = R I^-1 R^T L                 translation     m v' = force
  work          the power of the damper and of the torque is integrated along with the rest

What goes in are the doubles of this file, taken as exact. Usage: /usr/bin/python3 textbook_reference.py
"""
import csv
import itertools
import pathlib

from mpmath import matrix, mp, mpf, nstr

mp.dps = 50
DIGITS = 25
STEPS = 10
STEP = mpf(0.05)  # s

MASS = mpf(2.0)
INERTIAS = {
    "principal": [[0.5, 0, 0], [0, 0.8, 0], [0, 0, 1.1]],
    "full": [[0.7, 0.1, -0.15], [0.1, 0.9, 0.2], [-0.15, 0.2, 0.6]],
}
GRAVITY = [0, 0, -9.81]
STIFFNESS, DAMPING, REST_LENGTH = mpf(8.0), mpf(0.4), mpf(0.5)
ANCHOR_BODY, ANCHOR_WORLD = [0.1, 0.25, -0.4], [0.5, 0, 2.0]
TORQUE_BODY = [0.3, -0.2, 0.5]
POSITION, ORIENTATION = [0.2, -0.1, 0.4], [0.1, 0.7, -0.5, 0.5]
VELOCITY, ANGULAR_VELOCITY = [0.5, -1.0, 0.25], [1.0, 2.0, -1.5]

SCHEMES = ("explicit_euler", "semi_implicit_euler", "explicit_midpoint", "rk4")


def vector(numbers):
    return matrix([mpf(x) for x in numbers])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def star(a):
    """a* b = a x b."""
    return matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def hamilton(a, b):
    """The product of two quaternions, each a scalar and a vector."""
    (s, u), (t, v) = (a[0], a[1:]), (b[0], b[1:])
    scalar = s * t - dot(u, v)
    return [scalar, *(s * y + t * x + z for x, y, z in zip(u, v, cross(u, v)))]


class Box:
    """The equations in one formulation. A state is a dict of position, orientation, velocity, angular, work."""

    def __init__(self, inertia, chart, angular_state, gyroscopic, rotation_from):
        self.inertia = matrix([[mpf(x) for x in row] for row in inertia])
        self.inverse = self.inertia**-1
        self.chart, self.angular_state = chart, angular_state
        self.gyroscopic, self.rotation_from = gyroscopic, rotation_from

    def start(self):
        q, w = vector(ORIENTATION), vector(ANGULAR_VELOCITY)
        orientation = q if self.chart == "quaternion" else self.turn_by_sandwich(list(q))
        rotation = self.rotation(orientation)
        angular = {
            "velocity_world": w,
            "velocity_body": rotation.T * w,
            "momentum_world": rotation * self.inertia * rotation.T * w,
        }[self.angular_state]
        return {"position": vector(POSITION), "orientation": orientation, "velocity": vector(VELOCITY),
                "angular": angular, "work": mpf(0)}

    @staticmethod
    def turn_by_sandwich(q):
        """R v = q v q^-1."""
        length2 = sum(x * x for x in q)
        inverse = [q[0] / length2] + [-x / length2 for x in q[1:]]
        columns = [hamilton(hamilton(q, [0, *axis]), inverse)[1:] for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
        return matrix(columns).T

    def rotation(self, orientation):
        if self.chart == "matrix":
            return orientation
        w, x, y, z = orientation
        if self.rotation_from == "normalized":
            return self.turn_by_sandwich([w, x, y, z])
        return matrix([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                       [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                       [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    def world_velocity(self, state):
        r, angular = self.rotation(state["orientation"]), state["angular"]
        if self.angular_state == "velocity_world":
            return angular
        return r * angular if self.angular_state == "velocity_body" else r * (self.inverse * (r.T * angular))

    def spring(self, state):
        """Arm of the body's end about the mass centre, direction, force on the body, rate of change of length."""
        arm = self.rotation(state["orientation"]) * vector(ANCHOR_BODY)
        d = vector(ANCHOR_WORLD) - (state["position"] + arm)
        length = mp.sqrt(dot(d, d))
        n = d / length
        rate = -dot(n, state["velocity"] + cross(self.world_velocity(state), arm))
        return arm, (STIFFNESS * (length - REST_LENGTH) + DAMPING * rate) * n, rate

    def acceleration(self, state):
        """Rates of velocity and angular."""
        r, angular = self.rotation(state["orientation"]), state["angular"]
        arm, pull, _ = self.spring(state)
        torque = cross(arm, pull) + r * vector(TORQUE_BODY)
        if self.angular_state == "velocity_world":
            momentum = r * self.inertia * r.T * angular
            twist = torque - cross(angular, momentum) if self.gyroscopic else torque
            rate = r * self.inverse * r.T * twist
        elif self.angular_state == "velocity_body":
            twist = r.T * torque
            if self.gyroscopic:
                twist -= cross(angular, self.inertia * angular)
            rate = self.inverse * twist
        else:
            rate = torque
        return {"velocity": vector(GRAVITY) + pull / MASS, "angular": rate}

    def kinematics(self, state):
        """Rates of position, orientation and work."""
        in_body = self.angular_state == "velocity_body"
        w, orientation = state["angular"] if in_body else self.world_velocity(state), state["orientation"]
        if self.chart == "quaternion":
            q, turn = list(orientation), [0, *w]
            rate = matrix(hamilton(q, turn) if in_body else hamilton(turn, q)) / 2
        else:
            rate = orientation * star(w) if in_body else star(w) * orientation
        _, _, stretching = self.spring(state)
        torque = self.rotation(orientation) * vector(TORQUE_BODY)
        power = dot(torque, self.world_velocity(state)) - DAMPING * stretching**2
        return {"position": state["velocity"], "orientation": rate, "work": power}

    def rate(self, state):
        return self.acceleration(state) | self.kinematics(state)


def moved(state, h, rates):
    """The state with h times some rates added."""
    return {key: value + h * rates[key] if key in rates else value for key, value in state.items()}


def step(scheme, box, y, h):
    if scheme == "explicit_euler":
        return moved(y, h, box.rate(y))
    if scheme == "semi_implicit_euler":
        y = moved(y, h, box.acceleration(y))
        return moved(y, h, box.kinematics(y))
    if scheme == "explicit_midpoint":
        return moved(y, h, box.rate(moved(y, h / 2, box.rate(y))))
    k1 = box.rate(y)
    k2 = box.rate(moved(y, h / 2, k1))
    k3 = box.rate(moved(y, h / 2, k2))
    k4 = box.rate(moved(y, h, k3))
    for weight, k in ((1, k1), (2, k2), (2, k3), (1, k4)):
        y = moved(y, weight * h / 6, k)
    return y


def formulations():
    for chart, angular_state, gyroscopic, rotation_from in itertools.product(
            ("quaternion", "matrix"), ("velocity_world", "velocity_body", "momentum_world"), (True, False),
            ("normalized", "stored")):
        if angular_state == "momentum_world" and not gyroscopic or chart == "matrix" and rotation_from == "stored":
            continue
        yield chart, angular_state, gyroscopic, rotation_from


def numbers(state):
    """As a row has them: a matrix goes by rows; the numbers of the other chart are empty."""
    orientation = [nstr(x, DIGITS, strip_zeros=False) for x in state["orientation"]]
    quaternion, rotation = (orientation, [""] * 9) if len(orientation) == 4 else ([""] * 4, orientation)
    rest = lambda key: [nstr(x, DIGITS, strip_zeros=False) for x in state[key]]
    return [*rest("position"), *quaternion, *rotation, *rest("velocity"), *rest("angular"),
            nstr(state["work"], DIGITS, strip_zeros=False)]


def main():
    out = pathlib.Path(__file__).with_suffix(".csv")
    with out.open("w", newline="", encoding="utf-8") as file:
        file.write("# Ten steps of 0.05 s of the textbook schemes, 25 digits, written by "
                   "tests/integrators/textbook_reference.py: SI units,\n"
                   "# orientation body to world; (ax, ay, az) is the angular state.\n")
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow("scheme,inertia,orientation,angular_state,gyroscopic,rotation_from,px,py,pz,qw,qx,qy,qz,"
                      "r11,r12,r13,r21,r22,r23,r31,r32,r33,vx,vy,vz,ax,ay,az,work".split(","))
        for scheme, inertia, formulation in itertools.product(SCHEMES, INERTIAS, formulations()):
            box = Box(INERTIAS[inertia], *formulation)
            y = box.start()
            for _ in range(STEPS):
                y = step(scheme, box, y, STEP)
            chart, angular_state, gyroscopic, rotation_from = formulation
            rows.writerow([scheme, inertia, chart, angular_state, "on" if gyroscopic else "off", rotation_from,
                           *numbers(y)])


if __name__ == "__main__":
    main()
