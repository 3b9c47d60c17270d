# SPDX-License-Identifier: BSD-3-Clause
"""Every paper: its study runs, and each number of its expected.csv comes out as given.

POLHODE_BIN_DIR is the folder of the experiments.
"""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("POLHODE_BIN_DIR", "."))
NAMES = sorted(p.parent.name for p in ROOT.glob("papers/*/study.toml"))


class Papers(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="polhode_paper_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_paper(self, paper, status):
        done = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "scripts/paper.py"), str(BIN), str(paper), "--out",
                               str(self.folder / "out"), "--no-figures"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def changed(self, old, new, file="expected.csv", name="detest_b5"):
        paper = self.folder / name
        shutil.copytree(ROOT / "papers" / name, paper)
        text = (paper / file).read_text(encoding="utf-8")
        self.assertIn(old, text)
        (paper / file).write_text(text.replace(old, new, 1), encoding="utf-8")
        return paper

    def test_there_are_papers(self):
        self.assertGreaterEqual(len(NAMES), 4)

    def test_each_is_reproduced(self):
        for name in NAMES:
            with self.subTest(name):
                folder = ROOT / "papers" / name
                for file in ("README.md", "expected.csv"):
                    self.assertTrue((folder / file).is_file(), file)
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                done = self.run_paper(folder, 0)
                self.assertNotIn("\nnot ", done.stdout)

    def test_a_number_that_is_not_reproduced_is_told(self):
        done = self.run_paper(self.changed("-0.93965707987292", "-0.93965707997292"), 3)
        self.assertIn("8 of 9 numbers as given", done.stdout)

    def test_a_row_that_picks_no_run_is_bad_input(self):
        self.assertIn("picks 0 rows of runs.csv", self.run_paper(self.changed("rkmk4,1e-3", "rkmk4,1e-4"), 2).stderr)

    def test_a_value_that_is_no_number_is_bad_input(self):
        done = self.run_paper(self.changed("-0.93965707987292", "much"), 2)
        self.assertIn("expected.csv, row 2: value must be a number", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_a_bound_from_below_counts(self):
        done = self.run_paper(self.changed("-0.93965707987292,1e-10,absolute", "-0.9,0,at_least"), 3)
        self.assertIn("at least -0.9", done.stdout)
        self.assertIn("8 of 9 numbers as given", done.stdout)

    def test_an_experiment_that_is_not_there_is_bad_input(self):
        done = self.run_paper(self.changed("\nsmall_steps,", "\nsmall_step,", name="simbenchmark_bouncing"), 2)
        self.assertIn("row 2: experiments.toml has no small_step", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_what_an_experiment_refuses_is_passed_on(self):
        self.run_paper(self.changed("--dt 1e-3", "--dt -1", "experiments.toml", "simbenchmark_bouncing"), 2)

    def test_a_quantity_of_the_motion_needs_the_motion(self):
        paper = self.changed("1e-3,,,,,,,angular_momentum_drift_max_rel,", "1e-3,,,,,,,impacts,", name="course_report")
        done = self.run_paper(paper, 2)
        self.assertIn("events.csv: No such file or directory; add --trajectory csv", done.stderr)

    def test_a_paper_names_the_experiments_that_it_needs(self):
        done = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "scripts/paper.py"), str(BIN),
                               str(ROOT / "papers/course_report"), "--programs"], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.split(), ["energy_drift", "narrow_phase"])

    def test_what_the_study_refuses_is_passed_on(self):
        self.run_paper(self.changed("dt = [1e-3", "dt = [-1e-3", "study.toml"), 2)


if __name__ == "__main__":
    unittest.main()
