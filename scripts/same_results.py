# SPDX-License-Identifier: BSD-3-Clause
"""Shows that a change of the code left the results as they were, byte for byte.

    same_results.py record BIN FOLDER [--jobs N] [--only PATTERN]... [--list]
    same_results.py compare FOLDER FOLDER [--only PATTERN]...

`record` carries out every case with the programs in BIN and leaves what they write in FOLDER, one subfolder for each
case: files, standard output, standard error and exit status. A case that is done is skipped, so that the same command
goes on after an interruption. `compare` lists each file that differs or stands on one side alone, and for a text its
first differing line. PATTERN is a shell pattern of cases: 'scenario/*', 'study/pile'.

    same_results.py record ../before/build/release/bin /tmp/before     # about 6 minutes on two cores that others use as well
    same_results.py record build/release/bin /tmp/after
    same_results.py compare /tmp/before /tmp/after

Before and after must be built alike and run on the same machine: the flags include -march=native. Use the script of one
checkout for both, because the cases, the papers and paper.py are its own. What cannot be the same in two records is named
in LEFT_OUT and FILTERS below, with the reason, and nowhere else.

Exit status of record: 0 all cases are done, 2 bad input, 3 some could not be carried out. Of compare: 0 all the same, 1 a
difference, 2 bad input.
"""
import argparse
import concurrent.futures
import fnmatch
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
DONE = ".done"  # the folder of the marks of the cases that are done, beside PLACES
PLACES = "places.json"  # the folders that the programs were given, for the filter of absolute paths

# Files that are not compared: pattern of the path within the record, reason.
LEFT_OUT = [
    ("*.sqlite", "the store: its pages depend on when runs are committed; runs.csv has what it holds"),
    ("*.sqlite-*", "files of SQLite beside the store"),
    ("*/timings.csv", "wall times"),
    ("*/timings/*", "what an experiment makes of wall times"),
    ("study/broad_phase/results/figures/*", "drawn from wall times"),
    ("study/broad_phase/results/tables/*", "made from wall times"),
    ("study/broad_phase/results/report.html", "made from wall times"),
    ("study/broad_phase/results.stdout", "a table of wall times; how many steps are measured depends on them"),
    ("paper/engine_slides/results/broad_phase/figures/*", "drawn from wall times"),
    ("paper/engine_slides/results/broad_phase/tables/*", "made from wall times"),
    ("paper/engine_slides/results/broad_phase/report.html", "made from wall times"),
]

# Parts of texts that are not compared: pattern of the path, expression, what stands in its place, reason.
FILTERS = [
    ("*manifest.json", r'"cores": \d+', '"cores": …', "machine"),
    ("*manifest.json", r'"(processor|operating_system)": "[^"\n]*"', r'"\1": …', "machine"),
    ("*manifest.json", r'"(commit|compiler|flags|build_type)": "[^"\n]*"', r'"\1": …', "build"),
    ("*manifest.json", r'"dirty": (true|false)', '"dirty": …', "build"),
    ("*manifest.json", r'"libraries": \{[^}]*\}', '"libraries": …', "build"),
    ("*.html", r"(polhode [0-9.]+, commit )[0-9A-Za-z.-]+", r"\1…", "build"),
    ("*.stderr", r"(?m)^\w+: \d+ of \d+ runs, \d+ %, .*\n", "", "progress, printed every 10 s"),
    ("*.stdout", r"(?m)^(about|at least) .* with \d+ jobs?[,:] .*\n", "", "time that --dry-run expects"),
    ("*.stdout", r"(?m)^.*: [0-9.e+-]+ steps per second\.\n", "", "wall times (pile)"),
    ("*.stdout", r"(?m)^Cheapest by wall time .*\n", "", "wall times (work_precision)"),
    ("*.stdout", r"(?m)^.*A step takes .*\n", "", "wall times (certificate)"),
    ("*.stdout", r"(?m)^.*: an overlap takes .*\n", "", "wall times (narrow_phase)"),
    ("study/answers/*.stdout", r"(?m)^(\d+,\d+,\d+),[0-9.e+-]+$", r"\1,…", "wall time of each step (broad_phase --boxes)"),
    ("study/answers/*.stdout", r"[0-9.e+-]+ (n?s) per (step|box)", r"… \1 per \2", "their mean"),
    ("*broad_phase/*cost.csv", r"(?m)^(\w+,\d+),[^,\n]*,[^,\n]*,([^,\n]*),\d+$", r"\1,…,\2,…",
     "wall times; how many steps are measured depends on them"),
]

