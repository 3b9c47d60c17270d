# SPDX-License-Identifier: BSD-3-Clause
"""Reproduces a paper: runs its study, compares the results with the numbers that it gives, and draws both.

    paper.py BIN_DIR PAPER_DIR [--out DIR]

PAPER_DIR holds README.md, study.toml (what energy_drift runs) and expected.csv. Each row of expected.csv picks one run by
the columns of runs.csv that it fills in, and names a quantity, its value, how near ours must be, and where the value
comes from. A quantity is a column of runs.csv, or one of those below that are made from the end of the trajectory.
Exit status: 0 all within their tolerances, 2 bad input, 3 not all.
"""
import argparse
import csv
import math
import pathlib
import shutil
import subprocess
import sys

OWN_COLUMNS = ["quantity", "scale", "value", "allowed", "kind", "source"]
KINDS = ("relative", "absolute", "at_most")


class BadInput(Exception):
    """Something that the user can mend; its text is one line."""


def table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from error


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


SPIN = ("wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s")
MOMENTUM = ("lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s")


def end_quantities(row, reference):
    """What is made from the last row of a trajectory of one body; `reference` is the point of reference.csv."""
    values = {}
    for name, vector in (("end_body_angular_velocity", to_body(row, SPIN)),
                         ("end_body_angular_momentum", to_body(row, MOMENTUM)), ("end_axis", axis_3(row))):
        for i in range(3):
            values[f"{name}_{i + 1}"] = vector[i]
    if reference:
        values["end_body_angular_momentum_error"] = math.dist(to_body(row, MOMENTUM), reference)
    return values


def same(wanted, have):
    """Of two cells of tables: as numbers where both are."""
    try:
        return float(wanted) == float(have)
    except ValueError:
        return wanted == have


class Paper:
    def __init__(self, folder):
        self.folder = folder
        self.expected = table(folder / "expected.csv")
        for number, row in enumerate(self.expected, start=2):
            where = f"{folder / 'expected.csv'}, row {number}"
            if row.get("kind") not in KINDS:
                raise BadInput(f"{where}: kind must be one of {', '.join(KINDS)}")
            for column in ("value", "allowed", "scale"):
                try:
                    float(row[column])
                except (KeyError, TypeError, ValueError) as error:
                    raise BadInput(f"{where}: {column} must be a number") from error
        points = table(folder / "reference.csv") if (folder / "reference.csv").exists() else []
        self.reference = [float(points[0][k]) for k in ("x", "y", "z")] if points else None

    def needs_trajectories(self):
        return any(row["quantity"].startswith("end_") for row in self.expected)

    def compare(self, out):
        runs = table(out / "runs.csv")
        rows = []
        for number, wanted in enumerate(self.expected, start=2):
            where = f"{self.folder / 'expected.csv'}, row {number}"
            chosen = {k: v for k, v in wanted.items() if k not in OWN_COLUMNS and v}
            found = [r for r in runs if all(same(v, r.get(k, "")) for k, v in chosen.items())]
            if len(found) != 1:
                raise BadInput(f"{where}: it picks {len(found)} runs of the study; it must pick one")
            rows.append(self.judge(wanted, found[0], out, where))
        return rows

    def judge(self, wanted, run, out, where):
        quantity = wanted["quantity"]
        if quantity.startswith("end_"):
            last = table(out / "trajectories" / run["run"] / "trajectory.csv")[-1]
            values = end_quantities(last, self.reference)
        else:
            values = run
        if values.get(quantity, "") == "":
            raise BadInput(f"{where}: the run has no quantity {quantity}")
        ours = float(values[quantity]) * float(wanted["scale"])
        value, tolerance = float(wanted["value"]), float(wanted["allowed"])
        if wanted["kind"] == "at_most":
            within = ours <= value
        else:
            within = abs(ours - value) <= tolerance * (abs(value) if wanted["kind"] == "relative" else 1)
        return {"integrator": run["integrator"], "orientation": run["orientation"],
                "angular_state": run["angular_state"], "dt_s": run["dt_s"], "tolerance": run["tolerance"],
                "quantity": quantity, "ours": repr(ours), "theirs": wanted["value"], "kind": wanted["kind"],
                "allowed": wanted["allowed"], "source": wanted["source"], "verdict": "as given" if within else "not"}


