# SPDX-License-Identifier: BSD-3-Clause
"""The time of a run of a large study beyond its steps: planning, making, measurement at the end, store, export, tables and
page. Studies of free tops by RK4 with two jobs are carried out with N and with 4 N steps a run, one after the other; what
does not grow with the number of steps is the time beyond them. A step includes the measurement after it.

    POLHODE_BIN_DIR=build/release/bin beyond_steps.py [RUNS [ROUNDS]]     100000 and 5 without arguments
"""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

PROGRAM = (pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "build/release/bin")) / "energy_drift").resolve()
STEPS, MORE = 1000, 4  # of a run; times as many in the longer one


def seconds(runs, steps):
    """Wall and processor seconds of a study of so many runs."""
    with tempfile.TemporaryDirectory() as folder:
        before, began = os.times(), time.monotonic()
        subprocess.run([PROGRAM, "--scenario", "free_symmetric_top", "--integrator", "rk4", "--dt", str(1 / steps), "--t-end", "1",
                        "--vary", f"body.0.angular_velocity.1=1:5:{runs}", "--jobs", "2", "--no-figures", "--out", f"{folder}/study"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wall, after = time.monotonic() - began, os.times()
    return wall, after.children_user + after.children_system - before.children_user - before.children_system


def main(runs=100_000, rounds=5):
    print(f"us a run, {runs} runs, two jobs: wall (processor)")
    print(f"| round | {STEPS} steps | {MORE * STEPS} steps | {STEPS} steps alone | beyond the steps |")
    print("|---|---|---|---|---|")
    found = []
    for number in range(rounds):
        few, many = ([1e6 * s / runs for s in seconds(runs, steps)] for steps in (STEPS, MORE * STEPS))
        alone = [(b - a) / (MORE - 1) for a, b in zip(few, many)]
        found.append([few, many, alone, [a - b for a, b in zip(few, alone)]])
        print(f"| {number + 1} | " + " | ".join(f"{wall:.1f} ({processor:.1f})" for wall, processor in found[-1]) + " |", flush=True)
    middle = [[statistics.median(r[k][part] for r in found) for part in (0, 1)] for k in range(4)]
    print("| median | " + " | ".join(f"{wall:.1f} ({processor:.1f})" for wall, processor in middle) + " |")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