METHODS = "explicit_euler,semi_implicit_euler,rk4,lie_midpoint,dmv,cvode_adams,odeint_dopri5"
FIXED_STEP_METHODS = "explicit_euler,semi_implicit_euler,rk4,lie_midpoint,dmv"
CHARTS = ("--orientation", "quaternion,matrix")
OWN_T_END = None

# Duration in s of each built-in scenario without contact; bytes matter, not length.
FREE_SCENARIOS = {
    "coursework": 10, "detest_b5": OWN_T_END, "dyadic_top": 16, "dzhanibekov": 20, "five_cubes": 2,
    "free_symmetric_top": 2, "hairer_vilmart": OWN_T_END, "kovalevskaya_top": 5, "lagrange_top": 5, "oscillator": 10,
    "peters_hsu": 5, "peters_hsu_simple": 5, "physical_pendulum": 5, "projectile": OWN_T_END, "simo_wong": 2,
    "sleeping_top": 5, "spring_box": 5, "two_bodies": 10, "two_four_bars": 2,
}

# Durations in s of those with contact: contacts at each step, impacts where they are, contacts as springs (None: a run
# that ends at an impact has none there).
CONTACT_SCENARIOS = {
    "bouncing_ball": (4, 2, 1), "contact_detection": (4, 4, None), "cube_bouncing": (2, 2, 1), "dominoes": (0.3, 0.04, 0.02),
    "edge_on_edge": (2, 2, 1), "incline": (1, 1, 0.2), "newtons_cradle": (2, 2, 1), "pile_10": (1, 0.4, 0.2),
    "pile_100": (0.3, 0.06, 0.03), "pile_1000": (0.05, 0.01, 0.01), "rattleback": (1, 0.05, 0.1),
    "simbenchmark_bouncing": (2, 2, 0.2), "simbenchmark_rolling": (0.2, 0.01, 0.01), "slip_to_roll": (1, 0.2, 0.1),
    "spinning_coin": (0.5, 0.02, 0.05), "spinning_cubes": (2, 2, 1), "stack": (1, 0.04, 0.02), "tumbling_cube": (2, 2, 1),
    "two_cubes": (2, 2, 1), "vertex_on_face": (2, 2, 1),
}

# Each experiment that makes a study or a folder, with what its default study needs to stay short.
EXPERIMENTS = {
    "energy_drift": [], "simulate": [], "convergence": [], "work_precision": [], "stability": [], "precision": [],
    "certificate": [], "impact": [], "pile": [], "stack": [], "joints": [], "narrow_phase": [],
    "broad_phase": ["--bodies", "100,1000"],  # 100 to 100000 bodies by default: nothing but wall times
}
STUDIES = [name for name in EXPERIMENTS if name not in ("narrow_phase", "broad_phase")]
PROGRAMS = [*EXPERIMENTS, "judge", "replay", "viewer"]
PAPERS = ["course_report", "detest_b5", "engine_slides", "hairer_vilmart_2006", "peters_hsu_2015", "simbenchmark_bouncing",
          "simbenchmark_rolling", "simo_wong_1991"]
CATALOGUES = ["integrators", "scenarios", "forces", "shapes", "invariants", "metrics", "broad-phases", "narrow-phases",
              "responses", "impact-timings"]

# A live session in a window is not recorded: its steps follow the pace of the wall. Its digits without a window are those of
# the other cases (tests/viewer). Benchmarks print nothing but wall times.


class BadInput(Exception):
    """Something that the user can mend; its text is one line."""


class Step:
    """One call of a program in the folder of its case; what it prints goes into NAME.stdout, .stderr and .exit."""

    def __init__(self, name, program, *arguments):
        self.name, self.program, self.arguments = name, program, [str(a) for a in arguments]


