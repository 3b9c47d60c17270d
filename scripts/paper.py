# SPDX-License-Identifier: BSD-3-Clause
"""Reproduces a paper: runs its studies, compares the results with the numbers that it gives, and draws both.

    paper.py BIN_DIR PAPER_DIR [--out DIR]

PAPER_DIR holds README.md, study.toml (what energy_drift runs) and expected.csv. Where one study does not do, it has
experiments.toml besides: a name for each further experiment, and its command as `./run` takes it, or that of a script of
PAPER_DIR that makes a table of what the others left. All run in PAPER_DIR, one after another, and each leaves its results in
the folder of its name; {out} is the folder of them all.

Each row of expected.csv picks one row of a table by the columns that it fills in, and names a quantity, its value, how
near ours must be, where the value comes from, and the claim of ../claims.csv that it belongs to. The kind `measured` is for what
differs from run to run, such as a time: ours is written beside theirs, and no verdict is given. `of` is the experiment, empty for
study.toml, and `table` the file, where it is not runs.csv. A quantity is a column of the table, or one of those of paper_quantities.py that are made from the
motion of a run, of its body number `body` (default 0).
Exit status: 0 all within their tolerances, 2 bad input, 3 not all.
"""
import argparse
import csv
import pathlib
import shlex
import shutil
import subprocess
import sys
import tomllib

import paper_quantities

OWN_COLUMNS = ["claim", "of", "table", "body", "quantity", "scale", "value", "allowed", "kind", "source"]
NAMED_BY_VALUE = ("scenario", "broad_phase", "narrow_phase", "response", "impact_timing", "trajectory", "class")
KINDS = ("relative", "absolute", "at_most", "at_least", "measured")


class BadInput(Exception):
    """Something that the user can mend; its text is one line."""


def table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from error


def same(wanted, have):
    """Of two cells of tables: as numbers where both are."""
    try:
        return float(wanted) == float(have)
    except ValueError:
        return wanted == have


class Paper:
    def __init__(self, folder):
        self.folder = folder
        self.commands = {}
        if (folder / "experiments.toml").exists():
            with open(folder / "experiments.toml", "rb") as file:
                try:
                    commands = tomllib.load(file)
                except tomllib.TOMLDecodeError as error:
                    raise BadInput(f"{folder / 'experiments.toml'}: {error}") from error
            for name, line in commands.items():
                if not isinstance(line, str) or not line.split():
                    raise BadInput(f"{folder / 'experiments.toml'}: {name}: must be a command")
                self.commands[name] = shlex.split(line)
        self.expected = table(folder / "expected.csv")
        for number, row in enumerate(self.expected, start=2):
            where = f"{folder / 'expected.csv'}, row {number}"
            if row.get("kind") not in KINDS:
                raise BadInput(f"{where}: kind must be one of {', '.join(KINDS)}")
            if (row.get("of") or "") not in ("", *self.commands):
                raise BadInput(f"{where}: experiments.toml has no {row['of']}")
            for column in ("value", "allowed", "scale"):
                try:
                    float(row[column])
                except (KeyError, TypeError, ValueError) as error:
                    raise BadInput(f"{where}: {column} must be a number") from error
        points = table(folder / "reference.csv") if (folder / "reference.csv").exists() else []
        self.reference = [float(points[0][k]) for k in ("x", "y", "z")] if points else None

    def programs(self):
        """The experiments that it needs, study.toml's first."""
        return ["energy_drift", *sorted({c[0] for c in self.commands.values()} - {"energy_drift"} - self.scripts())]

    def scripts(self):
        return {c[0] for c in self.commands.values() if c[0].endswith(".py")}

    def run(self, bin_folder, out, figures):
        """0, or the exit status of the first program that failed."""
        bin_folder, out, plain = bin_folder.resolve(), out.resolve(), [] if figures else ["--no-figures"]
        study = [str(bin_folder / "energy_drift"), "--study", "study.toml", "--out", str(out), *plain]
        moved = self.scripts() or any(paper_quantities.known(row["quantity"]) for row in self.expected if not row.get("of"))
        steps = [study + (["--trajectory", "csv"] if moved else [])]
        for name, (program, *options) in self.commands.items():
            options = [option.replace("{out}", str(out)) for option in options]
            if program in self.scripts():
                steps.append([sys.executable, "-B", program, *options])
            else:
                steps.append([str(bin_folder / program), *options, "--out", str(out / name), *plain])
        for command in steps:
            done = subprocess.run(command, stdout=subprocess.DEVNULL, cwd=self.folder, check=False)
            if done.returncode not in (0, 3):
                return done.returncode
        return 0

    def compare(self, out):
        rows, tables = [], {}
        for number, wanted in enumerate(self.expected, start=2):
            where = f"{self.folder / 'expected.csv'}, row {number}"
            folder = out / (wanted.get("of") or "")
            path = folder / (wanted.get("table") or "runs.csv")
            if path not in tables:
                tables[path] = table(path)
            chosen = {k: v for k, v in wanted.items() if k not in OWN_COLUMNS and v}
            found = [r for r in tables[path] if all(same(v, r.get(k, "")) for k, v in chosen.items())]
            if len(found) != 1:
                raise BadInput(f"{where}: it picks {len(found)} rows of {path.name}; it must pick one")
            rows.append(self.judge(wanted, chosen, found[0], folder, where))
        return rows

    def judge(self, wanted, chosen, row, folder, where):
        quantity = wanted["quantity"]
        values = row
        if paper_quantities.known(quantity):
            motion = folder / "trajectories" / row["run"]
            try:
                values = paper_quantities.of(quantity, motion if motion.exists() else folder, wanted.get("body") or "0",
                                             self.reference)
            except OSError as error:
                raise BadInput(f"{where}: {error.filename}: {error.strerror}; add --trajectory csv") from error
        if values.get(quantity, "") in ("", None):
            raise BadInput(f"{where}: {quantity} is not there")
        ours = float(values[quantity]) * float(wanted["scale"])
        value, tolerance = float(wanted["value"]), float(wanted["allowed"])
        if wanted["kind"] == "measured":
            within = None
        elif wanted["kind"] == "at_most":
            within = ours <= value
        elif wanted["kind"] == "at_least":
            within = ours >= value
        else:
            within = abs(ours - value) <= tolerance * (abs(value) if wanted["kind"] == "relative" else 1)
        label = quantity + (f" of body {wanted['body']}" if wanted.get("body") else "")
        return {"claim": wanted.get("claim") or "", "of": wanted.get("of") or "", "picked": said_of(chosen), "quantity": label,
                "ours": repr(ours), "theirs": wanted["value"], "kind": wanted["kind"], "allowed": wanted["allowed"],
                "source": wanted["source"], "verdict": {None: "measured", True: "as given", False: "not"}[within]}


