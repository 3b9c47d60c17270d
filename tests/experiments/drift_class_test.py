# SPDX-License-Identifier: BSD-3-Clause
"""What the programs say of the growth of a drift: nothing of round-off, and of what is undecided the duration that decides.

POLHODE_BIN_DIR is the folder of energy_drift. Every test works in its own temporary folder.
"""
import html
import re
import unittest

from programs import call, read, temporary_folder

GROWING = {"random walk", "sublinear", "linear", "quadratic", "faster"}
CONTACT = ["--broad-phase", "sweep_and_prune", "--response", "sequential_impulses"]


class DriftClassTest(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)
        self.count = 0

    def study(self, *arguments):
        """The rows of runs.csv, the text of the report, and the terminal's."""
        self.count += 1
        out = self.folder / f"out{self.count}"
        done = call("energy_drift", *arguments, "--no-figures", "--out", str(out), folder=self.folder)
        report = html.unescape(re.sub("<[^>]+>", "", (out / "report.html").read_text()))
        return read(out / "runs.csv"), report, done.stdout

    def sentence(self, report, start):
        """The sentence of the report that starts so, or an empty one."""
        found = re.search(re.escape(start) + r"[^\n]*", report)
        return found.group(0) if found else ""

    def check(self, rows):
        """What holds of every row."""
        for row in rows:
            kind = row["drift_class"]
            with self.subTest(method=row["integrator"], dt=row["dt_s"], kind=kind):
                if float(row["energy_drift_max_J"]) <= float(row["energy_round_off_J"]):
                    self.assertEqual(kind, "round-off")
                self.assertEqual(row["drift_exponent"] != "", kind in GROWING | {"bounded"})
                self.assertEqual(row["drift_exponent_low"] != "", kind in GROWING | {"bounded"})
                if row["drift_decided_after_s"]:
                    self.assertEqual(kind, "undecided")
                    self.assertGreater(float(row["drift_decided_after_s"]), float(row["t_end_s"]))

    def test_the_first_study_calls_no_rounding_growth(self):
        rows, report, _ = self.study()
        self.check(rows)
        classes = {}
        for row in rows:
            classes.setdefault(row["integrator"], set()).add(row["drift_class"])
        self.assertEqual(classes["dmv"], {"round-off"})
        self.assertEqual(classes["explicit_euler"], {"linear"})
        self.assertLessEqual(classes["rk4"], {"round-off", "undecided"})
        for start in ("The energy drift grows", "It grows"):
            for line in re.findall(re.escape(start) + r"[^\n]*", report):
                self.assertNotIn("dmv", line)
                self.assertNotIn("rk4", line)
        kept = self.sentence(report, "Energy over the runs:")
        self.assertRegex(kept, r"kept to round-off by dmv\b")
        self.assertRegex(self.sentence(report, "It never leaves round-off"), r"\bdmv\b")
        self.assertIn("would decide", report)

    def test_an_undecided_run_shows_the_duration_that_decides_and_that_does(self):
        study = ["--scenario", "dzhanibekov", "--integrator", "lie_midpoint,implicit_midpoint", "--dt", "0.02"]
        rows, report, terminal = self.study(*study)
        self.check(rows)
        self.assertEqual([row["drift_class"] for row in rows], ["undecided", "undecided"])
        self.assertRegex(terminal, r"undecided \(try \d+ s\)")
        self.assertEqual(self.sentence(report, "It grows"), "")
        self.assertNotIn("gained by", report)
        longer = max(float(row["drift_decided_after_s"]) for row in rows)
        rows, report, _ = self.study(*study, "--t-end", str(round(longer / 240 + 0.5) * 240))
        self.check(rows)
        self.assertEqual([row["drift_class"] for row in rows], ["bounded", "bounded"])
        self.assertIn("The energy drift stays bounded in 2 runs", report)
        self.assertIn("neither gained nor lost for good", report)

    def test_a_ball_dropped_from_rest_keeps_its_energy_to_round_off(self):
        scenario = self.folder / "drop.toml"
        scenario.write_text('title = "Dropped"\ngravity = [0.0, 0.0, -9.81]\nt_end = 10.0\n[[body]]\nname = "ball"\nmass = 1.0\n'
                            'shape = { kind = "sphere", radius = 0.1 }\n')
        rows, report, _ = self.study("--scenario", scenario, "--integrator", "rk4,velocity_verlet,gauss4",
                                     "--dt", "1e-4,1e-3,1e-2,3e-2")
        self.check(rows)
        self.assertEqual({row["drift_class"] for row in rows}, {"round-off"})
        self.assertNotIn("grows", self.sentence(report, "The energy drift"))

    def test_impacts_and_lost_motions_are_no_growth(self):
        rows, report, _ = self.study("--scenario", "newtons_cradle,bouncing_ball", "--dt", "1e-3,1e-2",
                                     "--integrator", "explicit_euler,semi_implicit_euler,rk4", *CONTACT)
        self.check(rows)
        for row in rows:
            self.assertNotIn(row["drift_class"], GROWING)
        rows, report, _ = self.study("--scenario", "two_bodies", "--integrator", "explicit_euler", "--dt", "0.01,0.05")
        self.assertEqual({row["drift_class"] for row in rows}, {"saturated"})
        self.assertIn("as large as the energy that moves", report)


if __name__ == "__main__":
    unittest.main()