def scenario_steps(scenario, *options, t_end=OWN_T_END, methods=METHODS, dt=0.01):
    duration = [] if t_end is OWN_T_END else ["--t-end", t_end]
    samples = ["--samples", 50] if t_end is OWN_T_END or 2 * t_end % 1 == 0 else []  # on whole steps only
    return [Step("results", "energy_drift", "--scenario", scenario, "--integrator", methods, *CHARTS, "--dt", dt,
                 *(["--tolerance", 1e-8] if methods == METHODS else []), *samples, "--trajectory", "csv", "--no-figures",
                 "--jobs", 1, *duration, *options, "--out", "results")]


def cases():
    """{name: steps}, in the order in which they are carried out: what costs nothing comes first."""
    every = {}
    for program in PROGRAMS:
        every[f"words/{program}"] = [Step("help", program, "--help")]
        if program != "judge":
            every[f"words/{program}"].append(Step("list", program, "--list"))
        if program in STUDIES:
            every[f"words/{program}"].append(Step("plan", program, "--dry-run"))
    every["words/catalogues"] = [Step(c, "energy_drift", "--list", c) for c in CATALOGUES]

    for name, t_end in FREE_SCENARIOS.items():
        every[f"scenario/{name}"] = scenario_steps(name, t_end=t_end)
    for name, (stepped, located, springs) in CONTACT_SCENARIOS.items():
        every[f"scenario/{name}"] = scenario_steps(name, t_end=stepped, methods=FIXED_STEP_METHODS)
        every[f"scenario/{name}-located"] = scenario_steps(name, "--impact-timing", "event_located", t_end=located)
        if springs:
            every[f"scenario/{name}-compliant"] = scenario_steps(name, "--response", "compliant", t_end=springs, dt=0.001)

    def study(name, *options):
        every[f"options/{name}"] = [Step("results", "energy_drift", *options, "--jobs", 1, "--no-figures", "--out", "results")]

    top = ("--scenario", "lagrange_top", "--t-end", 1, "--dt", 0.01, "--trajectory", "csv", "--samples", 20)
    study("every_step", "--scenario", "lagrange_top", "--t-end", 1, "--dt", 0.01, "--tolerance", 1e-8, "--integrator", METHODS,
          *CHARTS, "--trajectory", "csv")
    study("angular_state", *top, "--integrator", FIXED_STEP_METHODS, *CHARTS,
          "--angular-state", "velocity_world,velocity_body,momentum_world", "--gyroscopic", "on,off", "--normalize", "never,step")
    study("rotation_from", *top, "--integrator", "rk4", "--rotation-from", "normalized,stored")
    study("precision", *top, "--integrator", "explicit_euler,rk4,lie_midpoint", *CHARTS, "--precision", "float,double,long_double",
          "--summation", "plain,compensated")
    study("all_methods", "--scenario", "hairer_vilmart", "--t-end", 1, "--dt", 0.02, "--tolerance", 1e-6, "--integrator", "all",
          *CHARTS, "--trajectory", "csv", "--samples", 10)
    study("orders", "--scenario", "lagrange_top", "--t-end", 1, "--trajectory", "csv", "--samples", 20,
          "--integrator", "arkode_erk", "--order", "2,3,4,5", "--tolerance", 1e-6)
    study("vary", *top, "--integrator", "rk4,dmv", "--vary", "body.0.mass=1:3:3", "--vary", "body.0.inertia=[1,1,0.5];[1,1,0.8]")
    study("reference", "--scenario", "spring_box", "--t-end", 0.5, "--integrator", "rk4,dmv", "--dt", "0.01,0.02", "--reference")
    study("contact", "--scenario", "two_cubes", "--t-end", 2, "--dt", 0.01, "--integrator", "semi_implicit_euler", "--response",
          "all", "--impact-timing", "all", "--narrow-phase", "all", "--broad-phase", "all", "--trajectory", "csv", "--samples", 10)
    study("timings", "--scenario", "tumbling_cube", "--t-end", 2, "--dt", 0.01, "--integrator", "semi_implicit_euler,rk4",
          "--response", "all", "--impact-timing", "time_stepping,time_stepping_free_end,event_located", "--trajectory", "csv",
          "--samples", 10)

    for name, options in EXPERIMENTS.items():
        every[f"study/{name}"] = [Step("results", name, *options, *(["--jobs", 1] if name in STUDIES else []), "--out", "results")]
    every["study/judge"] = [
        *(Step(m, "simulate", "--scenario", "hairer_vilmart", "--integrator", m, "--dt", 0.01, "--t-end", 5, "--no-figures", "--jobs",
               1, "--out", m) for m in ("rk4", "explicit_euler", "dmv")),
        Step("results", "judge", "--scenario", "hairer_vilmart", "rk4/trajectory.csv", "explicit_euler/trajectory.csv",
             "dmv/trajectory.csv", "--out", "results")]
    every["study/replay"] = [
        Step("page", "replay", "--out", "replay.html"),
        Step("kept", "energy_drift", "--scenario", "two_cubes", "--integrator", "semi_implicit_euler,rk4", "--dt", 0.01, "--trajectory",
             "csv", "--no-figures", "--jobs", 1, "--out", "kept"),
        Step("page_of_kept", "replay", "--results", "kept")]
    every["study/viewer"] = [
        Step("pictures", "viewer", "--offscreen", "--scenario", "two_cubes", "--integrator", "semi_implicit_euler,rk4", "--dt", 0.01,
             "--plots", "--show", "axes,omega,momentum,contacts,trails", "--pause-on-collision", "--frames-per-second", 4, "--size",
             "640x360", "--out", "pictures"),
        Step("polhode", "viewer", "--offscreen", "--scenario", "dzhanibekov", "--dt", 0.01, "--show", "polhode,poinsot,trails",
             "--from", 10, "--duration", 0, "--size", "640x360", "--out", "polhode")]
    every["study/answers"] = [
        *(Step(n, "narrow_phase", "--pairs", "pairs.csv", "--narrow-phase", n, "--out", f"{n}.csv")
          for n in ("sat", "gjk", "sat_course_report")),
        *(Step(b, "broad_phase", "--boxes", "boxes.csv", "--broad-phase", b, "--out", f"{b}.csv")
          for b in ("all_pairs", "sweep_and_prune", "uniform_grid", "quadtree", "octree", "bsp_tree", "bvh"))]
    for name in PAPERS:
        every[f"paper/{name}"] = [Step("results", "paper.py", name)]
    return every