def said_of(chosen):
    """What picks a row, in words: the method and its chart, then what else is chosen."""
    chart = chosen.get("orientation", "quaternion")
    words = [chosen["integrator"] + ("" if chart == "quaternion" else f" ({chart})")] if "integrator" in chosen else []
    for name, value in chosen.items():
        if name == "dt_s":
            words.append(f"h = {float(value):g} s")
        elif name in NAMED_BY_VALUE:
            words.append(value)
        elif name not in ("integrator", "orientation", "angular_state"):
            words.append(f"{name} {value}")
    return ", ".join(words)


def write_comparison(rows, out):
    with open(out / "comparison.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def draw(name, rows, out):
    """comparison.svg: how far each of our numbers is from theirs, in parts of what is allowed."""
    places, labels, values = [], [], []
    rows = [row for row in rows if row["verdict"] != "measured"]
    for i, row in enumerate(rows, start=1):
        theirs, ours = float(row["theirs"]), float(row["ours"])
        if row["kind"] == "at_most":
            place = ours / theirs if theirs else ours
        elif row["kind"] == "at_least":
            place = theirs / ours if ours else 2
        else:
            allowed = float(row["allowed"]) * (abs(theirs) if row["kind"] == "relative" else 1)
            place = (ours - theirs) / allowed if allowed else 2 * (ours - theirs)
        labels.append(f'"{", ".join(w for w in (row["of"], row["picked"]) if w)}: {row["quantity"]}" {i}')
        values.append(f'set label "{ours:.10g}" at graph 1.02,first {i}')
        places.append(f"{max(-1.45, min(1.45, place)):.6g} {i}")
    left = max(470, 20 + 7 * max(len(label) for label in labels))  # pixels
    width = left + 570
    script = [f"set terminal svg size {width},{130 + 21 * len(rows)} font 'sans,12' background 'white'",
              f"set output '{out / 'comparison.svg'}'", f"set title '{name}: our numbers beside theirs' noenhanced",
              "set xlabel '(ours − theirs)/allowed; of a bound: ours/upper, lower/ours. Between the dashed lines: as given'",
              "set xrange [-1.5:1.5]", f"set yrange [{len(rows) + 0.7}:0.3]", "set key off", "set grid y lc rgb '#e4e4e4'",
              f"set ytics noenhanced ({', '.join(labels)})", f"set lmargin at screen {left / width:.6g}",
              f"set rmargin at screen {(left + 410) / width:.6g}",
              "set arrow from -1,graph 0 to -1,graph 1 nohead dt 2", "set arrow from 1,graph 0 to 1,graph 1 nohead dt 2",
              "set label 'ours' at graph 1.02,first 0", *values,
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
    parser.add_argument("--programs", action="store_true", help="name the experiments that it needs, and run nothing")
    given = parser.parse_args()
    if given.programs:
        print(*Paper(given.paper).programs())
        return 0
    out = given.out or pathlib.Path("results") / f"paper-{given.paper.name}"
    paper = Paper(given.paper)
    status = paper.run(given.bin, out, not given.no_figures)
    if status:
        return status
    rows = paper.compare(out)
    write_comparison(rows, out)
    said = "" if given.no_figures else draw(given.paper.name, rows, out)
    whose = [" ".join(w for w in (row["of"], row["picked"]) if w) for row in rows]
    widths = max(map(len, whose)), max(len(row["quantity"]) for row in rows)
    for who, row in zip(whose, rows):
        bound = {"at_most": "at most", "at_least": "at least"}.get(row["kind"], "theirs")
        print(f"{row['verdict']:8}  {who:{widths[0]}} {row['quantity']:{widths[1]}}  "
              f"ours {float(row['ours']):.10g}, {bound} {row['theirs']} ({row['source']})")
    wrong = sum(row["verdict"] == "not" for row in rows)
    judged = sum(row["verdict"] != "measured" for row in rows)
    print(f"{judged - wrong} of {judged} numbers as given; {out / 'comparison.csv'}")
    if said:
        print(f"paper: {said}", file=sys.stderr)
    return 3 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as problem:
        print(f"paper: {problem}", file=sys.stderr)
        sys.exit(2)
