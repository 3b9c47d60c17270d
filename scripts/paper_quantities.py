# SPDX-License-Identifier: BSD-3-Clause
"""Quantities that are made from the motion of a run: from its trajectory.csv, energy.csv and events.csv.

end_COLUMN                         a column of trajectory.csv at the end
end_body_angular_velocity_1 … _3   Ω in body axes at the end, likewise end_body_angular_momentum_…
end_axis_1 … _3                    the body's third axis in world axes at the end
end_body_angular_momentum_error    distance of the body's momentum at the end from the point of reference.csv
impacts                            rows of events.csv
first_impact_t_s                   of the first impact, as events.csv has it
first_impact_impulse_N_s           the sum over the contact points of that instant
flips_K                            sign changes of component K (1, 2, 3) of the body's momentum in body axes after the start
flip_interval_least_K_s, …_largest_K_s   least and largest time from one of them to the next
period_K_s                         twice the mean of these times
axis_3_least, axis_3_largest       extremes of end_axis_3 over the run: of cos θ, θ from the world's axis 3
mean_square_energy_error_J2        mean over all instants but the first of (E − E0)², E kinetic and potential
"""
import csv
import itertools
import math

from numpy.polynomial import Polynomial

SPIN = ("wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s")
MOMENTUM = ("lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s")


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


def known(quantity):
    return (quantity.startswith(("end_", "first_impact_", "flip", "period_", "axis_3_"))
            or quantity in ("impacts", "mean_square_energy_error_J2"))


def of(quantity, folder, body, reference):
    """The quantities of that kind, by name; `folder` is that of the run's motion, `reference` the point of reference.csv."""
    if quantity.startswith("end_"):
        last = {}
        for row in rows(folder / "trajectory.csv"):
            last[row["body"]] = row
        return end_quantities(last[body], reference) if body in last else {}
    if quantity.startswith(("flip", "period_")):
        component = int(next(part for part in quantity.split("_") if part.isdigit()))
        return flip_quantities(folder / "trajectory.csv", body, component)
    if quantity.startswith("axis_3_"):
        return nutation(folder / "trajectory.csv", body)
    if quantity == "mean_square_energy_error_J2":
        return {quantity: mean_square_energy_error(folder / "energy.csv")}
    return impact_quantities(list(rows(folder / "events.csv")))


def to_body(row, name):
    """A world vector of a row of trajectory.csv, in body axes: q* v q."""
    w, x, y, z = (float(row[k]) for k in ("qw", "qx", "qy", "qz"))
    n = w * w + x * x + y * y + z * z
    v = [float(row[k]) for k in name]
    u = (-x, -y, -z)
    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    uv = cross(u, v)
    uuv = cross(u, uv)
    return [v[i] + 2 * (w * uv[i] + uuv[i]) / n for i in range(3)]


def axis_3(row):
    """The body's third axis, in world axes."""
    w, x, y, z = (float(row[k]) for k in ("qw", "qx", "qy", "qz"))
    n = w * w + x * x + y * y + z * z
    return [2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, (w * w - x * x - y * y + z * z) / n]


def end_quantities(row, reference):
    values = {f"end_{name}": value for name, value in row.items()}
    for name, vector in (("end_body_angular_velocity", to_body(row, SPIN)),
                         ("end_body_angular_momentum", to_body(row, MOMENTUM)), ("end_axis", axis_3(row))):
        for i in range(3):
            values[f"{name}_{i + 1}"] = vector[i]
    if reference:
        values["end_body_angular_momentum_error"] = math.dist(to_body(row, MOMENTUM), reference)
    return values


def impact_quantities(impacts):
    values = {"impacts": len(impacts)}
    if impacts:
        first = impacts[0]["t_s"]
        values["first_impact_t_s"] = first
        values["first_impact_impulse_N_s"] = math.fsum(float(i["impulse_N_s"]) for i in impacts if i["t_s"] == first)
    return values


def mean_square_energy_error(path):
    """The start counts for nothing: there is no error yet."""
    start, squares, instants = None, 0.0, 0
    for row in rows(path):
        energy = float(row["kinetic_J"]) + float(row["potential_J"])
        if start is None:
            start = energy
            continue
        squares += (energy - start) ** 2
        instants += 1
    return squares / instants if instants else ""


def through(points):
    """The polynomial through all points (x, y)."""
    x, y = zip(*points)
    return Polynomial.fit(x, y, len(points) - 1)


def series(path, body, value):
    """(t, value of the row) of all rows of the body."""
    return [(float(row["t_s"]), value(row)) for row in rows(path) if row["body"] == body]


def zeros(points, reach=4):
    """Times at which the series changes its sign, after its first two points: roots of polynomials through the 2 `reach` nearest."""
    found = []
    for i in range(1, len(points) - 1):
        (t0, y0), (t1, y1) = points[i], points[i + 1]
        if y0 * y1 < 0 or y0 == 0:
            first = max(0, min(i + 1 - reach, len(points) - 2 * reach))
            roots = through(points[first:first + 2 * reach]).roots()
            middle = t0 if y0 == 0 else (t0 * y1 - t1 * y0) / (y1 - y0)
            found.append(min((r.real for r in roots), key=lambda t: abs(t - middle)))
    return found


def flip_quantities(path, body, component):
    times = zeros(series(path, body, lambda row: to_body(row, MOMENTUM)[component - 1]))
    values = {f"flips_{component}": len(times)}
    if len(times) > 1:
        intervals = [b - a for a, b in itertools.pairwise(times)]
        values[f"flip_interval_least_{component}_s"] = min(intervals)
        values[f"flip_interval_largest_{component}_s"] = max(intervals)
        values[f"period_{component}_s"] = 2 * (times[-1] - times[0]) / len(intervals)
    return values


def nutation(path, body):
    heights = series(path, body, lambda row: axis_3(row)[2])
    return {"axis_3_least": extreme(heights, min), "axis_3_largest": extreme(heights, max)}


def extreme(points, which):
    """The least or largest value of the series: that of the polynomial through five points, if it lies inside the series."""
    i = which(range(len(points)), key=lambda k: points[k][1])
    if not 2 <= i < len(points) - 2:
        return points[i][1]
    curve = through(points[i - 2:i + 3])
    slopes = [r.real for r in curve.deriv().roots() if points[i - 1][0] <= r.real <= points[i + 1][0] and not r.imag]
    return which([points[i][1], *map(curve, slopes)])
