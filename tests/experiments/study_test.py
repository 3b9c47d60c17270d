# SPDX-License-Identifier: BSD-3-Clause
"""What a user meets: the real programs, run as on a command line, killed, resumed, fed nonsense and read back.

POLHODE_BIN_DIR is the folder of energy_drift and simulate. Every test works in its own temporary folder.
"""
import collections
import contextlib
import csv
import json
import math
import os
import pathlib
import platform
import re
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest

from programs import peak_memory, stored

BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))
PATIENCE = 120  # s; a loaded machine is slow, a hanging program is not waited for longer

RUNS_START = ["run", "scenario", "integrator", "orientation", "angular_state", "gyroscopic", "normalize", "rotation_from",
              "precision", "dt_s", "tolerance", "t_end_s", "broad_phase", "narrow_phase", "response", "impact_timing"]
RUNS_RESULTS = ["status", "message", "steps", "rhs_evaluations", "energy_initial_J", "energy_scale_J",
                "energy_drift_max_J", "energy_round_off_J", "energy_drift_max_rel",
                "energy_drift_final_rel", "energy_drift_rate_W", "drift_class", "energy_drift_rate_ci_W", "drift_exponent",
                "drift_exponent_low", "drift_exponent_high", "drift_decided_after_s", "linear_momentum_drift_max_rel",
                "angular_momentum_drift_max_rel"]
RUNS_END = ["orientation_defect_max", "position_error_max_m", "attitude_error_max_rad", "angular_velocity_error_max_rel",
            "polhode_phase_error_max_s", "polhode_phase_error_max_rad", "polhode_off_error_max_rel"]
TRAJECTORY = ["t_s", "body", "px_m", "py_m", "pz_m", "qw", "qx", "qy", "qz", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s",
              "wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s", "lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s",
              "energy_J"]