def write_inputs(folder):
    """pairs.csv and boxes.csv of study/answers; the same bytes at every call."""
    draw = random.Random(1).random

    def rotation():
        q = [2 * draw() - 1 for _ in range(4)]
        length = sum(x * x for x in q) ** 0.5
        return [x / length for x in q]

    with open(folder / "pairs.csv", "w", encoding="utf-8") as file:
        for k in range(200):
            numbers = []
            for place in (0, 1.5):
                numbers += [0.2 + draw() for _ in range(3)] + [place + draw() for _ in range(3)] + rotation()
            file.write(",".join([str(k), "drawn", *map(repr, numbers)]) + "\n")
    boxes = [[[0.1 + 0.4 * draw() for _ in range(3)], [5 * draw() for _ in range(3)], [draw() - 0.5 for _ in range(3)]]
             for _ in range(60)]
    with open(folder / "boxes.csv", "w", encoding="utf-8") as file:
        file.write("step,id,hx,hy,hz,px,py,pz\n")
        for step in range(20):
            for k, (half, place, way) in enumerate(boxes):
                numbers = half + [p + 0.1 * step * v for p, v in zip(place, way)]
                file.write(",".join([str(step), str(k), *map(repr, numbers)]) + "\n")


def carry_out(name, steps, programs, folder):
    """None, or why the case could not be carried out."""
    here = folder / name
    shutil.rmtree(here, ignore_errors=True)
    here.mkdir(parents=True)
    if name == "study/answers":
        write_inputs(here)
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "LIBGL_ALWAYS_SOFTWARE": "1"}
    environment.pop("DISPLAY", None)
    environment.pop("WAYLAND_DISPLAY", None)
    started = time.monotonic()
    for step in steps:
        if step.program == "paper.py":
            command = [sys.executable, "-B", ROOT / "scripts/paper.py", programs, ROOT / "papers" / step.arguments[0], "--out",
                       here / step.name, "--no-figures"]
        else:
            command = [programs / step.program, *step.arguments]
            if not command[0].exists():
                return f"there is no {command[0]}"
        with open(here / f"{step.name}.stdout", "wb") as out, open(here / f"{step.name}.stderr", "wb") as error:
            status = subprocess.run([str(word) for word in command], cwd=here, stdin=subprocess.DEVNULL, stdout=out, stderr=error,
                                    env=environment, check=False).returncode
        if status not in (0, 2, 3):
            return f"{step.name} ended with status {status}"
        (here / f"{step.name}.exit").write_text(f"{status}\n")
        if status == 2:
            reason = (here / f"{step.name}.stderr").read_text(encoding="utf-8", errors="replace").strip()
            print(f"{name}: bad input, recorded as such: {reason}", file=sys.stderr, flush=True)
    mark = folder / DONE / name
    mark.parent.mkdir(parents=True, exist_ok=True)
    mark.write_text(f"{time.monotonic() - started:.1f} s\n")
    return None


