# SPDX-License-Identifier: BSD-3-Clause
"""Figures of the paper: impact_orders.svg, the order of each method with located impacts and with impacts at steps, and
impact_errors.svg, the errors of four methods against the step. Nothing is drawn without gnuplot.

    figure.py ORDERS_DIR OUT_DIR       ORDERS_DIR is that of orders.py
"""
import csv
import pathlib
import shutil
import subprocess
import sys

PANELS = (("sprung_ball", "position", "ball on a spring: position at the end"),
          ("tumbling_box", "attitude", "tumbling box: attitude at the end"))
TIMINGS = (("event_located", "located impacts", 7, "#1f5fa8"), ("time_stepping", "impacts at steps", 4, "#b8501e"))
METHODS = ("semi_implicit_euler", "explicit_midpoint", "rk4", "gauss6")
UNITS = {"position": "m", "attitude": "rad"}


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["response"] == "single_impulse" and row["against"] == "step"]


def gnuplot(lines):
    subprocess.run(["gnuplot"], input="\n".join(lines) + "\n", text=True, check=True)


def data(points):
    return [*(" ".join(map(str, point)) for point in points), "e"]


def draw_orders(orders, out):
    names = sorted({row["integrator"] for row in orders}, key=lambda name: (declared(orders, name), name))
    script = [f"set terminal svg size 1100,{140 + 21 * len(names)} font 'sans,12' background 'white'",
              f"set output '{out / 'impact_orders.svg'}'", "set multiplot layout 1,2", "set key outside top center horizontal",
              f"set yrange [{len(names) + 0.7}:0.3]", "set xrange [0:7]", "set grid lc rgb '#e4e4e4'",
              "set tmargin at screen 0.95", "set bmargin at screen 0.06"]
    for panel, (scenario, error, title) in enumerate(PANELS):
        left = 0.24 + 0.39 * panel
        ticks = [f'"{name if panel == 0 else ""}" {i}' for i, name in enumerate(names, start=1)]
        script += [f"set xlabel 'observed order ({title})'", f"set lmargin at screen {left}",
                   f"set rmargin at screen {left + 0.36}", f"set ytics noenhanced ({', '.join(ticks)})"]
        plots, blocks = [], []
        for timing, label, mark, colour in TIMINGS:
            plots.append(f"'-' using 1:2 with points pt {mark} ps 0.7 lc rgb '{colour}' title '{label}'")
            found = {row["integrator"]: row[f"{error}_order"] for row in orders
                     if (row["scenario"], row["impact_timing"]) == (scenario, timing)}
            blocks += data((found[name], i) for i, name in enumerate(names, start=1) if found.get(name))
            script += [f"set label 'exact' at 6.25,{i} textcolor rgb '{colour}'" for i, name in enumerate(names, start=1)
                       if found.get(name) == ""]
        script += ["plot " + ", ".join(plots), *blocks]
    gnuplot(script)


def declared(orders, name):
    """By observed order, rounded: for the sequence of the methods alone."""
    return round(next(float(row["position_order"]) for row in orders
                      if (row["scenario"], row["integrator"], row["impact_timing"]) == ("sprung_ball", name, "event_located")))


def draw_errors(errors, out):
    script = ["set terminal svg size 1100,470 font 'sans,12' background 'white'", f"set output '{out / 'impact_errors.svg'}'",
              "set multiplot layout 1,2", "set logscale xy", "set format xy '%.0e'", "set grid lc rgb '#e4e4e4'",
              "set xlabel 'step h = dt (s)'", "set xrange [2e-4:0.15]", "set yrange [1e-14:10]", "set bmargin at screen 0.13",
              "set tmargin at screen 0.92"]
    for panel, (scenario, error, title) in enumerate(PANELS):
        left = 0.07 + 0.39 * panel
        script += [f"set title '{title}'", f"set ylabel 'error ({UNITS[error]})'", f"set lmargin at screen {left}",
                   f"set rmargin at screen {left + 0.29}",
                   "unset key" if panel == 0 else "set key at screen 0.99,0.9 right top noenhanced samplen 2"]
        plots, blocks = [], []
        for place, name in enumerate(METHODS):
            for timing, *_ in TIMINGS:
                style = f"with linespoints pt {(5, 7, 9, 11)[place]} ps 0.4 dt {1 if timing == 'event_located' else 3}"
                colour = ("#7a7a7a", "#2a8a5a", "#1f5fa8", "#a02060")[place]
                named = f"{name}, {'located' if timing == 'event_located' else 'at steps'}"
                plots.append(f"'-' using 1:2 {style} lc rgb '{colour}' title '{named}'")
                blocks += data((row["size"], row[f"{error}_error"]) for row in errors
                               if (row["scenario"], row["integrator"], row["impact_timing"]) == (scenario, name, timing))
        script += ["plot " + ", ".join(plots), *blocks]
    gnuplot(script)


def main():
    orders, out = map(pathlib.Path, sys.argv[1:])
    if not shutil.which("gnuplot"):
        print("figure.py: no figures, because gnuplot is not installed", file=sys.stderr)
        return
    out.mkdir(parents=True, exist_ok=True)
    draw_orders(rows(orders / "orders.csv"), out)
    draw_errors(rows(orders / "errors.csv"), out)


if __name__ == "__main__":
    main()