def write_comparison(rows, out):
    with open(out / "comparison.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def draw(name, rows, out):
    """comparison.svg: how far each of our numbers is from theirs, in parts of what is allowed."""
    places, labels, values = [], [], []
    for i, row in enumerate(rows, start=1):
        theirs, ours = float(row["theirs"]), float(row["ours"])
        if row["kind"] == "at_most":
            place = ours / theirs
        else:
            place = (ours - theirs) / (float(row["allowed"]) * (abs(theirs) if row["kind"] == "relative" else 1))
        size = f"h = {row['dt_s']} s" if row["dt_s"] else f"tolerance {row['tolerance']}"
        chart = "" if row["orientation"] == "quaternion" else f" ({row['orientation']})"
        labels.append(f'"{row["integrator"]}{chart}, {size}: {row["quantity"]}" {i}')
        values.append(f'set label "{ours:.6g}" at graph 1.02,first {i}')
        places.append(f"{max(-1.45, min(1.45, place)):.6g} {i}")
    script = [f"set terminal svg size 1000,{130 + 21 * len(rows)} font 'sans,12' background 'white'",
              f"set output '{out / 'comparison.svg'}'", f"set title '{name}: our numbers beside theirs' noenhanced",
              "set xlabel '(ours − theirs)/allowed; of an upper bound: ours/bound. Between the dashed lines: as given'",
              "set xrange [-1.5:1.5]", f"set yrange [{len(rows) + 0.7}:0.3]", "set key off", "set grid y lc rgb '#e4e4e4'",
              f"set ytics noenhanced ({', '.join(labels)})", "set lmargin at screen 0.47", "set rmargin at screen 0.88",
              "set arrow from -1,graph 0 to -1,graph 1 nohead dt 2", "set arrow from 1,graph 0 to 1,graph 1 nohead dt 2",
              "set label 'ours' at graph 1.02,graph 1.02", *values,
              "plot '-' using 1:2 with points pt 7 ps 0.6 lc rgb '#1f5fa8'", *places, "e"]
    if not shutil.which("gnuplot"):
        return "no comparison.svg, because gnuplot is not installed"
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)
    return ""


def main():
    parser = argparse.ArgumentParser(prog="paper", description="Reproduces a paper and compares with its numbers.")
    parser.add_argument("bin", type=pathlib.Path, help="folder of the programs")
    parser.add_argument("paper", type=pathlib.Path, help="folder of the paper")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the results (default: results/paper-NAME)")
    parser.add_argument("--no-figures", action="store_true", help="tables only")
    given = parser.parse_args()
    out = given.out or pathlib.Path("results") / f"paper-{given.paper.name}"
    paper = Paper(given.paper)
    command = [str(given.bin / "energy_drift"), "--study", str(given.paper / "study.toml"), "--out", str(out)]
    command += ["--trajectory", "csv"] if paper.needs_trajectories() else []
    command += ["--no-figures"] if given.no_figures else []
    done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    if done.returncode not in (0, 3):
        return done.returncode
    rows = paper.compare(out)
    write_comparison(rows, out)
    said = "" if given.no_figures else draw(given.paper.name, rows, out)
    width = max(len(row["quantity"]) for row in rows)
    for row in rows:
        bound = "at most" if row["kind"] == "at_most" else "theirs"
        print(f"{row['verdict']:8}  {row['integrator']:26} {row['dt_s'] or row['tolerance']:7} {row['quantity']:{width}}  "
              f"ours {float(row['ours']):.10g}, {bound} {row['theirs']} ({row['source']})")
    wrong = sum(row["verdict"] != "as given" for row in rows)
    print(f"{len(rows) - wrong} of {len(rows)} numbers as given; {out / 'comparison.csv'}")
    if said:
        print(f"paper: {said}", file=sys.stderr)
    return 3 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as problem:
        print(f"paper: {problem}", file=sys.stderr)
        sys.exit(2)