def chosen(names, patterns):
    return [n for n in names if not patterns or any(fnmatch.fnmatchcase(n, p) for p in patterns)]


def warn_of_scenarios_without_case(programs):
    known = {*FREE_SCENARIOS, *CONTACT_SCENARIOS}
    said = subprocess.run([str(programs / "energy_drift"), "--list", "scenarios"], capture_output=True, text=True, check=True).stdout
    # A name stands at the start of its line, indented by as much as all others.
    names = re.findall(r"(?m)^ {0,2}([a-z0-9_]+) ", said)
    for name in sorted(set(names) - known):
        print(f"same_results: scenario {name} has no case yet; add it to the tables of this script", file=sys.stderr)


def record(given):
    programs, folder = given.bin.resolve(), given.folder.resolve()
    every = cases()
    names = chosen(every, given.only)
    if given.list:
        print(*names, sep="\n")
        return 0
    if not names:
        raise BadInput(f"--only: no case is called {', '.join(given.only)}")
    if not (programs / "energy_drift").exists():
        raise BadInput(f"{programs}: there are no programs here")
    warn_of_scenarios_without_case(programs)
    folder.mkdir(parents=True, exist_ok=True)
    places = {"RECORD": str(folder), "BIN": str(programs), "REPOSITORY": str(ROOT)}
    if (folder / PLACES).exists() and json.loads((folder / PLACES).read_text(encoding="utf-8")) != places:
        raise BadInput(f"{folder}: was recorded with other folders ({PLACES}); name a new one")
    (folder / PLACES).write_text(json.dumps(places) + "\n", encoding="utf-8")
    left = [n for n in names if not (folder / DONE / n).exists()]
    if len(left) < len(names):
        print(f"{len(names) - len(left)} of {len(names)} cases are done already", file=sys.stderr)
    started, failed = time.monotonic(), 0
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        running = {pool.submit(carry_out, name, every[name], programs, folder): name for name in left}
        for count, one in enumerate(concurrent.futures.as_completed(running), start=1):
            name, problem = running[one], one.result()
            failed += problem is not None
            said = problem or (folder / DONE / name).read_text().strip()
            print(f"{count:3} of {len(left)}, {time.monotonic() - started:4.0f} s: {name}: {said}", file=sys.stderr, flush=True)
    print(f"{len(names) - failed} of {len(names)} cases are done, {time.monotonic() - started:.0f} s", file=sys.stderr)
    return 3 if failed else 0


def left_out(path):
    return any(fnmatch.fnmatchcase(path, pattern) for pattern, _ in LEFT_OUT)


def files_of(folder, name):
    return {str(p.relative_to(folder)) for p in (folder / name).rglob("*") if p.is_file()}


