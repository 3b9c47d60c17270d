# SPDX-License-Identifier: BSD-3-Clause
"""The experiment `convergence` as a user meets it: a small study, its orders.csv, its tables and its report."""
import re
import unittest

from programs import call, read, temporary_folder

SMALL = ["--scenario", "hairer_vilmart,peters_hsu,kovalevskaya_top", "--integrator", "explicit_euler,rk4,cvode_adams",
         "--dt", "0.1,0.05,0.025,0.0125,0.00625,0.003125,0.0015625,0.00078125", "--tolerance", "1e-4,1e-6,1e-8,1e-10",
         "--angular-state", "velocity_world,velocity_body"]


class Convergence(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls.addClassCleanup)
        cls.out = cls.folder / "out"
        cls.printed = cls.run_program(*SMALL, "--out", cls.out).stdout
        cls.rows = read(cls.out / "orders.csv")

    @classmethod
    def run_program(cls, *arguments, status=0):
        return call("convergence", *arguments, folder=cls.folder, status=status)

    def row(self, method, scenario, error="attitude_error_max_rad", state="velocity_body"):
        found = [r for r in self.rows if r["integrator"] == method and r["scenario"] == scenario
                 and r["error_of"] == error and r["angular_state"] == state]
        self.assertEqual(len(found), 1, f"{method} on {scenario}")
        return found[0]

    def test_orders_are_the_declared_ones(self):
        for method, order in (("explicit_euler", 1), ("rk4", 4)):
            for state in ("velocity_world", "velocity_body"):
                row = self.row(method, "hairer_vilmart", state=state)
                self.assertEqual(row["verdict"], "as declared", row)
                self.assertEqual(row["declared_order"], str(order))
                self.assertAlmostEqual(float(row["observed_order"]), order, delta=0.25)
                low, high = float(row["confidence_95_low"]), float(row["confidence_95_high"])
                self.assertLess(low, float(row["observed_order"]))
                self.assertGreater(high, float(row["observed_order"]))
                self.assertGreaterEqual(int(row["points"]), 4)

    def test_every_point_is_accounted_for(self):
        for row in self.rows:
            steps = 4 if row["against"] == "tolerance" else 8
            dropped = sum(int(row[c]) for c in ("left_out_lost", "left_out_round_off", "left_out_not_straight"))
            self.assertEqual(int(row["points"]) + dropped, steps, row)

    def test_an_adaptive_method_is_set_against_its_tolerance(self):
        row = self.row("cvode_adams", "hairer_vilmart")
        self.assertEqual((row["against"], row["declared_order"]), ("tolerance", "1"))
        self.assertEqual((row["step_smallest_s"], row["tolerance_smallest"]), ("", "1e-10"))
        self.assertGreater(float(row["observed_order"]), 0.5)

    def test_a_parabola_is_exact_to_a_high_order(self):
        self.assertEqual(self.row("rk4", "peters_hsu", "position_error_max_m")["verdict"], "exact here")
        euler = self.row("explicit_euler", "peters_hsu", "position_error_max_m")
        self.assertAlmostEqual(float(euler["observed_order"]), 1, delta=0.01)

    def test_a_body_that_stays_where_it_is_has_no_order_of_its_position(self):
        self.assertFalse([r for r in self.rows if r["scenario"] == "hairer_vilmart" and r["error_of"].startswith("pos")])

    def test_with_joints_velocities_and_reactions_have_orders_of_their_own(self):
        out = self.folder / "joints"
        self.run_program("--scenario", "double_pendulum", "--integrator", "rk4,shake,rattle,half_explicit4,generalized_alpha_index2",
                         "--dt", "0.02,0.01,0.005,0.0025,0.00125", "--t-end", "0.5", "--reference", "--out", out)
        reactions = {"rk4": 4, "shake": 2, "rattle": 1, "half_explicit4": 2, "generalized_alpha_index2": 2}
        motion = {**reactions, "rattle": 2, "half_explicit4": 4}
        rows = {(r["integrator"], r["error_of"]): r for r in read(out / "orders.csv")}
        for column, orders in (("velocity_error_max_m_per_s", motion), ("joint_reaction_error_max_N", reactions)):
            for method, order in orders.items():
                row = rows[method, column]
                self.assertEqual((row["declared_order"], row["verdict"]), (str(order), "as declared"), row)
                self.assertAlmostEqual(float(row["observed_order"]), order, delta=0.15)

    def test_what_has_no_exact_solution_is_named(self):
        self.assertFalse([r for r in self.rows if r["scenario"] == "kovalevskaya_top"])
        self.assertIn("No error was measured on kovalevskaya_top", self.printed)

    def test_report_tables_and_terminal_say_the_same(self):
        report = (self.out / "report.html").read_text(encoding="utf-8")
        words = re.sub(r"<[^>]*>", "", report)
        sentence = re.search(r"\d of 2 methods with a declared order (is|are) as declared .*?\.", self.printed)[0]
        self.assertIn(sentence, words)
        self.assertIn("Observed order", words)
        self.assertIn('href="orders.csv"', report)
        self.assertIn('id="error_against_step"', report)
        observed = f"{float(self.row('rk4', 'hairer_vilmart')['observed_order']):.2f}"
        for text in (self.printed, (self.out / "tables/orders.md").read_text(encoding="utf-8"),
                     (self.out / "tables/orders.tex").read_text(encoding="utf-8"), words):
            self.assertIn(observed, text)

    def test_the_same_input_gives_the_same_bytes(self):
        again = self.folder / "again"
        self.run_program(*SMALL, "--jobs", "1", "--out", again)
        for name in ("orders.csv", "tables/orders.md", "tables/orders.tex", "figures/error_against_step.svg"):
            self.assertEqual((again / name).read_bytes(), (self.out / name).read_bytes(), name)

    def test_without_the_gyroscopic_term_there_is_no_order(self):
        out = self.folder / "off"
        printed = self.run_program("--scenario", "hairer_vilmart", "--integrator", "rk4", "--dt", "0.1,0.05,0.025",
                                   "--gyroscopic", "off", "--no-figures", "--out", out).stdout
        self.assertEqual(len((out / "orders.csv").read_text(encoding="utf-8").splitlines()), 1, "the header alone")
        self.assertIn("solve another equation", printed)

    def test_one_step_shows_no_order(self):
        out = self.folder / "one"
        printed = self.run_program("--scenario", "hairer_vilmart", "--integrator", "rk4", "--dt", "0.1", "--no-figures",
                                   "--out", out).stdout
        self.assertIn("not seen: too few points", printed)


if __name__ == "__main__":
    unittest.main()
