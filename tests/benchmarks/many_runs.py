# SPDX-License-Identifier: BSD-3-Clause
"""Many short runs (100 RK4 steps each) as one study, by GNU parallel and by Snakemake with a process for each run: lines to
write, files left, seconds. The results of all three must be the same lines. Debian: apt-get install parallel snakemake.

    POLHODE_BIN_DIR=build/release/bin many_runs.py [RUNS [RUNS OF THE OTHER TWO]]     10000 each without arguments
"""
import csv
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

PROGRAM = (pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "build/release/bin")) / "energy_drift").resolve()
JOBS = 2
RUN = f"{PROGRAM} --integrator rk4 --dt 0.01 --t-end 1 --jobs 1 --no-figures"
KEY = "body.0.angular_velocity.1"

STUDY = f"{PROGRAM} --integrator rk4 --dt 0.01 --t-end 1 --jobs {JOBS} --no-figures --cells cells.csv --out study\n"
PARALLEL = f"""\
tail -n +2 cells.csv | parallel --jobs {JOBS} --halt soon,fail=1 --joblog log {RUN} --vary {KEY}={{}} --out runs/{{#}}
awk 'FNR > 1 || NR == 1' $(printf 'runs/%s/runs.csv\\n' $(seq $(tail -n +2 cells.csv | wc -l))) > runs.csv
"""
SNAKEFILE = f"""\
values = open("cells.csv").read().split()[1:]
rule all:
    input: "runs.csv"
rule run:
    output: "runs/{{k}}/runs.csv"
    params: value=lambda wildcards: values[int(wildcards.k)], folder=lambda wildcards: "runs/" + wildcards.k
    shell: "{RUN} --vary {KEY}={{params.value}} --out {{params.folder}} > /dev/null"
rule join:
    input: expand("runs/{{k}}/runs.csv", k=range(len(values)))
    output: "runs.csv"
    run:
        with open(output[0], "w") as table:
            for k, name in enumerate(input):
                table.writelines(open(name).readlines()[k > 0:])
"""
SNAKEMAKE = f"snakemake --quiet --cores {JOBS} --scheduler greedy\n"


def measured(folder, runs, command, files):
    """Carries out a shell command on so many runs. Returns wall and processor seconds and the number of files left."""
    folder.mkdir()
    given = {"cells.csv": "\n".join([KEY, *(repr(1 + 4 * k / runs) for k in range(runs))]) + "\n", **files}
    for name, text in given.items():
        (folder / name).write_text(text)
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    wall, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise SystemExit(f"{command}exit status {done.returncode}: {done.stderr[-800:]}")
    left = sum(path.is_file() for path in folder.rglob("*")) - len(given)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, left


def seconds_of_runs(folder):
    return sum(float(row["wall_s"]) for path in folder.rglob("timings.csv") for row in csv.DictReader(open(path)))


def main(runs=10000, of_others=None):
    ways = [("one study", runs, STUDY, {}, STUDY), ("GNU parallel", of_others or runs, PARALLEL, {}, PARALLEL),
            ("Snakemake", of_others or runs, SNAKEMAKE, {"Snakefile": SNAKEFILE}, SNAKEFILE + SNAKEMAKE)]
    print("| way | runs | lines to write | files left | seconds | processor seconds | seconds of the runs in timings.csv |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as place:
        for number, (name, count, command, files, written) in enumerate(ways):
            tool = command.split()[0] if name != "GNU parallel" else "parallel"
            if not shutil.which(tool):
                print(f"{name}: skipped, because {tool} is not installed", file=sys.stderr)
                continue
            folder, twin = pathlib.Path(place, str(number)), pathlib.Path(place, f"{number}_study")
            wall, processor, left = measured(folder, count, command, files)
            lines = len(written.splitlines())
            print(f"| {name} | {count} | {lines} | {left} | {wall:.1f} | {processor:.2f} | {seconds_of_runs(folder):.2f} |", flush=True)
            if number == 0:
                continue
            measured(twin, count, STUDY, {})
            ours, theirs = ((path / "runs.csv").read_text().splitlines() for path in (twin / "study", folder))
            if sorted(ours) != sorted(theirs):
                raise SystemExit(f"{name}: runs.csv has other lines than that of one study")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
