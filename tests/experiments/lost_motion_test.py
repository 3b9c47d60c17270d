# SPDX-License-Identifier: BSD-3-Clause
"""Runs that break off, or end far from the motion, as a user of `energy_drift` meets them: no error, no praise."""
import re
import unittest

from programs import call, read, temporary_folder

ERRORS = ["position_error_max_m", "attitude_error_max_rad", "angular_velocity_error_max_rel", "polhode_phase_error_max_s",
          "polhode_phase_error_max_rad", "polhode_off_error_max_rel"]


class LostMotion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = call("energy_drift", "--scenario", "peters_hsu", "--integrator", "explicit_euler,rk4", "--dt", "0.2,0.5,1",
                           "--no-figures", "--out", cls.out, folder=cls.folder).stdout
        cls.runs = read(cls.out / "runs.csv")
        cls.page = re.sub(r"<[^>]*>", "", (cls.out / "report.html").read_text(encoding="utf-8"))

    def test_a_run_that_diverged_has_no_error(self):
        diverged = [r for r in self.runs if r["status"] == "diverged"]
        self.assertEqual(sorted((r["integrator"], float(r["dt_s"])) for r in diverged),
                         [("explicit_euler", 0.5), ("explicit_euler", 1), ("rk4", 0.5), ("rk4", 1)])
        for row in diverged:
            self.assertEqual([row[c] for c in ERRORS], [""] * len(ERRORS), row["integrator"])
        for line in self.printed.splitlines():
            if " diverged " in line:
                self.assertEqual(line.split()[-1], "-", "attitude rad")

    def test_a_run_that_ended_has_them(self):
        ended = [r for r in self.runs if r["status"] == "ok"]
        self.assertEqual({r["integrator"] for r in ended}, {"explicit_euler", "rk4"})
        for row in ended:
            self.assertGreater(float(row["attitude_error_max_rad"]), 1, row["integrator"])

    def test_nothing_is_praised_where_no_run_follows_the_motion(self):
        self.assertNotIn("least attitude error", self.page)
        self.assertIn("no run follows the motion: the attitude of rk4 and explicit_euler is off by more than a radian", self.page)
        self.assertLess(self.page.index("No run follows the motion of peters_hsu"), self.page.index("rk4 has the least energy drift"))
        self.assertIn(", but does not follow the motion) and explicit_euler the most", self.page)


if __name__ == "__main__":
    unittest.main()
