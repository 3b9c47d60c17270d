# SPDX-License-Identifier: BSD-3-Clause
"""Study files from the command line to the results: tables of points, random points, conditions, several studies."""
import json
import re
import unittest

from programs import call, read, temporary_folder

TWO = """
[defaults]
integrator = ["rk4", "cvode_adams"]
tolerance = 1e-6

[study.turns]
where = "dt < 0.15 or given(tolerance)"
[study.turns.zip]
dt = [0.05, 0.1, 0.2]
t_end = [1, 2, 3]
[study.turns.random]
n = 3
seed = 7
body.0.angular_velocity = { distribution = "sphere", radius = 3 }

[study.listed]
cells = "cells.csv"
"""
CELLS = "dt,t_end,body.0.mass\n0.05,1,\n0.1,2,4\n"
TURNS = ["--integrator", "rk4,cvode_adams", "--tolerance", "1e-6", "--zip", "dt=0.05,0.1,0.2 t_end=1,2,3", "--random",
         "n=3 seed=7 body.0.angular_velocity=sphere(3)", "--where", "dt < 0.15 or given(tolerance)"]


class StudyFiles(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)
        (self.folder / "two.toml").write_text(TWO)
        (self.folder / "cells.csv").write_text(CELLS)

    def drift(self, *arguments, status=0):
        return call("energy_drift", *arguments, "--no-figures", folder=self.folder, status=status)

    def test_the_dry_run_counts_cells_and_what_is_there(self):
        text = self.drift("--study", "two.toml", "--out", "out", "--dry-run").stdout
        self.assertIn("energy_drift: 19 runs, ", text)
        self.assertIn("turns: 18 cells, of which where leaves out 3\n", text)
        self.assertIn("listed: 4 cells\n", text)
        self.assertIn("  turns: zip of dt, t-end: 3 points: (0.05, 1), (0.1, 2), (0.2, 3)\n", text)
        self.assertRegex(text, r"  turns: random of body\.0\.angular_velocity: 3 points: \(\[")
        self.assertIn("  listed: cells of dt, t-end, body.0.mass: 2 points: (0.05, 1, ), (0.1, 2, 4)\n", text)
        self.assertNotIn("are there already", text)
        self.assertRegex(text, r"(?m)^about [\d.]+ s with \d+ jobs?[,:] ")
        self.assertFalse((self.folder / "out").exists())
        self.drift("--study", "two.toml:listed", "--out", "out")
        self.assertIn("4 of 4 runs are there already\n", self.drift("--study", "two.toml:listed", "--out", "out", "--dry-run").stdout)
        more = self.drift("--study", "two.toml", "--out", "out", "--dry-run").stdout
        self.assertIn("4 of 19 runs are there already\n", more)

    def test_one_study_of_a_file_is_that_of_the_command_line(self):
        self.drift("--study", "two.toml:turns", "--out", "file")
        self.drift(*TURNS, "--out", "line")
        self.assertEqual(len(read(self.folder / "file/runs.csv")), 15)
        for name in ("runs.csv", "tables/summary.md"):
            self.assertEqual((self.folder / "file" / name).read_bytes(), (self.folder / "line" / name).read_bytes())
        file, line = (json.loads((self.folder / out / "manifest.json").read_text()) for out in ("file", "line"))
        self.assertEqual(file["study"], line["study"])
        said = file["studies"][0]
        self.assertEqual(said.pop("name"), "turns")
        self.assertEqual(said["random"], ["n=3 seed=7 body.0.angular_velocity=sphere(3)"])
        self.assertEqual(said["where"], ["dt < 0.15 or given(tolerance)"])

    def test_defaults_give_conditions_and_the_columns_that_a_study_leaves_to_them(self):
        (self.folder / "shared.toml").write_text(
            "[defaults]\nintegrator = 'rk4'\nwhere = 'dt < 0.15'\n[defaults.zip]\ndt = [0.05, 0.1, 0.2]\nt_end = [1, 2, 3]\n"
            "[study.a]\n[study.b]\nt_end = 5\nwhere = 'dt > 0.07'\n")
        text = self.drift("--study", "shared.toml", "--out", "out", "--dry-run").stdout
        self.assertIn("energy_drift: 3 runs, ", text)
        self.assertIn("a: 3 cells, of which where leaves out 1\n", text)
        self.assertIn("b: 3 cells, of which where leaves out 2\n", text)

    def test_a_large_study_is_told_from_a_choice_of_its_cells_before_all_are_planned(self):
        text = self.drift("--integrator", "rk4,heun", "--t-end", "1", "--random", "n=60000 dt=uniform(0.1,0.2) body.0.mass=uniform(1,2)",
                          "--where", "dt < 0.15", "--out", "out", "--dry-run").stdout
        first = re.match(r"energy_drift: 120000 cells; by \d+ of them about (\d+) runs and (\S+) right-hand sides\nabout ", text)
        all_of_them = re.search(r"^energy_drift: (\d+) runs, about (\S+) right-hand sides, into out$", text, re.MULTILINE)
        self.assertTrue(first and all_of_them, text)
        for k in (1, 2):
            self.assertAlmostEqual(float(first[k]) / float(all_of_them[k]), 1, delta=0.05)
        few = self.drift("--integrator", "rk4", "--t-end", "1", "--dt", "0.1:0.2:1000", "--out", "out", "--dry-run").stdout
        self.assertNotIn("cells; by", few)

    def test_more_points_use_the_results_that_are_there(self):
        few = ["--integrator", "rk4", "--dt", "0.1", "--t-end", "1", "--random"]
        self.drift(*few, "n=5 body.0.mass=uniform(1,2)", "--out", "out")
        before = {row["run"]: row for row in read(self.folder / "out/runs.csv")}
        done = self.drift(*few, "n=50 body.0.mass=uniform(1,2)", "--out", "out")
        self.assertIn("5 of 50 runs are there already", done.stderr)
        after = {row["run"]: row for row in read(self.folder / "out/runs.csv")}
        self.assertEqual(len(after), 50)
        for run, row in before.items():
            self.assertEqual(after[run], row)

    def test_random_runs_are_those_of_every_platform(self):
        self.drift("--integrator", "rk4", "--dt", "0.1", "--t-end", "1", "--random",
                   "n=2 seed=7 body.0.mass=uniform(0.5,3)", "--out", "out")
        self.assertEqual({row["body.0.mass"] for row in read(self.folder / "out/runs.csv")}, {"2.1419296496399425", "2.5884286094920372"})

    def test_what_cannot_be_meant_is_refused_at_once(self):
        for words, number in ((["--dt", "1e-3:1e-1:1000000", "--t-end", "1:2:1000000"], "1000000000000 runs"),
                              (["--vary", "body.0.mass=1:2:1000000", "--vary", "body.0.velocity.0=1:2:1000000"], "6000000000000 runs"),
                              (["--random", "n=1000000000 dt=uniform(1,2)"], "1000000000 points")):
            message = self.drift("--integrator", "rk4", *words, status=2)
            self.assertRegex(message.stderr, r"\Aenergy_drift: [^\n]+\n\Z")
            self.assertIn(number, message.stderr)


if __name__ == "__main__":
    unittest.main()
