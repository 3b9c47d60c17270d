# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `precision` as a user meets it: rounding told from truncation, compensated summation, Brouwer's law."""
import re
import unittest

from programs import BIN, call, read, temporary_folder

STEPS = "0.125,0.0625,0.03125,0.015625,0.0078125,0.00390625"
SMALL = ["--integrator", "rk4", "--dt", STEPS, "--t-end", "128"]
TINY = ["--scenario", "dyadic_top", "--integrator", "odeint_rk4,odeint_adams_bashforth_moulton", "--dt",
        "0.0625,0.03125,0.015625,0.0078125", "--vary", "body.0.angular_velocity.2=0.5,0.75,0.625", "--t-end", "32"]


class Precision(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = cls.run_program(*SMALL, "--out", cls.out).stdout
        cls.runs, cls.rounding, cls.growth = (read(cls.out / name) for name in ("runs.csv", "rounding.csv", "growth.csv"))

    @classmethod
    def run_program(cls, *arguments, status=0):
        return call("precision", *arguments, folder=cls.folder, status=status)

    @staticmethod
    def one(rows, **wanted):
        found = [r for r in rows if all(r[k] == v for k, v in wanted.items())]
        if len(found) != 1:
            raise AssertionError(f"{len(found)} rows of {wanted}")
        return found[0]

    def ladder(self, precision, summation, method="rk4", error="attitude_error_max_rad"):
        return self.one(self.rounding, integrator=method, precision=precision, summation=summation, error_of=error)

    def test_truncation_has_the_order_of_the_method(self):
        for precision in ("double", "long_double"):
            for summation in ("plain", "compensated"):
                row = self.ladder(precision, summation)
                self.assertAlmostEqual(float(row["order"]), 4, delta=0.25, msg=row)
                low, high = float(row["confidence_95_low"]), float(row["confidence_95_high"])
                self.assertLess(low, high)

    def test_rounding_takes_over_in_float_far_before_double(self):
        single, double = self.ladder("float", "plain"), self.ladder("double", "plain")
        at = float(single["rounding_takes_over_at"])
        self.assertGreaterEqual(at, 0.03125)
        if double["rounding_takes_over_at"]:
            self.assertLess(float(double["rounding_takes_over_at"]), at / 8)
        self.assertLess(float(double["least_error"]), 1e-5 * float(single["least_error"]))

    def test_the_floor_of_float_rises_as_the_steps_become_more(self):
        energy = self.ladder("float", "plain", error="energy_drift_max_rel")
        self.assertAlmostEqual(float(energy["rounding_power_of_step"]), -0.5, delta=0.25)
        self.assertGreater(float(energy["least_error_at"]), 0.01, "the least drift is not at the smallest step")

    def test_compensated_summation_lowers_the_floor(self):
        for error, factor in (("attitude_error_max_rad", 10), ("energy_drift_max_rel", 5)):
            plain, compensated = (self.ladder("float", summation, error=error) for summation in ("plain", "compensated"))
            self.assertLess(factor * float(compensated["least_error"]), float(plain["least_error"]))
        self.assertRegex(self.printed, r"rk4: compensated summation brings in float the attitude error from")

    def test_there_is_nothing_against_which_to_tell_the_highest_precision(self):
        row = self.ladder("long_double", "plain")
        self.assertEqual(row["rounding_takes_over_at"], "")
        self.assertIn("There is no higher precision", self.printed)

    def test_brouwers_law_is_seen(self):
        row = self.one(self.growth, integrator="rk4", precision="float", summation="plain", growth_of="energy_drift_rel")
        self.assertEqual(row["growth"], "random walk")
        self.assertGreaterEqual(int(row["runs"]), 40)
        low, high = float(row["confidence_95_low"]), float(row["confidence_95_high"])
        self.assertLess(high - low, 0.4)
        self.assertGreater(low, 0.25)
        self.assertLess(high, 0.75)
        attitude = self.one(self.growth, integrator="rk4", precision="float", summation="plain",
                            growth_of="attitude_error_rad")
        self.assertAlmostEqual(float(attitude["exponent"]), 1.5, delta=0.25)
        still = self.one(self.growth, integrator="rk4", precision="float", summation="compensated",
                         growth_of="energy_drift_rel")
        self.assertEqual(still["growth"], "bounded")
        self.assertIn("Brouwer’s law is seen", self.printed)

    def test_the_least_error_is_that_of_the_runs(self):
        row = self.ladder("float", "plain")
        errors = [float(r["attitude_error_max_rad"]) for r in self.runs
                  if r["integrator"] == "rk4" and r["precision"] == "float" and r["summation"] == "plain"
                  and r["dt_s"] == row["least_error_at"]]
        self.assertEqual(len(errors), 12)
        mean = (sum(e * e for e in errors) / len(errors)) ** 0.5
        self.assertAlmostEqual(float(row["least_error"]) / mean, 1, delta=1e-12)

    def test_report_tables_and_figures(self):
        report = (self.out / "report.html").read_text(encoding="utf-8")
        for part in ("Rounding and truncation", 'id="error_against_step_by_precision"', 'id="rounding_against_time"',
                     'href="rounding.csv"', 'href="growth.csv"', "Brouwer"):
            self.assertIn(part, report)
        words = re.sub(r"<[^>]*>", "", report)
        self.assertIn(re.search(r"rk4: rounding takes over in float from .*?\)", self.printed)[0], words)
        self.assertIn("compensated", (self.out / "tables/growth.md").read_text(encoding="utf-8"))

    def test_the_same_input_gives_the_same_bytes(self):
        first, second = self.folder / "first", self.folder / "second"
        names = ("runs.csv", "rounding.csv", "growth.csv", "tables/rounding.md", "figures/rounding_against_time.svg")
        self.run_program(*TINY, "--out", first)
        self.run_program(*TINY, "--jobs", "1", "--out", second)
        kept = {name: (first / name).read_bytes() for name in names}
        for name in names:
            self.assertEqual((second / name).read_bytes(), kept[name], name)
        self.run_program(*TINY, "--no-figures", "--out", first)  # from its store
        for name in names:
            self.assertEqual((first / name).read_bytes(), kept[name], name)
        growth = read(first / "growth.csv")
        for method in ("odeint_rk4", "odeint_adams_bashforth_moulton"):
            self.one(growth, integrator=method, precision="float", summation="plain", growth_of="attitude_error_rad")

    def test_plain_summation_is_what_a_run_always_was(self):
        one = ["--scenario", "hairer_vilmart", "--integrator", "rk4", "--dt", "0.1", "--precision", "double", "--samples",
               "10", "--t-end", "1", "--no-figures"]
        study = self.folder / "energy_drift"
        self.run_program(*one, "--out", study)
        rows = read(study / "runs.csv")
        self.assertEqual([r["summation"] for r in rows], ["compensated", "plain"])
        if not (BIN / "energy_drift").exists():
            self.skipTest("energy_drift is not built")
        unnamed = self.folder / "unnamed"
        call("energy_drift", *one, "--angular-state", "velocity_body", "--out", unnamed, folder=self.folder)
        row, = read(unnamed / "runs.csv")
        self.assertNotIn("summation", row, "no column where nobody asks")
        self.assertEqual(row["run"], rows[1]["run"])
        self.assertNotEqual(row["run"], rows[0]["run"])

    def test_what_cannot_be_compensated_says_why(self):
        for method, setting, reason in (("rkmk4", ["--dt", "0.1"], "not the sum of the state and an increment"),
                                        ("odeint_dopri5", ["--tolerance", "1e-6"], "a fixed step")):
            done = self.run_program("--integrator", method, *setting, "--summation", "compensated", "--samples", "10",
                                    "--t-end", "1", "--out", self.folder / "refused", status=2)
            self.assertIn(reason, done.stderr)
            self.assertIn(method, done.stderr)
            self.assertFalse((self.folder / "refused").exists())

    def test_odeints_controlled_methods_work_in_three_precisions(self):
        out = self.folder / "controlled"
        self.run_program("--integrator", "odeint_dopri5,odeint_fehlberg78", "--tolerance", "1e-3,1e-4,1e-5,1e-6", "--summation",
                         "plain", "--t-end", "16", "--samples", "16", "--no-figures", "--out", out)
        runs = read(out / "runs.csv")
        self.assertEqual({r["status"] for r in runs}, {"ok"})
        self.assertEqual({r["precision"] for r in runs}, {"float", "double", "long_double"})
        low = self.run_program("--integrator", "odeint_dopri5", "--tolerance", "1e-9", "--precision", "float", "--summation",
                               "plain", "--out", self.folder / "low", status=2)
        self.assertIn("a tolerance of 1e-09 is below", low.stderr)


if __name__ == "__main__":
    unittest.main()
