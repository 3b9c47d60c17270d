# SPDX-License-Identifier: BSD-3-Clause
"""results, rerun and explain on the folders of studies, as a user calls them."""
import contextlib
import csv
import io
import random
import re
import shutil
import sqlite3
import unittest

from programs import call, read, temporary_folder

TOP = ["--scenario", "peters_hsu,lagrange_top", "--integrator", "rk4,heun,dmv,cvode_adams", "--dt", "0.02,0.01,0.005", "--tolerance",
       "1e-6", "--t-end", "1", "--no-figures"]  # 20 runs
LANES = ["--scenario", "dzhanibekov", "--integrator", "rk4", "--dt", "0.01", "--t-end", "1", "--vary", "body.0.angular_velocity.1=1:5:12",
         "--curves", "3", "--no-figures"]


def change(folder, sql):
    with sqlite3.connect(folder / "results.sqlite") as db:
        db.executescript(sql)
    db.close()


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        call("energy_drift", *TOP, "--out", "results/top", folder=cls.folder)
        call("energy_drift", *LANES, "--out", "results/lanes", folder=cls.folder)
        cls.top = [row for row in read(cls.folder / "results/top/runs.csv") if row["status"] != "refused"]

    def copy(self, name, study="top"):
        folder = self.folder / name
        shutil.copytree(self.folder / "results" / study, folder)
        self.addCleanup(shutil.rmtree, folder)
        return folder

    def number(self, folder, run):
        """The number of the rows of a run."""
        with contextlib.closing(sqlite3.connect(folder / "results.sqlite")) as db:
            return db.execute("SELECT number FROM runs WHERE printf('%016x', id) = ?", (run,)).fetchone()[0]

    def said(self, *arguments, program="results", status=0):
        done = call(program, *arguments, folder=self.folder, status=status)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def rows(self, *arguments):
        return list(csv.DictReader(io.StringIO(self.said(*arguments, "--format", "csv"))))

    def refused(self, *arguments, program="results", status=2):
        done = call(program, *arguments, folder=self.folder, status=status)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
        return done.stderr

    # Listing.

    def test_csv_of_all_runs_is_runs_csv(self):
        for study in ("top", "lanes"):
            lines = (self.folder / "results" / study / "runs.csv").read_text().splitlines(keepends=True)
            self.assertEqual(self.said(f"results/{study}", "--format", "csv"), "".join(x for x in lines if ",refused," not in x))
        self.said("results/top", "--format", "csv", "--out", "all.csv")
        self.assertEqual((self.folder / "all.csv").read_text(), self.said("results/top", "--format", "csv"))
        self.assertFalse((self.folder / "all.csv.new").exists())

    def test_csv_of_all_runs_has_the_options_on_demand_that_the_study_gives(self):
        joints = ["--scenario", "peters_hsu,double_pendulum", "--integrator", "rk4", "--dt", "0.01,0.02"]
        top = ["--scenario", "lagrange_top", "--integrator", "rk4,arkode_erk", "--dt", "0.02", "--tolerance", "1e-6"]
        cells = self.folder / "cells.csv"
        cells.write_text("integrator,summation\nrk4,plain\nheun,plain\n", encoding="utf-8")
        for k, (study, given) in enumerate((
                (joints, []), ([*joints, "--stabilization", "none"], ["stabilization"]),
                ([*joints, "--stabilization", "none,both"], ["stabilization"]),
                ([*joints, "--stabilization", "both", "--projection-metric", "mass"], ["projection_metric", "stabilization"]),
                ([*joints, "--zip", "stabilization=none,baumgarte baumgarte-alpha=10,5"], ["baumgarte_alpha_per_s", "stabilization"]),
                (top, []), ([*top, "--order", "4"], ["order"]), ([*top, "--summation", "plain"], ["summation"]),
                (["--scenario", "lagrange_top", "--dt", "0.02", "--cells", cells], ["summation"]))):
            with self.subTest(study):
                out = self.folder / f"on_demand_{k}"
                call("energy_drift", *study, "--t-end", "0.1", "--no-figures", "--out", out, folder=self.folder)
                runs = (out / "runs.csv").read_text()
                self.assertEqual(self.said(out.name, "--format", "csv"), runs)
                names = ("stabilization", "projection_metric", "baumgarte_alpha_per_s", "order", "summation")
                self.assertEqual(sorted(set(runs.splitlines()[0].split(",")) & set(names)), given)

    def test_csv_of_a_study_that_has_not_ended_has_the_options_of_which_a_run_has_an_unusual_value(self):
        call("energy_drift", "--scenario", "double_pendulum", "--integrator", "rk4", "--dt", "0.01", "--t-end", "0.1",
             "--stabilization", "none,both", "--out", "halves", "--shard", "1/1", folder=self.folder)
        self.addCleanup(shutil.rmtree, self.folder / "halves")
        columns = self.rows("halves")[0]
        self.assertIn("stabilization", columns)
        self.assertNotIn("projection_metric", columns)

    def test_the_summary(self):
        text = self.said("results")
        self.assertIn("results/lanes: 12 runs\n  energy_drift: ./run energy_drift --scenario dzhanibekov", text)
        self.assertIn(f"results/top: {len(self.top)} runs\n", text)
        self.assertIn("  scenarios: dzhanibekov (12)\n  methods: rk4 (12)\n  status: ok (12)\n", text)
        self.assertIn("cvode_adams (2)", text)
        self.assertNotIn("damaged", text)
        self.assertEqual(self.said("results/lanes", "results/top"), text)

    def test_conditions_on_options_metrics_and_scenario_keys(self):
        def ids(*arguments):
            return {row["run"] for row in self.rows(*arguments, "--columns", "run")}

        def wanted(test):
            return {row["run"] for row in self.top if test(row)}

        self.assertEqual(ids("results/top", "--where", "integrator == 'rk4' and dt < 0.01"),
                         wanted(lambda r: r["integrator"] == "rk4" and r["dt_s"] == "0.005"))
        self.assertEqual(ids("results/top", "--where", "given(dt_s) and attitude_error_max_rad < 1e-4"),
                         wanted(lambda r: r["dt_s"] and r["attitude_error_max_rad"] and float(r["attitude_error_max_rad"]) < 1e-4))
        self.assertEqual(ids("results/top", "--where", "not (integrator == 'rk4')", "--where", "evaluations > 150"),
                         wanted(lambda r: r["integrator"] != "rk4" and int(r["rhs_evaluations"]) > 150))
        varied = {row["run"]: float(row["body.0.angular_velocity.1"]) for row in read(self.folder / "results/lanes/runs.csv")}
        self.assertEqual(ids("results/lanes", "--where", "body.0.angular_velocity.1 >= 3"), {r for r, x in varied.items() if x >= 3})
        # A key that no run varies has the value of the scenario.
        mass = self.rows("results/lanes", "--columns", "body.0.mass,body.0.angular_velocity")
        self.assertEqual(len({row["body.0.mass"] for row in mass}), 1)
        self.assertNotEqual(mass[0]["body.0.mass"], "")
        self.assertEqual(len({row["body.0.angular_velocity"] for row in mass}), 12, "its part 1 is varied")
        self.assertEqual(ids("results", "--where", "folder == 'results/top'"), {row["run"] for row in self.top})
        self.assertEqual(ids("results/top", "--where", "status == 'failed'"), set())

    def test_sorting_and_limits(self):
        drifts = [float(r["energy_drift_max_rel"]) for r in self.rows("results/top", "--sort", "-energy_drift_max_rel")]
        self.assertEqual(drifts, sorted((float(r["energy_drift_max_rel"]) for r in self.top), reverse=True))
        steps = [(r["integrator"], r["dt_s"]) for r in self.rows("results/top", "--sort", "dt,integrator", "--limit", "3")]
        self.assertEqual([dt for _, dt in steps], ["0.005"] * 3)
        last = self.rows("results/top", "--sort", "-dt")[-1]
        self.assertEqual(last["dt_s"], "", "runs without a value come last")
        text = self.said("results/top", "--limit", "2")
        self.assertEqual(text.count("\n"), 4)
        self.assertIn("\n2 runs\n", text)

    def test_groups(self):
        groups = self.rows("results/top", "--group", "scenario,integrator", "--show", "count,median:rhs_evaluations,max:dt,mean:dt")
        self.assertEqual([(g["scenario"], g["integrator"]) for g in groups],
                         sorted((g["scenario"], g["integrator"]) for g in groups))
        mine = next(g for g in groups if (g["scenario"], g["integrator"]) == ("peters_hsu", "rk4"))
        work = sorted(int(r["rhs_evaluations"]) for r in self.top if (r["scenario"], r["integrator"]) == ("peters_hsu", "rk4"))
        self.assertEqual((mine["count"], float(mine["median:rhs_evaluations"]), mine["max:dt"]), ("3", work[1], "0.02"))
        self.assertAlmostEqual(float(mine["mean:dt"]), 0.035 / 3, places=15)
        order = self.rows("results/top", "--group", "integrator", "--show", "min:evaluations", "--sort", "-min:evaluations")
        self.assertEqual([float(g["min:evaluations"]) for g in order], sorted((float(g["min:evaluations"]) for g in order), reverse=True))

    def test_markdown_and_latex(self):
        text = self.said("results/top", "--format", "markdown", "--columns", "integrator,dt,energy_drift_max_rel", "--limit", "2")
        self.assertEqual(text.count("\n"), 4)
        self.assertIn("| integrator | dt\\_s | energy\\_drift\\_max\\_rel |\n| --- | ---: | ---: |\n", text)
        self.assertIn("\\begin{tabular}", self.said("results/top", "--format", "latex", "--limit", "2"))

    def test_wrong_names_are_answered_by_what_was_meant(self):
        for arguments, said in ((["--columns", "atitude_error_max_rad"], "--columns: there is no column 'atitude_error_max_rad'; did you "
                                 "mean 'attitude_error_max_rad'?"),
                                (["--where", "integratr == 'rk4'"], "--where: integratr: there is no column 'integratr'; did you mean 'integrator'?"),
                                (["--sort", "-stepps"], "did you mean 'steps'?"),
                                (["--where", "dt < 'a'"], "it compares the number"),
                                (["--where", "dt <"], "the condition ends too early"),
                                (["--group", "scenario", "--show", "medium:steps"], "there is no 'medium'; did you mean 'median'?"),
                                (["--group", "scenario", "--show", "mean:status"], "the column holds texts"),
                                (["--show", "count"], "name their columns with --group"),
                                (["--limit", "0"], "0 rows"),
                                (["--colums", "run"], "did you mean '--columns'?")):
            with self.subTest(arguments):
                self.assertIn(said, self.refused("results/top", *arguments))
        (self.folder / "nothing").mkdir(exist_ok=True)
        self.assertIn("has no results", self.refused("nothing"))
        self.assertIn("no such folder", self.refused("nowhere"))
        self.assertIn("is not a folder", self.refused("results/top/runs.csv"))
        self.assertIn("body.0.mass", self.said("results/lanes", "--columns", "body.0.mass", "--limit", "1"))
        self.assertIn("attitude_error_max_rad\n", self.said("results/lanes", "--list"))

    def test_numbers_below_zero_and_too_large_are_refused(self):
        for program, arguments in (("results", ["results/top", "--limit"]), ("rerun", ["results/top", "--random"]),
                                   ("rerun", ["results/top", "--random", "1", "--seed"])):
            for number in ("-1", "99999999999999999999"):
                with self.subTest(program, number=number):
                    line = self.refused(*arguments, number, program=program)
                    self.assertIn(f"{arguments[-1]}: {number} is not a whole number from 0 to", line)

    def test_empty_values_are_refused(self):
        for option in ("--sort", "--group", "--columns", "--show", "--out"):
            self.assertIn(f"{option}: the value is empty", self.refused("results/top", option, ""))
        for option in ("--by", "--at-most"):
            self.assertIn(f"{option}: the value is empty", self.refused("best", "results/top", option, ""))

    def test_damaged_runs_are_said_and_never_shown(self):
        folder = self.copy("damaged")
        victim, other = self.top[0]["run"], self.top[1]["run"]
        change(folder, f"UPDATE runs SET steps = steps + 1 WHERE printf('%016x', id) = '{victim}';"
                       f"UPDATE timings SET wall_s = 0.5 WHERE number = (SELECT number FROM runs WHERE printf('%016x', id) = '{other}')")
        done = call("results", "damaged", "--format", "csv", folder=self.folder, status=1)
        self.assertEqual([r["run"] for r in csv.DictReader(io.StringIO(done.stdout))], [r["run"] for r in self.top[2:]])
        self.assertRegex(done.stderr, r"results: 2 runs are damaged and left out \(the first: run " + victim + r" of \S+: runs.checksum\)")
        text = call("results", "damaged", folder=self.folder, status=1).stdout
        self.assertIn(f"damaged: {len(self.top) - 2} runs", text)
        self.assertIn("  damaged: 2 runs (the first: run ", text)
        groups = call("results", "damaged", "--group", "folder", "--format", "csv", folder=self.folder, status=1).stdout
        self.assertIn(f"damaged,{len(self.top) - 2}\n", groups)
        self.assertIn("not repeated: it is damaged (runs.checksum)", self.refused(victim, "damaged", program="rerun", status=3))
        self.assertIn("it is damaged (runs.checksum)", self.refused(victim, "damaged", program="explain", status=3))
        change(folder, "UPDATE configurations SET dt_s = 7 WHERE dt_s = 0.02")
        done = call("results", "damaged", "--format", "csv", "--columns", "run,dt", folder=self.folder, status=1)
        self.assertNotIn("0.02", done.stdout)
        self.assertNotIn(",7\n", done.stdout)
        self.assertIn("runs.configuration", done.stderr)

    def test_a_row_without_an_id_is_one_damaged_run(self):
        folder = self.copy("nameless")
        nameless = [self.number(folder, row["run"]) for row in self.top[:2]]
        change(folder, f"UPDATE runs SET id = 'abc' WHERE number = {nameless[0]}; UPDATE runs SET id = 1.5 WHERE number = {nameless[1]}")
        done = call("results", "nameless", "--format", "csv", folder=self.folder, status=1)
        self.assertEqual([r["run"] for r in csv.DictReader(io.StringIO(done.stdout))], [r["run"] for r in self.top[2:]])
        self.assertRegex(done.stderr, r"results: 2 runs are damaged and left out \(the first: row \d+ of \S+: runs.id\)")
        text = call("results", "nameless", folder=self.folder, status=1).stdout
        self.assertRegex(text, rf"  damaged: 2 runs \(the first: row {min(nameless)} of \S+: runs.id\)")
        done = call("rerun", "--all", "nameless", folder=self.folder, status=3)
        for number in nameless:
            self.assertRegex(done.stderr, rf"rerun: row {number} of \S+: not repeated: it is damaged \(runs.id\)")
        sound = len(self.top) - 2
        self.assertIn(f"{sound} of {len(self.top)} runs repeated: {sound} the same, 0 different, 2 not repeated", done.stdout)

    def test_many_runs_are_read_in_parts(self):
        # More runs than several threads read at a time, each in the store of a shard and in that of the study.
        study = ["energy_drift", "--scenario", "dzhanibekov", "--integrator", "rk4", "--dt", "0.01", "--t-end", "0.01", "--no-figures",
                 "--vary", "body.0.angular_velocity.1=1:5:24001", "--out", "many"]
        for shard in ("1/2", "2/2"):
            call(*study, "--shard", shard, folder=self.folder)
        call(*study, "--merge", folder=self.folder)
        runs = (self.folder / "many/runs.csv").read_text(encoding="utf-8")
        lines = runs.splitlines()
        first = lines[1].split(",")[0]
        for shard in (self.folder / "many/shards").iterdir():  # the other runs stand there at odd places and twice
            change(shard, f"DELETE FROM runs WHERE printf('%016x', id) = '{first}'")
        self.assertEqual(self.said("many", "--format", "csv", "--columns", "all"), runs)
        column = lines[0].split(",").index("body.0.angular_velocity.1")
        chosen = [line for line in lines[1:] if float(line.split(",")[column]) > 4.3]
        self.assertEqual(self.said("many", "--format", "csv", "--where", "body.0.angular_velocity.1 > 4.3").splitlines()[1:], chosen)
        self.assertEqual(self.said("many", "--format", "csv", "--limit", "17001").splitlines(), lines[:17002])
        shutil.rmtree(self.folder / "many/shards")
        self.assertEqual(self.said("many", "--format", "csv"), runs)
        victims = [lines[k].split(",")[0] for k in (9000, 20000)]  # in this order in runs.csv
        for victim in victims:
            change(self.folder / "many", f"UPDATE runs SET steps = steps + 1 WHERE printf('%016x', id) = '{victim}'")
        done = call("results", "many", "--format", "csv", folder=self.folder, status=1)
        self.assertEqual(done.stdout.splitlines(), [line for line in lines if line.split(",")[0] not in victims])
        self.assertRegex(done.stderr, rf"results: 2 runs are damaged and left out \(the first: run {victims[0]} of \S+: runs.checksum\)")

    def test_shards_belong_to_their_study(self):
        study = ["energy_drift", *LANES, "--out", "sharded"]
        for k in (1, 2, 3):
            call(*study, "--shard", f"{k}/3", folder=self.folder)
        whole = self.said("results/lanes", "--format", "csv")
        self.assertEqual(self.said("sharded", "--format", "csv"), whole)
        self.assertIn("sharded: 12 runs in 3 stores\n  no study has ended here yet\n", self.said("sharded"))
        self.assertIn("12 runs repeated: 12 the same", self.said("--all", "sharded", program="rerun").replace("12 of 12", "12"))
        call(*study, "--merge", folder=self.folder)
        self.assertEqual(self.said("sharded", "--format", "csv"), whole, "each run once, although it stands in two stores")
        self.assertIn("sharded: 12 runs in 4 stores\n", self.said("sharded"))
        victim = read(self.folder / "results/lanes/runs.csv")[3]["run"]
        change(self.folder / "sharded", f"UPDATE runs SET steps = 1 WHERE printf('%016x', id) = '{victim}'")
        self.assertEqual(self.said("sharded", "--format", "csv"), whole, "the run of the shard stands in for the damaged one")
        self.assertNotIn("damaged", self.said("sharded"))

    def test_stores_without_runs_and_of_another_version(self):
        folder = self.copy("other")
        change(folder, "PRAGMA user_version = 1")
        for program, arguments in (("results", []), ("rerun", ["--all"]), ("explain", ["00"])):
            line = self.refused(*arguments, "other", program=program)
            self.assertIn("the store has schema version 1, and this program reads version 2; use the version of polhode that made it, or", line)
        torn = self.copy("torn")
        change(torn, "DROP TABLE scenarios")
        for program, arguments in (("results", []), ("rerun", ["--all"]), ("explain", ["00"])):
            line = self.refused(*arguments, "torn", program=program)
            self.assertRegex(line, "its table scenarios is missing, .*; the command of its study makes it anew with --force")
        (self.folder / "begun").mkdir()
        self.addCleanup(shutil.rmtree, self.folder / "begun")
        sqlite3.connect(self.folder / "begun/results.sqlite").close()
        done = call("results", "begun", "--format", "csv", folder=self.folder)
        self.assertIn("begun/results.sqlite: is empty, because its study was stopped before the first run", done.stderr)
        change(folder, "PRAGMA user_version = 2; DELETE FROM runs; DELETE FROM timings; DELETE FROM curves")
        self.assertIn("other: 0 runs\n", self.said("other"))
        self.assertEqual(self.said("other", "--format", "csv").count("\n"), 1)
        self.assertEqual(self.said("other", "--limit", "3").splitlines()[-1], "0 runs")
        self.assertIn("no run 00… in other", self.refused("00", "other", program="rerun"))

    # best.

    def test_best_answers_work_against_precision(self):
        rows = self.rows("best", "results/top", "--at-most", "evaluations=900")
        for scenario in ("peters_hsu", "lagrange_top"):
            mine = [r for r in rows if r["scenario"] == scenario]
            self.assertEqual([r["place"] for r in mine], [str(k + 1) for k in range(len(mine))])
            least = {}
            for r in self.top:
                if r["scenario"] == scenario and r["attitude_error_max_rad"] and int(r["rhs_evaluations"]) <= 900:
                    error = float(r["attitude_error_max_rad"])
                    least[r["integrator"]] = min(error, least.get(r["integrator"], error))
            self.assertEqual({r["integrator"]: float(r["attitude_error_max_rad"]) for r in mine}, least)
            self.assertEqual(mine[0]["integrator"], min(least, key=least.get))
        cheap = self.rows("best", "results/top", "--by", "evaluations", "--at-most", "attitude_error_max_rad=1e-5", "--limit", "1",
                          "--where", "scenario == 'peters_hsu' and integrator != 'dmv'")
        wanted = min(int(r["rhs_evaluations"]) for r in self.top if r["scenario"] == "peters_hsu" and r["integrator"] != "dmv"
                     and float(r["attitude_error_max_rad"]) <= 1e-5)
        self.assertEqual([int(float(r["rhs_evaluations"])) for r in cheap], [wanted])

    def test_best_without_a_bound_prints_pareto_fronts(self):
        rows = self.rows("best", "results/top", "--where", "scenario == 'peters_hsu'")
        for method in {r["integrator"] for r in rows}:
            front = [(float(r["rhs_evaluations"]), float(r["attitude_error_max_rad"])) for r in rows if r["integrator"] == method]
            self.assertEqual(front, sorted(front))
            self.assertEqual([e for _, e in front], sorted((e for _, e in front), reverse=True))
        self.assertIn("yes", {r["best of all"] for r in rows})
        self.assertIn("a column and a number", self.refused("best", "results/top", "--at-most", "evaluations"))
        self.assertIn("belong to best", self.refused("results/top", "--by", "steps"))

    def different_scenarios_of_one_name(self):
        """The folders a and b with a scenario "my" each, and c with that of a; the inertia of each."""
        inertia = {"a": "[1.0, 2.0, 3.0]", "b": "[1.0, 1.0, 1.0]", "c": "[1.0, 2.0, 3.0]"}
        for name, moments in inertia.items():
            file = self.folder / f"of_{name}/my.toml"
            file.parent.mkdir()
            self.addCleanup(shutil.rmtree, file.parent)
            file.write_text(f't_end = 1.0\n[[body]]\nname = "top"\nmass = 1.0\ninertia = {moments}\n'
                            "angular_velocity = [0.3, 3.0, 0.3]\n", encoding="utf-8")
            call("energy_drift", "--scenario", file, "--integrator", "rk4,heun" if name == "c" else "rk4", "--dt", "0.01,0.02", "--t-end",
                 "1", "--no-figures", "--out", name, folder=self.folder)
            self.addCleanup(shutil.rmtree, self.folder / name)

    def test_different_scenarios_of_one_name_are_told_apart(self):
        self.different_scenarios_of_one_name()
        of_folder = {name: {row["run"] for row in read(self.folder / name / "runs.csv")} for name in "abc"}
        for arguments in ([], ["--at-most", "evaluations=1e9"], ["--at-most", "energy_drift_max_rel=1"]):
            rows = self.rows("best", "a", "b", *arguments)
            self.assertEqual({row["scenario"] for row in rows}, {"my (a)", "my (b)"})
            for row in rows:
                self.assertIn(row["run"], of_folder[row["scenario"][4]])
        self.assertEqual([(g["scenario"], g["count"]) for g in self.rows("a", "b", "c", "--group", "scenario")],
                         [("my (a)", "6"), ("my (b)", "2")], "c has the scenario of a")
        self.assertEqual({(row["folder"], row["scenario"]) for row in self.rows("a", "b", "c")},
                         {("a", "my (a)"), ("b", "my (b)"), ("c", "my (a)")})
        self.assertRegex(self.said("a", "b", "--limit", "9"), r"\A *run +folder +scenario +")
        self.assertEqual(len(self.rows("a", "b", "--where", "scenario == 'my'")), 4, "conditions take the name")
        # Where no names collide, they stay as they are.
        self.assertEqual({row["scenario"] for row in self.rows("best", "a", "c")}, {"my"})
        self.assertNotIn("scenario", self.said("a", "c", "--limit", "9").splitlines()[0])
        self.assertIn("  scenarios: my (2)\n", self.said("b"))

    # rerun.

    def test_reruns_have_the_same_digits(self):
        one = self.top[4]["run"]
        self.assertEqual(self.said(one[:9], "results", program="rerun").count("every digit is the same"), 1)
        self.assertIn("32 of 32 runs repeated: 32 the same, 0 different, 0 not repeated\n", self.said("--all", program="rerun"))
        self.assertIn("5 of 5 runs repeated: 5 the same", self.said("--random", "5", "--seed", "3", "results/lanes", program="rerun"))
        self.assertIn("no run ffffffff… in", self.refused("ffffffff", program="rerun"))
        self.assertIn("is not the id of a run", self.refused("xyz", program="rerun"))
        self.assertIn("no run is named", self.refused(program="rerun"))

    def test_a_run_whose_id_is_not_that_of_its_row_is_not_compared(self):
        folder = self.copy("without_source")
        change(folder, "DELETE FROM scenarios WHERE name = 'lagrange_top'")
        done = call("rerun", "--all", "without_source", folder=self.folder, status=3)
        lost = sum(r["scenario"] == "lagrange_top" for r in self.top)
        self.assertIn(f"{len(self.top) - lost} the same, 0 different, {lost} not repeated", done.stdout)
        self.assertIn("not repeated: the store does not have its scenario lagrange_top, or it is damaged", done.stderr)

    # explain.

    def test_explain_names_the_keys(self):
        chance = random.Random(5)
        for _ in range(5):
            a, b = chance.sample(self.top, 2)
            text = self.said(a["run"], b["run"], program="explain")
            keys = set(re.findall(r"^(\S+)  ", text, re.M))
            options = {k for k in ("scenario", "integrator", "dt_s", "tolerance") if a[k] != b[k]}
            self.assertEqual(options, keys & {"scenario", "integrator", "dt_s", "tolerance"}, text)
        lanes = [row["run"] for row in read(self.folder / "results/lanes/runs.csv")]
        text = self.said(lanes[0], lanes[-1], "results/top", "results/lanes", program="explain")
        self.assertRegex(text, r"body\.0\.angular_velocity\.1 +1\.0 +5\.0\n1 key differs|body\.0\.angular_velocity\.1 +1 +5\n1 key differs")
        self.assertEqual(self.said(lanes[0], lanes[0], program="explain"), "the same run\n")
        one = self.said(lanes[0], program="explain")
        for words in ("results version ", "scenario text ", "integrator ", "dt_s ", "body.0.angular_velocity.1 "):
            self.assertIn(f"\n{words}", one)
        self.assertIn("\nbody mass=", one)


if __name__ == "__main__":
    unittest.main()