def filtered(path, data, places):
    """A text without what cannot be the same, or None where it is no text."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        return None
    for word, place in places.items():  # the record first: it may lie within the repository
        text = text.replace(place, f"<{word}>")
    for pattern, expression, instead, _ in FILTERS:
        if fnmatch.fnmatchcase(path, pattern):
            text = re.sub(expression, instead, text)
    return text


def difference(path, one, other):
    """What differs, in words; None where nothing does. `one` and `other`: folder, places."""
    (a_folder, a_places), (b_folder, b_places) = one, other
    a, b = (a_folder / path).read_bytes(), (b_folder / path).read_bytes()
    if a == b:
        return None
    a_text, b_text = filtered(path, a, a_places), filtered(path, b, b_places)
    if a_text is None or b_text is None:
        at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
        return f"binary, {len(a)} and {len(b)} bytes, the first difference at byte {at}"
    if a_text == b_text:
        return None
    a_lines, b_lines = a_text.split("\n"), b_text.split("\n")
    at = next((i for i, (x, y) in enumerate(zip(a_lines, b_lines)) if x != y), min(len(a_lines), len(b_lines)))
    shown = [excerpt(lines, other_lines, at) for lines, other_lines in ((a_lines, b_lines), (b_lines, a_lines))]
    return f"line {at + 1}\n    - {shown[0]}\n    + {shown[1]}"


def excerpt(lines, other, at):
    """Line `at`, from a little before the place where the other one differs."""
    if at >= len(lines):
        return "(no such line)"
    line = lines[at]
    beside = other[at] if at < len(other) else ""
    first = next((i for i, (x, y) in enumerate(zip(line, beside)) if x != y), min(len(line), len(beside)))
    begin = max(0, first - 60)
    return ("…" if begin else "") + line[begin:begin + 160] + ("…" if begin + 160 < len(line) else "")


def opened(folder):
    try:
        return folder, json.loads((folder / PLACES).read_text(encoding="utf-8"))
    except OSError as error:
        raise BadInput(f"{folder}: is no record, because {PLACES} cannot be read: {error.strerror}") from error


def compare(given):
    one, other = opened(given.one), opened(given.other)
    done = [{str(p.relative_to(f / DONE)) for p in (f / DONE).rglob("*") if p.is_file()} for f, _ in (one, other)]
    names = chosen(sorted(done[0] | done[1]), given.only)
    if not names:
        raise BadInput("no case is done in either record")
    compared = same = omitted = alone = 0
    for name in names:
        for where, there in ((one[0], done[0]), (other[0], done[1])):
            if name not in there:
                print(f"{name}: the case is not done in {where}")
                alone += 1
        if name not in done[0] or name not in done[1]:
            continue
        a, b = files_of(one[0], name), files_of(other[0], name)
        for path in sorted(a | b):
            if left_out(path):
                omitted += 1
            elif path not in a or path not in b:
                print(f"{path}: stands in {(one if path in a else other)[0]} alone")
                alone += 1
            else:
                compared += 1
                what = difference(path, one, other)
                same += what is None
                if what is not None:
                    print(f"{path}: {what}")
    print(f"{len(names)} cases: {compared} files compared, {same} the same, {compared - same} different, {alone} on one side alone, "
          f"{omitted} left out by rule")
    return 0 if same == compared and not alone else 1


def main():
    parser = argparse.ArgumentParser(prog="same_results", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    recording = commands.add_parser("record", help="carry out every case")
    recording.add_argument("bin", type=pathlib.Path, help="folder of the programs")
    recording.add_argument("folder", type=pathlib.Path, help="folder of the record")
    recording.add_argument("--jobs", type=int, default=1, help="cases at a time (default: 1)")
    recording.add_argument("--only", metavar="PATTERN", action="append", default=[], help="these cases only; may be repeated")
    recording.add_argument("--list", action="store_true", help="name the cases, and run nothing")
    comparing = commands.add_parser("compare", help="list what differs between two records")
    comparing.add_argument("one", type=pathlib.Path)
    comparing.add_argument("other", type=pathlib.Path)
    comparing.add_argument("--only", metavar="PATTERN", action="append", default=[], help="these cases only; may be repeated")
    given = parser.parse_args()
    return record(given) if given.command == "record" else compare(given)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as problem:
        print(f"same_results: {problem}", file=sys.stderr)
        sys.exit(2)