MATRIX = [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
ENERGY = ["t_s", "kinetic_J", "potential_J", "work_J", "impact_loss_J", "friction_loss_J", "penetration_J",
          "projection_J", "drift_J"]
EVENTS = ["t_s", "kind", "body_a", "body_b", "px_m", "py_m", "pz_m", "nx", "ny", "nz", "impulse_N_s", "energy_lost_J"]

# 240 runs of some 10 ms of one core each, in ensembles: long enough to be stopped half-way.
MANY = ["--integrator", "rk4,explicit_midpoint", "--dt", "2e-5", "--vary", "body.0.angular_velocity.1=1:5:120",
        "--no-figures", "--jobs", "2"]
SMALL = ["--integrator", "rk4", "--dt", "1e-2,5e-3", "--no-figures"]

BODY = "[[body]]\nname = \"a\"\nmass = 1.0\ninertia = [1.0, 2.0, 2.5]\nangular_velocity = [0.1, 2.0, 0.3]\n"

Table = collections.namedtuple("Table", "header rows")


def read_table(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    for row in rows:
        if len(row) != len(header):
            raise AssertionError(f"{path}: a row of {len(row)} cells under {len(header)} columns: {row}")
    return Table(header, [dict(zip(header, row)) for row in rows])


def rows_by_run(path):
    """The lines of a CSV file by the run that they begin with."""
    lines = path.read_bytes().splitlines(keepends=True)[1:]
    return {line.split(b",", 1)[0]: line for line in lines}


def files_in(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def norm(v):
    return math.sqrt(sum(x * x for x in v))


class StudyTest(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        for name in ("energy_drift", "simulate"):
            self.assertTrue((BIN / name).is_file(), f"no program {name} in POLHODE_BIN_DIR = {BIN}")
        holder = tempfile.TemporaryDirectory(prefix="polhode_study_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.work = self.folder / "work"  # where the programs are started: must stay empty when nothing may be written
        self.work.mkdir()
        self.count = 0

    def new_out(self):
        self.count += 1
        return self.folder / f"out{self.count}"

    def call(self, program, *arguments, status=0, **settings):
        done = subprocess.run([str(BIN / program), *map(str, arguments)], cwd=self.work, capture_output=True, text=True,
                              timeout=PATIENCE, stdin=subprocess.DEVNULL, **settings)
        self.assertEqual(done.returncode, status,
                         f"{program} {' '.join(map(str, arguments))}: exit status {done.returncode}, not {status}\n"
                         f"stdout: {done.stdout[-1500:]}\nstderr: {done.stderr[-1500:]}")
        return done

    def study(self, *arguments, out=None, status=0):
        out = out or self.new_out()
        self.call("energy_drift", *arguments, "--out", out, status=status)
        return out

    def rows(self, *arguments, status=0):
        return read_table(self.study(*arguments, status=status) / "runs.csv").rows

    def simulate(self, *arguments):
        out = self.new_out()
        self.call("simulate", *arguments, "--no-figures", "--out", out)
        return out

    def start(self, *arguments):
        program = subprocess.Popen([str(BIN / "energy_drift"), *map(str, arguments)], cwd=self.work, text=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

        def end():
            if program.poll() is None:
                program.kill()
            program.communicate()

        self.addCleanup(end)
        return program

    def wait_for(self, what, condition, program):
        end = time.monotonic() + PATIENCE
        while not condition():
            if program.poll() is not None:
                self.fail(f"the program ended with {program.returncode} before {what}: {program.stderr.read()[-800:]}")
            self.assertLess(time.monotonic(), end, f"waited {PATIENCE} s in vain for {what}")
            time.sleep(0.005)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def refused(self, *arguments, program="energy_drift", say=()):
        """Bad input: exit status 2, one line on stderr that holds each of `say`, and nothing written."""
        before = files_in(self.folder)
        folders = {p for p in self.folder.rglob("*") if p.is_dir()}
        done = self.call(program, *arguments, status=2)
        self.assertEqual(done.stdout, "", "bad input is reported on stderr only")
        self.assertTrue(done.stderr.endswith("\n") and done.stderr.count("\n") == 1,
                        f"not exactly one line on stderr: {done.stderr!r}")
        for text in [say] if isinstance(say, str) else say:
            self.assertIn(text, done.stderr)
        self.assertEqual(files_in(self.folder), before, "bad input must leave all files as they were")
        self.assertEqual({p for p in self.folder.rglob("*") if p.is_dir()}, folders, "bad input must make no folder")
        return done.stderr


class Resuming(StudyTest):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="polhode_whole_")
        cls.addClassCleanup(cls.holder.cleanup)
        cls.whole = pathlib.Path(cls.holder.name) / "whole"
        done = subprocess.run([str(BIN / "energy_drift"), *MANY, "--out", str(cls.whole)], capture_output=True, text=True,
                              cwd=cls.holder.name, timeout=PATIENCE)
        if done.returncode != 0:
            raise AssertionError(f"the uninterrupted study failed with {done.returncode}: {done.stderr}")
        cls.runs = (cls.whole / "runs.csv").read_bytes()

    def test_the_whole_study_has_every_run_once(self):
        rows = read_table(self.whole / "runs.csv").rows
        self.assertEqual(len(rows), 240)
        self.assertEqual(len({r["run"] for r in rows}), 240)

    def test_killed_at_several_moments_it_ends_with_the_same_bytes(self):
        out = self.new_out()
        kept = 0
        for moment in (1, 50, 120, 190):
            program = self.start(*MANY, "--out", out)
            self.wait_for(f"{moment} stored runs", lambda: stored(out) >= moment, program)
            program.send_signal(signal.SIGKILL)
            self.assertEqual(program.wait(PATIENCE), -signal.SIGKILL)
            self.assertFalse((out / "runs.csv").exists(), "it was not stopped half-way; make the study longer")
            now = stored(out)
            self.assertGreaterEqual(now, max(kept, moment), "a run that was stored is lost")
            kept = now
        self.study(*MANY, out=out)
        self.assertEqual((out / "runs.csv").read_bytes(), self.runs)

    def test_killed_at_once_it_ends_with_the_same_bytes(self):
        whole = (self.study(*SMALL) / "runs.csv").read_bytes()
        for pause in (0, 0.003, 0.006, 0.01, 0.02, 0.03):
            out = self.new_out()
            program = self.start(*SMALL, "--out", out)
            time.sleep(pause)
            program.send_signal(signal.SIGKILL)
            program.wait(PATIENCE)
            self.study(*SMALL, out=out)
            self.assertEqual((out / "runs.csv").read_bytes(), whole)

    def test_an_empty_store_is_no_obstacle(self):
        """A kill between the making of the store and of its table leaves this behind."""
        out = self.new_out()
        out.mkdir()
        sqlite3.connect(out / "results.sqlite").executescript("PRAGMA journal_mode=WAL; PRAGMA user_version=0;")
        self.study(*SMALL, out=out)

    def test_interrupted_it_says_how_to_go_on(self):
        for wanted, go_on in ((signal.SIGINT, True), (signal.SIGTERM, False), (signal.SIGUSR1, False),
                              (signal.SIGXCPU, False)):
            out = self.new_out()
            program = self.start(*MANY, "--out", out)
            self.wait_for("20 stored runs", lambda: stored(out) >= 20, program)
            program.send_signal(wanted)
            _, text = program.communicate(timeout=PATIENCE)
            self.assertEqual(program.returncode, 75, text)
            found = re.search(r"interrupted; (\d+) of 240 runs are kept in (\S+); the same command goes on", text)
            self.assertTrue(found, text)
            self.assertEqual(int(found[1]), stored(out))
            self.assertEqual(found[2], str(out))
            if not go_on:
                continue
            done = self.call("energy_drift", *MANY, "--out", out)
            self.assertIn(f"{found[1]} of 240 runs are there already", done.stderr)
            self.assertEqual((out / "runs.csv").read_bytes(), self.runs)

    def test_interrupted_while_the_runs_are_planned_it_ends_at_once(self):
        for wanted in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGXCPU):
            out = self.new_out()
            program = self.start("--integrator", "rk4", "--dt", "1e-2", "--no-figures", "--out", out, "--jobs", "1",
                                 "--random", "n=3000000 seed=1 body.0.angular_velocity.1=uniform(1,5)")  # some 20 s
            time.sleep(1)
            program.send_signal(wanted)
            _, text = program.communicate(timeout=PATIENCE)
            self.assertEqual(program.returncode, 75, text)
            self.assertIn("interrupted before a run began; the same command begins", text)
            self.assertFalse(out.exists())

    def test_interrupted_as_soon_as_it_holds_its_folder_it_lets_go_of_it(self):
        for _ in range(3):
            out = self.new_out()
            program = self.start("--scenario", "free_symmetric_top", "--integrator", "rk4", "--dt", "1e-4", "--t-end", "1e5",
                                 "--no-figures", "--out", out)
            while not (out / "results.lock").exists():  # without a pause: the program has just made it
                self.assertIsNone(program.poll())
            program.send_signal(signal.SIGINT)
            program.send_signal(signal.SIGUSR1)  # two signals that differ are two signals
            _, text = program.communicate(timeout=PATIENCE)
            self.assertEqual(program.returncode, 75, text)
            self.assertIn("0 of 1 runs are kept", text)
            self.assertFalse((out / "results.lock").exists())

    def test_after_a_first_signal_a_short_run_ends_and_after_a_second_one_a_long_run_is_stopped(self):
        short = ["--integrator", "rk4", "--dt", "1e-6", "--t-end", "8", "--no-figures", "--jobs", "1"]  # about two seconds
        out = self.new_out()
        program = self.start(*short, "--out", out)
        self.wait_for("the store", lambda: (out / "results.sqlite").exists(), program)
        time.sleep(0.3)  # until the run has begun
        program.send_signal(signal.SIGUSR1)
        _, text = program.communicate(timeout=PATIENCE)
        self.assertEqual(program.returncode, 75, text)
        self.assertIn("1 of 1 runs are kept", text)
        self.assertIn("a second signal stops them", text)
        long = ["--scenario", "free_symmetric_top", "--integrator", "rk4", "--dt", "1e-4", "--t-end", "1e5",
                "--no-figures", "--jobs", "1"]
        for second in (signal.SIGTERM, None):  # without a second one it ends after five seconds
            out = self.new_out()
            program = self.start(*long, "--out", out)
            self.wait_for("the store", lambda: (out / "results.sqlite").exists(), program)
            time.sleep(0.3)
            began = time.monotonic()
            program.send_signal(signal.SIGUSR1)
            if second:
                time.sleep(0.2)
                self.assertIsNone(program.poll(), "the first signal lets runs under way go on")
                program.send_signal(second)
            _, text = program.communicate(timeout=PATIENCE)
            self.assertEqual(program.returncode, 75, text)
            self.assertIn("0 of 1 runs are kept", text)
            if not second:
                self.assertGreater(time.monotonic() - began, 4.5)

    def test_the_number_of_jobs_changes_nothing(self):
        for jobs in (1, 2, 5):
            out = self.study(*MANY[:2], "--dt", "1e-3,2e-3", *MANY[4:-2], "--jobs", jobs)
            runs = (out / "runs.csv").read_bytes()
            if jobs == 1:
                alone = runs
            self.assertEqual(runs, alone, f"--jobs {jobs} differs from --jobs 1")

    def test_runs_in_an_ensemble_have_the_digits_of_runs_alone(self):
        # A run whose trajectory is written goes alone; the others share the lanes of an ensemble.
        options = ["--scenario", "coursework,free_symmetric_top", "--integrator", "rk4,semi_implicit_euler", "--dt", "0.01",
                   "--t-end", "2", "--normalize", "step", "--vary", "body.0.angular_velocity.1=1:5:11", "--no-figures"]
        together, alone = self.study(*options), self.study(*options, "--trajectory", "csv")
        self.assertEqual(len(read_table(together / "runs.csv").rows), 44)
        self.assertEqual((together / "runs.csv").read_bytes(), (alone / "runs.csv").read_bytes())

    def test_repeating_carries_nothing_out_again(self):
        out = self.study(*SMALL)
        before = files_in(out)
        self.study(*SMALL, out=out)
        after = files_in(out)
        for name in ("runs.csv", "timings.csv", "manifest.json", "report.html"):
            self.assertEqual(after[name], before[name], name)

    def test_a_widened_study_reuses_what_is_there(self):
        out = self.study(*SMALL)
        runs, timings = rows_by_run(out / "runs.csv"), rows_by_run(out / "timings.csv")
        wide = ["--integrator", "semi_implicit_euler,rk4", "--dt", "2e-2,1e-2,5e-3,2e-3", "--gyroscopic", "on,off",
                "--no-figures"]
        done = self.call("energy_drift", *wide, "--out", out)
        self.assertIn("2 of 16 runs are there already", done.stderr)
        wide_runs, wide_timings = rows_by_run(out / "runs.csv"), rows_by_run(out / "timings.csv")
        self.assertEqual(len(wide_runs), 16)
        for run in runs:
            self.assertEqual(wide_runs.get(run), runs[run])
            self.assertEqual(wide_timings.get(run), timings[run], "the run was made anew")
        self.assertEqual((out / "runs.csv").read_bytes(), (self.study(*wide) / "runs.csv").read_bytes())

    def test_a_trajectory_cut_off_by_a_kill_is_made_whole(self):
        """The results are stored already; only the trajectory is asked for later, and its writing is interrupted."""
        options = ["--integrator", "rk4", "--dt", "1e-4", "--no-figures"]
        whole = self.study(*options, "--trajectory", "csv")
        path = next(whole.glob("trajectories/*/trajectory.csv"))
        out = self.study(*options)
        again = out / path.relative_to(whole)
        for wanted in (signal.SIGKILL, signal.SIGINT):
            shutil.rmtree(out / "trajectories", ignore_errors=True)
            program = self.start(*options, "--trajectory", "csv", "--out", out)
            begun = again.with_name(again.name + ".unfinished")
            self.wait_for("the first rows", lambda: begun.exists() and begun.stat().st_size > 100_000, program)
            program.send_signal(wanted)
            program.communicate(timeout=PATIENCE)
            self.assertNotEqual(program.returncode, 0, "it was not stopped half-way; make the run longer")
            self.study(*options, "--trajectory", "csv", out=out)
            self.assertEqual(again.stat().st_size, path.stat().st_size, f"cut off by {wanted.name}, taken for whole")
        self.assertEqual(again.read_bytes(), path.read_bytes())


class SameBytes(StudyTest):
    def test_the_order_of_values_does_not_matter(self):
        one = self.study("--scenario", "peters_hsu,oscillator", "--integrator", "rk4,explicit_euler", "--dt", "1e-2,5e-3",
                         "--orientation", "quaternion,matrix", "--t-end", "1,2", "--vary", "body.0.mass=1,2,10",
                         "--vary", "body.0.velocity=[0,0,1];[1,0,0]", "--no-figures")
        two = self.study("--no-figures", "--vary", "body.0.velocity=[1,0,0];[0,0,1]", "--vary", "body.0.mass=10,2,1",
                         "--t-end", "2,1", "--orientation", "matrix,quaternion", "--dt", "5e-3,0.01", "--integrator",
                         "explicit_euler,rk4", "--scenario", "oscillator,peters_hsu")
        self.assertEqual((one / "runs.csv").read_bytes(), (two / "runs.csv").read_bytes())

    def test_a_value_given_twice_counts_once(self):
        self.assertEqual(len(self.rows("--integrator", "rk4,rk4", "--dt", "1e-2,0.01,0.010", "--no-figures")), 1)

    def test_the_product_counts_each_run_once(self):
        rows = self.rows("--integrator", "rk4,odeint_dopri5", "--dt", "1e-2,2e-2", "--tolerance", "1e-5,1e-6,1e-7",
                         "--no-figures")
        self.assertEqual(sum(r["integrator"] == "rk4" and r["tolerance"] == "" for r in rows), 2)
        self.assertEqual(sum(r["integrator"] == "odeint_dopri5" and r["dt_s"] == "" for r in rows), 3)
        self.assertEqual(len(rows), 5)

    def test_order_chooses_the_table_of_methods_that_offer_several(self):
        runs = self.rows("--scenario", "detest_b5", "--integrator", "arkode_erk,arkode_dirk,rk4", "--order", "3,5",
                         "--tolerance", "1e-8", "--dt", "0.1", "--t-end", "10")
        self.assertEqual([(r["integrator"], r["order"]) for r in runs],
                         [("arkode_dirk", "3"), ("arkode_dirk", "5"), ("arkode_erk", "3"), ("arkode_erk", "5"), ("rk4", "")])
        steps = {(r["integrator"], r["order"]): int(r["steps"]) for r in runs}
        for method in ("arkode_dirk", "arkode_erk"):
            self.assertGreater(steps[method, "3"], 2 * steps[method, "5"], "a higher order takes longer steps")
        refused = self.rows("--scenario", "detest_b5", "--integrator", "arkode_erk,arkode_dirk", "--order", "7",
                            "--tolerance", "1e-8", "--t-end", "1", status=3)
        self.assertEqual([(r["integrator"], r["status"]) for r in refused], [("arkode_dirk", "refused"), ("arkode_erk", "ok")])
        self.assertIn("has the orders 2 to 5, not 7", refused[0]["message"])

    def test_a_study_file_says_the_same_as_the_command_line(self):
        file = self.write("study.toml", """
scenario = ["peters_hsu"]
integrator = ["rk4", "semi_implicit_euler", "odeint_dopri5"]
dt = [1e-2, 5e-3]
tolerance = 1e-6
normalize = "step"
t_end = 2
[vary]
"body.0.mass" = [1, 2.5]
"body.0.angular_velocity" = [[0.1, 5.0, 0.1], [1.0, 0.0, 2.0]]
""")
        line = self.study("--scenario", "peters_hsu", "--integrator", "rk4,semi_implicit_euler,odeint_dopri5", "--dt",
                          "1e-2,5e-3", "--tolerance", "1e-6", "--normalize", "step", "--t-end", "2", "--vary",
                          "body.0.mass=1,2.5", "--vary", "body.0.angular_velocity=[0.1,5,0.1];[1,0,2]", "--no-figures")
        from_file = self.study("--study", file, "--no-figures")
        a, b = read_table(line / "runs.csv"), read_table(from_file / "runs.csv")
        self.assertEqual(len(a.rows), 20)
        self.assertEqual(a.header, b.header)
        key = "body.0.angular_velocity"
        for row in a.rows + b.rows:  # whole vectors stand as they were written: 5 and 5.0 are the same number
            row[key] = json.loads(row[key])
        self.assertEqual(len([r for r in b.rows if r[key] == [0.1, 5.0, 0.1]]), 10)
        del_run = [[{k: v for k, v in r.items() if k != "run"} for r in t.rows] for t in (a, b)]
        self.assertEqual(sorted(map(str, del_run[0])), sorted(map(str, del_run[1])))

    def test_a_study_file_of_plain_values_gives_the_same_bytes(self):
        file = self.write("study.toml", 'integrator = ["rk4", "explicit_euler"]\ndt = [1e-2, 5e-3]\ngyroscopic = ["on", '
                          '"off"]\nt_end = [1.0, 2]\n[vary]\n"body.0.mass" = [1, 2.5]\n')
        line = self.study("--integrator", "rk4,explicit_euler", "--dt", "1e-2,5e-3", "--gyroscopic", "on,off", "--t-end",
                          "1,2", "--vary", "body.0.mass=1,2.5", "--no-figures")
        from_file = self.study("--study", file, "--no-figures")
        self.assertEqual((line / "runs.csv").read_bytes(), (from_file / "runs.csv").read_bytes())

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed: no figures to compare")
    def test_figures_are_the_same_bytes_from_run_to_run(self):
        options = ["--integrator", "rk4,explicit_euler,semi_implicit_euler", "--dt", "1e-2,2e-2,5e-3"]
        one, two = files_in(self.study(*options) / "figures"), files_in(self.study(*options) / "figures")
        self.assertTrue([n for n in one if n.endswith(".svg")], "no SVG figure was made")
        self.assertEqual(sorted(one), sorted(two))
        for name in one:
            self.assertEqual(one[name], two[name], f"{name} differs from run to run")
        for name in (n for n in one if n.endswith(".svg")):
            self.assertIn(name[:-4] + ".gp", one)
            self.assertIn(b"<svg", one[name][:2000])

    def test_no_figures_makes_none(self):
        out = self.study("--integrator", "rk4", "--dt", "1e-2,2e-2", "--no-figures")
        self.assertFalse(list(out.rglob("*.svg")) + list(out.rglob("*.pdf")) + list(out.rglob("*.gp")))
        self.assertTrue((out / "report.html").is_file())


class BadInput(StudyTest):
    def test_scenario_files(self):
        bodyless = BODY.replace("mass = 1.0", "mass = {}")
        inertia = BODY.replace("[1.0, 2.0, 2.5]", "{}")
        # what is wrong: the text after a first line with t_end, the line at fault, and what the message must name
        table = {
            "unknown key": ("colour = 3\n" + BODY, 2, "colour"),
            "unknown key of a body": (BODY + "weight = 3\n", 7, "weight"),
            "unknown table": (BODY + "[[joint]]\nkind = \"hinge\"\n", 7, "joint"),
            "duplicate key": (BODY + "mass = 2.0\n", 7, "mass"),
            "text for a number": (bodyless.format('"heavy"'), 4, "mass"),
            "number for a list": (inertia.format("1.0"), 5, "inertia"),
            "list too short": (inertia.format("[1.0, 1.0]"), 5, "inertia"),
            "NaN": (bodyless.format("nan"), 4, "mass"),
            "infinite": (inertia.format("[1.0, inf, 1.0]"), 5, "inertia"),
            "negative mass": (bodyless.format("-1.0"), 4, "mass"),
            "zero mass": (bodyless.format("0"), 4, "mass"),
            "impossible inertia": (inertia.format("[1.0, 1.0, 5.0]"), 5, "inertia"),
            "negative inertia": (inertia.format("[1.0, -1.0, 1.0]"), 5, "inertia"),
            "asymmetric inertia": (inertia.format("[[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]"), 5, "inertia"),
            "no unit quaternion": (BODY + "orientation = [1.0, 0.1, 0.0, 0.0]\n", 7, "orientation"),
            "zero quaternion": (BODY + "orientation = [0.0, 0.0, 0.0, 0.0]\n", 7, "orientation"),
            "unknown force": (BODY + '[[force]]\nkind = "sprong"\nbodies = ["a"]\n', 8, "sprong"),
            "unknown body": (BODY + '[[force]]\nkind = "spring"\nbodies = ["b"]\nstiffness = 1.0\n', 9, "bodies"),
            "unknown key of a force": (BODY + '[[force]]\nkind = "spring"\nbodies = ["a"]\nstiffness = 1.0\nsize = 2\n',
                                       11, "size"),
            "two bodies of one name": (BODY + BODY, 8, "name"),
            "unknown frame": (BODY + 'angular_velocity_frame = "moon"\n', 7, "angular_velocity_frame"),
            "duration twice": ("t_end = 1.0\n" + BODY, 2, "t_end"),
            "unknown shape": (BODY + 'shape = { kind = "teapot" }\n', 7, "teapot"),
            "unknown invariant": ('invariants = ["luck"]\n' + BODY, 2, "luck"),
            "no TOML": (BODY + "mass == \n", 7, ""),
            "cut off": (BODY + "position = [0.0, \n", None, ""),
            "a line break in a key": (BODY + '"wei\\nght" = 3\n', 7, "ght"),
        }
        for what, (text, line, name) in table.items():
            with self.subTest(what):
                path = self.write("bad.toml", "t_end = 1.0\n" + text)
                message = self.refused("--scenario", path, "--integrator", "rk4", "--out", self.new_out(), say=name)
                self.assertRegex(message, r"bad\.toml:\d+:\d+: ")
                if line:
                    self.assertEqual(int(re.search(r"bad\.toml:(\d+):", message)[1]), line, message)

    def test_scenario_files_that_are_none(self):
        (self.folder / "folder.toml").mkdir()
        for path in (self.folder / "missing.toml", self.folder / "folder.toml", self.write("empty.toml", "")):
            with self.subTest(path.name):
                self.refused("--scenario", path, "--integrator", "rk4", "--out", self.new_out(), say=path.name)

    def test_options(self):
        rk4 = ["--integrator", "rk4"]
        table = {
            "unknown scenario": (["--scenario", "peter_hsu"], ["peter_hsu", "peters_hsu"]),
            "unknown integrator": (["--integrator", "rk44"], ["rk44", "rk4"]),
            "unknown orientation": (rk4 + ["--orientation", "euler"], ["--orientation", "euler"]),
            "unknown angular state": (rk4 + ["--angular-state", "spin"], ["--angular-state", "spin"]),
            "unknown precision": (rk4 + ["--precision", "half"], ["--precision", "half"]),
            "unknown switch": (rk4 + ["--gyroscopic", "yes"], ["--gyroscopic", "yes"]),
            "unknown normalize": (rk4 + ["--normalize", "always"], ["--normalize", "always"]),
            "unknown trajectory": (rk4 + ["--trajectory", "xml"], ["--trajectory"]),
            "dt 0": (rk4 + ["--dt", "0"], ["--dt"]),
            "dt negative": (rk4 + ["--dt", "-1e-3"], ["--dt"]),
            "dt nan": (rk4 + ["--dt", "nan"], ["--dt"]),
            "dt infinite": (rk4 + ["--dt", "inf"], ["--dt"]),
            "dt text": (rk4 + ["--dt", "small"], ["--dt", "small"]),
            "dt with a unit": (rk4 + ["--dt", "1e-3s"], ["--dt"]),
            "dt overflows": (rk4 + ["--dt", "1e400"], ["--dt"]),
            "dt far too small": (rk4 + ["--dt", "1e-300"], ["dt"]),
            "one bad dt of three": (rk4 + ["--dt", "1e-3,0,1e-2"], ["--dt"]),
            "empty list": (rk4 + ["--dt", ""], ["--dt"]),
            "empty item": (rk4 + ["--dt", "1e-3,,1e-2"], ["--dt", "empty"]),
            "empty names": (["--integrator", ","], ["--integrator", "empty"]),
            "range without count": (rk4 + ["--dt", "1e-3:1e-2"], ["--dt"]),
            "range of half a value": (rk4 + ["--dt", "1e-3:1e-2:2.5"], ["--dt"]),
            "range through zero": (rk4 + ["--dt", "-1:1:3:log"], ["--dt"]),
            "tolerance 0": (["--integrator", "cvode_bdf", "--tolerance", "0"], ["--tolerance"]),
            "tolerance 2": (["--integrator", "cvode_bdf", "--tolerance", "2"], ["--tolerance"]),
            "t-end 0": (rk4 + ["--t-end", "0"], ["--t-end"]),
            "t-end text": (rk4 + ["--t-end", "later"], ["--t-end"]),
            "samples 0": (rk4 + ["--samples", "0"], ["--samples"]),
            "samples 2.5": (rk4 + ["--samples", "2.5"], ["--samples"]),
            "samples that do not divide": (rk4 + ["--dt", "1e-3", "--samples", "7"], ["samples", "7"]),
            "vary an unknown key": (rk4 + ["--vary", "body.0.weight=1,2"], ["body.0.weight", "weight"]),
            "vary an unknown body": (rk4 + ["--vary", "body.7.mass=1,2"], ["body.7.mass"]),
            "vary without values": (rk4 + ["--vary", "body.0.mass="], ["body.0.mass"]),
            "vary without a key": (rk4 + ["--vary", "1,2"], ["--vary"]),
            "vary a wrong type": (rk4 + ["--vary", "body.0.mass=heavy"], ["body.0.mass"]),
            "vary a negative mass": (rk4 + ["--vary", "body.0.mass=1,-1"], ["body.0.mass"]),
            "vary an impossible inertia": (rk4 + ["--vary", "body.0.inertia=[1,1,5]"], ["inertia"]),
            "unknown option": (rk4 + ["--stepsize", "1"], ["--stepsize"]),
            "stray word": (rk4 + ["fast"], ["fast"]),
            "jobs 0": (rk4 + ["--jobs", "0"], ["--jobs"]),
            "jobs text": (rk4 + ["--jobs", "many"], ["--jobs"]),
            "seed text": (rk4 + ["--seed", "lucky"], ["--seed"]),
            "a phase that there is not": (rk4 + ["--broad-phase", "magic"], ["--broad-phase"]),
            "missing study file": (["--study", "no.toml"], ["no.toml"]),
            "a line break in a name": (["--integrator", "rk\n4"], ["--integrator"]),
        }
        for what, (arguments, say) in table.items():
            with self.subTest(what):
                self.refused(*arguments, "--out", self.new_out(), say=say)

    def test_the_default_folder_is_not_made_either(self):
        self.refused("--integrator", "rk4", "--dt", say="--dt")  # without its value
        for arguments in (["--integrator", "rk44"], ["--dt", "0"], ["--vary", "body.0.weight=1"], ["--stepsize", "1"]):
            self.refused(*arguments)

    def test_listing_an_unknown_word(self):
        self.refused("--list", "wishes", say="wishes")

    def test_study_files(self):
        table = {
            "unknown axis": ('integrator = "rk4"\ncolour = 1\n', 2, "colour"),
            "no TOML": ("integrator = \n", 1, ""),
            "duplicate": ("dt = 1e-3\ndt = 1e-2\n", 2, "dt"),
            "empty list": ("dt = []\n", 1, "dt"),
            "date": ("dt = 2020-01-01\n", 1, "dt"),
            "vary is no table": ("vary = 3\n", 1, "vary"),
            "vary of an empty list": ('[vary]\n"body.0.mass" = []\n', 2, "body.0.mass"),
        }
        for what, (text, line, name) in table.items():
            with self.subTest(what):
                message = self.refused("--study", self.write("bad.toml", text), "--out", self.new_out(), say=name)
                self.assertRegex(message, rf"bad\.toml:{line}:\d+: ")

    def test_values_in_study_files(self):
        for text, *say in (('integrator = "rk44"\n', "bad.toml:1:14: integrator: ", "rk44"),
                           ("\ndt = 0.0\n", "bad.toml:2:6: dt: 0 is not positive"),
                           ("dt = nan\n", "bad.toml:1:6: dt: ", "finite"),
                           ("tolerance = [1e-3, 2]\n", "bad.toml:1:13: tolerance: 2 is too large"),
                           ('scenario = "nowhere"\n', "bad.toml:1:12: scenario: "),
                           ('integrator = "rk4"\ndt = 1e-300\n', "bad.toml:2:6: dt: "),
                           ('[vary]\n"body.0.weight" = [1, 2]\n', "bad.toml:2:19: vary.body.0.weight: ", "weight"),
                           ('[vary]\n"body.0.mass" = [1, -2]\n', "bad.toml:2:17: vary.body.0.mass: -2 is not")):
            with self.subTest(text):
                self.refused("--study", self.write("bad.toml", text), "--out", self.new_out(), say=say)
        self.refused("--study", self.write("bad.toml", "dt = 0.0\n"), "--dt", "-1", "--out", self.new_out(), say="--dt: -1")

    def test_folders_that_cannot_be(self):
        file = self.write("file", "mine\n")
        out = ["--integrator", "rk4", "--dt", "1e-2", "--out"]
        self.refused(*out, file, say="is not a folder")
        self.refused(*out, file / "below", say="--out")
        for folder in ("/proc", "/proc/polhode", "/proc/1/polhode"):
            if os.path.isdir(os.path.dirname(folder)):
                with self.subTest(folder):
                    self.refused(*out, folder, say="--out")
        if os.geteuid() != 0:
            closed = self.folder / "closed"
            closed.mkdir()
            closed.chmod(0o500)
            self.addCleanup(closed.chmod, 0o700)
            self.refused(*out, closed, say="--out")
            self.refused(*out, closed / "below", say="--out")

    def test_simulate_makes_one_run(self):
        self.refused("--dt", "1e-2,1e-3", "--out", self.new_out(), program="simulate", say="one run")
        self.refused("--integrator", "all", "--out", self.new_out(), program="simulate", say="one run")

    def test_pairings_that_make_no_sense_are_refused(self):
        no_term = ["--integrator", "rk4", "--dt", "1e-2", "--gyroscopic", "off", "--angular-state", "momentum_world"]
        self.refused(*no_term, "--out", self.new_out(), say=["gyroscopic", "momentum"])
        for method in ("cvode_bdf", "cvode_adams"):
            self.refused("--integrator", method, "--precision", "float", "--out", self.new_out(), say=[method, "float"])

    def test_a_refused_pairing_within_a_product_is_a_row(self):
        rows = self.rows("--integrator", "rk4", "--dt", "1e-2", "--gyroscopic", "on,off", "--angular-state",
                         "velocity_world,momentum_world", "--no-figures", status=3)
        self.assertEqual(len(rows), 4)
        for row in rows:
            senseless = row["gyroscopic"] == "off" and row["angular_state"] == "momentum_world"
            self.assertEqual(row["status"], "refused" if senseless else "ok")
            self.assertEqual("gyroscopic" in row["message"], senseless, row["message"])
            self.assertEqual(row["energy_drift_max_rel"] == "", senseless)


class ResultFolders(StudyTest):
    OTHER = ["--integrator", "explicit_midpoint", "--dt", "2e-2", "--no-figures"]

    def test_results_of_another_study_are_not_overwritten(self):
        out = self.study(*SMALL)
        before = files_in(out)
        self.refused(*self.OTHER, "--out", out, say=[str(out), "different study", "--force"])
        self.refused(*SMALL[:2], "--dt", "1e-2", "--no-figures", "--out", out, say="--force")
        self.assertEqual(files_in(out), before)

    def test_results_without_a_store_are_not_overwritten(self):
        for name in ("runs.csv", "report.html", "manifest.json"):
            out = self.new_out()
            out.mkdir()
            (out / name).write_text("mine\n")
            self.refused(*SMALL, "--out", out, say=[name, "--force"])

    def test_a_store_that_is_none_is_not_overwritten(self):
        out = self.new_out()
        out.mkdir()
        (out / "results.sqlite").write_text("not a database, but someone's work " * 200)
        self.refused(*SMALL, "--out", out, say="--force")

    def test_a_pipe_or_a_device_is_no_store(self):
        for make in (os.mkfifo, lambda path: path.symlink_to("/dev/zero")):
            out = self.new_out()
            out.mkdir()
            make(out / "results.sqlite")
            for program, *arguments in (("energy_drift", *SMALL, "--out", out), ("energy_drift", *SMALL, "--out", out, "--dry-run"),
                                        ("results", out)):
                with self.subTest(program, arguments=arguments):
                    done = self.call(program, *arguments, status=2)
                    self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                    self.assertIn("results.sqlite: is no regular file", done.stderr)
            self.assertEqual([path.name for path in out.iterdir()], ["results.sqlite"])
            self.call("energy_drift", *SMALL, "--out", out, "--force")
            self.assertTrue((out / "results.sqlite").is_file())

    def test_a_database_that_is_no_store_of_the_study_stays_as_it_is(self):
        store = self.study(*SMALL) / "results.sqlite"
        for name, sql in (("foreign", "CREATE TABLE mine (x); INSERT INTO mine VALUES (1)"),
                          ("older", "PRAGMA user_version=1"), ("rollback", "PRAGMA journal_mode=DELETE"), ("empty", "")):
            out = self.new_out()
            out.mkdir()
            if name in ("older", "rollback"):
                shutil.copy(store, out)
            with contextlib.closing(sqlite3.connect(out / "results.sqlite")) as db:
                db.executescript(sql)
            before = files_in(out)
            refused = name in ("foreign", "older")
            for arguments in ((SMALL, [*SMALL, "--dry-run"]) if refused else ([*SMALL, "--dry-run"],)):
                with self.subTest(name, arguments=arguments):
                    done = self.call("energy_drift", *arguments, "--out", out, status=2 if refused else 0)
                    if refused:
                        self.assertIn("--force", done.stderr)
                        self.assertNotIn("kept", done.stderr)
                    else:
                        self.assertIn("2 of 2 runs are there" if name == "rollback" else "2 runs", done.stdout)
                    self.assertEqual({k: v for k, v in files_in(out).items() if k != "results.lock"}, before)

    def test_other_files_in_the_folder_are_left_alone(self):
        out = self.new_out()
        out.mkdir()
        (out / "notes.txt").write_text("mine\n")
        self.study(*SMALL, out=out)
        self.assertEqual((out / "notes.txt").read_text(), "mine\n")

    def test_force_replaces_them(self):
        out = self.study(*SMALL)
        self.study(*self.OTHER, "--force", out=out)
        self.assertEqual((out / "runs.csv").read_bytes(), (self.study(*self.OTHER) / "runs.csv").read_bytes())
        self.assertEqual(stored(out), 1)
        self.study(*self.OTHER, out=out)

    def test_force_leaves_nothing_of_the_other_study(self):
        out = self.study("--integrator", "rk4,explicit_euler", "--dt", "1e-2,5e-3", "--trajectory", "csv")
        self.study(*self.OTHER, "--force", out=out)
        fresh = self.study(*self.OTHER)
        self.assertEqual(sorted(files_in(out)), sorted(files_in(fresh)))

    def test_simulate_does_not_take_the_motion_of_another_run_for_its_own(self):
        out, fresh = self.new_out(), self.new_out()
        other = ["--dt", "1e-2", "--scenario", "oscillator", "--no-figures"]
        self.call("simulate", "--dt", "1e-2", "--no-figures", "--out", out)
        self.call("simulate", *other, "--trajectory", "none", "--force", "--out", out)
        self.call("simulate", *other, "--out", out)
        self.call("simulate", *other, "--out", fresh)
        self.assertEqual((out / "trajectory.csv").read_bytes(), (fresh / "trajectory.csv").read_bytes())

    def test_two_programs_do_not_share_a_folder(self):
        out = self.new_out()
        long = ["--scenario", "free_symmetric_top", "--integrator", "rk4", "--dt", "1e-4", "--t-end", "1e5",
                "--no-figures", "--out", out]
        first = self.start(*long)
        self.wait_for("the store", lambda: (out / "results.sqlite").exists(), first)
        for force in ([], ["--force"]):
            done = self.call("energy_drift", *long, *force, status=2)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertRegex(done.stderr, rf"another program is writing into {re.escape(str(out))} \(process {first.pid} on host "
                             r"\S+, since \d{4}-\d\d-\d\d \d\d:\d\d:\d\d UTC: \S*energy_drift --scenario .*\); wait for it")
        self.assertIsNone(first.poll(), "the first program must not be disturbed")
        self.assertTrue((out / "results.lock").exists())
        first.send_signal(signal.SIGINT)
        _, text = first.communicate(timeout=PATIENCE)
        self.assertEqual(first.returncode, 75, text)
        self.assertIn("0 of 1 runs", text)
        self.assertFalse((out / "results.lock").exists())


class Results(StudyTest):
    def test_the_table_of_runs(self):
        out = self.study("--scenario", "lagrange_top,peters_hsu", "--integrator", "rk4,odeint_dopri5", "--dt", "1e-2",
                         "--tolerance", "1e-6", "--orientation", "quaternion,matrix", "--vary", "body.0.mass=1,2",
                         "--no-figures")
        table = read_table(out / "runs.csv")
        self.assertEqual(table.header, RUNS_START + ["body.0.mass"] + RUNS_RESULTS +
                         ["p_phi_drift_max_rel", "p_psi_drift_max_rel"] + RUNS_END)
        self.assertEqual(len(table.rows), 16)
        words = {"", "run", "scenario", "integrator", "orientation", "angular_state", "gyroscopic", "normalize",
                 "rotation_from", "precision", "status", "message", "drift_class", "broad_phase", "narrow_phase",
                 "response", "impact_timing"}
        for row in table.rows:
            for column, cell in row.items():
                self.assertNotRegex(cell, r"(?i)^[-+]?(nan|inf)", column)
                if column not in words and cell:
                    self.assertTrue(math.isfinite(float(cell)), f"{column}: {cell}")
            self.assertEqual(row["rotation_from"], "" if row["orientation"] == "matrix" else "normalized")
            self.assertEqual((row["dt_s"] == "") + (row["tolerance"] == ""), 1)
            self.assertEqual(row["p_phi_drift_max_rel"] != "", row["scenario"] == "lagrange_top")
            self.assertEqual(row["linear_momentum_drift_max_rel"], "")  # gravity, and in the other case a pivot

    def test_the_manifest(self):
        out = self.study(*SMALL, "--seed", "7")
        manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
        self.assertRegex(manifest["polhode"]["commit"], r"^[0-9a-f]{7,40}(-dirty)?$|^unknown$")
        self.assertRegex(manifest["polhode"]["version"], r"^\d+\.\d+")
        self.assertRegex(manifest["compiler"], r"\d")
        self.assertIn("-std=c++20", manifest["flags"])
        self.assertEqual(manifest["polhode"]["dirty"], manifest["polhode"]["commit"].endswith("-dirty"))
        self.assertTrue(manifest["processor"])
        self.assertGreaterEqual(manifest["cores"], 1)
        self.assertIn(platform.machine(), manifest["operating_system"])
        self.assertEqual(set(manifest["libraries"]), {"Eigen", "SUNDIALS", "Boost", "HDF5", "SQLite", "toml++", "CLI11",
                                                      "nlohmann-json", "fmt", "TBB", "Qhull", "xxHash", "jemalloc"})
        for library, version in manifest["libraries"].items():
            self.assertRegex(version, r"^\d+(\.\d+)+", library)
        with contextlib.closing(sqlite3.connect(out / "results.sqlite")) as store:
            self.assertEqual(store.execute("PRAGMA user_version").fetchone()[0], manifest["store_version"])
            studies = store.execute("SELECT experiment, command, manifest FROM studies").fetchall()
            self.assertEqual(studies, [("energy_drift", manifest["command"], (out / "manifest.json").read_text())])
            self.assertEqual(store.execute("SELECT name, canonical FROM scenarios").fetchall(),
                             [(name, scenario["resolved"]) for name, scenario in manifest["scenarios"].items()])
        self.assertGreaterEqual(manifest["results_version"], 4)
        self.assertEqual(manifest["runs"], 2)
        self.assertEqual(manifest["options"], {"seed": 7, "max_steps": None, "reference": False, "trajectory": "none"})
        self.assertNotIn("study_file", manifest)
        self.assertEqual(manifest["axes"]["integrator"], "rk4")
        self.assertIn("energy_drift --integrator rk4", manifest["command"])

    def test_the_allocator_uses_huge_pages(self):
        out = self.study(*SMALL)
        if "-fsanitize" in json.loads((out / "manifest.json").read_text(encoding="utf-8"))["flags"]:
            self.skipTest("skipped, because a sanitizer has an allocator of its own")
        shown = self.call("energy_drift", "--help", env={**os.environ, "MALLOC_CONF": "stats_print:true"})
        self.assertIn('opt.thp: "always"', shown.stderr)

    def test_the_store_has_the_configuration_of_each_run(self):
        out = self.study("--scenario", "lagrange_top,peters_hsu", "--integrator", "rk4,odeint_dopri5", "--dt", "1e-2", "--tolerance",
                         "1e-6", "--orientation", "quaternion,matrix", "--vary", "body.0.mass=1,2", "--no-figures")
        rows = {row["run"]: row for row in read_table(out / "runs.csv").rows}
        with contextlib.closing(sqlite3.connect(out / "results.sqlite")) as store:
            store.row_factory = sqlite3.Row
            found = store.execute("SELECT * FROM runs JOIN configurations ON key = configuration").fetchall()
            count = store.execute("SELECT count(*) FROM configurations").fetchone()[0]
        self.assertEqual((len(found), count), (16, 8))
        for run in found:
            row = rows[f"{run['id'] % 2**64:016x}"]
            self.assertEqual(run["varied"], f"body.0.mass={row['body.0.mass']}")
            for column in RUNS_START[1:]:
                value = run[column] if column in run.keys() else None
                if isinstance(value, float):
                    self.assertEqual(value, float(row[column]), column)
                else:
                    self.assertEqual(value or "", row[column], column)

    def test_the_manifest_names_the_study_file(self):
        file = self.work / "study.toml"
        file.write_text('integrator = ["rk4"]\ndt = [1e-2]\n')
        first, second = (json.loads((self.study("--study", file, "--no-figures") / "manifest.json").read_text()) for _ in range(2))
        self.assertEqual(first["study_file"]["path"], str(file))
        self.assertRegex(first["study_file"]["xxh3_64"], r"^[0-9a-f]{16}$")
        self.assertEqual(first["study_file"], second["study_file"])
        file.write_text('integrator = ["rk4"]\ndt = [1e-2] # s\n')
        changed = json.loads((self.study("--study", file, "--no-figures") / "manifest.json").read_text())
        self.assertNotEqual(changed["study_file"]["xxh3_64"], first["study_file"]["xxh3_64"])

    def test_the_files_of_a_study(self):
        out = self.study(*SMALL)
        for name in ("results.sqlite", "runs.csv", "timings.csv", "manifest.json", "report.html"):
            self.assertTrue((out / name).is_file(), name)
        self.assertTrue(list((out / "tables").iterdir()))
        html = (out / "report.html").read_text(encoding="utf-8")
        self.assertNotRegex(html, r'(?i)(src|href)\s*=\s*"(https?:)?//')
        ids = [r["run"] for r in read_table(out / "runs.csv").rows]
        self.assertEqual([r["run"] for r in read_table(out / "timings.csv").rows], ids)

    def test_a_blow_up_is_a_row_and_the_study_goes_on(self):
        rows = self.rows("--scenario", "spring_box", "--integrator", "explicit_euler,rk4", "--dt", "1e-3,0.5", "--vary",
                         "force.0.stiffness=1e4", "--no-figures")
        self.assertEqual(len(rows), 4)
        for row in rows:
            if row["dt_s"] == "0.5":
                self.assertEqual(row["status"], "diverged")
                found = re.search(r"t = ([0-9.e+-]+) s", row["message"])
                self.assertTrue(found, row["message"])
                self.assertTrue(0 < float(found[1]) <= 10, row["message"])
            elif row["integrator"] == "rk4":
                self.assertEqual(row["status"], "ok")
            for cell in row.values():
                self.assertNotRegex(cell, r"(?i)^[-+]?(nan|inf)")

    def test_a_run_that_overflows_at_once_is_a_row(self):
        rows = self.rows("--scenario", "oscillator", "--integrator", "explicit_euler,rk4,semi_implicit_euler",
                         "--dt", "1", "--vary", "force.0.stiffness=1,1e300", "--t-end", "5", "--no-figures")
        self.assertEqual(len(rows), 6)
        for row in rows:
            self.assertIn(row["status"], ("ok", "diverged", "failed"))
            self.assertEqual(row["message"] == "", row["status"] == "ok")
            for cell in row.values():
                self.assertNotRegex(cell, r"(?i)^[-+]?(nan|inf)")

    def test_a_run_that_fails_is_a_row_and_the_study_goes_on(self):
        rows = self.rows("--scenario", "oscillator", "--integrator", "cvode_bdf", "--tolerance", "1e-4", "--t-end", "5",
                         "--vary", "force.0.stiffness=1,1e300", "--no-figures", status=3)
        self.assertEqual([r["status"] for r in rows], ["ok", "failed"])
        self.assertRegex(rows[1]["message"], r"CVODE .* at t = \S+ s")

    def test_memory_does_not_grow_with_the_length_of_a_run(self):
        def peak(t_end):
            return peak_memory("energy_drift", "--integrator", "rk4", "--dt", "1e-3", "--t-end", t_end, "--jobs", "1",
                               "--no-figures", "--out", self.new_out())

        # 8 bytes kept of each of the 4e6 steps would still show.
        short = peak(10)
        for t_end in (1000, 4000):
            self.assertLess(peak(t_end), 1.2 * short, f"kB, for {t_end} s; {short} kB for 10 s")


class Physics(StudyTest):
    DRIFT = 0.0325276  # drift of the angular momentum without the gyroscopic term, at every step

    def test_energy_alone_would_call_a_missing_gyroscopic_term_perfect(self):
        out = self.study("--gyroscopic", "off", "--integrator", "rk4,semi_implicit_euler", "--dt",
                         "1e-2,5e-3,2e-3,1e-3,5e-4", "--vary", "gravity=[0,0,0]", "--no-figures")
        rows = read_table(out / "runs.csv").rows
        self.assertEqual(len(rows), 10)
        for row in rows:
            self.assertLess(float(row["energy_drift_max_rel"]), 1e-12)
            self.assertAlmostEqual(float(row["angular_momentum_drift_max_rel"]), self.DRIFT, delta=1e-5)
        html = re.sub(r"<[^>]*>", "", (out / "report.html").read_text(encoding="utf-8"))
        self.assertRegex(re.sub(r"\s+", " ", html), r"(?i)energy alone")

    def test_with_the_gyroscopic_term_the_report_does_not_say_so(self):
        out = self.study(*SMALL)
        self.assertNotRegex((out / "report.html").read_text(encoding="utf-8"), r"(?i)would call (it|them) perfect")

    def test_rotational_energy_and_momentum_without_the_term_along_the_trajectory(self):
        for method in ("rk4", "semi_implicit_euler"):
            out = self.simulate("--gyroscopic", "off", "--integrator", method, "--dt", "1e-2")
            rows = [{k: float(v) for k, v in r.items()} for r in read_table(out / "trajectory.csv").rows]
            self.assertEqual(len(rows), 1001)
            spin = [[r[f"w{c}_rad_per_s"] for c in "xyz"] for r in rows]
            momentum = [[r[f"l{c}_kg_m2_per_s"] for c in "xyz"] for r in rows]
            energy = [sum(a * b for a, b in zip(w, l)) / 2 for w, l in zip(spin, momentum)]
            self.assertLess(max(abs(e / energy[0] - 1) for e in energy), 1e-12)
            drift = max(norm([a - b for a, b in zip(l, momentum[0])]) for l in momentum) / norm(momentum[0])
            self.assertAlmostEqual(drift, self.DRIFT, delta=1e-5)
            measured = float(read_table(out / "runs.csv").rows[0]["angular_momentum_drift_max_rel"])
            self.assertAlmostEqual(drift, measured, delta=1e-12)

    def test_peters_and_hsu_s_row_of_ode(self):
        """Semi-implicit Euler on the world velocity, normalized, is their ODE: energy, momentum and position."""
        published = {1e-4: (0.00124711, 0.0012715, 0.0049), 1e-3: (0.012462, 0.0130708, 0.049)}
        rows = self.rows("--integrator", "semi_implicit_euler", "--angular-state", "velocity_world", "--normalize", "step",
                         "--dt", "1e-3,1e-4", "--no-figures")
        for row in rows:
            energy, momentum, position = published[float(row["dt_s"])]
            self.assertAlmostEqual(float(row["energy_drift_max_rel"]) / energy, 1, delta=1e-4)
            self.assertAlmostEqual(float(row["angular_momentum_drift_max_rel"]) / momentum, 1, delta=1e-4)
            self.assertAlmostEqual(float(row["position_error_max_m"]) / position, 1, delta=1e-6)
            self.assertAlmostEqual(float(row["position_error_max_m"]), 0.5 * 9.8 * float(row["dt_s"]) * 10, delta=1e-8)
            self.assertEqual(float(row["energy_initial_J"]), 368.546416625)

    def test_the_oscillator_s_closed_forms(self):
        h, steps = 0.1, 100
        rows = self.rows("--scenario", "oscillator", "--integrator", "explicit_euler", "--dt", h, "--t-end", h * steps,
                         "--no-figures")
        self.assertAlmostEqual(float(rows[0]["energy_drift_final_rel"]) / ((1 + h * h) ** steps - 1), 1, delta=1e-10)


class Simulate(StudyTest):
    def columns(self, path):
        table = read_table(path)
        return table.header, [[float(x) for x in r.values()] for r in table.rows]

    def test_the_files_and_their_columns(self):
        out = self.simulate("--dt", "1e-2", "--t-end", "1")
        for name, expected in (("trajectory", TRAJECTORY), ("energy", ENERGY), ("events", EVENTS)):
            header, rows = self.columns(out / f"{name}.csv")
            self.assertEqual(header, expected)
            self.assertEqual(len(rows), 0 if name == "events" else 101)
            for row in rows:
                self.assertTrue(all(math.isfinite(x) for x in row))
        text = (out / "trajectory.csv").read_text()
        for cell in text.splitlines()[57].split(","):
            self.assertEqual(float(cell), float(repr(float(cell))))
            self.assertLessEqual(len(cell), 24)  # the shortest text that reads back exactly
        _, rows = self.columns(out / "trajectory.csv")
        self.assertEqual(rows[0][:15], [0, 0, 0, 0, 0, 1, 0, 0, 0, -2, 2, 8, 0.1, 5, 0.1])
        for got, exact in zip(rows[0][15:18], (0.80833333 * 0.1, 0.68333333 * 5, 0.14166667 * 0.1)):
            self.assertAlmostEqual(got, exact, delta=1e-15)
        self.assertEqual(rows[0][18], 368.546416625)

    def test_the_matrix_chart_has_the_matrix(self):
        out = self.simulate("--dt", "1e-2", "--t-end", "1", "--orientation", "matrix")
        header, rows = self.columns(out / "trajectory.csv")
        self.assertEqual(header, TRAJECTORY + MATRIX)
        self.assertEqual(rows[0][19:], [1, 0, 0, 0, 1, 0, 0, 0, 1])
        w, x, y, z = rows[-1][5:9]
        of_quaternion = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                         2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                         2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
        for a, b in zip(rows[-1][19:], of_quaternion):
            self.assertAlmostEqual(a, b, delta=1e-6)

    def test_static_bodies_are_left_out(self):
        still = ('[[body]]\nname = "ground"\nstatic = true\nmass = 1.0\ninertia = [1.0, 1.0, 1.0]\n'
                 'position = [9.0, 9.0, 9.0]\n')
        path = self.write("with_ground.toml", "t_end = 1.0\n" + still + BODY + "position = [1.0, 0.0, 0.0]\n" +
                          BODY.replace('"a"', '"b"') + "position = [2.0, 0.0, 0.0]\n")
        out = self.simulate("--scenario", path, "--dt", "0.1", "--t-end", "1")
        _, rows = self.columns(out / "trajectory.csv")
        self.assertEqual(len(rows), 22)
        self.assertEqual({(r[1], r[2]) for r in rows}, {(0, 1), (1, 2)})

    def test_samples_are_exactly_where_they_were_asked_for(self):
        for method in ("rk4", "semi_implicit_euler", "cvode_adams", "cvode_bdf", "odeint_dopri5"):
            for scenario, bodies in (("peters_hsu", 1), ("two_bodies", 2)):
                for t_end in (10.0, 0.7):
                    with self.subTest(f"{method}, {scenario}, {t_end} s"):
                        step = ["--tolerance", "1e-8"] if method.startswith(("cvode", "odeint")) else ["--dt", "1e-2"]
                        out = self.simulate("--scenario", scenario, "--integrator", method, *step, "--t-end", t_end,
                                            "--samples", "10")
                        _, rows = self.columns(out / "trajectory.csv")
                        exact = [k * t_end / 10 for k in range(11) for _ in range(bodies)]
                        times = [r[0] for r in rows]
                        if t_end == 10 or method.startswith(("cvode", "odeint")):
                            self.assertEqual(times, exact)
                        else:  # the time of a fixed step is a whole number of steps, which may round otherwise
                            self.assertEqual(len(times), len(exact))
                            self.assertLess(max(abs(a - b) for a, b in zip(times, exact)), 4 * math.ulp(t_end))
                        self.assertEqual([r[1] for r in rows], list(range(bodies)) * 11)
                        self.assertEqual([r[0] for r in self.columns(out / "energy.csv")[1]], times[::bodies])

    def test_samples_change_nothing_of_a_fixed_step_run(self):
        every = self.columns(self.simulate("--dt", "1e-2") / "trajectory.csv")[1]
        some = self.columns(self.simulate("--dt", "1e-2", "--samples", "10") / "trajectory.csv")[1]
        self.assertEqual([r[1:] for r in every[::100]], [r[1:] for r in some])

    def test_the_energy_ledger_agrees_with_the_table_of_runs(self):
        for arguments in (["--dt", "1e-2"], ["--dt", "1e-2", "--integrator", "semi_implicit_euler", "--normalize", "step"],
                          ["--scenario", "five_cubes", "--dt", "1e-2", "--integrator", "explicit_euler"],
                          ["--scenario", "spring_box", "--dt", "1e-2", "--orientation", "matrix", "--normalize", "step"],
                          ["--integrator", "odeint_dopri5", "--tolerance", "1e-5"]):
            with self.subTest(" ".join(arguments)):
                out = self.simulate(*arguments)
                _, rows = self.columns(out / "energy.csv")
                run = read_table(out / "runs.csv").rows[0]
                start = float(run["energy_initial_J"])
                scale = float(run["energy_scale_J"])
                for t, kinetic, potential, work, impact, friction, penetration, projection, drift in rows:
                    ledger = kinetic + potential - work + impact + friction - penetration - projection - start
                    self.assertAlmostEqual(ledger, drift, delta=1e-12 * max(kinetic, abs(potential), scale))
                largest = max(abs(r[8]) for r in rows)
                self.assertAlmostEqual(largest, float(run["energy_drift_max_J"]), delta=1e-14 * scale)
                self.assertAlmostEqual(largest, float(run["energy_drift_max_rel"]) * scale, delta=1e-14 * scale)
                self.assertAlmostEqual(rows[-1][8], float(run["energy_drift_final_rel"]) * scale, delta=1e-14 * scale)
                energies = {r[0]: r[18] for r in self.columns(out / "trajectory.csv")[1]}
                for r in rows:
                    self.assertAlmostEqual(energies[r[0]], r[1] + r[2], delta=1e-12 * max(r[1], abs(r[2]), scale))

    def test_hdf5(self):
        out = self.simulate("--dt", "1e-2", "--t-end", "1", "--trajectory", "hdf5")
        self.assertEqual((out / "trajectory.h5").read_bytes()[:8], b"\x89HDF\r\n\x1a\n")
        self.assertGreater((out / "trajectory.h5").stat().st_size, 101 * (19 + 9) * 8)
        self.assertFalse((out / "trajectory.csv").exists())

    def test_hdf5_is_the_same_bytes_in_another_second(self):
        """Its file format has dates, of whole seconds."""
        options = ["--dt", "1e-2", "--t-end", "1", "--trajectory", "hdf5"]
        one = self.simulate(*options)
        made = (one / "trajectory.h5").stat().st_mtime
        time.sleep(max(0.0, made + 1.1 - time.time()))
        self.assertEqual((one / "trajectory.h5").read_bytes(), (self.simulate(*options) / "trajectory.h5").read_bytes())

    def test_a_study_s_trajectories_are_those_of_simulate(self):
        out = self.study("--integrator", "rk4", "--dt", "1e-2,2e-2", "--trajectory", "csv", "--no-figures")
        alone = self.simulate("--dt", "2e-2")
        for row in read_table(out / "runs.csv").rows:
            folder = out / "trajectories" / row["run"]
            for name in ("trajectory.csv", "energy.csv", "events.csv"):
                self.assertTrue((folder / name).is_file(), f"{folder.name}/{name}")
            if row["dt_s"] == "0.02":
                self.assertEqual((folder / "trajectory.csv").read_bytes(), (alone / "trajectory.csv").read_bytes())

    def test_a_step_that_does_not_divide_the_duration_ends_there(self):
        _, rows = self.columns(self.simulate("--dt", "3e-2", "--t-end", "1") / "trajectory.csv")
        self.assertEqual(len(rows), 35)
        self.assertEqual(rows[-1][0], 1.0)


class Asking(StudyTest):
    def test_lists(self):
        everything = self.call("energy_drift", "--list").stdout
        for word, known in (("integrators", "rk4"), ("scenarios", "peters_hsu"), ("forces", "spring"), ("joints", "hinge"), ("shapes", "box"),
                            ("broad-phases", ""), ("narrow-phases", ""), ("responses", ""),
                            ("metrics", "orientation_defect_max"), ("invariants", "p_phi")):
            done = self.call("energy_drift", "--list", word)
            self.assertEqual(done.stderr, "")
            self.assertIn(known, done.stdout)
            self.assertIn(known, everything)
            self.assertTrue(done.stdout.strip(), word)
        self.assertEqual(files_in(self.folder), {})

    def test_help(self):
        for program in ("energy_drift", "simulate"):
            done = self.call(program, "--help")
            for option in ("--scenario", "--integrator", "--dt", "--tolerance", "--vary", "--study", "--out", "--force",
                           "--jobs", "--trajectory", "--no-figures", "--dry-run", "--list"):
                self.assertIn(option, done.stdout)
            self.assertEqual(done.stderr, "")

    def test_a_dry_run_writes_nothing(self):
        out = self.new_out()
        done = self.call("energy_drift", *MANY, "--dry-run", "--out", out)
        self.assertIn("240 runs", done.stdout)
        self.call("energy_drift", *MANY, "--dry-run")
        self.assertEqual(list(self.folder.iterdir()), [self.work])
        self.assertEqual(list(self.work.iterdir()), [])

    def test_a_dry_run_knows_how_fast_gnuplot_starts(self):
        def after_the_runs(gnuplot):
            path = self.folder / "path"
            path.mkdir(exist_ok=True)
            if gnuplot:
                (path / "gnuplot").write_text(gnuplot, encoding="utf-8")
                (path / "gnuplot").chmod(0o755)
            said = self.call("energy_drift", "--integrator", "rk4", "--dt", "1e-2,5e-3", "--dry-run",
                             env={**os.environ, "PATH": str(path)}).stdout
            return float(re.search(r"of which ([\d.]+) s after the runs", said)[1])

        without = after_the_runs(None)
        self.assertGreater(after_the_runs("#!/bin/sh\n/bin/sleep 0.3\n"), 5 * without)

    def test_the_default_folder_names_the_study(self):
        done = self.call("energy_drift", *SMALL)
        folders = list((self.work / "results").iterdir())
        self.assertEqual(len(folders), 1)
        self.assertRegex(folders[0].name, r"^energy_drift-peters_hsu-[0-9a-f]{8}$")
        self.assertIn(folders[0].name, done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
