#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What --dry-run says of the time of the default study of each experiment, beside the time that it takes.

    tests/benchmarks/time_needed.py [PRESET] [EXPERIMENT...]
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXPERIMENTS = ("simulate", "energy_drift", "convergence", "impact", "pile", "stack", "stability", "work_precision",
               "precision", "certificate", "joints")
UNITS = {"s": 1, "min": 60, "h": 3600}


def seconds(text):
    return sum(float(number) * UNITS[unit] for number, unit in re.findall(r"([\d.]+) (s|min|h)\b", text))


def estimate(program, folder):
    """The time that --dry-run says, in s, and the time that it takes to say it, in s."""
    start = time.perf_counter()
    said = subprocess.run([program, "--dry-run"], cwd=folder, capture_output=True, text=True, check=True).stdout
    line = re.search(r"^about (.*?) with \d+ jobs?", said, re.MULTILINE)
    return seconds(line[1]), time.perf_counter() - start


def real(program, folder):
    start = time.perf_counter()
    subprocess.run([program, "--out", "out"], cwd=folder, capture_output=True, check=False)
    return time.perf_counter() - start


def main():
    preset = sys.argv[1] if len(sys.argv) > 1 else "release"
    print(f"{'experiment':<16}{'estimate, s':>12}{'real, s':>10}{'ratio':>8}{'--dry-run, s':>14}")
    with tempfile.TemporaryDirectory() as folder:
        real(ROOT / "build" / preset / "bin" / "simulate", folder)  # reads what draws the figures from the disk
    for name in sys.argv[2:] or EXPERIMENTS:
        program = ROOT / "build" / preset / "bin" / name
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "--help"], capture_output=True, check=True)  # reads the program from the disk
            said, took = estimate(program, folder)
            true = real(program, folder)
        print(f"{name:<16}{said:>12.1f}{true:>10.1f}{said / true:>8.2f}{took:>14.2f}", flush=True)


if __name__ == "__main__":
    main()
