# SPDX-License-Identifier: BSD-3-Clause
"""--reference: errors where no exact solution is known, by a motion that proves its digits or says that it cannot.

POLHODE_BIN_DIR is the folder of energy_drift. Every test works in its own temporary folder.
"""
import json
import math
import unittest

from programs import call, read, temporary_folder

SPRING = ["--scenario", "spring_box", "--integrator", "rk4", "--t-end", "2"]
ERRORS = ["position_error_max_m", "attitude_error_max_rad", "angular_velocity_error_max_rel"]
REFERENCES = ["position_reference_m", "attitude_reference_rad", "angular_velocity_reference_rel"]


class ReferenceTest(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self.addCleanup)
        self.count = 0

    def run_drift(self, *arguments, status=0):
        return call("energy_drift", *arguments, folder=self.folder, status=status)

    def study(self, *arguments):
        """The rows of runs.csv, and the folder."""
        self.count += 1
        out = self.folder / f"out{self.count}"
        self.run_drift(*arguments, "--no-figures", "--out", str(out))
        return read(out / "runs.csv"), out

    def test_runs_without_it_are_as_ever(self):
        rows, out = self.study(*SPRING, "--dt", "0.01")
        self.assertFalse(set(REFERENCES) & set(rows[0]))
        self.assertEqual([rows[0][e] for e in ERRORS], ["", "", ""])
        self.assertNotIn("references", json.loads((out / "manifest.json").read_text()))
        self.assertIn("No exact solution is known for spring_box", (out / "report.html").read_text())
        with_it, _ = self.study(*SPRING, "--dt", "0.01", "--reference")
        self.assertNotEqual(rows[0]["run"], with_it[0]["run"])

    def test_errors_fall_with_the_order_of_rk4(self):
        for scenario in ("spring_box", "lagrange_top", "kovalevskaya_top", "two_bodies"):
            rows, _ = self.study("--scenario", scenario, "--integrator", "rk4", "--t-end", "2", "--dt", "0.005,0.0025,0.00125",
                                 "--reference")
            error = "position_error_max_m" if scenario == "two_bodies" else "attitude_error_max_rad"
            values = [float(row[error]) for row in sorted(rows, key=lambda row: -float(row["dt_s"]))]
            for coarse, fine in zip(values, values[1:]):
                self.assertAlmostEqual(math.log2(coarse / fine), 4, delta=0.35, msg=f"{scenario}: {values}")

    def test_it_is_in_manifest_and_report(self):
        rows, out = self.study(*SPRING, "--dt", "0.01,0.005", "--reference")
        (entry,) = json.loads((out / "manifest.json").read_text())["references"]
        self.assertEqual((entry["scenario"], entry["varied"], entry["t_end_s"]), ("spring_box", {}, 2.0))
        for reference, error in zip(REFERENCES, ERRORS):
            self.assertLess(entry[reference], 1e-14)
            for row in rows:
                self.assertEqual(float(row[reference]), entry[reference])
                self.assertGreater(float(row[error]), 100 * entry[reference])
        report = (out / "report.html").read_text()
        self.assertIn("in its place stands a reference in extended precision", report)
        self.assertNotIn("No exact solution is known for spring_box", report)

    # Where the exact solution is known it is used, and nothing is said of a reference.
    def test_the_exact_motion_goes_first(self):
        arguments = ["--scenario", "peters_hsu,two_bodies,lagrange_top,physical_pendulum,oscillator", "--integrator", "rk4",
                     "--t-end", "1", "--dt", "0.01"]
        plain, _ = self.study(*arguments)
        rows, out = self.study(*arguments, "--reference")
        for a, b in zip(plain, rows):
            self.assertEqual([a[e] for e in ERRORS], [b[e] for e in ERRORS])
            self.assertTrue(a["attitude_error_max_rad"])
            self.assertEqual([b[r] for r in REFERENCES], ["", "", ""])
        self.assertEqual(json.loads((out / "manifest.json").read_text())["references"], [])

    def test_a_chaotic_motion_has_no_errors_and_says_why(self):
        rows, out = self.study("--scenario", "spring_box", "--vary", "force.0.stiffness=400", "--integrator", "rk4",
                               "--dt", "0.01", "--t-end", "400", "--reference")
        row = rows[0]
        self.assertEqual(row["status"], "ok")
        self.assertEqual([row[e] for e in ERRORS], ["", "", ""])
        self.assertGreater(float(row["attitude_reference_rad"]), 0.01)
        self.assertIn("could not prove digits enough", (out / "report.html").read_text())

    # One thread or two, alone or in ensembles, in one go or in two: the same bytes.
    def test_same_study_same_bytes(self):
        arguments = ["--scenario", "spring_box", "--integrator", "rk4,explicit_midpoint", "--dt", "0.01", "--t-end", "1",
                     "--vary", "body.0.angular_velocity.1=1,2,3", "--reference"]
        _, one = self.study(*arguments, "--jobs", "1")
        _, two = self.study(*arguments, "--jobs", "2")
        self.assertEqual((one / "runs.csv").read_bytes(), (two / "runs.csv").read_bytes())
        first = list(arguments)
        first[first.index("body.0.angular_velocity.1=1,2,3")] = "body.0.angular_velocity.1=2"
        out = self.folder / "resumed"
        self.run_drift(*first, "--no-figures", "--out", str(out))
        self.run_drift(*arguments, "--no-figures", "--out", str(out))
        self.assertEqual((one / "runs.csv").read_bytes(), (out / "runs.csv").read_bytes())
        names = lambda folder: json.loads((folder / "manifest.json").read_text())["references"]
        self.assertEqual(len(names(one)), 3)
        self.assertEqual(names(one), names(out))

    def test_samples_and_steps_off_the_instants(self):
        plain, _ = self.study(*SPRING, "--dt", "0.01", "--reference")
        sampled, _ = self.study(*SPRING, "--dt", "0.01", "--samples", "200", "--reference")
        odd, _ = self.study(*SPRING, "--dt", "0.0101", "--reference")
        adaptive, _ = self.study("--scenario", "spring_box", "--t-end", "2", "--integrator", "cvode_adams", "--tolerance",
                                 "1e-10", "--reference")
        for error in ERRORS:
            self.assertGreaterEqual(float(sampled[0][error]), float(plain[0][error]))
            self.assertAlmostEqual(float(odd[0][error]) / float(plain[0][error]) / 1.01**4, 1, delta=0.15)
            self.assertLess(float(adaptive[0][error]), 1e-6)

    def test_a_study_file_may_ask_for_it(self):
        study = self.folder / "study.toml"
        lines = 'scenario = "spring_box"\nintegrator = "rk4"\ndt = 0.01\nt_end = 1\n'
        study.write_text(lines + "reference = true\n")
        rows, _ = self.study("--study", str(study))
        self.assertTrue(rows[0]["attitude_error_max_rad"])
        study.write_text(lines + "reference = 3\n")
        done = self.run_drift("--study", str(study), status=2)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)
        self.assertIn("must be true or false", done.stderr)
        self.assertIn("--reference", self.run_drift("--help").stdout)


if __name__ == "__main__":
    unittest.main()
