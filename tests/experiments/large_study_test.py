# SPDX-License-Identifier: BSD-3-Clause
"""A study with more runs than are held: what it writes, however it was carried out."""
import csv
import re
import subprocess
import time
import unittest

from programs import BIN, call, peak_memory, stored, temporary_folder
from shards_test import files

STUDY = ["--integrator", "rk4", "--dt", "0.01", "--t-end", "0.03", "--vary", "body.0.angular_velocity.1=1:5:101", "--vary",
         "body.0.angular_velocity.0=0.1:2:101", "--no-figures"]  # 10201 runs


class LargeStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.whole = cls.run_in("whole")
        cls.files = files(cls.folder / "whole/out")

    @classmethod
    def run_in(cls, place, *arguments, study=None):
        (cls.folder / place).mkdir(exist_ok=True)
        return call("energy_drift", *(study or STUDY), *arguments, "--out", "out", folder=cls.folder / place)

    def rows(self):
        with open(self.folder / "whole/out/runs.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_every_run_has_a_row_in_the_order_of_its_values(self):
        values = [(float(row["body.0.angular_velocity.0"]), float(row["body.0.angular_velocity.1"])) for row in self.rows()]
        self.assertEqual(len(values), 101 * 101)
        self.assertEqual(values, sorted(set(values)))

    def test_the_distributions_are_those_of_the_rows(self):
        rows = self.rows()
        with open(self.folder / "whole/out/distributions.csv", newline="") as file:
            found = list(csv.DictReader(file))
        self.assertIn("energy_drift_max_rel", [line["metric"] for line in found])
        for line in found:
            values = sorted(float(row[line["metric"]]) for row in rows if row[line["metric"]])
            self.assertEqual(int(line["runs"]), len(values))
            self.assertEqual((float(line["least"]), float(line["largest"])), (values[0], values[-1]))
            largest = next(row for row in rows if row["run"] == line["largest_in_run"])
            self.assertEqual(float(largest[line["metric"]]), values[-1])
            for share in (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99):
                exact = values[int(share * (len(values) - 1) + 0.5)]
                self.assertAlmostEqual(float(line[f"quantile_{share:g}"]), exact, delta=0.0101 * abs(exact))

    def test_the_page_and_the_terminal_tell_all_runs(self):
        page = self.files["report.html"].decode()
        self.assertIn("10201 runs, all completed.", page)
        self.assertIn("of evenly chosen motions; the study has 10201", page)
        self.assertIn("largest energy drift (relative)", self.whole.stdout)
        self.assertLess(len(page), 5_000_000)

    def test_shards_make_the_same_bytes(self):
        for k in (1, 2):
            self.run_in("parts", "--shard", f"{k}/2")
        self.run_in("parts", "--merge")
        self.assertEqual(files(self.folder / "parts/out"), self.files)

    def test_runs_that_finish_in_another_order_than_the_plans_make_the_same_bytes(self):
        """The longest runs are carried out first; made again, all runs are read back from the store."""
        study = ["--integrator", "explicit_euler,rk4", "--dt", "0.01,0.03", "--t-end", "0.06", "--vary",
                 "body.0.angular_velocity.1=1:5:4500", "--no-figures"]  # 18000 runs, of which 9000 wait
        self.run_in("ordered", study=study)
        first, out = files(self.folder / "ordered/out"), self.folder / "ordered/out"
        (out / "runs.csv").unlink()
        (out / "timings.csv").rename(out / "before.csv")
        self.run_in("ordered", study=study)
        self.assertEqual((out / "timings.csv").read_bytes(), (out / "before.csv").read_bytes())
        (out / "before.csv").unlink()
        self.assertEqual(files(out), first)

    def test_a_kill_while_rows_are_written_loses_and_doubles_nothing(self):
        study = [{"0.01": "0.001", "0.03": "1"}.get(word, word) for word in STUDY]
        self.run_in("undisturbed", study=study)
        (self.folder / "killed").mkdir()
        out = self.folder / "killed/out"
        rows = out / "runs.csv.new"
        with subprocess.Popen([BIN / "energy_drift", *study, "--out", "out"], cwd=self.folder / "killed",
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            while process.poll() is None and not (rows.exists() and rows.stat().st_size > 0 and stored(out) > 0):
                time.sleep(0.001)
            process.kill()
        self.assertEqual(process.returncode, -9, "it ended before it was killed")
        self.assertRegex(self.run_in("killed", study=study).stderr, r"\d+ of 10201 runs are there already")
        self.assertEqual(files(out), files(self.folder / "undisturbed/out"))

    def test_memory_hardly_grows_with_the_number_of_runs(self):
        """A run of two steps is carried out faster than it is stored, and one axis has all the values."""
        if b"__asan_init" in (BIN / "energy_drift").read_bytes():
            self.skipTest("skipped, because AddressSanitizer keeps memory that was freed")

        def peak(runs):
            return peak_memory("energy_drift", "--scenario", "dzhanibekov", "--integrator", "rk4", "--dt", "1e-3", "--t-end", "2e-3", "--vary",
                               f"body.0.angular_velocity.1=1:5:{runs}", "--no-figures", "--out", self.folder / str(runs))

        few, many = 20_000, 200_000
        self.assertLess((peak(many) - peak(few)) * 1024 / (many - few), 400, "bytes for each further run")

    def test_a_study_that_grew_carries_out_what_is_new(self):
        fewer = [word.replace("1:5:101", "1:5:51") for word in STUDY]  # every other value
        self.run_in("grown", study=fewer)
        said = self.run_in("grown")
        there = re.search(r"(\d+) of 10201 runs are there already", said.stderr)
        self.assertGreater(int(there[1]), 5000)  # of 5151, but for those that now keep curves
        self.assertEqual(files(self.folder / "grown/out"), self.files)


if __name__ == "__main__":
    unittest.main()
